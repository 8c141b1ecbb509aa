"""Pictures with four samples for each pixel, against values that are worked out by hand.

Most pictures have a single pixel, whose samples lie at (3, 1), (7, 3), (1, 5) and (5, 7) eighths
from its left and upper side.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from burnish.compiler.ir.shader import Shader
from burnish.compiler.reference.picture import (
    Canvas,
    Expected,
    Geometry,
    Hulls,
    RasterRules,
    draw_onto,
    expected_on,
    written_by,
)

from .kit import few_ulps, picture, shader
from .test_coverage import clip_positions
from .test_drawing import PASSING, triangles

ONE = RasterRules(1, 1, subpixel_bits=8, samples=4)
FAR = 40.0
CONSTANT = "param c : vec4 = vec4(1)\nvalue = c"
STEP = 2.0**-11
"""The distance of floats of 16 bits between 1/2 and 1."""
BLACK = (0.0, 0.0, 0.0, 0.0)
Point = tuple[float, float]


def smooth(
    members: str = CONSTANT, format_: str = "rgba16f", more: str = "", samples: int = 4
) -> Shader:
    """A shader with four samples that draws `value`, which `members` define."""
    return shader(
        f"""{PASSING}
        material M : Base {{ {members} }}
        pass P {{
            raster {{ samples = {samples} }}
            target t : {format_} = material.value {more}
        }}""",
        "P",
    )


def face(*corners: Point, z: Sequence[float] = (0.5, 0.5, 0.5), rules: RasterRules = ONE) -> Any:
    """The clip positions of a triangle between places in the picture, in pixels."""
    places = clip_positions(corners, rules)
    places[:, 2] = z
    return places


def left_of(edge: float, **more: Any) -> Any:
    """A triangle over all that is left of an upright edge."""
    return face((edge, -FAR), (-FAR, 0.0), (edge, FAR), **more)


def red(found: Expected) -> float:
    """The red of the only pixel."""
    return float(found.targets[0][0, 0, 0])


@pytest.mark.parametrize(("edge", "samples"), [(0.1, 0), (0.25, 1), (0.5, 2), (0.75, 3), (0.9, 4)])
def test_a_pixel_has_the_share_of_its_samples_that_are_covered(edge: float, samples: int) -> None:
    found = picture(smooth(), triangles(left_of(edge)), ONE)
    assert red(found) == samples / 4
    assert found.covered.tolist() == [[samples > 0]]
    assert not found.undecided.any()


def test_two_triangles_with_an_edge_in_common_cover_each_sample_once() -> None:
    square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    halves = [face(*(square[i] for i in each)) for each in ((0, 1, 2), (0, 2, 3))]
    found = picture(smooth(more="blend add"), triangles(*halves), ONE)
    assert red(found) == 1.0


SLIVER = face((0.0, 0.2), (0.3, 0.375), (0.0, 0.55))
"""A face that covers the place (1, 3) only."""


@pytest.mark.parametrize("bottom_up", [False, True])
def test_a_device_that_counts_rows_from_below_has_its_samples_turned_over(bottom_up: bool) -> None:
    rules = RasterRules(1, 1, subpixel_bits=8, bottom_up=bottom_up)
    assert red(picture(smooth(), triangles(SLIVER), rules)) == (0.25 if bottom_up else 0.0)


def test_pixels_have_their_samples_in_the_order_of_rows() -> None:
    rules = RasterRules(3, 2, subpixel_bits=8)
    cut = face((1.5, -FAR), (-FAR, 0.0), (1.5, FAR), rules=rules)
    found = picture(smooth(), triangles(cut), rules)
    assert found.targets[0][..., 0].tolist() == [[1.0, 0.5, 0.0]] * 2


# --- shading -------------------------------------------------------------------------------------


@pytest.mark.parametrize("edge", [0.25, 0.75])
def test_values_are_those_at_the_centre_even_outside_of_the_triangle(edge: float) -> None:
    """The value is the distance from the left side, which is 1/2 at the centre."""
    given = smooth("attribute s : float\nvalue = vec4(s, frag_coord.x, frag_coord.y, 1)")
    found = picture(given, triangles(left_of(edge), s=[edge, -FAR, edge]), ONE)
    share = found.targets[0][0, 0, 3]
    assert np.allclose(found.targets[0][0, 0] / share, [0.5, 0.5, 0.5, 1.0], rtol=0, atol=1e-12)


@pytest.mark.parametrize(("horizon", "known"), [(0.5 - 1e-6, False), (0.25, True)])
def test_nothing_is_known_of_a_centre_at_the_horizon(horizon: float, known: bool) -> None:
    """A floor of which only the lowest sample of the pixel is seen."""
    given = smooth("attribute s : float\nvalue = vec4(s)")
    places = face((-FAR, 0.7), (FAR, 0.7), (0.5, FAR))
    # 1 / w grows from the horizon downwards.
    far = 1.0 / (np.array([0.7, 0.7, FAR]) - horizon)
    rules = RasterRules(1, 1, subpixel_bits=8, varying_bits=22)
    mesh = triangles(places * far[:, None], s=[0.0, 1e-6, 2e-6])
    found = picture(given, mesh, rules, errors=few_ulps)
    assert found.covered.all()
    wide = found.high[0][0, 0, 0] - found.low[0][0, 0, 0]
    assert np.isfinite(wide) == known


def test_a_fragment_discards_all_its_samples() -> None:
    source = """
    attribute s : float
    value = vec4(1)
    """
    given = smooth(source, more="\ndiscard when material.s < 0.4")
    # At the centre, the value is 1/2 or, if the vertices' values are smaller, below 0.4.
    kept, dropped = (
        triangles(left_of(0.75), s=[0.75 - by, -FAR - by, 0.75 - by]) for by in (0.0, 0.125)
    )
    assert red(picture(given, kept, ONE)) == 0.75
    assert red(picture(given, dropped, ONE)) == 0.0


def test_pixels_of_a_quad_without_a_covered_sample_help_with_derivatives() -> None:
    rules = RasterRules(2, 2, subpixel_bits=8)
    given = smooth("attribute s : float\nvalue = vec4(ddx(s), ddy(s), 0, 1)")
    corner = face((0.0, 0.0), (0.8, 0.0), (0.0, 0.8), rules=rules)
    mesh = triangles(corner, s=[0.0, 0.8, 1.6])
    found = picture(given, mesh, rules)
    assert found.covered.tolist() == [[True, False], [False, False]]
    share = found.targets[0][0, 0, 3]
    assert np.allclose(found.targets[0][0, 0, :2] / share, [1.0, 2.0])


# --- tests and blending --------------------------------------------------------------------------


@pytest.mark.parametrize(("crossing", "nearer"), [(0.25, 1), (0.5, 2), (0.75, 3)])
def test_the_depth_of_each_sample_is_compared(crossing: float, nearer: int) -> None:
    """A triangle at one depth, and one that goes through it within the pixel."""
    level = left_of(FAR)
    # Its depth is 1/2 at the crossing, and grows by 1/128 for each pixel to the right.
    depths = [0.5 + (x - crossing) / 128 for x in (FAR, -FAR, FAR)]
    steep = left_of(FAR, z=depths)
    given = smooth("attribute s : float\nvalue = vec4(s)")
    for order in ([0, 1], [1, 0]):
        of_corners = np.repeat(np.array([[0.0], [1.0]])[order], 3, axis=0)
        mesh = triangles(*([level, steep][i] for i in order), s=of_corners)
        found = picture(given, mesh, ONE)
        assert red(found) == nearer / 4
        assert not found.undecided.any()


@pytest.mark.parametrize("samples", [1, 4])
def test_a_bias_moves_the_depths_of_all_samples(samples: int) -> None:
    text = f"""{PASSING}
    material M : Base {{ attribute s : float
    value = vec4(s) }}
    pass P {{
        raster {{ samples = {samples} }}
        depth {{ slope_bias = 2 }}
        target t : rgba16f = material.value
    }}"""
    sloped = [0.5 + x / 128 for x in (FAR, -FAR, FAR)]
    # Two pixels' slope farther away, or by less.
    for by, seen in ((1.5, 1.0), (2.5, 0.0)):
        behind = [z + by / 128 for z in sloped]
        level = left_of(FAR, z=behind)
        given, plain = shader(text, "P"), shader(text.replace("slope_bias = 2", "bias = 0"), "P")
        canvas = blank(given)
        rules = RasterRules(1, 1, subpixel_bits=8, samples=samples)
        for which, mesh, value in ((plain, level, 1.0), (given, left_of(FAR, z=sloped), 0.0)):
            draw_onto(canvas, which, {}, {}, triangles(mesh, s=[value] * 3), rules)
        assert red(expected_on(canvas, rules)) == seen


def blank(given: Shader, *, rounds: bool = False) -> Canvas:
    """A canvas of one pixel for a shader."""
    count = given.render_state.samples
    return Canvas(count, [BLACK], written_by(given), rounds=rounds)


def test_each_sample_has_a_stencil_value() -> None:
    """The first draw marks the left part of the pixel; the second one draws where that is."""
    stencil = "depth {{ compare = always }}\nstencil {{ {} }}"
    mark, use = (
        shader(
            f"""{PASSING}
            material M : Base {{ {CONSTANT} }}
            pass P {{
                raster {{ samples = 4 }}
                {stencil.format(state)}
                target t : rgba16f = material.value
            }}""",
            "P",
        )
        for state in ("reference = 1, pass = replace", "reference = 1, compare = equal")
    )
    canvas = blank(mark)
    for given, edge, shade in ((mark, 0.75, 0.0), (use, FAR, 1.0)):
        draw_onto(canvas, given, {"c": (shade,) * 4}, {}, triangles(left_of(edge)), ONE)
    assert sorted(canvas.stencil.values.tolist()) == [0, 1, 1, 1]
    assert red(expected_on(canvas, ONE)) == 0.75


@pytest.mark.parametrize(
    ("format_", "shade", "expected"),
    [("rgba16f", 0.75, 1.125), ("rgba8", 0.75, 0.875), ("rgba8", 0.25, 0.375)],
)
def test_each_sample_is_blended(format_: str, shade: float, expected: float) -> None:
    """Half of the pixel is drawn twice: a format in fixed point clamps it there before the mean is
    taken."""
    given = smooth(format_=format_, more="blend add")
    mesh = triangles(left_of(FAR), left_of(0.5, z=(0.25, 0.25, 0.25)))
    assert red(picture(given, mesh, ONE, c=(shade,) * 4)) == expected


# --- means ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("format_", "colour", "expected"),
    [("rgba16f", 8.0, 2.0), ("rgba8", 8.0, 0.25), ("rgba8_srgb", 1.0, 0.25)],
)
def test_the_mean_is_one_of_linear_numbers_that_the_format_has(
    format_: str, colour: float, expected: float
) -> None:
    found = picture(smooth(format_=format_), triangles(left_of(0.25)), ONE, c=(colour,) * 4)
    assert red(found) == expected


@pytest.mark.parametrize("format_", ["rgba8", "rgba8_srgb", "rgba16f", "rgb10a2"])
def test_a_pixel_whose_samples_are_alike_has_the_bounds_of_one_sample(format_: str) -> None:
    colour = (0.2, 0.4, 0.6, 1.0)
    mesh = triangles(left_of(FAR))
    one, four = (
        picture(smooth(format_=format_, samples=n), mesh, ONE, errors=few_ulps, c=colour)
        for n in (1, 4)
    )
    assert np.array_equal(one.low, four.low)
    assert np.array_equal(one.high, four.high)


def test_what_nothing_covers_is_known_exactly() -> None:
    given = smooth(format_="rgba8")
    nothing = triangles(left_of(0.1))
    found = picture(given, nothing, ONE, clear=(0.2, 0.4, 0.6, 0.8), errors=few_ulps)
    untouched = picture(
        smooth(format_="rgba8", samples=1), nothing, ONE, clear=(0.2, 0.4, 0.6, 0.8),
        errors=few_ulps,
    )  # fmt: skip
    assert np.array_equal(found.low, untouched.low)
    assert np.array_equal(found.high, untouched.high)


def test_a_mean_is_rounded_to_either_neighbour_of_the_format() -> None:
    """The mean of one step and three zeros is a quarter of a step, which becomes 0 or 1."""
    given = smooth(format_="rgba8")
    found = picture(given, triangles(left_of(0.25)), ONE, errors=few_ulps, c=(1 / 255,) * 4)
    assert found.targets[0][0, 0, 0] == pytest.approx(1 / 1020)
    assert found.low[0][0, 0, 0] == 0.0
    assert found.high[0][0, 0, 0] == pytest.approx(1 / 255, rel=1e-6)
    assert found.high[0][0, 0, 0] >= 1 / 255


def test_a_mean_may_overflow_on_its_way() -> None:
    """Four times the largest float of 16 bits is a float of 32 bits."""
    given = smooth(format_="rgba16f")
    found = picture(given, triangles(left_of(0.75)), ONE, errors=few_ulps, c=(65504.0,) * 4)
    assert red(found) == 0.75 * 65504
    assert found.high[0][0, 0, 0] < 65504


# --- what hangs on rounding ----------------------------------------------------------------------


@pytest.mark.parametrize("aside", [-1e-7, 1e-7], ids=["covered", "uncovered"])
def test_a_pixel_with_an_undecided_sample_is_one_of_both(aside: float) -> None:
    """The edge goes through the third of the samples from the left."""
    rules = RasterRules(1, 1, samples=4)
    given = smooth()
    canvas = blank(given, rounds=True)
    hulls = Hulls(canvas)
    mesh: Geometry = triangles(left_of(0.625 - aside))
    draw_onto(canvas, given, {"c": (1.0,) * 4}, {}, mesh, rules, few_ulps, hulls=hulls)
    assert int((canvas.undecided | canvas.shaky).sum()) == 1
    found = expected_on(canvas, rules, hulls=hulls)
    assert found.undecided.all()
    ends = [found.low[0][0, 0, 0], found.high[0][0, 0, 0]]
    assert ends == pytest.approx([0.5, 0.75], abs=STEP)
    assert ends[0] <= 0.5 and ends[1] >= 0.75


def test_only_an_edge_through_a_sample_is_undecided() -> None:
    rules = RasterRules(1, 1)
    for edge, undecided in ((0.5, False), (0.625, True), (0.875, True), (0.7, False)):
        found = picture(smooth(), triangles(left_of(edge)), rules)
        assert found.undecided.tolist() == [[undecided]]


def test_shaders_may_read_the_depth_of_any_sample() -> None:
    """The depth changes by 1/128 per pixel; samples are within half a pixel of the centre."""
    given = smooth("value = vec4(frag_coord.z, frag_coord.w, 0, 1)")
    sloped = left_of(FAR, z=[0.5 + (x - 0.5) / 128 for x in (FAR, -FAR, FAR)])
    found = picture(given, triangles(sloped), ONE, errors=few_ulps)
    low, high = found.low[0][0, 0, 0], found.high[0][0, 0, 0]
    assert red(found) == 0.5
    assert low < 0.5 - 0.375 / 128 and high > 0.5 + 0.375 / 128
    assert low > 0.5 - 0.75 / 128 and high < 0.5 + 0.75 / 128
    assert found.high[0][0, 0, 1] - found.low[0][0, 0, 1] < 0.01
