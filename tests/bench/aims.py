"""The numbers that Burnish aims at, each beside its aim and beside other compilers.

Everything is CPU time if it does not say otherwise: the best of a few runs, and of many such rounds
the median, as clocks of virtual machines are far off now and then. All that is compared takes turns
within one run, so what else the machine does spoils all alike: two checkouts, and the compilers of
``peers``, which are numbers to divide by.
"""

from __future__ import annotations

import gc
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from statistics import median
from time import process_time
from typing import Any

from .chains import LONGEST, equations
from .checkout import Checkout, Worker
from .closures import LAYERED, layers
from .edits import Edit, long_edit, principled_edit
from .peers.found import Peer, found_peers
from .peers.materialx import FRESH, KEPT
from .peers.slang import SLANG
from .starts import PLASTIC, Start
from .table import Cell, Row, Section

HERE = Path(__file__).parent
PRINCIPLED = HERE.parents[1] / "examples" / "principled.burnish"
DEFERRED = HERE.parents[1] / "examples" / "frames" / "deferred.burnish"
"""A frame with up to 32 lights."""
TARGETS = ("hlsl", "glsl", "wgsl")
AGAIN = 200
"""The number of compiles of the same text in one run, as each takes less than clocks can tell."""

FRESH_RATIO, KEPT_RATIO = 0.7, 2.0
"""What plastic may take beside MaterialX, with fresh contexts and with kept ones."""


@dataclass(frozen=True, slots=True)
class Effort:
    """The sizes of what is measured, and how often it is measured."""

    rounds: int = 12
    """The number of rounds in which all that is compared takes turns."""
    runs: int = 8
    """The number of compiles, or starts, in a turn."""
    layers: int = 200
    """The depth of the deepest surface of closures."""
    lines: int = 2000
    """The length of the file that is checked."""
    files: int = 300
    """The number of files of one command."""
    chain: int = LONGEST
    """The number of equations of the longest chain."""


Measure = Callable[[], float]
"""Does something once, or a few times, and says how many milliseconds it took at best."""


@dataclass(frozen=True, slots=True)
class Number:
    """A row of the table: something to measure, of each checkout and of some peers."""

    what: str
    aim: float | None
    rounds: int
    of: Mapping[str, Measure]
    """The measures by the checkout's name."""
    beside: Mapping[str, Measure] = field(default_factory=dict)
    """Those of peers, by the name of the column."""

    def row(self, peers: Sequence[Peer]) -> Row:
        """Measure all in turn; the last checkout is what the aim is for, and what is divided by the
        times of peers."""
        measures = {**self.beside, **self.of}
        found: dict[str, list[float]] = {name: [] for name in measures}
        for _ in range(self.rounds):
            for name, measure in measures.items():
                found[name].append(measure())
        typical = {name: median(times) for name, times in found.items()}
        now = {name: typical[name] for name in self.of}
        last = [*now.values()][-1]
        within = None if self.aim is None else last <= self.aim
        return {
            "what": self.what, **now, "aim": self.aim, "within": within,
            **{f"/ {each.name}": self._ratio(last, each, typical) for each in peers},
        }  # fmt: skip

    def _ratio(self, last: float, peer: Peer, typical: Mapping[str, float]) -> Cell:
        """The time beside that of a peer; nothing where the two do not do the same."""
        if not peer.is_there:
            return "not run"
        return last / typical[peer.name] if peer.name in self.beside else None


USUAL = Effort()


def measure(checkouts: Sequence[Checkout], effort: Effort = USUAL) -> Iterator[Section]:
    """Every number, of every checkout; and the peers beside which they stand."""
    peers = found_peers()
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        workers = {each.name: stack.enter_context(each.worker()) for each in checkouts}
        starts = {
            each.name: Start(
                stack.enter_context(each.environment()), folder / f"out{number}", effort.runs
            )
            for number, each in enumerate(checkouts)
        }
        numbers = [*_warm(workers, folder, effort, peers), *_cold(starts, effort)]
        rows = [number.row(peers) for number in numbers]
    title = (
        "Milliseconds of CPU time, best of a few runs, beside the aim; and as a ratio to others: "
        f"aims for plastic are {FRESH_RATIO} and {KEPT_RATIO} of MaterialX"
    )
    yield Section("aims", title, rows)
    yield Section("peers", "The compilers beside which they stand", [each.row() for each in peers])


def _warm(
    workers: Mapping[str, Worker], folder: Path, effort: Effort, peers: Sequence[Peer]
) -> Iterator[Number]:
    """What running processes take."""
    others = {each.name: partial(_texts, each, effort.runs) for each in peers if each.is_there}
    model = {name: others[name] for name in (FRESH, KEPT) if name in others}
    twin = {name: others[name] for name in (SLANG,) if name in others}
    for path, aim, beside in (
        (HERE / "surface.burnish", None, twin),
        (PLASTIC, 8.0, model),
        (HERE / "street.burnish", 16.0, {}),
        (PRINCIPLED, 18.0, model),
        (DEFERRED, 100.0, {}),
        (LAYERED, 300.0, {}),
    ):
        of = {name: partial(_compiled, each, path, effort.runs) for name, each in workers.items()}
        yield Number(f"{path.stem}, three targets, warm", aim, effort.rounds, of, beside)
    if model:
        yield from _documents(workers, effort, model)
    again = {name: partial(_again, each, effort.runs) for name, each in workers.items()}
    yield Number("plastic, the same text again", 0.05, effort.rounds, again)
    for edit in (
        principled_edit(PRINCIPLED, folder / "edited.burnish"),
        long_edit(folder / "long.burnish", effort.lines),
    ):
        yield Number(edit.what, edit.aim, effort.rounds, {
            name: partial(_edited, each, edit, effort.runs) for name, each in workers.items()
        })  # fmt: skip
    yield from _large(workers, folder, effort)


def _documents(
    workers: Mapping[str, Worker], effort: Effort, model: Mapping[str, Measure]
) -> Iterator[Number]:
    """What running processes take to import documents of MaterialX and to compile them."""
    for name, beside in (("open_pbr", {}), ("standard_surface", model)):
        path = HERE / f"{name}.mtlx"
        of = {
            each: partial(_compiled, worker, path, effort.runs) for each, worker in workers.items()
        }
        what = f"{name} imported and compiled, three targets, warm"
        yield Number(what, 300.0, min(3, effort.rounds), of, beside)


def _large(workers: Mapping[str, Worker], folder: Path, effort: Effort) -> Iterator[Number]:
    """What running processes take for the largest documents."""
    deep, chain = folder / "layers.burnish", folder / "chain.burnish"
    deep.write_text(layers(effort.layers), encoding="utf-8")
    chain.write_text(equations(effort.chain), encoding="utf-8")
    yield Number(
        f"{effort.layers} closures, each under the next, three targets, warm", 300.0,
        min(3, effort.rounds),
        {name: partial(_compiled, each, deep, effort.runs) for name, each in workers.items()},
    )  # fmt: skip
    yield Number(
        f"a chain of {effort.chain} equations to WGSL", 6000.0, 1,
        {name: partial(_compiled, each, chain, 1, ("wgsl",)) for name, each in workers.items()},
    )  # fmt: skip


def _cold(starts: Mapping[str, Start], effort: Effort) -> Iterator[Number]:
    """What fresh processes take."""
    for what, aim, measure in (
        ("python, nothing else", None, Start.python),
        ("burnish --help", None, Start.help),
        ("burnish compile, one target, cold", 110.0, Start.changed),
        ("the same again, unchanged", 50.0, Start.unchanged),
        ("the same again, unchanged, until it is done", 50.0, Start.unchanged_wall),
    ):
        of = {name: partial(measure, start) for name, start in starts.items()}
        yield Number(what, aim, effort.rounds, of)
    many = {name: partial(start.many, effort.files) for name, start in starts.items()}
    yield Number(f"{effort.files} files by one command, until it is done", 3000.0, 1, many)


# --- measures ------------------------------------------------------------------------------------


def _compiled(worker: Worker, path: Path, runs: int, targets: Sequence[str] = TARGETS) -> float:
    """Compiles in which everything is done again."""
    return _best(worker.compile(path, targets, reflect=False, enough=float("inf"), runs=runs))


def _again(worker: Worker, runs: int) -> float:
    """Compiles of a text that the process has compiled before."""
    _best(worker.compile(PLASTIC, TARGETS, reflect=False, runs=1, remember=True))
    return _best(
        worker.compile(
            PLASTIC,
            TARGETS,
            reflect=False,
            enough=float("inf"),
            runs=runs,
            remember=True,
            times=AGAIN,
        )
    )


def _edited(worker: Worker, edit: Edit, runs: int) -> float:
    """Compiles, or checks, of a file after an edit of one declaration, each time of another."""
    best = float("inf")
    for _ in range(runs):
        edit.make()
        best = min(best, _best(worker.compile(
            edit.path, TARGETS, reflect=False, runs=1, remember=True, check=edit.is_checked
        )))  # fmt: skip
    return best


def _best(answer: Mapping[str, Any] | None) -> float:
    """The milliseconds of a worker's best compile; infinite if there was none."""
    if answer is None or "failed" in answer or answer["codes"]:
        return float("inf")
    return 1000 * float(answer["seconds"]["all"])


def _texts(peer: Peer, runs: int) -> float:
    """Texts of a material by another compiler, each time of another one."""
    best = float("inf")
    for _ in range(runs):
        gc.collect()
        start = process_time()
        peer.texts()
        best = min(best, 1000 * (process_time() - start))
    return best
