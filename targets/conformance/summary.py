"""Describes a conformance run in words and numbers, for the terminal and for the report."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from .compare import Sample
from .drivers import DRIVERS
from .error_words import lanes_text
from .profiles import profile_of
from .rows import STATUSES, CaseResult, Row, Status

FAILURES: frozenset[Status] = frozenset({"differs", "overflows", "failed"})
"""The statuses that make the exit code 1."""

MEANINGS = {
    "route": "The way to a picture: a language of shaders, and the API and device that draw.",
    "result": "Whether every pixel lies between the bounds that a conforming device has to keep.",
    "max |difference|": "How far a pixel is from the reference at most, in the target's numbers.",
    "of bound": "How much of its bound the worst pixel needs.",
    "bound in steps": "How wide bounds usually are, in steps of what the render target can hold.",
    "unproven": "How many pixels the bounds say nothing about, or leave undecided.",
}
"""Columns of a table of verdicts, with what each of them says."""
HEADINGS = tuple(MEANINGS)


@dataclass(frozen=True, slots=True)
class Unfinished:
    """A run that was ended before all of its rows were known."""

    known: int
    """The number of rows that are known."""
    of: int | None
    """The number of all rows; ``None`` if it was ended before that was known."""

    @property
    def text(self) -> str:
        """The words for it: ``unfinished, 12 of 40 rows``."""
        if self.of is None:
            return "unfinished, nothing was drawn yet"
        return f"unfinished, {self.known} of {self.of} rows"


def cells(row: Row) -> tuple[str, ...]:
    """The texts of a row under ``HEADINGS``."""
    if not row.results:
        return row.route.name, row.status, "", "", "", ""
    difference = f"{row.max_difference:.1e}"
    return row.route.name, row.status, difference, share(row), bite(row), unproven(row)


def share(row: Row) -> str:
    """The part of its bound that the worst pixel needs; more than 100% is a violation."""
    worst = max(result.comparison.excess for result in row.results)
    return (
        f"{worst:.0%}" if worst < 1000 else f"{worst:.0e}" if math.isfinite(worst) else "infinite"
    )


def bite(row: Row) -> str:
    """The tightness of the bounds: the median of their width, in steps of the target's format."""
    if not math.isfinite(row.bite):
        return "infinite"
    if row.bite >= 1e5:
        return f"{row.bite:.0e}"
    return f"{row.bite:.0f}" if row.bite >= 10 else f"{row.bite:.1f}"


def unproven(row: Row) -> str:
    """The number of the object's pixels whose bounds say nothing, or that are not compared."""
    return f"{row.covered - row.proven} of {row.covered}"


def is_failure(row: Row, *, strict: bool) -> bool:
    """True if the row fails; with ``strict``, a row that proves little fails, too."""
    return row.status in FAILURES or (strict and row.status == "proves little")


def by_material(rows: Iterable[Row]) -> dict[str, list[Row]]:
    """The rows of each material, in their order."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row.material, []).append(row)
    return groups


def counted(rows: Iterable[Row]) -> str:
    """The number of rows of each status: ``12 agree, 1 differs``."""
    counts = Counter(row.status for row in rows)
    words = {
        "agrees": "agree", "differs": "differ", "proves little": "prove little",
        "overflows": "overflow",
    }  # fmt: skip
    shown = (
        f"{counts[status]} {words.get(status, status) if counts[status] != 1 else status}"
        for status in STATUSES
        if counts[status]
    )
    return ", ".join(shown)


def outcome(rows: Iterable[Row], unfinished: Unfinished | None) -> str:
    """The sentence about a whole run: ``unfinished, 13 of 40 rows: 12 agree, 1 differs``."""
    said = (unfinished.text if unfinished else "", counted(rows))
    return ": ".join(filter(None, said))


def devices(rows: Iterable[Row]) -> Mapping[str, str]:
    """The name and version that each driver reports."""
    return {row.route.driver: row.device.title for row in rows if row.device is not None}


def tools(rows: Iterable[Row]) -> Mapping[str, str]:
    """The versions of all tools that took part."""
    found = {name: version for row in rows for name, version in row.versions.items()}
    return dict(sorted(found.items()))


def lacking(rows: Iterable[Row]) -> Mapping[str, Sequence[str]]:
    """The reasons why routes were not run, each with the routes' names."""
    found: dict[str, dict[str, None]] = {}
    for row in rows:
        if row.status == "not run":
            found.setdefault(row.problem, {})[row.route.name] = None
    return {problem: tuple(names) for problem, names in found.items()}


def messages(rows: Sequence[Row]) -> Iterator[tuple[Sequence[Row], Sequence[str]]]:
    """The messages about one material's rows: the rows that each is about, and its lines.

    Rows that prove little do so on all routes, for the same reason; that is said once, of the route
    that proves the least.
    """
    weak = [row for row in rows if row.status == "proves little"]
    for row in rows:
        if row is min(weak, key=lambda one: one.proven, default=None):
            yield weak, list(details(row))
        elif row.status not in ("proves little", "not run") and (lines := list(details(row))):
            yield [row], lines


def unmeasured(rows: Iterable[Row]) -> list[str]:
    """The drivers of rows that prove little, of whose devices nothing was measured."""
    weak = {
        row.route.driver: row.device
        for row in rows
        if row.status == "proves little" and DRIVERS[row.route.driver].measured is None
    }
    return [
        driver for driver, device in weak.items()
        if device is not None and profile_of(driver, device) is None
    ]  # fmt: skip


def details(row: Row) -> Iterator[str]:
    """Lines about a row that fails or proves little; none if it agrees."""
    yield from row.problem.splitlines()
    if row.results and not row.covered:
        yield "no scene shows anything of it, which proves nothing"
    for result in row.results:
        weak = row.status == "proves little"
        yield from (f"{result.case}: {line}" for line in _about(result, weak=weak))
    yield from row.reasons


def _about(result: CaseResult, *, weak: bool) -> Iterator[str]:
    """The sentences about one case that fails, or that proves little if it is ``weak``."""
    comparison = result.comparison
    covered = comparison.covered
    if (change := comparison.change) is not None:
        yield (
            f"the compiler has changed the meaning of {comparison.changed} of {covered} pixels: "
            f"{_place(change, result)} the material means {lanes_text(change.got)}, but what was "
            f"emitted gives a value {_range(change)}"
        )
    if comparison.wrong and (worst := comparison.worst) is not None:
        yield (
            f"{comparison.wrong} of {covered} pixels are out of bounds; the worst, "
            f"{_place(worst, result)}, is {lanes_text(worst.got)} and must be {_range(worst)}"
        )
    elif (overflow := comparison.overflow) is not None:
        yield (
            f"in {comparison.overflowing} of {covered} pixels the value leaves what float32 holds, "
            f"where nothing is promised; at ({overflow.x}, {overflow.y}) it is "
            f"{lanes_text(overflow.expected)}"
        )
    elif weak and (comparison.wide or comparison.undecided):
        yield (
            f"{comparison.wide} of {covered} pixels may have nearly any value, and at "
            f"{comparison.undecided} rounding decides what is drawn"
        )
    if (beyond := comparison.beyond) is not None:
        yield (
            f"{_place(beyond, result)} it is {lanes_text(beyond.got)}, which is within what is "
            f"guaranteed, but not {_range(beyond)}, as was measured of this driver before"
        )


def _place(sample: Sample, result: CaseResult) -> str:
    place = f"at ({sample.x}, {sample.y})"
    return f"{place} of target {sample.target}" if len(result.got) > 1 else place


def _range(sample: Sample) -> str:
    """The range in which a pixel's value has to be."""
    if sample.low == sample.high:
        return f"exactly {lanes_text(sample.low)}"
    return f"from {lanes_text(sample.low)} to {lanes_text(sample.high)}"
