"""The farm of one run of ``burnish conform --scheduler``: Dask's workers, instead of processes.

``conform_run.py`` asks it as it asks ``judges.py``. Dask's scheduler hands tasks to workers, and
does those of a worker that has died once more elsewhere. Each subject is one task with one result,
whoever computes it and however often, so rows are neither lost nor doubled, and ``Gathering`` has
them in the usual order.
"""

from __future__ import annotations

import logging
import pickle
import uuid
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError, Future
from contextlib import suppress
from functools import partial
from importlib import import_module
from pathlib import Path
from threading import Event, RLock, Thread
from typing import TYPE_CHECKING, Any, NamedTuple

from ...compiler.budget import current
from ...targets.closing import Closing
from ..building.program import program
from ..compared import ConformRequest
from ..judge import Contents, Unit
from .calling import asking_ability, plugin, working
from .errors import FarmError
from .reading import inputs_of
from .sending import Ability, Parcel, contents_of

if TYPE_CHECKING:
    from ...targets.conformance.gathering import Work
    from ...targets.conformance.rows import Row
    from ...targets.runner.routes import Route

CONNECTING = 10.0
"""The seconds to wait for a scheduler, and for its first worker."""
ALONE = 60.0
"""The seconds to wait for another worker when all have gone; they may have been restarted."""
LOOKING = 1.0
"""The seconds after which the workers are counted again."""
CLOSING = 5.0
"""The seconds to wait until workers have been told that a run has ended."""
KILLED = "the workers that were given it have died, one after the other"
AHEAD = 2
"""The tasks that the scheduler has for each subject that is judged at once: nobody has to wait for
the next one, and few are lost with a worker."""

Tell = Callable[[str], None]
"""Called with a sentence about a worker."""


class _Waiting(NamedTuple):
    """A task that the scheduler has not been given yet."""

    name: str
    about: bytes
    killed: Callable[[], object]
    made: Future[Any]


class Farm(Closing):
    """The workers that take part in one run."""

    def __init__(
        self,
        address: str,
        request: ConformRequest,
        routes: Sequence[Route],
        tell: Tell,
        *,
        named: bool,
    ) -> None:
        """``named`` is true if the routes were named: then a worker has to be able to draw with all
        of them, and otherwise with those that any of the workers can draw with.

        Raises ``FarmError`` and ``CompileError``.
        """
        self._request, self._routes, self._tell = request, routes, tell
        folders, files = contents_of(inputs_of(request))
        self._key = f"burnish-{uuid.uuid4().hex}"
        self._lock, self._open = RLock(), dict[Any, Future[Any]]()
        self._waiting, self._size = deque[_Waiting](), 1
        self._ended, self._problem = Event(), ""
        self._known: set[str] = set()
        self._work = working()
        self._client = _connected(address)
        self._address = address
        try:
            self._needed = self._find_workers(routes, named=named)
            parcel = Parcel(
                program(), request, self._needed, str(Path.cwd()), folders, files, current()
            )
            self._begin(pickle.dumps(parcel))
            self._size = self.size
        except BaseException:
            self.close()
            raise
        self._watcher = Thread(target=self._watch, daemon=True)
        self._watcher.start()

    @property
    def size(self) -> int:
        """The number of subjects that are judged at once."""
        return max(1, sum(self._taking().values()))

    def contents(self, files: Iterable[Path]) -> Iterator[Contents]:
        """The contents of some files, in their order. Raises ``FarmError``."""
        begun: list[Future[Contents]] = [
            self._task("contents", file, partial(_unknown, file)) for file in files
        ]
        return (future.result() for future in begun)

    def begin(self, unit: Unit) -> Work:
        """Have a worker judge a subject, behind all with which others were asked to begin."""
        return self._task("rows", unit, partial(self._failed, unit))

    def close(self) -> None:
        """Take all tasks back, and let the workers go. Whoever waits gets a ``FarmError``."""
        self._ended.set()
        self._fail("the run has ended")
        with suppress(Exception):
            self._client.sync(self._leave, callback_timeout=CLOSING)
        with suppress(Exception):
            self._client.close(timeout=CLOSING)

    async def _leave(self) -> None:
        await self._client.scheduler.unregister_worker_plugin(name=self._key)

    def _find_workers(self, routes: Sequence[Route], *, named: bool) -> tuple[str, ...]:
        """Ask all workers what they can do; returns the routes that a worker has to have.

        Tells of those that do not fit. Raises ``FarmError`` if none does.
        """
        found = self._abilities()
        mine = program()
        able = {address: each for address, each in found.items() if isinstance(each, Ability)}
        same = [each for each in able.values() if each.program == mine]
        needed = tuple(
            route.name
            for route in routes
            if named or any(route.name not in each.lacking for each in same)
        )
        fit = self._told(found, needed)
        if not fit:
            raise FarmError(
                f"none of the workers of `{self._address}` can take part, and nothing was drawn"
            )
        return needed

    def _abilities(self, workers: Sequence[str] | None = None) -> Mapping[str, Ability | Exception]:
        """What workers can do, by address, or why they could not say so."""
        names = ",".join(route.name for route in self._routes).encode()
        try:
            said = self._client.run(asking_ability(), names, workers=workers, on_error="return")
        except (OSError, TimeoutError) as error:
            raise FarmError(f"the scheduler at `{self._address}` has gone: {error}") from error
        return {
            address: pickle.loads(each) if isinstance(each, bytes) else each
            for address, each in said.items()
        }

    def _told(self, found: Mapping[str, Ability | Exception], needed: Sequence[str]) -> int:
        """The number of workers that fit; a sentence tells of each other one, once."""
        fit = 0
        for address, each in found.items():
            problem = _problem(each, needed)
            fit += problem is None
            if problem is not None and address not in self._known:
                self._tell(f"the worker at {address} gets nothing: {problem}")
            self._known.add(address)
        return fit

    def _begin(self, packed: bytes) -> None:
        """Let all workers take part, also those that come later."""
        with suppress(ImportError):
            self._client.register_plugin(plugin(self._key, packed), name=self._key)

    def _task(self, name: str, about: object, killed: Callable[[], object]) -> Future[Any]:
        """Have a worker do a work; if workers die of it, ``killed`` makes the result or raises."""
        made: Future[Any] = Future()
        with self._lock:
            if self._problem:
                made.set_exception(FarmError(self._problem))
            else:
                self._waiting.append(_Waiting(name, pickle.dumps(about), killed, made))
        self._hand_out()
        return made

    def _hand_out(self) -> None:
        """Give tasks to the scheduler, as long as it has few.

        If a worker dies, Dask suspects all tasks that it has been given, and drops those that have
        been suspected several times. So none is given long before somebody has time for it.
        """
        with self._lock:
            while self._waiting and len(self._open) < AHEAD * self._size:
                name, packed, killed, made = self._waiting.popleft()
                task = self._client.submit(
                    self._work, name, self._key, packed, resources={self._key: 1}, pure=False
                )
                self._open[task] = made
                task.add_done_callback(partial(self._settle, killed))

    def _settle(self, killed: Callable[[], object], task: Any) -> None:
        """Hand the result of a task on; Dask calls this in a thread of its own."""
        from distributed import KilledWorker

        with self._lock:
            made = self._open.pop(task, None)
        if made is None:
            return  # The run has ended.
        self._hand_out()
        try:
            try:
                made.set_result(pickle.loads(task.result()))
            except KilledWorker:
                made.set_result(killed())
        except CancelledError:
            made.set_exception(FarmError(f"the scheduler at `{self._address}` has gone"))
        except Exception as error:  # Whatever a worker has raised.
            made.set_exception(error)

    def _failed(self, unit: Unit) -> Sequence[Row]:
        from ...targets.conformance.rows import Row

        return [Row(unit.label, route, "failed", KILLED) for route in self._routes]

    def _taking(self) -> Mapping[str, int]:
        """The workers that take part, each with the number of subjects that it judges at once."""
        workers = self._client.scheduler_info(n_workers=-1)["workers"]
        found = {name: int(row["resources"].get(self._key, 0)) for name, row in workers.items()}
        return {name: count for name, count in found.items() if count}

    def _watch(self) -> None:
        """Tell of workers that come later and do not fit; end the run if all have gone."""
        alone = 0.0
        while not self._ended.wait(LOOKING):
            try:
                alone = 0.0 if self._taking() else alone + LOOKING
                self._size = self.size
                self._hand_out()
                workers = self._client.scheduler_info(n_workers=-1)["workers"]
                if new := [name for name in workers if name not in self._known]:
                    self._told(self._abilities(new), self._needed)
            except Exception:  # The connection may be lost for a while, which counts.
                alone += LOOKING
            if alone >= ALONE:
                self._fail(f"all workers have gone, and none has come back for {ALONE:g} seconds")

    def _fail(self, problem: str) -> None:
        """Let all who wait for a result get an error."""
        with self._lock:
            self._problem = self._problem or problem
            waiting = [*self._open.values(), *(each.made for each in self._waiting)]
            self._open, self._waiting = {}, deque()
        for each in waiting:
            each.set_exception(FarmError(problem))


def _unknown(file: Path) -> None:
    """Say that the contents of a file are not known. Raises ``FarmError``."""
    raise FarmError(f"`{file}`: {KILLED}")


def _connected(address: str) -> Any:
    """A client of the scheduler at an address. Raises ``FarmError``."""
    distributed: Any = import_module("distributed")  # It has types for half of its functions.
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # Sentences say what matters.
    warnings.filterwarnings("ignore", module="distributed")
    try:
        client = distributed.Client(address, timeout=CONNECTING, set_as_default=False)
    except (OSError, TimeoutError) as error:
        raise FarmError(
            f"nobody answers at `{address}`: start a scheduler there with `dask scheduler`"
        ) from error
    except (ValueError, ImportError) as error:
        raise FarmError(
            f"`{address}` is no address of a scheduler, such as tcp://10.0.0.7:8786: {error}"
        ) from error
    try:
        client.wait_for_workers(1, timeout=CONNECTING)
    except (OSError, TimeoutError) as error:
        client.close()
        raise FarmError(
            f"the scheduler at `{address}` has no worker: start some with `dask worker {address}`"
        ) from error
    return client


def _problem(found: Ability | Exception, needed: Iterable[str]) -> str | None:
    """The reason why a worker does not fit; ``None`` if it does."""
    if not isinstance(found, Ability):
        if isinstance(found, ModuleNotFoundError):
            return f"it lacks the package `{found.name}`"
        return f"it could not say what it is: {found}"
    if found.program != program():
        return f"it has Burnish {_shown(found.program)}, and this is {_shown(program())}"
    for route in needed:
        if route in found.lacking:
            return f"it cannot draw with {route}: {found.lacking[route]}"
    return None


def _shown(name: str) -> str:
    """A version with the beginning of the digest of its code."""
    version, _, digest = name.partition("+")
    return f"{version} ({digest[:8]})"
