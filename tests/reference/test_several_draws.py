"""Several draws on one canvas: what is in front, and what undecided pixels may be.

The colours and depths are told by the test. Where a device may draw either of two faces, it has the
colour of one of them, which has to lie within the hull.
"""

from __future__ import annotations

import numpy as np
import pytest

from burnish.compiler.reference.picture import (
    Canvas,
    Expected,
    Hulls,
    draw_onto,
    expected_on,
    written_by,
)

from .kit import few_ulps
from .test_drawing import at, passing, triangles

PIXELS = 4
BLACK = (0.0, 0.0, 0.0, 1.0)
RULES = at(2, edge_slack=2.0**-10)
COLOURED = "param c : vec4 = vec4(0)\nvalue = c"
LEFT, RIGHT = (0, 2), (1, 3)
"""Numbers of pixels of a picture that is two pixels wide."""

Layer = tuple[float, float]
"""A depth and a shade of red."""


def cover(depth: float, edge: float = 3.0) -> list[tuple[float, float, float, float]]:
    """A triangle over all that is left of an upright edge, in clip space."""
    return [(edge, 20.0, depth, 1.0), (-20.0, 0.0, depth, 1.0), (edge, -20.0, depth, 1.0)]


class Painting:
    """A canvas, and what its undecided pixels may be."""

    def __init__(self, blend: str = "none", *, has_depth: bool = True) -> None:
        self._shader = passing(COLOURED, blend)
        written = written_by(self._shader)
        self.canvas = Canvas(PIXELS, [BLACK], written, rounds=True, has_depth=has_depth)
        self.hulls = Hulls(self.canvas)

    def draw(self, layer: Layer, edge: float = 3.0) -> None:
        """Draw all that is left of an edge in one depth and one shade of red."""
        depth, red = layer
        draw_onto(
            self.canvas, self._shader, {"c": (red, 0.0, 0.0, 1.0)}, {},
            triangles(cover(depth, edge)), RULES, few_ulps, hulls=self.hulls,
        )  # fmt: skip

    @property
    def picture(self) -> Expected:
        """The picture after the draws so far."""
        return expected_on(self.canvas, RULES)

    @property
    def reds(self) -> list[float]:
        """The shades of red of all pixels."""
        return [float(red) for red in self.canvas.targets[0][0, :, 0]]

    def hull(self, pixel: int) -> tuple[float, float]:
        """The two reds between which the red of a pixel is."""
        low, high = self.hulls.targets[0][:, pixel, 0]
        return float(low), float(high)

    def depths(self, pixel: int) -> tuple[float, float]:
        """The two depths between which the depth of a pixel is."""
        low, high = self.hulls.depth[:, pixel]
        return float(low), float(high)


NEAR, FAR = (0.25, 0.75), (0.5, 0.5)
THROUGH_CENTRES = 0.5
"""An edge through the middles of the pixels of the right column: rounding may tip whether these are
covered."""


@pytest.mark.parametrize("layers", [(NEAR, FAR), (FAR, NEAR)], ids=["near first", "far first"])
def test_the_nearest_of_several_draws_is_seen(layers: tuple[Layer, Layer]) -> None:
    painting = Painting()
    for layer in layers:
        painting.draw(layer)
    assert painting.reds == [0.75] * PIXELS
    assert not painting.picture.undecided.any()


def test_without_depths_the_last_draw_is_seen() -> None:
    painting = Painting(has_depth=False)
    painting.draw(NEAR)
    painting.draw(FAR)
    assert painting.reds == [0.5] * PIXELS
    assert not painting.picture.undecided.any()


def test_draws_are_added() -> None:
    painting = Painting("add", has_depth=False)
    for layer in (NEAR, FAR, FAR):
        painting.draw(layer)
    assert painting.reds == [1.75] * PIXELS


def test_draws_at_one_depth_are_undecided_and_either_of_them() -> None:
    painting = Painting()
    painting.draw((0.5, 0.75))
    painting.draw((0.5, 0.25))
    assert painting.picture.undecided.all()
    low, high = painting.hull(0)
    assert low <= 0.25
    assert 0.75 <= high < 0.76


@pytest.mark.parametrize("aside", [-1e-6, 1e-6], ids=["not drawn", "drawn"])
def test_an_undecided_pixel_is_what_was_there_or_what_may_be_drawn(aside: float) -> None:
    """Both are in the hull, whichever of them the reference has drawn."""
    painting = Painting()
    painting.draw(FAR)
    painting.draw(NEAR, THROUGH_CENTRES + aside)
    assert painting.reds[1] == (0.75 if aside > 0 else 0.5)
    assert painting.picture.undecided.ravel().tolist() == [False, True, False, True]
    for pixel in LEFT:
        assert painting.hull(pixel) == pytest.approx((0.75, 0.75), abs=1e-6)
    for pixel in RIGHT:
        assert painting.hull(pixel) == pytest.approx((0.5, 0.75), abs=1e-6)
        assert painting.depths(pixel) == pytest.approx((0.25, 0.5), abs=1e-6)


@pytest.mark.parametrize("aside", [-1e-6, 1e-6], ids=["not drawn", "drawn"])
@pytest.mark.parametrize(
    ("blend", "last", "left", "right"),
    [
        ("add", FAR, 1.75, (1.0, 1.75)),
        ("add", None, 1.25, (0.5, 1.25)),
        ("alpha", FAR, 0.5, (0.5, 0.5)),
        ("alpha", None, 0.75, (0.5, 0.75)),
    ],
)
def test_what_may_be_blended_or_not_is_in_the_hull(
    blend: str, last: Layer | None, left: float, right: tuple[float, float], aside: float
) -> None:
    """This holds whichever of them the reference has drawn, and for any later blending."""
    painting = Painting(blend, has_depth=False)
    painting.draw(FAR)
    painting.draw(NEAR, THROUGH_CENTRES + aside)
    if last is not None:
        painting.draw(last)
    for pixel in LEFT:
        assert painting.hull(pixel) == pytest.approx((left, left), abs=1e-6)
    for pixel in RIGHT:
        assert painting.hull(pixel) == pytest.approx(right, abs=1e-6)


@pytest.mark.parametrize("aside", [-1e-6, 1e-6], ids=["not drawn", "drawn"])
def test_what_may_be_hidden_or_not_is_blended_or_not(aside: float) -> None:
    """A near layer hides those behind it, if it is there."""
    painting = Painting("add")
    painting.draw(NEAR, THROUGH_CENTRES + aside)
    painting.draw(FAR)
    for pixel in RIGHT:
        low, high = painting.hull(pixel)
        assert low <= 0.5
        assert high >= 0.75


def test_what_is_hidden_is_not_blended() -> None:
    painting = Painting("add")
    painting.draw(NEAR)
    painting.draw((0.4, 0.25), THROUGH_CENTRES)
    painting.draw(FAR)
    for pixel in RIGHT:
        low, high = painting.hull(pixel)
        assert low <= 0.75 <= high


def test_what_is_drawn_over_an_undecided_pixel_is_in_its_hull() -> None:
    """A device has the near layer there, whatever was drawn before."""
    painting = Painting()
    painting.draw(FAR, THROUGH_CENTRES)
    painting.draw(NEAR)
    for pixel in RIGHT:
        low, high = painting.hull(pixel)
        assert low <= 0.75 <= high
        assert np.isfinite([low, high]).all()


def test_of_what_is_added_where_it_may_be_nothing_is_known() -> None:
    painting = Painting("add", has_depth=False)
    painting.draw(FAR)
    painting.draw(NEAR, THROUGH_CENTRES)
    for pixel in RIGHT:
        low, high = painting.hull(pixel)
        assert low <= 0.5
        assert high >= 1.25
    assert painting.hull(0) == pytest.approx((1.25, 1.25), abs=1e-6)
