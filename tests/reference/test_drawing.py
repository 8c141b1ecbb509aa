"""Whole pictures: interpolation, depth, discarding, blending, jumps, and input that is unfit."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

from burnish.compiler.ir.render_state import RenderState
from burnish.compiler.ir.shader import Shader
from burnish.compiler.passes.pipeline import Options
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.picture import (
    Geometry,
    RasterRules,
    draw,
    instanced,
    stage_evaluation,
)
from burnish.stdlib.builtins.accuracy import INTERPOLATED_BITS
from burnish.support.frozen import changed

from ..passes.kit import history
from .kit import columns, few_ulps, geometry, moved, perspective, picture, shader, sphere

PASSING = """
abstract material Base {
    attribute place : vec4
    clip_position : vec4 = place
    value : vec4
}
"""
"""Draws `value` where the vertices say, in clip space."""

FULL = [(-1, -1, 0.5, 1), (3, -1, 0.5, 1), (-1, 3, 0.5, 1)]
"""One triangle over the whole picture."""


def passing(members: str, blend: str = "none", discard: str = "") -> Shader:
    """A shader that draws `value`, which `members` define."""
    return shader(
        PASSING + f"material M : Base {{ {members} }}\n"
        f"pass P {{ target t : rgba32f = material.value blend {blend}\n{discard} }}",
        "P",
    )


def at(size: int = 4, **more: Any) -> RasterRules:
    return RasterRules(size, size, **more)


def triangles(*corners: Any, **attributes: Any) -> Geometry:
    """Triangles one after the other."""
    place = np.array(corners, dtype=np.float64).reshape(-1, 4)
    arrays = {k: np.asarray(v).reshape(len(place), -1) for k, v in attributes.items()}
    return geometry(np.arange(len(place)), place=place, **arrays)


# --- interpolation -------------------------------------------------------------------------------


def test_interpolation_is_correct_in_perspective() -> None:
    """On a plane through the eye's view, the value is that of the point that each ray meets."""
    given = passing("attribute s : vec2\nvalue = vec4(s, 0, 1)")
    # In view space, x right, y up, z ahead: a tilted plane with z = 4 + x + y / 2.
    places = [(-2.0, -2.0), (9.0, -2.0), (-2.0, 8.0)]
    depths = [4 + x + y / 2 for x, y in places]
    clip = [(x, y, 0.5 * z, z) for (x, y), z in zip(places, depths, strict=True)]
    mesh = triangles(clip, s=places)
    found = picture(given, mesh, at(8))
    assert found.covered.any()
    y, x = np.nonzero(found.covered)
    ray_x, ray_y = (x + 0.5) / 4 - 1, 1 - (y + 0.5) / 4
    z = 4 / (1 - ray_x - ray_y / 2)
    expected = np.stack([ray_x * z, ray_y * z], axis=-1)
    assert np.allclose(found.targets[0][y, x, :2], expected, rtol=1e-12)


def test_what_is_zero_at_all_corners_is_exactly_zero() -> None:
    """So the floor or sign of a plane's coordinate does not depend on flushed numbers."""
    given = passing("attribute s : vec2\nvalue = vec4(s, 0, 1)")
    mesh = triangles(*FULL, s=[(0, 0.5), (0, 0.25), (0, 0.125)])
    found = picture(given, mesh, at(4, varying_bits=20), errors=few_ulps)
    widths = (found.high[0] - found.low[0])[found.covered]
    assert (widths[:, 0] == 0).all()
    assert (widths[:, 1] > 0).all()


def test_a_clipped_triangle_keeps_its_values() -> None:
    given = passing("attribute s : vec2\nvalue = vec4(s, frag_coord.w, frag_coord.z)")
    world = [(-40.0, 30.0), (40.0, 30.0), (0.0, -30.0)]
    # A floor at y = -1, seen along z; the last corner lies behind the eye.
    mesh = triangles([(x, -1, z - 1, z) for x, z in world], s=world)
    found = picture(given, mesh, at(16))
    y, x = np.nonzero(found.covered)
    assert len(y) > 20
    z = -1 / (1 - (y + 0.5) / 8)
    expected = np.stack([((x + 0.5) / 8 - 1) * z, z, 1 / z, 1 - 1 / z], axis=-1)
    assert np.allclose(found.targets[0][y, x], expected, rtol=1e-9)
    assert z.min() >= 1


@pytest.mark.parametrize("behind", [False, True])
def test_flat_values_are_those_of_the_first_vertex(behind: bool) -> None:
    given = passing("attribute n : int\nvalue = vec4(float(n), 0, 0, 1)")
    corners = [(-4, -4, 1, 4), (4, -4, 1, 4), (0, 8, 1, 4)]
    if behind:
        corners[0] = (-4, -4, -1, -1)
    found = picture(given, triangles(corners, n=np.array([7, 8, 9])), at())
    assert found.covered.any()
    assert (found.targets[0][found.covered][:, 0] == 7).all()


def test_inputs_of_the_pipeline() -> None:
    given = passing("value = vec4(frag_coord.xyz, if front_facing then frag_coord.w else -1)")
    clip = [(-2.0, -2.0, 0.5, 2.0), (6.0, -2.0, 0.5, 2.0), (-2.0, 6.0, 0.5, 2.0)]
    found = picture(given, triangles(clip), at(2)).targets[0]
    assert found[0, 1].tolist() == [1.5, 0.5, 0.25, 0.5]
    assert found[1, 0].tolist() == [0.5, 1.5, 0.25, 0.5]
    clip[1], clip[2] = clip[2], clip[1]
    assert picture(given, triangles(clip), at(2)).targets[0][0, 0, 3] == -1


def test_a_depth_may_be_clamped_before_a_shader_reads_it() -> None:
    given = passing("value = frag_coord.zzzz")
    # Clipped at 1.7 pixels, which snaps to the middle of a pixel that is in front of the plane.
    mesh = triangles([(-1, -1, -0.17, 1), (3, -1, 0.63, 1), (-1, 3, -0.17, 1)])
    found = picture(given, mesh, at(4, subpixel_bits=1), errors=few_ulps)
    place = 3, 1, 0
    assert found.targets[0][place] == 0
    assert found.low[0][place] == pytest.approx(-0.02, abs=1e-5)
    assert found.high[0][place] == pytest.approx(0, abs=1e-5)


def test_a_power_of_zero_may_be_that_of_a_tiny_number() -> None:
    """SwiftShader computes it as ``exp2(y * -127)``."""
    given = passing("attribute s : float\nvalue = vec4(pow(s, 0.001), pow(s, 2), pow(0.0, s), 1)")
    mesh = triangles(FULL, s=[0, 0, 0])
    found = picture(given, mesh, at(1), errors=Errors(("vulkan",)))
    assert found.targets[0][0, 0].tolist() == [0, 0, 1, 1]
    assert found.low[0][0, 0].tolist() == [0, 0, 1, 1]
    assert found.high[0][0, 0] == pytest.approx([2**-0.126, 0, 1, 1], rel=1e-3)


def test_a_value_that_is_the_same_at_all_vertices_is_interpolated() -> None:
    given = passing("param p : float\nvalue = vec4(@vertex (if place.x > 9 then place.y else p))")
    mesh = triangles(FULL)
    found = picture(given, mesh, at(1, varying_bits=20), errors=few_ulps, p=(0.7,))
    assert found.low[0].max() < 0.7 < found.high[0].min()


def test_far_behind_the_nearest_corner_a_mean_may_leave_the_corners() -> None:
    """So range analysis knows nothing about interpolated values, whatever the corners have."""
    given = passing("attribute s : float\nvalue = vec4(@vertex (0.5 + saturate(s)))")
    for nearest, inside in ((0.5, True), (1e-5, False)):
        corners = [(-3, 0.75, 0, 1), (3, 0.75, 0, 1), (0, -3 * nearest, 0, nearest)]
        mesh = triangles(corners, s=[1, 0, 0])
        found = picture(given, mesh, at(varying_bits=INTERPOLATED_BITS), errors=few_ulps)
        assert found.covered.all()
        assert (found.low[0] > 0).all() == inside


def test_nothing_is_known_of_values_whose_plane_may_overflow() -> None:
    given = passing("attribute s : float\nvalue = vec4(s)")
    for large, known in ((1e38, False), (1e35, True)):
        mesh = triangles(FULL, s=[large, 3 * large, -large])
        found = picture(given, mesh, at(2, varying_bits=20), errors=few_ulps)
        assert np.isfinite(found.high[0]).all() == known


def test_values_may_be_interpolated_between_snapped_places() -> None:
    given = passing("attribute s : float\nvalue = vec4(s)")
    mesh = triangles([(-1, -1, 0, 1), (3.1, -1, 0, 1), (-1, 3.1, 0, 1)], s=[0, 4.1, 0])
    exact = picture(given, mesh, at(1, subpixel_bits=0)).targets[0][0, 0, 0]
    snapped = picture(given, mesh, at(1, subpixel_bits=0, interpolates_snapped=True))
    assert exact == pytest.approx(1.0)
    assert snapped.targets[0][0, 0, 0] == pytest.approx(4.1 / 4)


def test_a_corner_beside_the_eye_has_no_place_to_be_snapped_to() -> None:
    """With w = 0 it is infinitely far to one side, but what is ahead of the eye is drawn."""
    given = passing("attribute s : float\nvalue = vec4(s)")
    mesh = triangles([(-1, -1, 0, 1), (3, -1, 0, 1), (0, 1, 0, 0)], s=[0, 4, 2])
    rules = at(2, subpixel_bits=8, clips_sides=True)
    exact, snapped = (
        picture(given, mesh, changed(rules, interpolates_snapped=answer)).targets[0][..., 0]
        for answer in (False, True)
    )
    # A point of the plane is (1 - b, b, c) times the corners; x is 4 * b - 1, and y is c - 1.
    b, c = np.array([0.125, 0.375]), np.array([[1.5], [0.5]])
    assert exact == pytest.approx((4 * b + 2 * c) / (1 + c))
    assert snapped == pytest.approx(exact)


def test_parts_of_one_clipped_triangle_leave_no_pixel_undecided_between_them() -> None:
    """Clipped at the sides, one triangle over everything becomes two, with the diagonal between."""
    given = passing("attribute s : float\nvalue = vec4(s)")
    rules = at(4, subpixel_bits=8, clips_sides=True, edge_slack=2.0**-11)
    found = picture(given, triangles(FULL, s=[0, 4, 0]), rules, errors=few_ulps)
    assert not found.undecided.any()
    assert found.covered.all()
    assert found.targets[0][..., 0] == pytest.approx(np.tile([0.25, 0.75, 1.25, 1.75], (4, 1)))


def test_an_edge_between_two_triangles_is_undecided_if_a_device_may_draw_it_elsewhere() -> None:
    given = passing("attribute s : float\nvalue = vec4(s)")
    rules = at(4, subpixel_bits=8, edge_slack=2.0**-11)
    corners = [(-1, -1, 0.5, 1), (1, -1, 0.5, 1), (1, 1, 0.5, 1)]
    others = [(-1, -1, 0.5, 1), (1, 1, 0.5, 1), (-1, 1, 0.5, 1)]
    found = picture(given, triangles(corners, others, s=[0] * 3 + [1] * 3), rules, errors=few_ulps)
    assert (found.undecided == np.eye(4, dtype=bool)[::-1]).all()


def test_corners_far_outside_are_snapped_with_larger_errors() -> None:
    """Float32 has steps of 0.001 there, so that a corner may be snapped to either side."""
    given = passing("attribute s : float\nvalue = vec4(s)")
    rules = at(2, subpixel_bits=0, interpolates_snapped=True, clips_sides=True, varying_bits=40)

    def width(far: float) -> float:
        mesh = triangles([(-1, -1, 0, 1), (far, -1, 0, 1), (-1, 9, 0, 1)], s=[0, far, 0])
        found = picture(given, mesh, rules, errors=few_ulps)
        return float((found.high[0] - found.low[0])[1, 1, 0])

    # A pixel next to another corner moves with this one by its weight only.
    assert 1e-3 < width(9999.502) < 0.1
    assert width(9999.6) < 1e-4


def test_derivatives_reach_beyond_the_triangle() -> None:
    given = passing(
        "attribute s : float\nvalue = vec4(ddx(s), ddy(s), fwidth(7 * frag_coord.y - s), 1)"
    )
    # Only the pixel at the top left is covered.
    corners = [(-1, 1, 0, 1), (0.2, 1, 0, 1), (-1, -0.2, 0, 1)]
    found = picture(given, triangles(corners, s=[0, 3.6, 6]), at(2)).targets[0]
    assert found[0, 0] == pytest.approx([3, 5, 5, 1])
    assert not found[1, 1].any()


def test_a_derivative_may_be_that_of_the_quads_other_row() -> None:
    given = passing("attribute s : float\nvalue = vec4(ddx(s * frag_coord.y), 0, 0, 1)")
    mesh = triangles(FULL, s=[0, 8, 0])
    found = picture(given, mesh, at(), errors=few_ulps)
    # s grows by 1 a pixel, so the derivative is y, and the quad's other row is 1 further.
    assert found.targets[0][:, 0, 0] == pytest.approx([0.5, 1.5, 2.5, 3.5])
    assert found.low[0][:, 0, 0] == pytest.approx([0.5, 0.5, 2.5, 2.5], abs=1e-4)
    assert found.high[0][:, 0, 0] == pytest.approx([1.5, 1.5, 3.5, 3.5], abs=1e-4)


def test_opengl_pairs_the_rows_of_a_picture_from_below() -> None:
    given = passing("value = vec4(ddy(frag_coord.y * frag_coord.y))")
    found = picture(given, triangles(FULL), at(3)).targets[0][:, 0, 0]
    from_below = picture(given, triangles(FULL), at(3, bottom_up=True)).targets[0][:, 0, 0]
    assert found.tolist() == [2, 2, 6]
    assert from_below.tolist() == [0, 4, 4]


# --- depth, discarding, blending -----------------------------------------------------------------


def layers(*rows: tuple[float, tuple[float, float, float, float]]) -> Geometry:
    """Layers over the whole picture, each with its depth and colour."""
    place = [(x, y, z, 1) for z, _ in rows for x, y, _, _ in FULL]
    return triangles(place, c=[colour for _, colour in rows for _ in range(3)])


COLOURED = "attribute c : vec4\nvalue = c"
RED, GREEN, BLUE = (1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1)


@pytest.mark.parametrize("discard", ["", "discard when material.place.w < 0"])
def test_the_nearest_wins_and_of_equals_the_first(discard: str) -> None:
    given = passing(COLOURED, discard=discard)
    found = picture(given, layers((0.6, RED), (0.2, GREEN), (0.4, BLUE)), at())
    assert (found.targets[0] == GREEN).all()
    assert not found.undecided.any()
    equals = picture(given, layers((0.4, RED), (0.4, GREEN)), at())
    assert (equals.targets[0] == RED).all()
    assert equals.undecided.all()


@pytest.mark.parametrize("blend", ["none", "alpha"])
@pytest.mark.parametrize("moved", [False, True])
def test_of_instances_at_the_same_place_the_first_is_drawn(moved: bool, blend: str) -> None:
    """Their depths are equal on every device, unless their places are computed from the instance,
    each with errors of its own."""
    members = (
        "attribute shade : float per instance\nvalue = vec4(shade, float(instance_index), 0, 1)"
    )
    if moved:
        members += "\nclip_position = place + vec4(0, 0, shade - shade * 1.0000001, 0)"
    place = np.array(FULL, dtype=np.float64)
    shades = np.array([[0.25], [0.5], [0.75]])
    mesh = instanced({"place": place}, {"shade": shades}, np.array([[0, 1, 2]]), 3)
    found = picture(passing(members, blend), mesh, at(2, varying_bits=20, frag_coord_bits=20),
                    errors=few_ulps)  # fmt: skip
    assert found.covered.all()
    assert found.undecided.all() == moved
    if not moved:
        assert found.targets[0][..., :2].reshape(-1, 2).tolist() == [[0.25, 0.0]] * 4


def test_depths_that_rounding_may_exchange_are_undecided() -> None:
    """The plane through the depths is as precise as ``frag_coord``, whose depth is the same."""
    given, rows = passing(COLOURED), ((0.4, RED), (0.4 - 2.0**-17, GREEN))
    coarse, fine = (changed(at(), frag_coord_bits=bits) for bits in (16, 20))
    assert picture(given, layers(*rows), coarse).undecided.all()
    assert not picture(given, layers(*rows), fine).undecided.any()


EDGE_THROUGH_MIDDLES = [(-1, -1, 0.6, 1), (1, -1, 0.6, 1), (-1, 1, 0.6, 1)]
"""A triangle with the diagonal through the middles of pixels, which rounding may take from it."""


@pytest.mark.parametrize(("depth", "undecided"), [(0.2, 0), (0.8, 4)])
@pytest.mark.parametrize("in_front", [False, True])
def test_an_edge_that_is_hidden_leaves_nothing_undecided(
    depth: float, undecided: int, in_front: bool
) -> None:
    """This holds in either order of the two triangles."""
    whole = [(x, y, depth, w) for x, y, _, w in FULL]
    corners = [whole, EDGE_THROUGH_MIDDLES][:: -1 if in_front else 1]
    mesh = triangles([place for corner in corners for place in corner], c=[RED] * 3 + [GREEN] * 3)
    found = picture(passing(COLOURED), mesh, changed(at(), edge_slack=2.0**-10))
    assert found.undecided.sum() == undecided


def test_what_may_be_discarded_hides_nothing() -> None:
    whole = [(x, y, 0.2, w) for x, y, _, w in FULL]
    mesh = triangles([*whole, *EDGE_THROUGH_MIDDLES], c=[RED] * 3 + [GREEN] * 3)
    given = passing(COLOURED, discard="discard when material.c.a < 0.5")
    found = picture(given, mesh, changed(at(), edge_slack=2.0**-10))
    assert found.undecided.sum() == 4


def test_the_far_plane_is_not_nearer_than_itself() -> None:
    found = picture(passing(COLOURED), layers((1.0, RED)), at(), clear=BLUE)
    assert (found.targets[0] == BLUE).all() and not found.covered.any()


def test_what_is_discarded_writes_neither_colour_nor_depth() -> None:
    given = passing(COLOURED, discard="discard when material.c.a < 0.5")
    found = picture(given, layers((0.2, (0, 1, 0, 0.25)), (0.4, RED)), at())
    assert (found.targets[0] == RED).all()


@pytest.mark.parametrize(
    ("blend", "expected"),
    [
        ("none", (0.5, 0.25, 1.0, 0.25)),
        ("alpha", (0.725, 0.3625, 0.25, 0.625)),
        ("premultiplied", (1.1, 0.55, 1.0, 0.625)),
        ("add", (1.3, 0.65, 1.0, 0.75)),
        ("multiply", (0.4, 0.1, 0.0, 0.125)),
    ],
)
def test_blending(blend: str, expected: Any) -> None:
    found = picture(
        passing(COLOURED, blend=blend), layers((0.5, (0.5, 0.25, 1.0, 0.25))), at(),
        clear=(0.8, 0.4, 0.0, 0.5),
    )  # fmt: skip
    assert found.targets[0][1, 2] == pytest.approx(expected)


BY_FACTORS: dict[str, tuple[float, float, float, float]] = {
    "{ source = dst_alpha, destination = one_minus_src }": (0.65, 0.425, 0.5, 0.5),
    "{ source = one_minus_dst, destination = src_alpha, operation = subtract }": (
        -0.1, 0.05, 1.0, 0.0,
    ),
    "{ source = one, destination = one_minus_dst_alpha, operation = reverse_subtract }": (
        -0.1, -0.05, -1.0, 0.0,
    ),
    "{ operation = min }": (0.5, 0.25, 0.0, 0.25),
    "{ operation = max, alpha_operation = min }": (0.8, 0.4, 1.0, 0.25),
    "alpha { mask = rb }": (0.725, 0.4, 0.25, 0.5),
    "{ mask = none }": (0.8, 0.4, 0.0, 0.5),
    "{ source = src_alpha_saturated }": (0.125, 0.0625, 0.25, 0.25),
    "{ source = src, destination = dst }": (0.89, 0.2225, 1.0, 0.3125),
    "{ source = constant, destination = one_minus_constant }": (0.65, 0.3625, 1.0, 0.4375),
}  # fmt: skip
"""The results of blending a colour over another, by hand from the tables of OpenGL 4.6, 17.3.6."""


@pytest.mark.parametrize("blend", BY_FACTORS)
@pytest.mark.parametrize("errors", [None, few_ulps], ids=["exact", "with bounds"])
def test_blending_by_factors(blend: str, errors: Any) -> None:
    found = draw(
        passing(COLOURED, blend=blend), {}, {}, layers((0.5, (0.5, 0.25, 1.0, 0.25))), at(),
        [(0.8, 0.4, 0.0, 0.5)], errors, blend_constant=(0.5, 0.25, 1.0, 0.25),
    )  # fmt: skip
    expected = BY_FACTORS[blend]
    assert found.targets[0][1, 2] == pytest.approx(expected)
    assert (found.low[0][1, 2] <= np.array(expected) + 1e-12).all()
    assert (found.high[0][1, 2] >= np.array(expected) - 1e-12).all()
    assert (found.high[0][1, 2] - found.low[0][1, 2] < 1e-5).all()


def test_in_fixed_point_colours_are_clamped_before_they_are_blended() -> None:
    given = shader(
        PASSING + f"material M : Base {{ {COLOURED} }}\n"
        "pass P { target t : rgba8 = material.value blend { operation = reverse_subtract, "
        "destination = one } }",
        "P",
    )
    mesh = layers((0.5, (2.0, -1.0, 0.5, 1.0)))
    found = picture(given, mesh, at(), clear=(1.0, 0.6, 0.2, 1.0), errors=few_ulps)
    assert found.targets[0][1, 2] == pytest.approx((0.0, 0.6, 0.0, 0.0))


def test_blending_goes_in_the_order_of_drawing() -> None:
    given = passing(COLOURED, blend="alpha")
    rows = [(0.6, (1, 0, 0, 0.5)), (0.4, (0, 1, 0, 0.5)), (0.5, (0, 0, 1, 0.5))]
    found = picture(given, layers(*rows), at(), clear=(0, 0, 0, 1))
    # The last one is behind the second and is not drawn.
    assert found.targets[0][0, 0] == pytest.approx([0.25, 0.5, 0, 1])


def test_lanes_that_a_format_lacks() -> None:
    given = shader(
        PASSING + "material M : Base { value = vec4(3) }\n"
        "pass P { target t : rg32f = material.value.xy\n target u : r32f = 2.0 }",
        "P",
    )
    found = picture(given, triangles(FULL), at(1), clear=(9, 9, 9, 9))
    assert [target[0, 0].tolist() for target in found.targets] == [[3, 3, 0, 1], [2, 0, 0, 1]]


# --- bounds --------------------------------------------------------------------------------------


def jumps(members: str) -> list[int]:
    """The pixels whose value may be on either side of a jump, in a row over which `s` grows from -4
    to 4."""
    given = passing("attribute s : float\n" + members)
    mesh = triangles(FULL, s=[-4, 12, -4])
    found = picture(given, mesh, RasterRules(9, 1, varying_bits=20), errors=few_ulps)
    wide = found.high[0][0, :, 0] - found.low[0][0, :, 0] > 0.1
    found_at: list[int] = wide.nonzero()[0].tolist()
    return found_at


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("if s < 0 then 1 else 0", [4]),
        ("step(0.0, s)", [4]),
        ("sign(s)", [4]),
        ("floor(s * 9 / 16)", [0, 2, 4, 6, 8]),
        ("round(s * 9 / 16 + 0.5)", [0, 2, 4, 6, 8]),
        ("trunc(s * 9 / 16)", [0, 2, 6, 8]),
        ("fract(s * 9 / 16)", [0, 2, 4, 6, 8]),
        ("s * 9 / 16 mod 2", [0, 4, 8]),
        ("float(int(s * 9 / 16))", [0, 2, 6, 8]),
        ("max(s, 0)", []),
        ("if max(s + 100, 0) > 0 then 1 else 0", []),
        ("if max(s, 0) > 0 then 1 else 0", [4]),
        ("if saturate(s) * 2 > 0 then 1 else 0", [4]),
        ("if min(s, 0) * s >= 0 then 1 else 0", [4]),
        ("if saturate(s) * (3 * s - 8) > 0 then 1 else 0", [7]),
        ("if 1 < 2 then s else 0", []),
        ("if frag_coord.x < 4 then s else 0", []),
    ],
)
def test_bounds_have_both_sides_of_a_jump_that_is_close(value: str, expected: list[int]) -> None:
    # Pixel 4 is at 0; s·9/16 grows by a half a pixel, from -2 to 2.
    assert jumps(f"value = vec4({value})") == expected


def test_a_jump_at_a_vertex_is_seen_in_its_triangles() -> None:
    jumping = "value = @vertex vec4(if sqrt(s + 20) > 4.0 then 1 else 0)"
    assert jumps(jumping) == list(range(9))
    assert jumps(jumping.replace("4.0", "4.5")) == []


def as_srgb(light: Any) -> Any:
    """Linear light as a target that is encoded as sRGB holds it (IEC 61966-2-1)."""
    return np.where(
        light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 0) ** (1 / 2.4) - 0.055
    )


def test_a_phong_sphere_is_decided_nearly_everywhere() -> None:
    given = shader(
        "import std.terms\nmaterial M { color = lambert(vec3(0.5)) + phong(vec3(1), 20) }"
    )
    camera = columns(perspective(0.7, 0.1, 100) @ moved(0, 0, -4))
    given.render_state = RenderState(cull="back")
    rules = RasterRules(128, 128, subpixel_bits=8)
    found = picture(
        given, sphere(), rules, errors=few_ulps, view_projection=camera, eye=(0.0, 0.0, 4.0)
    )
    assert found.covered.mean() > 0.3
    assert found.undecided.sum() < 0.002 * found.covered.sum()
    off = (as_srgb(found.high[0]) - as_srgb(found.low[0]))[found.covered & ~found.undecided]
    # One step of the target's 8 bits, to either side; alpha is not encoded, and is always 1.
    assert off.max() < 2.1 / 255
    # The sphere is lit from above.
    assert found.targets[0][30, 64, 0] > 3 * found.targets[0][98, 64, 0]


# --- other forms of the graph --------------------------------------------------------------------


def test_passes_keep_the_picture() -> None:
    given = shader(
        "import std.terms\nimport std.lights\n"
        "material M { color = lambert(vec3(uv, 0.5)) + phong(vec3(1), 20) }\n"
        "rig R { a : Directional; b : Spot }"
    )
    values: Any = {
        "view_projection": columns(perspective(0.7, 0.1, 100) @ moved(0, 0, -4)),
        "b.place": (0.0, 1.0, 4.0),
        "b.axis": (0.0, 0.0, -1.0),
    }
    before = picture(given, sphere(16, 8), at(24), **values)
    past = history(given, Options(hoist=False))
    for name in ("open_binders", "fuse", "inline", "guard", "move_to_vertices"):
        roots = past.roots[name]
        given.results = tuple(
            changed(result, value=root) for result, root in zip(given.results, roots, strict=True)
        )
        after = picture(given, sphere(16, 8), at(24), **values)
        apart = np.abs(after.targets[0] - before.targets[0]).max(axis=-1)
        assert apart[~before.undecided].max() < 1e-9, name


# --- input that is not as it should be -----------------------------------------------------------


def test_there_may_be_nothing_to_draw() -> None:
    given = passing(COLOURED)
    empty = Geometry(
        {"place": np.zeros((0, 4)), "c": np.zeros((0, 4))}, np.zeros((0, 3), dtype=np.int64)
    )
    found = picture(given, empty, at(), clear=BLUE)
    assert (found.targets[0] == BLUE).all() and not found.covered.any()
    given.render_state = RenderState(cull="front")
    culled = picture(given, layers((0.5, RED)), at(), clear=BLUE)
    assert (culled.targets[0] == BLUE).all()


def test_what_is_not_finite_stays_where_it_is() -> None:
    huge = "exp(frag_coord.x + 800.0)"  # A constant that is too large would be an error.
    overflown = f"if frag_coord.x < 1 then {huge} - {huge} else 1"
    given = passing(f"attribute c : vec4\nvalue = c * ({overflown})")
    nan, inf = np.nan, np.inf
    bad = [(nan, 0, 0, 1), (inf, 0, 0, 1), (0, 0, 0, 0)]
    place = np.array([*bad, *FULL, (0, 0, 0.5, 1), (1, 1, 0.5, 1)])
    colours = np.array([(nan, inf, 0, 1), *[RED] * 7])
    chosen = np.array([(0, 1, 2), (2, 3, 4), (3, 6, 7), (6, 6, 6), (3, 4, 5)])
    mesh = geometry(chosen, place=place, c=colours)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = picture(given, mesh, at(3))
    assert found.covered.all()
    assert np.isnan(found.targets[0][:, 0]).all()
    assert (found.targets[0][:, 1:] == RED).all()


def test_one_pixel_with_everything_in_it() -> None:
    given = shader("material M { map m : texture2d\n color = m(uv).rgb }")
    camera = columns(perspective(0.7, 0.1, 100) @ moved(0, 0, -4))
    found = picture(given, sphere(), at(1, subpixel_bits=8), view_projection=camera)
    assert found.targets[0][0, 0].tolist() == [1, 1, 1, 1]


def test_triangles_far_larger_than_the_picture() -> None:
    given = passing("attribute s : float\nvalue = vec4(s)")
    big = 1e6
    mesh = triangles([(-big, -big, 0, 1), (big, -big, 0, 1), (0, big, 0, 1)], s=[0, 0, 1])
    found = picture(given, mesh, at(4, subpixel_bits=8))
    assert found.covered.all()
    assert np.allclose(found.targets[0][..., 0], 0.5, atol=1e-5)


def test_missing_values_are_named() -> None:
    given = shader("material M { map m : texture2d\n param p : float\n color = m(uv).rgb * p }")
    with pytest.raises(ValueError, match="The parameter `p` has no value"):
        picture(given, sphere(), at())
    bare = geometry([(0, 1, 2)], vertex_position=np.eye(3))
    with pytest.raises(ValueError, match="attribute `vertex_uv` is missing"):
        picture(given, bare, at(), p=(1.0,))
    odd = geometry([(0, 1, 2)], vertex_position=np.eye(3), vertex_uv=np.ones((3, 5)))
    with pytest.raises(ValueError, match=r"`vertex_uv` has the shape \(3, 5\)"):
        picture(given, odd, at(), p=(1.0,))


# --- operations without a guard -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "undecided"),
    [
        ("vec4(unguarded(sqrt(s.x)), 0, 0, 1)", [0, 1]),
        ("vec4(vec3(unguarded(1 / floor(s.x))), 1)", [2]),
        ("vec4(vec3(unguarded(sqrt(abs(s.x)))), 1)", []),
        # What the choice leaves out is of no account, wherever the operation is.
        ("vec4(vec3(if s.x < 0 then 0 else unguarded(sqrt(s.x))), 1)", []),
        ("vec4(vec3(if s.x < -1 then 0 else unguarded(sqrt(s.x))), 1)", [1]),
        # A condition is neither true nor false, and a whole number cannot be NaN.
        ("vec4(vec3(if unguarded(sqrt(s.x)) < 1 then 0 else 1), 1)", [0, 1]),
        ("vec4(vec3(float(unguarded(int(s.x * 2e9)))), 1)", [0, 3]),
        ("vec4(vec3(float(unguarded(8 / int(floor(s.x))))), 1)", [2]),
        ("vec4(vec3(sum i in 0..3 : unguarded(sqrt(s.x + float(i)))), 1)", [0, 1]),
        ("vec4(vec3(@vertex unguarded(sqrt(s.y))), 1)", [0, 1, 2, 3]),
    ],
)
def test_nothing_is_defined_where_an_unguarded_operation_leaves_its_domain(
    value: str, undecided: list[int]
) -> None:
    given = passing(f"attribute s : vec2\nvalue = {value}")
    # s.x is -1.5, -0.5, 0.5 and 1.5 in the four columns.
    mesh = triangles(*FULL, s=[(-2, -1), (6, 1), (-2, 1)])
    found = picture(given, mesh, at(4, unguarded_is_nan=True))
    assert found.undecided.all(axis=0).tolist() == [x in undecided for x in range(4)]
    assert (found.undecided.all(axis=0) == found.undecided.any(axis=0)).all()
    assert not picture(given, mesh, at(4)).undecided.any()


@pytest.mark.parametrize("errors", [None, few_ulps])
def test_vertices_are_the_same_however_many_are_evaluated_at_once(
    monkeypatch: pytest.MonkeyPatch, errors: Errors | None
) -> None:
    given = passing("attribute s : float\nvalue = vec4(s * s, float(vertex_index), 0, 1)")
    corners = [
        (left + x, below + y, 0.5, 1)
        for left in (-1, 0)
        for below in (-1, 0)
        for x, y in ((0, 0), (1, 0), (0, 1))
    ]
    mesh = triangles(corners, s=np.linspace(-0.3, 0.7, 12))
    whole = picture(given, mesh, at(8), errors=errors)
    monkeypatch.setattr(stage_evaluation, "VERTICES_AT_ONCE", 5)
    parts = picture(given, mesh, at(8), errors=errors)
    assert whole.covered.any()
    assert np.array_equal(whole.targets[0], parts.targets[0])
    assert np.array_equal(whole.low[0], parts.low[0])
    assert np.array_equal(whole.high[0], parts.high[0])
