"""Explains pixels of a conformance run: the values of each route, and where the error comes from.

``burnish conform`` calls it when a run is over: with ``--explain`` for the pixel that somebody asks
about, and for rows that differ or prove little, to name the cause in the source. Of a frame it says
which step has made the pixel, and which inputs of this step carry the error to it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...compiler.reference.attribution import Explanation
from ..runner.drivers.device import Device
from ..runner.frames.pixel_origins import BEFORE, Carried, Origin
from ..runner.frames.subjects import FrameSubject, is_shader
from ..runner.kernels import is_drawn
from ..runner.routes import Route
from ..runner.subject import Subject
from .cases import SIZE
from .conform import trials_of
from .error_words import blamed, causes, lines, short, small, table
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
from .trials import ShaderTrial, Trial

_BLAMED = 100.0
"""The multiple of its bound up to which a difference can come from an operation's error."""
_LARGE_PART = 0.5
"""An input is to blame if, with an exact input, the distance of the bounds falls below this
part."""
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


def explanation_lines(
    subject: Subject | FrameSubject,
    rows: Sequence[Row],
    seed: int,
    pixel: Pixel,
    case: str | None,
) -> Iterator[str]:
    """The lines that explain one pixel of a subject, from the subject's rows.

    Without a case, the one in which the pixel is the least certain is taken. Raises ``PixelError``.
    """
    trial, (x, y) = _trial(subject, seed), pixel
    kind = "image of this kernel" if is_shader(subject) else "output"
    seen = chosen(_seen(trial, rows), pixel, case, kind)
    found = _origin(trial, seen, pixel)
    if found is None:
        raise PixelError(_undrawn(seen, pixel))
    yield f"pixel {x},{y} of `{seen.name}`, by the rules of {seen.leading.route.name}"
    yield ""
    yield from values_lines(seen, pixel, found.target if isinstance(found, Explanation) else 0)
    yield ""
    yield from lines(found) if isinstance(found, Explanation) else made_lines(found)


def with_reasons(subject: Subject | FrameSubject, rows: Sequence[Row], seed: int) -> list[Row]:
    """The rows of one subject, with the reasons in the source for their verdicts.

    Rows that prove little do so for the same reason on all routes; it is worked out once. Reasons
    concern pixels, so there are none if no picture is drawn. Of frames, only those are told that
    prove little.
    """
    explains = ("proves little", "differs") if is_shader(subject) else ("proves little",)
    if not _has_pictures(subject) or not any(row.status in explains for row in rows):
        return list(rows)
    trial = _trial(subject, seed)
    weakest = min(filter(_is_weak, rows), key=lambda row: row.proven, default=None)
    shared = tuple(_of_little(trial, weakest)) if weakest else ()
    return [
        replace(row, reasons=shared)
        if _is_weak(row)
        else replace(row, reasons=tuple(_of_difference(trial, row)))
        if row.status in explains
        else row
        for row in rows
    ]


def _has_pictures(subject: Subject | FrameSubject) -> bool:
    return not is_shader(subject) or is_drawn(subject.reflection)


def _trial(subject: Subject | FrameSubject, seed: int) -> Trial:
    """The trial of a subject. Raises ``PixelError`` for one that draws no picture."""
    if not _has_pictures(subject):
        raise PixelError(f"{subject.name} draws no picture, so that it has no pixel to explain")
    (trial,) = trials_of([(subject.name, subject)], seed=seed)
    if isinstance(trial, tuple):
        raise PixelError(trial[1])
    return trial


def _is_weak(row: Row) -> bool:
    return row.status == "proves little"


def explained_alone(subject: Subject, route: Route, pixel: Pixel, name: str) -> Explanation:
    """The explanation of a pixel by a route's guaranteed bounds, without drawing anything.

    Raises ``PixelError`` if there is no such case, or nothing at the pixel.
    """
    trial, (x, y) = _trial(subject, 0), pixel
    assert isinstance(trial, ShaderTrial)
    state = named(trial.cases(), name)
    if not (x < state.width and y < state.height):
        raise PixelError(f"`{name}` has {state.width} x {state.height} pixels")
    found = trial.made(name, route, _ANY_DEVICE, "guaranteed", pixel)
    if found is None:
        raise PixelError(f"nothing is drawn at {x},{y} of `{name}`")
    return found


def _of_little(trial: Trial, row: Row) -> list[str]:
    """The places where precision is lost, in the case that proves the least.

    A usual pixel of the case is explained, or others if nothing is lost there.
    """
    least = max(_seen(trial, [row]), key=lambda seen: unproven(seen.result).sum(), default=None)
    if least is None:
        return []
    otherwise = []
    for pixel in usual_pixels(least.result):
        found = _origin(trial, least, pixel)
        if isinstance(found, Origin):
            return list(_carriers(found))
        if found is not None:
            if told := list(causes(found)):
                return told
            x, y = pixel
            otherwise.append(small(found, float(width_of(least.result.expected)[y, x])))
    return otherwise[:1]


def _carriers(made: Origin) -> Iterator[str]:
    """The input that has most of the error of a pixel of a frame, or else the places in its step
    where precision is lost."""
    worst = made.carried[0] if made.carried else None
    if worst is not None and worst.apart < _LARGE_PART * made.apart:
        yield f"`{made.step}` has most of the error from {_words(worst)}"
    elif made.explanation is not None:
        yield from (f"`{made.step}`: {cause}" for cause in causes(made.explanation))


def _of_difference(trial: Trial, row: Row) -> Iterator[str]:
    """The operation that explains most of the error of a case's worst pixel."""
    for seen in _seen(trial, [row]):
        comparison = seen.result.comparison
        # Rounding is to blame for a difference of its own order only.
        if comparison.wrong and comparison.worst is not None and comparison.excess < _BLAMED:
            found = _origin(trial, seen, (comparison.worst.x, comparison.worst.y))
            if isinstance(found, Explanation):
                yield from (f"{seen.name}: {text}" for text in blamed(found))


def made_lines(made: Origin) -> Iterator[str]:
    """The origin of a pixel, as lines of text."""
    yield f"the step `{made.step}` has made it, and its bounds are {short(made.apart)} apart"
    if made.carried:
        yield from ("", "how far apart they would be without the error of:")
        rows = [(short(one.apart), _words(one)) for one in made.carried]
        if len(rows) > 1:
            rows.append((short(made.alone), "all of these"))
        yield from table(rows)
    if made.explanation is not None:
        yield ""
        yield f"what `{made.step}` makes of what it reads:"
        yield from lines(made.explanation)


def _words(carried: Carried) -> str:
    if carried.result == BEFORE:
        return BEFORE
    return f"`{carried.name}`, which is `{carried.result}`"


def _seen(trial: Trial, rows: Sequence[Row]) -> list[Seen]:
    """The cases that any of these rows has drawn."""
    found = ((case, results_of(case, rows)) for case in trial.cases())
    return [Seen(case, results, leading_of(results, rows)) for case, results in found if results]


def _origin(trial: Trial, seen: Seen, pixel: Pixel) -> Explanation | Origin | None:
    """Explain a pixel by the bounds that decided on the verdict of the leading row."""
    row, level = seen.leading, seen.result.comparison.level
    assert row.device is not None
    return trial.made(seen.name, row.route, row.device, level, pixel)


def _undrawn(seen: Seen, pixel: Pixel) -> str:
    """The reason why a pixel cannot be explained, and a pixel that can be."""
    x, y = pixel
    covered = seen.result.expected.covered
    if covered.all():
        return f"no step draws the pixel {x},{y} of `{seen.name}`"
    text = f"nothing is drawn at {x},{y} of `{seen.name}`"
    if not covered.any():
        return f"{text}, nor elsewhere"
    rows, columns = np.nonzero(covered)
    near = int(np.hypot(columns - x, rows - y).argmin())
    return f"{text}; the nearest pixel that shows the mesh is {columns[near]},{rows[near]}"
