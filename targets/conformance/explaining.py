"""Explains pixels of a conformance run: the values of each route, and where the error comes from.

``burnish conform`` calls it when a run is over: with ``--explain`` for the pixel that somebody asks
about, and for rows that differ or prove little, to name the cause in the source.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from ...compiler.reference.attribution import Explanation, UncoveredError
from ..runner.drivers.device import Device
from ..runner.explanation import explained
from ..runner.frames.host import FrameSubject, is_frame, is_shader
from ..runner.kernels import drawable, is_drawn
from ..runner.routes import Route
from ..runner.subject import Subject
from .bounds import bounds_of
from .cases import SIZE, Case, series_of
from .error_words import blamed, causes, lines, small
from .frame_explaining import frame_lines, reasons_of_frame
from .rows import Row
from .seen import (
    Pixel,
    PixelError,
    Seen,
    chosen,
    leading_of,
    named,
    results_of,
    unproven,
    usual_pixels,
    values_lines,
    width_of,
)

_BLAMED = 100.0
"""The multiple of its bound up to which a difference can come from an operation's error."""
_ANY_DEVICE = Device("", "", subpixel_bits=8, subtexel_bits=8, mip_bits=8)
"""A device with the bits that nearly all devices have."""


def check_pixel(pixel: Pixel) -> None:
    """Raise ``PixelError`` for a pixel that no picture has, before anything is drawn."""
    x, y = pixel
    width, height = SIZE
    if not (0 <= x < width and 0 <= y < height):
        raise PixelError(
            f"there is no pixel {x},{y}: pictures have {width} columns and {height} rows, "
            "counted from 0,0 in the upper left corner"
        )


@dataclass(frozen=True, eq=False, slots=True)
class _SeenCase(Seen):
    """One case of a material."""

    case: Case


def explanation_lines(
    subject: Subject | FrameSubject,
    rows: Sequence[Row],
    seed: int,
    pixel: Pixel,
    case: str | None,
) -> Iterator[str]:
    """The lines that explain one pixel of a material, from the material's rows.

    Without a case, the one in which the pixel is the least certain is taken. Raises ``PixelError``.
    """
    if not is_shader(subject):
        assert is_frame(subject)
        yield from frame_lines(subject, rows, pixel, case)
        return
    x, y = pixel
    seen = chosen(_seen(subject, rows, seed), pixel, case, "image of this kernel")
    try:
        found = _explained(subject, seen, pixel)
    except UncoveredError:
        raise PixelError(_uncovered(seen, pixel)) from None
    yield f"pixel {x},{y} of `{seen.name}`, by the rules of {seen.leading.route.name}"
    yield ""
    yield from values_lines(seen, pixel, found.target)
    yield ""
    yield from lines(found)


def with_reasons(subject: Subject | FrameSubject, rows: Sequence[Row], seed: int) -> list[Row]:
    """The rows of one material, with the reasons in the source for their verdicts.

    Rows that prove little do so for the same reason on all routes; it is worked out once. Reasons
    concern pixels, so there are none if no picture is drawn.
    """
    weakest = min(filter(_is_weak, rows), key=lambda row: row.proven, default=None)
    if not is_shader(subject):
        assert is_frame(subject)
        shared = tuple(reasons_of_frame(subject, weakest)) if weakest else ()
        return [replace(row, reasons=shared) if _is_weak(row) else row for row in rows]
    if not is_drawn(subject.reflection):
        return list(rows)
    shared = tuple(_of_little(subject, weakest, seed)) if weakest else ()
    return [
        replace(row, reasons=shared)
        if _is_weak(row)
        else replace(row, reasons=tuple(_of_difference(subject, row, seed)))
        if row.status == "differs"
        else row
        for row in rows
    ]


def _is_weak(row: Row) -> bool:
    return row.status == "proves little"


def explained_alone(subject: Subject, route: Route, pixel: Pixel, name: str) -> Explanation:
    """The explanation of a pixel by a route's guaranteed bounds, without drawing anything.

    Raises ``PixelError`` if there is no such case, or nothing at the pixel.
    """
    every = chain.from_iterable(series.cases for series in series_of(subject.reflection))
    case = named({one.name: one for one in every}, name)
    if not (pixel[0] < case.state.width and pixel[1] < case.state.height):
        raise PixelError(f"`{name}` has {case.state.width} x {case.state.height} pixels")
    bounds = bounds_of(case.state, route, _ANY_DEVICE)[-1]
    try:
        return explained(drawable(subject.shader), case.state, bounds.rules, bounds.errors, *pixel)
    except UncoveredError:
        x, y = pixel
        raise PixelError(f"nothing is drawn at {x},{y} of `{name}`") from None


def _of_little(subject: Subject, row: Row, seed: int) -> list[str]:
    """The places where precision is lost, in the case that proves the least.

    A usual pixel of the case is explained, or others if nothing is lost there.
    """
    cases = _seen(subject, [row], seed)
    least = max(cases, key=lambda seen: unproven(seen.result).sum(), default=None)
    if least is None:
        return []
    otherwise = []
    for x, y in usual_pixels(least.result):
        for found in _explained_if_covered(subject, least, (x, y)):
            if told := list(causes(found)):
                return told
            otherwise.append(small(found, float(width_of(least.result.expected)[y, x])))
    return otherwise[:1]


def _of_difference(subject: Subject, row: Row, seed: int) -> Iterator[str]:
    """The operation that explains most of the error of a case's worst pixel."""
    for seen in _seen(subject, [row], seed):
        comparison = seen.result.comparison
        # Rounding is to blame for a difference of its own order only.
        if comparison.wrong and comparison.worst is not None and comparison.excess < _BLAMED:
            worst = comparison.worst
            for found in _explained_if_covered(subject, seen, (worst.x, worst.y)):
                yield from (f"{seen.name}: {text}" for text in blamed(found))


def _explained_if_covered(subject: Subject, seen: _SeenCase, pixel: Pixel) -> Iterator[Explanation]:
    try:
        yield _explained(subject, seen, pixel)
    except UncoveredError:
        return


def _seen(subject: Subject, rows: Iterable[Row], seed: int) -> list[_SeenCase]:
    """The cases that any of these rows has drawn."""
    drawn = [row for row in rows if row.results]
    found = []
    for series in series_of(subject.reflection, seed) if drawn else ():
        for case in series.cases:
            results = results_of(case.name, drawn)
            leading = leading_of(results, drawn)
            found.append(_SeenCase(case.name, results, leading, case))
    return found


def _explained(subject: Subject, seen: _SeenCase, pixel: Pixel) -> Explanation:
    """Explain a pixel by the bounds that decided on the verdict of the leading row."""
    row = seen.leading
    assert row.device is not None
    level = seen.result.comparison.level
    allowed = bounds_of(seen.case.state, row.route, row.device)
    bounds = next(one for one in allowed if one.level == level)
    return explained(drawable(subject.shader), seen.case.state, bounds.rules, bounds.errors, *pixel)


def _uncovered(seen: _SeenCase, pixel: Pixel) -> str:
    """The reason why a pixel cannot be explained, and a pixel that can be."""
    x, y = pixel
    covered = seen.result.expected.covered
    text = f"nothing is drawn at {x},{y} of `{seen.name}`"
    if not covered.any():
        return f"{text}, nor elsewhere"
    rows, columns = np.nonzero(covered)
    near = int(np.hypot(columns - x, rows - y).argmin())
    return f"{text}; the nearest pixel that shows the mesh is {columns[near]},{rows[near]}"
