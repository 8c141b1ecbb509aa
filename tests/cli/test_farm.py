"""``burnish conform --scheduler``: workers of Dask judge, and some of them die."""

from __future__ import annotations

import json
import os
import signal
import socket
import sys
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future
from contextlib import ExitStack
from functools import partial
from importlib import import_module
from pathlib import Path
from threading import RLock
from typing import Any
from unittest.mock import Mock

import pytest
from distributed import KilledWorker

from burnish.commands.building.program import program
from burnish.commands.farming import farm
from burnish.commands.farming.errors import FarmError
from burnish.commands.farming.farm import Farm
from burnish.commands.farming.sending import Ability
from burnish.commands.judge import Unit

from ..suite.processes import LIMIT, Program, started, until
from .kit import invoke

pytestmark = pytest.mark.xdist_group("farm")  # One process starts the scheduler.

COUNT = 8
ROUTE = "lavapipe:glsl"
LINE = ("--routes", ROUTE)
IMPATIENT = """
from burnish.commands.farming import farm
farm.ALONE, farm.LOOKING = 0.4, 0.1
from burnish.commands.cli import main
main()
"""
"""Burnish that does not wait long for other workers."""

Start = Callable[..., Program]


@pytest.fixture(scope="module")
def scheduler(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a scheduler."""
    file = tmp_path_factory.mktemp("scheduler") / "scheduler.json"
    command = dask("scheduler", "--port", "0", "--scheduler-file", file)
    with started(command, stderr=None, stdout=None):
        until(lambda: file.exists() and file.read_text(), "the scheduler")
        yield json.loads(file.read_text())["address"]


@pytest.fixture
def start(scheduler: str, tmp_path: Path) -> Iterator[Start]:
    """Starts workers, and ends them behind the test."""
    with ExitStack() as running:

        def begun(**environment: str) -> Program:
            command = dask("worker", scheduler, "--nthreads", "1", "--no-nanny")
            env = {**os.environ, **environment, "DASK_TEMPORARY_DIRECTORY": str(tmp_path / "dask")}
            return running.enter_context(started(command, env=env, stderr=None, stdout=None))

        yield begun


@pytest.fixture(autouse=True)
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Some files in the current folder, of which one imports another, and one has a warning."""
    (tmp_path / "place").mkdir()
    monkeypatch.chdir(tmp_path / "place")
    Path("half.burnish").write_text("fn half(x: float) -> float = x * 0.5\n")
    names = [f"m{number}.burnish" for number in range(COUNT)]
    for number, name in enumerate(names):
        Path(name).write_text(
            f'import "half.burnish".{{half}}\nmaterial M{number} '
            f"{{ color = vec3(half(uv.x), uv.y, {number} / 10.0) }}\n"
        )
    return names


def dask(what: str, *arguments: object) -> list[str]:
    """The command of a program of Dask, which listens to this machine only."""
    words = map(str, arguments)
    module = f"distributed.cli.dask_{what}"
    return [sys.executable, "-m", module, *words, "--host", "127.0.0.1", "--no-dashboard"]


def test_rows_are_the_same_whoever_dies(start: Start, scheduler: str, files: list[str]) -> None:
    """One of two workers is killed in the middle, and a third one lacks a tool."""
    alone = invoke("conform", *files, *LINE)
    first, second, _third = start(), start(), start(PATH="/nowhere")
    command = [sys.executable, "-m", "burnish", "conform", *files, *LINE, "--scheduler", scheduler]
    wait_for_workers(scheduler, 3)
    with started(command) as judging:
        lines: list[str] = []
        while not lines or "agrees" not in lines[-1]:
            lines.append(judging.line().decode())
        first.signal(signal.SIGKILL)
        done = judging.ended()
    assert "".join(lines) + done.stdout == alone.stdout
    (warning,) = done.stderr.splitlines()
    assert warning.startswith("warning: the worker at tcp://127.0.0.1:")
    assert f"gets nothing: it cannot draw with {ROUTE}: glslang is missing" in warning
    assert done.returncode == alone.exit_code == 0
    until(lambda: not judges_of(second), "the end of the processes behind a worker")


def test_what_is_known_is_told_if_all_workers_have_gone(
    start: Start, scheduler: str, files: list[str]
) -> None:
    worker = start()
    wait_for_workers(scheduler, 1)
    command = [
        sys.executable,
        "-c",
        IMPATIENT,
        "conform",
        *files[:4],
        *LINE,
        "--scheduler",
        scheduler,
    ]
    with started(command) as judging:
        while "agrees" not in judging.line().decode():
            pass
        worker.signal(signal.SIGKILL)
        done = judging.ended()
    assert done.returncode == 1
    assert "error: all workers have gone, and none has come back for 0.4 seconds\n" in done.stderr
    assert "unfinished" in done.stdout or "unfinished" in done.stderr


def test_a_worker_with_another_burnish_gets_nothing(
    start: Start, scheduler: str, files: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    start()
    wait_for_workers(scheduler, 1)
    monkeypatch.setattr(farm, "program", lambda: "0.0.9+0123456789abcdef")
    done = invoke("conform", *files, *LINE, "--scheduler", scheduler)
    assert (done.exit_code, done.stdout) == (1, "")
    warning, error = done.stderr.splitlines()
    assert "gets nothing: it has Burnish 0.1.0 (" in warning
    assert warning.endswith("), and this is 0.0.9 (01234567)")
    assert error == (
        f"error: none of the workers of `{scheduler}` can take part, and nothing was drawn"
    )


def test_a_scheduler_without_workers_and_one_that_is_not_there_are_told(
    scheduler: str, files: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(farm, "CONNECTING", 0.3)
    wait_for_workers(scheduler, 0)
    with socket.create_server(("127.0.0.1", 0)) as free:
        nobody = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    for address, message in {
        scheduler: f"the scheduler at `{scheduler}` has no worker: start some with `dask worker "
        f"{scheduler}`",
        nobody: f"nobody answers at `{nobody}`: start a scheduler there with `dask scheduler`",
        "nonsense": "`nonsense` is no address of a scheduler, such as tcp://10.0.0.7:8786: ",
    }.items():
        done = invoke("conform", *files, *LINE, "--scheduler", address)
        assert (done.exit_code, done.stdout) == (1, "")
        assert done.stderr.startswith(f"error: {message}")


def test_options_of_this_machine_do_not_go_with_a_farm(files: list[str]) -> None:
    for option in (["--golden", "folder"], ["--explain", "1,1"]):
        done = invoke("conform", files[0], *option, "--scheduler", "tcp://127.0.0.1:1")
        assert done.exit_code == 2
        assert f"and {option[0]} works on this one: leave out one of them" in done.stderr


def judges_of(worker: Program) -> list[str]:
    """The command lines of the processes that judge for a worker."""
    return [text for text in worker.family().values() if "judging_process" in text]


class Task:
    """A task of Dask that has ended."""

    def __init__(self, error: BaseException | None = None, packed: bytes = b"") -> None:
        self._error, self._packed = error, packed

    def result(self) -> bytes:
        if self._error is not None:
            raise self._error
        return self._packed

    def add_done_callback(self, call: Callable[[Task], None]) -> None:
        self.end = partial(call, self)


def settled(error: BaseException) -> Any:
    """What becomes of a subject whose task ends so."""
    unit = Unit(Path("m.burnish"), "m.burnish: M", "M", (), "", 1.0, 0.0)
    made: Future[Any] = Future()
    nobody, task = farm_of_nobody(), Task(error)
    nobody._open[task] = made
    nobody._settle(lambda: nobody._failed(unit), task)
    nobody._settle(lambda: None, task)  # Whoever ends once more has no effect.
    return made.result(timeout=0)


def test_the_scheduler_has_few_tasks_at_a_time() -> None:
    """Dask suspects all tasks that it has given to a worker that dies."""
    nobody, given, most = farm_of_nobody(), list[Task](), 2 * farm.AHEAD

    def submit(_work: object, _name: str, _key: str, packed: bytes, **_options: object) -> Task:
        given.append(Task(packed=packed))
        return given[-1]

    nobody.__dict__.update(_client=Mock(submit=submit), _size=2, _key="key", _work=None)
    works = [nobody._task("rows", number, lambda: None) for number in range(10)]
    assert len(given) == most
    for number in range(10):
        given[number].end()
        assert len(given) == min(10, most + number + 1)
    assert [work.result(timeout=0) for work in works] == list(range(10))


def farm_of_nobody() -> Farm:
    """A farm without a scheduler."""
    nobody = Farm.__new__(Farm)
    nobody.__dict__.update(
        _routes=[ROUTE],
        _address="tcp://nobody",
        _open={},
        _lock=RLock(),
        _problem="",
        _waiting=deque(),
    )
    return nobody


def test_a_subject_that_kills_workers_has_failed() -> None:
    (row,) = settled(KilledWorker("task", Mock(), 3))
    assert (row.material, row.problem) == ("m.burnish: M", farm.KILLED)
    with pytest.raises(FarmError, match="the scheduler at `tcp://nobody` has gone"):
        settled(CancelledError())
    with pytest.raises(ZeroDivisionError):
        settled(ZeroDivisionError())


def test_why_a_worker_gets_nothing() -> None:
    mine = program()
    assert farm._problem(Ability(mine, {}), [ROUTE]) is None
    assert farm._problem(Ability(mine, {"chromium:wgsl": "none"}), [ROUTE]) is None
    lacking = farm._problem(Ability(mine, {ROUTE: "it is missing"}), [ROUTE])
    assert lacking == f"it cannot draw with {ROUTE}: it is missing"
    absent = ModuleNotFoundError("No module named 'burnish'", name="burnish")
    assert farm._problem(absent, []) == "it lacks the package `burnish`"
    assert farm._problem(OSError("no"), []) == "it could not say what it is: no"


def wait_for_workers(scheduler: str, count: int) -> None:
    """Wait until a scheduler has exactly so many workers."""
    client: Any = import_module("distributed").Client
    with client(scheduler, timeout=LIMIT, set_as_default=False) as asking:
        until(
            lambda: len(asking.scheduler_info(n_workers=-1)["workers"]) == count,
            f"{count} workers",
        )
