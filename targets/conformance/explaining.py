"""Explains pixels of a conformance run: what each route drew, and the way of the error.

``burnish conform --explain`` prints the first, and the verdict ``proves little`` is told with the
second. Both are worked out from the rows of a run that is over.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...compiler.diagnostics.nearest import suggestion
from ...compiler.reference.attribution import Explanation, UncoveredError
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.picture import Expected
from ..runner.explanation import explained
from ..runner.subject import Subject
from .cases import SIZE, Case, series_of
from .error_words import causes, lines
from .plan import rules_of
from .rows import CaseResult, Row
from .tolerances import DRIVERS

Pixel = tuple[int, int]
"""Its column and its row, from the upper left corner of the picture."""


class PixelError(Exception):
    """There is no such pixel, or nothing to explain in it; the text tells people why."""


def check_pixel(pixel: Pixel, case: str | None) -> None:
    """Raise ``PixelError`` for what no picture has, before anything is drawn."""
    x, y = pixel
    width, height = SIZE
    if not (0 <= x < width and 0 <= y < height):
        raise PixelError(
            f"there is no pixel {x},{y}: pictures have {width} columns and {height} rows, "
            "counted from 0,0 in the upper left corner"
        )


@dataclass(frozen=True, eq=False, slots=True)
class Seen:
    """One case of a material, with what the routes that drew it have made of it."""

    case: Case
    results: Mapping[str, CaseResult]
    """By the route's name."""
    leading: Row
    """The row whose device and rules the explanation is for."""

    @property
    def expected(self) -> Expected:
        """The expected picture for the leading row."""
        return self.results[self.leading.route.name].expected


def explanation_lines(
    subject: Subject, rows: Sequence[Row], seed: int, pixel: Pixel, case: str | None
) -> Iterator[str]:
    """What there is to say of one pixel of a material, whose rows these are.

    Without a case, the one that is the least certain there is taken. Raises ``PixelError``.
    """
    x, y = pixel
    seen = _chosen(_seen(subject, rows, seed), pixel, case)
    try:
        found = _explained(subject, seen, pixel)
    except UncoveredError:
        raise PixelError(_uncovered(seen, pixel)) from None
    yield f"pixel {x},{y} of `{seen.case.name}`, by the rules of {seen.leading.route.name}"
    yield ""
    yield from _values(seen, pixel, found.target)
    yield ""
    yield from lines(found)


def reasons(subject: Subject, row: Row, seed: int) -> tuple[str, ...]:
    """Where in the source a row that proves little loses its precision: at its widest pixels."""
    found: dict[str, None] = {}
    for seen in _seen(subject, [row], seed):
        result = seen.results[row.route.name]
        for pixel in _widest(result.expected):
            try:
                found |= dict.fromkeys(causes(_explained(subject, seen, pixel)))
            except UncoveredError:  # Another fragment lies in front of what was discarded.
                continue
    return tuple(found)


def _seen(subject: Subject, rows: Iterable[Row], seed: int) -> list[Seen]:
    """The cases that any of these rows has drawn."""
    drawn = [row for row in rows if row.results]
    found = []
    for series in series_of(subject.reflection, seed) if drawn else ():
        for case in series.cases:
            results = {
                row.route.name: result
                for row in drawn
                for result in row.results
                if result.case == case.name
            }
            leading = next(row for row in drawn if row.route.name in results)
            found.append(Seen(case, results, leading))
    return found


def _chosen(seen: Sequence[Seen], pixel: Pixel, name: str | None) -> Seen:
    """The case with this name; or the one in which the pixel's bounds are widest."""
    if not seen:
        raise PixelError("no route has drawn it, so there is no device whose rounding to explain")
    if name is None:
        return max(seen, key=lambda one: _width(one.expected)[pixel[1], pixel[0]])
    by_name = {one.case.name: one for one in seen}
    if name not in by_name:
        hint = suggestion(name, by_name) or f"its cases are {', '.join(map(_quoted, by_name))}"
        raise PixelError(f"there is no case `{name}`; {hint}")
    return by_name[name]


def _explained(subject: Subject, seen: Seen, pixel: Pixel) -> Explanation:
    row = seen.leading
    assert row.device is not None
    rules = rules_of(seen.case.state, row.device, DRIVERS[row.route.driver])
    errors = Errors(row.route.platforms)
    return explained(subject.shader, seen.case.state, rules, errors, *pixel)


def _values(seen: Seen, pixel: Pixel, target: int) -> Iterator[str]:
    """The value and its bounds, and what each route has drawn."""
    x, y = pixel
    rows = []
    for route, result in seen.results.items():
        expected = result.expected
        low, high = expected.low[target][y, x], expected.high[target][y, x]
        got = result.got[target][y, x]
        inside = bool(((got >= low) & (got <= high)).all())
        note = "" if inside else "outside of its bounds"
        if expected.undecided[y, x]:
            note = "undecided: what is drawn here hangs on rounding"
        rows += [
            (route, _lanes(got), note),
            ("  from", _lanes(low), ""),
            ("  to", _lanes(high), ""),
        ]
    rows.insert(0, ("value", _lanes(seen.expected.targets[target][y, x]), ""))
    width = max(len(name) for name, _, _ in rows)
    for name, lanes, note in rows:
        yield f"{name:<{width}}  {lanes}{'  ' + note if note else ''}"


def _uncovered(seen: Seen, pixel: Pixel) -> str:
    """Why a pixel cannot be explained, and where something can be."""
    x, y = pixel
    covered = seen.expected.covered
    text = f"nothing is drawn at {x},{y} of `{seen.case.name}`"
    if not covered.any():
        return f"{text}, nor elsewhere"
    rows, columns = np.nonzero(covered)
    near = int(np.hypot(columns - x, rows - y).argmin())
    return f"{text}; the nearest pixel that shows the mesh is {columns[near]},{rows[near]}"


def _widest(expected: Expected) -> list[Pixel]:
    """The pixel with the widest bounds, if a pixel is covered."""
    width = np.where(expected.covered, _width(expected), -1.0)
    y, x = np.unravel_index(int(width.argmax()), width.shape)
    return [(int(x), int(y))] if width[y, x] > 0 else []


def _width(expected: Expected) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """(height, width): how far a pixel's bounds are apart, in its widest lane."""
    pairs = zip(expected.low, expected.high, strict=True)
    apart = [np.where(np.isfinite(high - low), high - low, np.inf) for low, high in pairs]
    widest: np.ndarray[tuple[int, int], np.dtype[np.float64]] = np.max(apart, axis=(0, 3))
    return np.where(expected.covered, widest, -1.0)


def _quoted(name: str) -> str:
    return f"`{name}`"


def _lanes(values: Iterable[float]) -> str:
    return f"({', '.join(f'{value:.7g}' for value in values)})"
