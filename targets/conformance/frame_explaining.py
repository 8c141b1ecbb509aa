"""Explains a pixel of a frame: the step that made it, and the inputs that carry the error to it.

``explaining.py`` calls it for ``burnish conform --explain``. Errors of the step's own shader are
explained as they are for materials.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..runner.frames.following import BEFORE, Carried, Made
from ..runner.frames.host import FrameSubject
from .cases import SIZE
from .error_words import causes, lines, short, table
from .frames import FramePlan
from .rows import Row
from .seen import (
    Pixel,
    PixelError,
    Seen,
    chosen,
    leading_of,
    results_of,
    unproven,
    usual_pixels,
    values_lines,
)

_LARGE_PART = 0.5
"""An input is to blame if, with an exact input, the distance of the bounds falls below this
part."""


def frame_lines(
    subject: FrameSubject, rows: Sequence[Row], pixel: Pixel, case: str | None
) -> Iterator[str]:
    """The lines that explain one pixel of a frame, from the frame's rows. Raises ``PixelError``."""
    plan = FramePlan(subject.name, subject, SIZE)
    seen = chosen(list(_seen(plan, rows)), pixel, case, "output")
    row, level = seen.leading, seen.result.comparison.level
    assert row.device is not None
    made = plan.made(seen.name, row.route, row.device, level, pixel)
    x, y = pixel
    if made is None:
        raise PixelError(f"no step draws the pixel {x},{y} of `{seen.name}`")
    yield f"pixel {x},{y} of `{seen.name}`, by the rules of {row.route.name}"
    yield ""
    yield from values_lines(seen, pixel, 0)
    yield ""
    yield from made_lines(made)


def reasons_of_frame(subject: FrameSubject, row: Row) -> Iterator[str]:
    """The places where precision is lost, at a usual pixel of the case that proves the least."""
    plan = FramePlan(subject.name, subject, SIZE)
    least = max(_seen(plan, [row]), key=lambda seen: unproven(seen.result).sum(), default=None)
    if least is None:
        return
    for pixel in usual_pixels(least.result)[:1]:
        assert row.device is not None
        level = least.result.comparison.level
        made = plan.made(least.name, row.route, row.device, level, pixel)
        if made is None:
            return
        worst = made.carried[0] if made.carried else None
        if worst is not None and worst.apart < _LARGE_PART * made.apart:
            yield f"`{made.step}` has most of the error from {_words(worst)}"
        elif made.explanation is not None:
            yield from (f"`{made.step}`: {cause}" for cause in causes(made.explanation))


def made_lines(made: Made) -> Iterator[str]:
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


def _seen(plan: FramePlan, rows: Sequence[Row]) -> Iterator[Seen]:
    """The cases that any of these rows has drawn."""
    for case in plan.cases():
        if results := results_of(case, rows):
            yield Seen(case, results, leading_of(results, rows))
