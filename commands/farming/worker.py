"""What a worker of a farm does for ``burnish conform``: it compiles and judges what it is sent.

A worker of Dask is one for each machine, with as many threads as this has processors: behind it are
the same processes and drivers that judge on a single machine (``judges.py``). Nothing is called
from outside but the functions here, by ``calling.py``; they take and give bytes.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Lock
from typing import TYPE_CHECKING, NoReturn

from ...compiler.budget import raised
from ...targets.runner.drivers.device import DriverError
from ...targets.runner.routes import select
from ...targets.runner.runner import Runner
from ...targets.toolchain import Toolchain
from ..building.program import program
from ..judge import Contents, Judge, Unit
from ..judges import Judges
from .sending import Ability, Parcel, unpacked

if TYPE_CHECKING:
    from ...targets.conformance.rows import Row


class _Nobody(Judge):
    """The judge of a worker itself, which leaves all work to processes.

    A crash there must not take the worker with it.
    """

    def contents(self, file: Path) -> NoReturn:
        """Say that no process could compile a file."""
        raise DriverError(f"no process could compile `{file}`: see what its worker prints")

    def rows(self, unit: Unit) -> Sequence[Row]:
        """The rows of a subject that no process could judge."""
        return self.failed(unit, "the processes that judged it have ended without an answer")


class _Session:
    """The part that a worker takes in one run."""

    def __init__(self, parcel: Parcel, threads: int) -> None:
        routes = select([parcel.request.routes])
        with ExitStack() as begun:
            root = begun.enter_context(TemporaryDirectory(prefix="burnish-farm-"))
            folder = unpacked(parcel, Path(root))
            runner = begun.enter_context(Runner(routes, device=parcel.request.device))
            toolchain = begun.enter_context(Toolchain(states=runner.states))
            here = _Nobody(parcel.request, routes, runner, toolchain)
            with raised(parcel.limits):
                judges = Judges(parcel.request, threads, here, runner, str(folder))
            self.judges = begun.enter_context(judges)
            self._open = begun.pop_all()

    def close(self) -> None:
        """End all processes, and delete all files."""
        self._open.close()


_SESSIONS: dict[str, _Session] = {}
_LOCK = Lock()


def ability(routes: bytes) -> bytes:
    """What this worker is, and which of some routes it can draw with: an ``Ability``."""
    chosen = select([routes.decode()])
    with Runner(chosen) as runner:
        problems = {route.name: runner.problem(route) for route in chosen}
    lacking = {name: problem for name, problem in problems.items() if problem is not None}
    return pickle.dumps(Ability(program(), lacking))


def begin(key: str, packed: bytes, threads: int) -> bool:
    """Take part in a run; false if this worker does not fit."""
    parcel: Parcel = pickle.loads(packed)
    found: Ability = pickle.loads(ability(parcel.request.routes.encode()))
    if found.program != parcel.program or not found.lacking.keys().isdisjoint(parcel.needed):
        return False
    end(key)
    with _LOCK:
        _SESSIONS[key] = _Session(parcel, threads)
    return True


def end(key: str) -> None:
    """Take no more part in a run."""
    with _LOCK:
        session = _SESSIONS.pop(key, None)
    if session is not None:
        session.close()


def contents(key: str, packed: bytes) -> bytes:
    """The contents of a file: its subjects, and what the compiler says."""
    file: Path = pickle.loads(packed)
    (found,) = _SESSIONS[key].judges.contents([file])
    assert isinstance(found, Contents)
    return pickle.dumps(found)


def rows(key: str, packed: bytes) -> bytes:
    """The rows of a subject."""
    unit: Unit = pickle.loads(packed)
    return pickle.dumps(_SESSIONS[key].judges.begin(unit).result())


WORKS: dict[str, Callable[[str, bytes], bytes]] = {"contents": contents, "rows": rows}
"""What a worker can be asked for, by name."""
