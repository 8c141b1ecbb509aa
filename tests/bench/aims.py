"""The numbers that Burnish aims at, each beside its aim: CPU time, the best of a few runs, and of
many such rounds the median, as clocks of virtual machines are far off now and then.

With a second checkout, both are measured in turn within one run: what else the machine does then
spoils both alike.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median
from time import perf_counter

from .chains import LONGEST, equations
from .checkout import Checkout, Worker
from .clock import PATIENCE
from .closures import LAYERED, layers
from .table import Row, Section

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples"
ROUNDS = 12
"""The number of rounds in which the checkouts take turns."""
RUNS = 8
"""The number of compiles, or starts, of each checkout in its turn."""

WARM = (
    (EXAMPLES / "plastic.burnish", 8.0),
    (HERE / "street.burnish", 16.0),
    (EXAMPLES / "principled.burnish", 18.0),
    (LAYERED, 300.0),
)
"""The files that a running process compiles to three targets, and the milliseconds to aim at."""
LAYERS, LAYERS_AIM = 200, 300.0
"""The depth of the deepest surface of closures, and the milliseconds to aim at."""
COLD_AIM, UNCHANGED_AIM = 130.0, 50.0
CHAIN_AIM = 6000.0

Measure = Callable[[], float]
"""Does something once, or a few times, and says how many milliseconds of CPU it took at best."""


@dataclass(frozen=True, slots=True)
class Number:
    """A row of the table: something to measure, of each checkout."""

    what: str
    aim: float | None
    rounds: int
    of: Mapping[str, Measure]
    """The measures by the checkout's name."""

    def row(self) -> Row:
        """Measure the checkouts in turn; the last one is what the aim is for."""
        found: dict[str, list[float]] = {name: [] for name in self.of}
        for _ in range(self.rounds):
            for name, measure in self.of.items():
                found[name].append(measure())
        typical = {name: median(times) for name, times in found.items()}
        last = [*typical.values()][-1]
        within = None if self.aim is None else last <= self.aim
        return {"what": self.what, **typical, "aim": self.aim, "within": within}


def measure(checkouts: Sequence[Checkout]) -> Iterator[Section]:
    """Every number, of every checkout."""
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        workers = {each.name: stack.enter_context(each.worker()) for each in checkouts}
        starts = {
            each.name: _Start(stack.enter_context(each.environment()), folder / f"out{number}")
            for number, each in enumerate(checkouts)
        }
        rows = [number.row() for number in _rows(workers, starts, folder)]
    yield Section("aims", "Milliseconds of CPU time, best of a few runs, beside the aim", rows)


def _rows(
    workers: Mapping[str, Worker], starts: Mapping[str, _Start], folder: Path
) -> Iterator[Number]:
    for path, aim in WARM:
        what = f"{path.stem}, three targets, warm"
        yield Number(what, aim, ROUNDS, {k: _warm(w, path) for k, w in workers.items()})
    deep = folder / "layers.burnish"
    deep.write_text(layers(LAYERS), encoding="utf-8")
    yield Number(
        f"{LAYERS} closures, each under the next, three targets, warm", LAYERS_AIM, 3,
        {name: _warm(worker, deep) for name, worker in workers.items()},
    )  # fmt: skip
    yield Number("python, nothing else", None, ROUNDS, {k: s.python for k, s in starts.items()})
    yield Number("burnish --help", None, ROUNDS, {k: s.help for k, s in starts.items()})
    yield Number(
        "burnish compile, one target, cold", COLD_AIM, ROUNDS,
        {name: start.changed for name, start in starts.items()},
    )  # fmt: skip
    yield Number(
        "the same again, unchanged", UNCHANGED_AIM, ROUNDS,
        {name: start.unchanged for name, start in starts.items()},
    )  # fmt: skip
    yield Number(
        "the same again, unchanged, until it is done", UNCHANGED_AIM, ROUNDS,
        {name: start.unchanged_wall for name, start in starts.items()},
    )  # fmt: skip
    chain = folder / "chain.burnish"
    chain.write_text(equations(LONGEST), encoding="utf-8")
    yield Number(
        f"a chain of {LONGEST} equations to WGSL", CHAIN_AIM, 1,
        {name: _chain(worker, chain) for name, worker in workers.items()},
    )  # fmt: skip


def _warm(worker: Worker, path: Path) -> Measure:
    return lambda: _milliseconds(worker, path, ("hlsl", "glsl", "wgsl"), RUNS)


def _chain(worker: Worker, path: Path) -> Measure:
    return lambda: _milliseconds(worker, path, ("wgsl",), 1)


def _milliseconds(worker: Worker, path: Path, targets: Sequence[str], runs: int) -> float:
    answer = worker.compile(path, targets, reflect=False, enough=float("inf"), runs=runs)
    if answer is None or "failed" in answer or answer["codes"]:
        return float("inf")
    return 1000 * float(answer["seconds"]["all"])


@dataclass(frozen=True, slots=True)
class _Start:
    """Fresh processes of one checkout, with a cache folder of their own."""

    environment: Mapping[str, str]
    folder: Path

    def python(self) -> float:
        """Python with what it always loads."""
        return self._best("-c", "pass")[0]

    def help(self) -> float:
        """A command that compiles nothing."""
        return self._best("-m", "burnish", "--help")[0]

    def changed(self) -> float:
        """A compile of a text that has not been compiled before."""
        found = []
        for number in range(RUNS):
            self._example().write_text(f"{self._text()}// {perf_counter()} {number}\n", "utf-8")
            found.append(self._once(*self._compile())[0])
        return min(found)

    def unchanged(self) -> float:
        """A compile of a text that was compiled before."""
        self._example().write_text(self._text(), "utf-8")
        self._once(*self._compile())
        return self._best(*self._compile())[0]

    def unchanged_wall(self) -> float:
        """The wall-clock time of a compile of a text that was compiled before."""
        self._example().write_text(self._text(), "utf-8")
        self._once(*self._compile())
        return self._best(*self._compile())[1]

    def _text(self) -> str:
        return (EXAMPLES / "plastic.burnish").read_text("utf-8")

    def _example(self) -> Path:
        self.folder.mkdir(exist_ok=True)
        return self.folder / "plastic.burnish"

    def _compile(self) -> tuple[str, ...]:
        output = str(self.folder / "build")
        return "-m", "burnish", "compile", str(self._example()), "--target", "wgsl", "-o", output

    def _best(self, *arguments: str) -> tuple[float, float]:
        found = [self._once(*arguments) for _ in range(RUNS)]
        return min(cpu for cpu, _ in found), min(wall for _, wall in found)

    def _once(self, *arguments: str) -> tuple[float, float]:
        """Milliseconds of CPU and by the clock of one process, as a user starts it."""
        environment = {**self.environment, "BURNISH_CACHE": str(self.folder / "cache")}
        before, start = getrusage(RUSAGE_CHILDREN), perf_counter()
        subprocess.run(
            [sys.executable, *arguments],
            env=environment,
            check=True,
            timeout=PATIENCE,
            stdout=subprocess.DEVNULL,
        )
        after, end = getrusage(RUSAGE_CHILDREN), perf_counter()
        user, system = after.ru_utime - before.ru_utime, after.ru_stime - before.ru_stime
        return 1000 * (user + system), 1000 * (end - start)
