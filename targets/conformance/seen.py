"""The results of all routes for one case, and the choice of the case that explains a pixel.

``explaining.py`` is about pixels of these.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from ...compiler.diagnostics.nearest import suggestion
from ...compiler.reference.picture import Expected
from .compare import Bools, ends_of, says_nothing, shares
from .error_words import lanes_text
from .rows import CaseResult, Row

T = TypeVar("T")
Pixel = tuple[int, int]
"""A pixel's column and row, from the upper left corner of the picture."""

_TRIED = (0.5, 0.75, 0.25, 0.9)
"""The pixels that are explained until one shows where precision is lost: ranks, from 0 to 1, in the
order of how wide their bounds are."""


class PixelError(Exception):
    """The pixel does not exist, or has nothing to explain; the text tells people why."""


@dataclass(frozen=True, eq=False, slots=True)
class Seen:
    """One case, with the results of the routes that drew it."""

    name: str
    results: Mapping[str, CaseResult]
    """The results, by the route's name."""
    leading: Row
    """The row whose device and rules the explanation is for."""

    @property
    def result(self) -> CaseResult:
        """The result of the leading row."""
        return self.results[self.leading.route.name]

    @property
    def size(self) -> tuple[int, int]:
        """The width and the height of its pictures."""
        height, width = self.result.expected.covered.shape
        return width, height


def results_of(case: str, rows: Iterable[Row]) -> dict[str, CaseResult]:
    """The results of a case in the rows that drew it, by the route's name."""
    found = ((row.route.name, result) for row in rows for result in row.results)
    return {route: result for route, result in found if result.case == case}


def leading_of(results: Mapping[str, CaseResult], rows: Iterable[Row]) -> Row:
    """The first of the rows that drew a case."""
    return next(row for row in rows if row.route.name in results)


def chosen(seen: Sequence[Seen], pixel: Pixel, name: str | None, what: str) -> Seen:
    """The case with this name; or the one in which the pixel's bounds are widest.

    ``what`` names the kind of picture in the error if no case has the pixel. Raises ``PixelError``.
    """
    if not seen:
        raise PixelError("no route has drawn it, so there is no device whose rounding to explain")
    x, y = pixel
    seen = [one for one in seen if x < one.size[0] and y < one.size[1]]
    if not seen:
        raise PixelError(f"no {what} has a pixel {x},{y}")
    if name is None:
        return max(seen, key=lambda one: width_of(one.result.expected)[y, x])
    return named({one.name: one for one in seen}, name)


def named(cases: Mapping[str, T], name: str) -> T:
    """The case of this name. Raises ``PixelError``."""
    if name not in cases:
        hint = suggestion(name, cases) or f"its cases are {', '.join(map(_quoted, cases))}"
        raise PixelError(f"there is no case `{name}`; {hint}")
    return cases[name]


def values_lines(seen: Seen, pixel: Pixel, target: int) -> Iterator[str]:
    """The value and its bounds, and the value that each route has drawn."""
    x, y = pixel
    rows = []
    for route, result in seen.results.items():
        expected = result.expected
        low, high = expected.low[target][y, x], expected.high[target][y, x]
        got = result.got[target][y, x]
        value = expected.targets[target][y, x]
        inside = bool((shares(got, value, low, high) <= 1).all())
        note = "" if inside else "outside of its bounds"
        if expected.undecided[y, x]:
            note = "undecided: what is drawn here hangs on rounding"
        rows += [
            (route, lanes_text(got), note),
            ("  from", lanes_text(low), ""),
            ("  to", lanes_text(high), ""),
        ]
    rows.insert(0, ("value", lanes_text(seen.result.expected.targets[target][y, x]), ""))
    width = max(len(name) for name, _, _ in rows)
    for name, lanes, note in rows:
        yield f"{name:<{width}}  {lanes}{'  ' + note if note else ''}"


def width_of(expected: Expected) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """(height, width): the distance of a pixel's bounds, in its widest lane."""
    pairs = zip(expected.low, expected.high, strict=True)
    apart = [np.where(np.isfinite(high - low), high - low, np.inf) for low, high in pairs]
    widest: np.ndarray[tuple[int, int], np.dtype[np.float64]] = np.max(apart, axis=(0, 3))
    return np.where(expected.covered, widest, -1.0)


def unproven(result: CaseResult) -> Bools:
    """(height, width): the object's pixels whose bounds say nothing."""
    expected = result.expected
    seen = expected.covered & ~expected.undecided
    return says_nothing(*ends_of(expected), seen) & seen


def usual_pixels(result: CaseResult) -> list[Pixel]:
    """Some pixels of usual widths among those whose bounds say nothing, the median first."""
    rows, columns = np.nonzero(unproven(result))
    if not len(rows):
        return []
    order = width_of(result.expected)[rows, columns].argsort(kind="stable")
    tried = [order[int(share * (len(order) - 1))] for share in _TRIED]
    return list(dict.fromkeys((int(columns[i]), int(rows[i])) for i in tried))


def _quoted(name: str) -> str:
    return f"`{name}`"
