"""The movement of triangles' depths by a bias: by hand, and with the freedom of specifications.

The triangles lie before an orthographic camera: the plane of each is known in pixels.
"""

from __future__ import annotations

import numpy as np
import pytest

from burnish.compiler.ir.render_state import DepthState, RenderState
from burnish.compiler.reference.picture import RasterRules
from burnish.compiler.reference.picture.assembly import faces_of
from burnish.compiler.reference.picture.faces import Faces

from .kit import few_ulps, picture
from .test_drawing import BLUE, COLOURED, RED, at, layers, passing

SIZE = 16
RULES = RasterRules(SIZE, SIZE, subpixel_bits=8)
WHOLE = np.array([[0, 1, 2]])


def faces(depths: tuple[float, float, float], state: DepthState) -> Faces:
    """Half of the picture, with depths at the left top, at the left bottom and at the right."""
    places = [(-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
    corners = [(x, y, z, 1.0) for (x, y), z in zip(places, depths, strict=True)]
    return faces_of(np.array(corners), WHOLE, RULES, state=RenderState(depth=state))


def moved(depths: tuple[float, float, float], **bias: float) -> tuple[float, float]:
    """The distance by which the face is moved, and the error of that which devices may make."""
    usual = faces(depths, DepthState())
    found = faces(depths, DepthState(**bias))  # type: ignore[arg-type]
    by = (found.z - usual.z)[0]
    assert np.ptp(by) < 1e-15
    return float(by[0]), float((found.z_off - usual.z_off)[0])


@pytest.mark.parametrize(
    ("depth", "step"), [(0.25, 2.0**-25), (0.5, 2.0**-24), (0.75, 2.0**-24), (0.3, 2.0**-25)]
)
def test_a_step_is_that_of_the_largest_depth(depth: float, step: float) -> None:
    by, off = moved((depth, 0.25, 0.25), bias=-1000)
    assert by == pytest.approx(-1000 * step)
    # At a power of two, a depth may be rounded below it, where steps are half as large.
    assert (off < 1e-3 * abs(by)) == (depth not in (0.25, 0.5))


def test_slopes_are_those_of_one_pixel() -> None:
    """Depths rise by 0.25 over 16 pixels to the right, and by 0.5 downwards."""
    by, off = moved((0.25, 0.75, 1.0), slope_bias=2.0)
    right, down = 0.25 / SIZE, 0.5 / SIZE
    assert by == pytest.approx(2 * down)
    # Vulkan and OpenGL may take the length of the gradient.
    longest = 2 * np.hypot(right, down)
    assert longest <= by + off < 1.05 * longest


def test_along_one_axis_both_slopes_are_the_same() -> None:
    by, off = moved((0.25, 0.75, 0.75), slope_bias=1.0)
    assert by == pytest.approx(0.5 / SIZE)
    assert off < 0.02 * by


@pytest.mark.parametrize(
    ("clamp", "expected"), [(0.0, 0.0625), (0.01, 0.01), (0.5, 0.0625), (-0.01, 0.0625)]
)
def test_a_clamp_limits_both_together(clamp: float, expected: float) -> None:
    by, _ = moved((0.25, 0.75, 0.75), slope_bias=2.0, bias_clamp=clamp)
    assert by == pytest.approx(expected)
    by, _ = moved((0.25, 0.75, 0.75), slope_bias=-2.0, bias_clamp=-clamp)
    assert by == pytest.approx(-expected)


def test_lines_stay_where_they_are() -> None:
    corners = np.array([(-1.0, 0.0, 0.5, 1.0), (1.0, 0.0, 0.75, 1.0)])
    state = RenderState(depth=DepthState(bias=10000, slope_bias=8.0))
    line = np.array([[0, 1]])
    plain, asked = (faces_of(corners, line, RULES, state=each) for each in (RenderState(), state))
    assert np.array_equal(plain.z, asked.z)


@pytest.mark.parametrize("winding", ["counter_clockwise", "clockwise"])
def test_which_side_is_the_front(winding: str) -> None:
    """The corners go counter-clockwise, as seen."""
    corners = np.array([(-1, 1, 0.5, 1), (-1, -1, 0.5, 1), (1, -1, 0.5, 1)], np.float64)
    state = RenderState(front=winding)  # type: ignore[arg-type]
    assert faces_of(corners, WHOLE, RULES, state=state).front.all() == (
        winding == "counter_clockwise"
    )


@pytest.mark.parametrize(("bias", "undecided"), [(1 << 19, False), (1 << 22, True)])
def test_a_depth_that_leaves_its_range_is_undecided(bias: int, undecided: bool) -> None:
    """A face at 0.9 is moved by 2^-5, or by 2^-2: then devices cut it, or have it at 1."""
    given = passing(COLOURED)
    given.render_state = RenderState(depth=DepthState(bias=bias))
    found = picture(given, layers((0.9, RED)), at(), clear=BLUE, errors=few_ulps)
    assert (found.undecided == undecided).all()
