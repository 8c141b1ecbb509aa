"""Describes a conformance run in words and numbers, for the terminal and for the report."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence

from .rows import STATUSES, Row

HEADINGS = ("route", "result", "max |difference|", "of tolerance", "undecided")


def cells(row: Row) -> tuple[str, ...]:
    """The texts of a row under ``HEADINGS``."""
    if not row.results:
        return row.route.name, row.status, "", "", ""
    difference, undecided = f"{row.max_difference:.1e}", f"{row.undecided} of {row.covered}"
    return row.route.name, row.status, difference, share(row), undecided


def share(row: Row) -> str:
    """How much of its tolerance the worst pixel needs; more than 100% is a disagreement."""
    worst = max(result.comparison.excess for result in row.results)
    return f"{worst:.0%}" if math.isfinite(worst) else "infinite"


def by_material(rows: Iterable[Row]) -> dict[str, list[Row]]:
    """The rows of each material, in their order."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row.material, []).append(row)
    return groups


def counted(rows: Iterable[Row]) -> str:
    """The number of rows of each status: ``12 agree, 1 differs``."""
    counts = Counter(row.status for row in rows)
    words = {"agrees": "agree", "differs": "differ", "overflows": "overflow"}
    shown = (
        f"{counts[status]} {words.get(status, status) if counts[status] != 1 else status}"
        for status in STATUSES
        if counts[status]
    )
    return ", ".join(shown)


def devices(rows: Iterable[Row]) -> Mapping[str, str]:
    """The name and version that each driver reports."""
    return {
        row.route.driver: f"{row.device.name}, {row.device.version}"
        for row in rows
        if row.device is not None
    }


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


def details(row: Row) -> Iterator[str]:
    """Lines that say what is wrong with a row; none if it agrees."""
    yield from row.problem.splitlines()
    if row.results and not row.covered:
        yield "no scene shows anything of it, which proves nothing"
    for result in row.results:
        comparison = result.comparison
        if comparison.wrong and comparison.worst:
            worst = comparison.worst
            place = f"at ({worst.x}, {worst.y})"
            if len(result.got) > 1:
                place += f" of target {worst.target}"
            yield (
                f"{result.case}: {comparison.wrong} of {comparison.covered} pixels; the worst, "
                f"{place}, is {_lanes(worst.got)} and should be {_lanes(worst.expected)}"
            )
        elif comparison.overflow:
            overflow = comparison.overflow
            yield (
                f"{result.case}: in {comparison.overflowing} of {comparison.covered} pixels the "
                "value leaves what float32 holds, where nothing is promised; at "
                f"({overflow.x}, {overflow.y}) it is {_lanes(overflow.expected)}"
            )
        elif comparison.changed and comparison.change:
            change = comparison.change
            yield (
                f"{result.case}: the compiler has changed the meaning of {comparison.changed} of "
                f"{comparison.covered} pixels; at ({change.x}, {change.y}) the material means "
                f"{_lanes(change.got)}, and the text {_lanes(change.expected)}"
            )


def _lanes(values: Sequence[float]) -> str:
    return f"({', '.join(f'{value:.6g}' for value in values)})"
