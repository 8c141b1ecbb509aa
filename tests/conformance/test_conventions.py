"""The promises of the conventions, executed: the expected pixels are worked out by hand.

Every route draws them. The reference is held against them too, as if it were one more route.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest

from burnish.targets.runner.routes import ROUTES

from . import matrices, rectangles
from .cells import CENTER, HEIGHT, HIGH, LOW, NATURAL, OVER, WHOLE, Cell, middle
from .drawings import (
    BARE,
    DRAWINGS,
    FAR_LAST,
    NEAR_FIRST,
    NEAR_LAST,
    OBLONG,
    RIGHT,
    SQUARE,
    TEXELS_SIZE,
    UP,
)
from .kit import REFERENCE, Floats, Studio

Pixel = tuple[float | None, float | None, float | None, float | None]
"""The lanes of a pixel; None where a lane does not matter."""

HALF = 0.5
CLOSE = 2e-3
"""For what is interpolated; every mistake that is looked for here is hundreds of times as large."""


@dataclass(frozen=True, slots=True)
class Expectation:
    """One pixel."""

    name: str
    drawing: str
    pixel: tuple[int, int]
    """From the left and from the top."""
    lanes: Pixel
    target: int = 0
    tolerance: float = 0.0
    flipped: Pixel | None = None
    """The pixel in a flipped text, whose first row in memory is the bottom one, if it differs."""


def _world() -> Iterator[Expectation]:
    """12 pixels a unit from (48, 24) at z = 0, 16 at z = 1, 9.6 at z = -1; y goes up."""
    for name, pixel, mark in [
        ("x goes right", (48 + 30, 24), RIGHT),
        ("y goes up", (48, 24 - 16), UP),
        ("z goes towards the viewer", (8, 24), NEAR_FIRST),
        ("what is further away is smaller", (48 - 22, 24), FAR_LAST),
        ("the nearer wins, drawn first", (4, 20), NEAR_FIRST),
        ("the nearer wins, drawn last", (4, 24 + 20), NEAR_LAST),
    ]:
        yield Expectation(name, "world", pixel, (mark, None, None, None))
    for drawing in ("last on top", "nothing hidden"):
        yield Expectation(f"{drawing}: far", drawing, (4, 20), (FAR_LAST, None, None, None))
        yield Expectation(f"{drawing}: near", drawing, (4, 24 + 20), (NEAR_LAST, None, None, None))
    yield Expectation("nothing is farther than what is cleared", "farther", (4, 20), BARE)
    for name, pixel in [
        ("nothing at -x", (48 - 10, 24)),
        ("nothing below", (48, 24 + 16)),
    ]:
        yield Expectation(name, "world", pixel, BARE)
    at = ((26 + HALF - 48) / 9.6, (24 - 22 - HALF) / 9.6, -1, 1)
    yield Expectation("world position", "world", (26, 22), at, target=1, tolerance=CLOSE)
    # x from -0.5 to 0.5 and y from 1 to 1.75 turn to x from -1.75 to -1 and y from -0.5 to 0.5.
    # Moved afterwards, this reaches from -1.5 to -0.75; moved before, from -0.25 to 0.75 in y.
    pixel = (48 - 10, 24 + 4)
    at = ((HALF - 10) / 12, (-4 - HALF) / 12, 0, 1)
    yield Expectation("turned, then moved", "turned", pixel, (UP, None, None, None))
    yield Expectation("turned position", "turned", pixel, at, target=1, tolerance=CLOSE)


def _depth() -> Iterator[Expectation]:
    drawn = {
        "before the near plane": (Cell.BEFORE_NEAR, BARE),
        "beyond the far plane": (Cell.BEYOND_FAR, BARE),
        "behind the viewer": (Cell.BEHIND, BARE),
        "close to the near plane": (Cell.NEAR, (Cell.NEAR, None, None, None)),
        "close to the far plane": (Cell.FAR, (Cell.FAR, None, None, None)),
        "the nearer over what is there": (Cell.UNDER_FIRST, (OVER, None, None, None)),
        "the nearer under what comes": (Cell.OVER_FIRST, (OVER, None, None, None)),
    }
    for name, (cell, lanes) in drawn.items():
        yield Expectation(name, "cells", middle(cell), lanes)
    x, y = middle(Cell.CROSSING)
    yield Expectation("clipped where z < 0", "cells", (x - 2, y), BARE)
    shown = (Cell.CROSSING, None, None, None)
    yield Expectation("not clipped where z > 0", "cells", (x + 2, y), shown)


def _coordinates() -> Iterator[Expectation]:
    for name, cell, pixel, z, w in [
        ("in the first cell", Cell.PLAIN, (CENTER, CENTER), 0.5, 1),
        ("in the last cell", Cell.LAST, (CENTER, CENTER), 0.5, 1),
        ("in a top left corner", Cell.PLAIN, (LOW, LOW), 0.5, 1),
        ("in a bottom right corner", Cell.LAST, (HIGH - 1, HIGH - 1), 0.5, 1),
        ("nearby", Cell.NEAR, (CENTER, CENTER), 0.125, 1),
        ("far away", Cell.FAR, (CENTER, CENTER), 0.875, 1),
        ("where w is 2", Cell.DOUBLE_W, (CENTER, CENTER), 0.25, 0.5),
    ]:
        x, y = (place - CENTER + inside for place, inside in zip(middle(cell), pixel, strict=True))
        from_top = (x + HALF, y + HALF, z, w)
        from_below = (x + HALF, HEIGHT - y - HALF, z, w)
        yield Expectation(
            f"frag_coord {name}", "cells", (x, y), from_top, 1, CLOSE, flipped=from_below
        )


def _interpolation() -> Iterator[Expectation]:
    inside = CENTER + HALF
    pixel = middle(Cell.PLAIN)
    slide = (Cell.PLAIN, None, inside, -inside)
    yield Expectation("interpolation", "cells", pixel, slide, tolerance=CLOSE)
    # From w = 1 at the left end to w = 3 at the right one.
    share = (inside - LOW) / (HIGH - LOW)
    over_w, one_over_w = share / 3, (1 - share) + share / 3
    right = LOW + (HIGH - LOW) * over_w / one_over_w
    receding = (Cell.RECEDING, None, right, None)
    pixel = middle(Cell.RECEDING)
    yield Expectation("perspective", "cells", pixel, receding, tolerance=CLOSE)
    coordinate = (None, None, 0.5, one_over_w)
    yield Expectation("frag_coord.w in between", "cells", pixel, coordinate, 1, CLOSE)
    for name, cell, mark in [
        ("left", Cell.FIRST_LEFT, 7),
        ("right", Cell.FIRST_RIGHT, 20),
        ("top", Cell.FIRST_TOP, 33),
    ]:
        lanes = (mark, None, None, None)
        yield Expectation(f"flat from the first vertex, {name}", "cells", middle(cell), lanes)
    pixel = middle(Cell.INTEGERS)
    yield Expectation("int attributes", "integers", pixel, WHOLE)
    yield Expectation("uint attributes", "integers", pixel, (*NATURAL, Cell.INTEGERS), 1)


def _faces() -> Iterator[Expectation]:
    front, back = middle(Cell.PLAIN), middle(Cell.CLOCKWISE)
    counter_clockwise, clockwise = (Cell.PLAIN, 1, None, None), (Cell.CLOCKWISE, 0, None, None)
    yield Expectation("counter-clockwise is the front", "cells", front, counter_clockwise)
    yield Expectation("clockwise is the back", "cells", back, clockwise)
    yield Expectation("back faces culled: front", "without back", front, counter_clockwise)
    yield Expectation("back faces culled: back", "without back", back, BARE)
    yield Expectation("front faces culled: front", "without front", front, BARE)
    yield Expectation("front faces culled: back", "without front", back, clockwise)


def _derivatives() -> Iterator[Expectation]:
    for name, cell in [("on even ground", Cell.PLAIN), ("at the end", Cell.LAST)]:
        pixel = middle(cell)
        yield Expectation(f"slopes of frag_coord {name}", "slopes", pixel, (1, 0, 0, 1), 0, CLOSE)
        # What rises to the right and upwards: ddy goes down, as frag_coord.y does.
        yield Expectation(
            f"slopes of a varying {name}", "slopes", pixel, (1, 0, 0, -1), 1, CLOSE,
            flipped=(1, 0, 0, 1),
        )  # fmt: skip


_OF_MATRICES = {
    "matrices": matrices.PIXELS,
    "hoisted": matrices.PIXELS,
    "rectangles": rectangles.PIXELS,
    "hoisted rectangles": rectangles.PIXELS,
}
"""The expected pixels of drawings that are rows of values of matrices."""


def _matrices() -> Iterator[Expectation]:
    for drawing, pixels in _OF_MATRICES.items():
        for number, (name, (x, y, z, w)) in enumerate(pixels.items()):
            yield Expectation(f"{drawing}: {name}", drawing, (number, 0), (x, y, z, w))


WRAPS: Sequence[Callable[[int, int], int]] = (
    lambda place, count: place % count,
    lambda place, count: min(max(place, 0), count - 1),
    lambda place, count: (
        place
        if 0 <= place < count
        else (-1 - place) % (2 * count)
        if place < 0
        else 2 * count - 1 - place
    ),
)
"""The texel that is shown for a place up to one texture's size before or behind a texture."""


def _textures() -> Iterator[Expectation]:
    width, height = TEXELS_SIZE
    for name, pixel, texel in [
        ("top left", (0, 0), SQUARE[0, 0]),
        ("top right", (width - 1, 0), SQUARE[0, 1]),
        ("bottom left", (0, height - 1), SQUARE[1, 0]),
        ("bottom right", (width - 1, height - 1), SQUARE[1, 1]),
    ]:
        x, y, z, w = (texel / 255).tolist()
        yield Expectation(f"texture, {name}", "textures", pixel, (x, y, z, w), 0, 1e-6)
    across, down = (0, 2, 4, 7, 8, 10, 11, 5), (8, 1, 3, 0, 5, 6, 2, 4)
    for pixel in zip(across, down, strict=True):
        at = pixel[0] - 4, pixel[1] - 3
        shown = [OBLONG[wrap(at[1], 3), wrap(at[0], 4)] / 255 for wrap in WRAPS]
        repeated, clamped, mirrored = map(float, shown)
        lanes = (repeated, clamped, mirrored, 1)
        yield Expectation(f"wrapped, texel {at}", "textures", pixel, lanes, 1, 1e-6)


pytestmark = pytest.mark.xdist_group("conventions")
"""One process compiles the drawings, for all tests."""

IN_SPACE = [
    *_world(), *_depth(), *_coordinates(), *_interpolation(), *_faces(), *_derivatives(),
    *_textures(),
]  # fmt: skip
FLIPPED = sorted({expectation.drawing for expectation in IN_SPACE})


@pytest.fixture(scope="module")
def drawn(studio: Studio) -> Callable[[str, str, bool], tuple[Floats, ...]]:
    """The targets of a drawing on a route, as it is or flipped; each is drawn once."""
    studio.prepare(
        *(drawing.material(flip_y=False) for drawing in DRAWINGS.values()),
        *(DRAWINGS[name].material(flip_y=True) for name in FLIPPED),
    )

    @cache
    def draw(route: str, name: str, flip_y: bool) -> tuple[Floats, ...]:
        drawing = DRAWINGS[name]
        material = drawing.material(flip_y=flip_y)
        return studio.draw(route, material, drawing.state(material))

    return draw


FIRST_ROW_BELOW = ("llvmpipe:gl450", "chromium:webgpu")

Drawn = Callable[[str, str, bool], tuple[Floats, ...]]


@pytest.mark.parametrize("expectation", [*IN_SPACE, *_matrices()], ids=lambda e: e.name)
@pytest.mark.parametrize("route", [REFERENCE, *ROUTES])
def test_convention(drawn: Drawn, route: str, expectation: Expectation) -> None:
    targets = drawn(route, expectation.drawing, False)
    _check(targets, expectation, expectation.lanes)


@pytest.mark.parametrize("expectation", IN_SPACE, ids=lambda e: e.name)
@pytest.mark.parametrize("route", ROUTES)
def test_convention_in_a_flipped_text(drawn: Drawn, route: str, expectation: Expectation) -> None:
    """The picture is the same, but the first row in memory of some is then the bottom one."""
    targets = drawn(route, expectation.drawing, True)
    from_below = route in FIRST_ROW_BELOW and expectation.flipped is not None
    _check(targets, expectation, expectation.flipped if from_below else expectation.lanes)


def _check(targets: Sequence[Floats], expectation: Expectation, lanes: Pixel | None) -> None:
    assert lanes is not None
    x, y = expectation.pixel
    got = targets[expectation.target][y, x]
    wanted = np.array([g if lane is None else lane for g, lane in zip(got, lanes, strict=True)])
    assert np.isfinite(got).all()
    assert (abs(got - wanted) <= expectation.tolerance).all(), f"{got} is not {lanes}"
