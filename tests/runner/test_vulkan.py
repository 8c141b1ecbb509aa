"""Pictures drawn by Vulkan that can be told by heart, on both software drivers."""

from __future__ import annotations

import struct
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest

from burnish.compiler.ir.blending import Factor, Operation
from burnish.compiler.ir.formats import VertexFormat
from burnish.compiler.ir.render_state import Compare, DepthState
from burnish.targets.runner.drivers.pipeline import VertexInput
from burnish.targets.runner.drivers.readback import TEXEL_LANES
from burnish.targets.runner.drivers.render_state import RenderTarget, TargetFormat
from burnish.targets.runner.drivers.slots import BlockSlot, Place

from .blends import blended, both, named
from .jobs_kit import draw_job
from .vulkan_kit import (
    PLACE,
    SIZE,
    WHOLE,
    Asker,
    draw_of,
    flat_pipeline,
    floats,
    glsl,
    painted_pipeline,
    pixels,
    quad,
)

RED, GREEN = [1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]
TOP_LEFT = quad(-1, 0, 0, 1, 0.5)
"""The top left quarter of clip space, whose y goes up."""
CLOCKWISE = [[x, y, z] for x, y, z in reversed(TOP_LEFT)]

FLIPPED = """#version 450
layout(location = 0) in vec3 place;
void main() { gl_Position = vec4(place.x, -place.y, place.z, 1.0); }
"""

HALF = SIZE // 2


def test_the_driver_names_itself(vulkan: Asker) -> None:
    device = vulkan.device()
    expected = {"lavapipe": ("llvmpipe", "Mesa "), "swiftshader": ("SwiftShader", "SwiftShader ")}
    name, version = expected[vulkan.driver]
    assert device.name.startswith(name)
    assert device.version.startswith(version)
    assert any(digit.isdigit() for digit in device.version)
    assert device.subpixel_bits >= 4
    assert device.subtexel_bits >= 4
    assert device.mip_bits >= 4
    assert device.lines == "rectangle"


# --- where things land -------------------------------------------------------------------------


def test_y_is_up_and_the_first_row_is_the_top(vulkan: Asker) -> None:
    covered = vulkan.one(flat_pipeline(), draw_of(TOP_LEFT))[:, :, 0]
    expected = np.zeros((SIZE, SIZE))
    expected[:HALF, :HALF] = 1.0
    assert np.array_equal(covered, expected)


def test_frag_coord_counts_from_the_top_left(vulkan: Asker) -> None:
    where = """#version 450
    layout(location = 0) out vec4 target;
    void main() { target = gl_FragCoord; }
    """
    picture = vulkan.one(flat_pipeline(where), draw_of(WHOLE, size=(6, 4)))
    assert picture[0, 0].tolist() == [0.5, 0.5, 0.5, 1.0]
    assert picture[3, 5].tolist() == [5.5, 3.5, 0.5, 1.0]


@pytest.mark.parametrize("size", [(1, 1), (3, 5), (17, 2)])
def test_pictures_of_any_size_have_all_their_rows(vulkan: Asker, size: tuple[int, int]) -> None:
    """Rows of odd lengths must come back without padding between them."""
    bottom = quad(-1, -1, 1, -1 + 2 / size[1], 0.5)
    picture = vulkan.one(flat_pipeline(), draw_of(bottom, size=size))
    assert picture.shape == (size[1], size[0], 4)
    assert np.all(picture[-1] == 1.0)
    assert not picture[:-1].any()


@pytest.mark.parametrize("front", ["ccw", "cw"])
@pytest.mark.parametrize("cull", ["none", "back", "front"])
def test_counter_clockwise_as_seen_is_the_front(vulkan: Asker, front: str, cull: str) -> None:
    pipeline = flat_pipeline(front_face=front, cull=cull)
    drawn = {
        winding: bool(vulkan.one(pipeline, draw_of(places)).any())
        for winding, places in (("ccw", TOP_LEFT), ("cw", CLOCKWISE))
    }
    expected = {"none": {"ccw", "cw"}, "back": {front}, "front": {"ccw", "cw"} - {front}}[cull]
    assert {winding for winding, there in drawn.items() if there} == expected


def test_gl_front_facing_agrees(vulkan: Asker) -> None:
    facing = """#version 450
    layout(location = 0) out vec4 target;
    void main() { target = vec4(gl_FrontFacing ? 1.0 : 0.5); }
    """
    assert vulkan.one(flat_pipeline(facing), draw_of(TOP_LEFT))[0, 0, 0] == 1.0
    assert vulkan.one(flat_pipeline(facing), draw_of(CLOCKWISE))[0, 0, 0] == 0.5


def test_a_flipped_text_draws_the_same(vulkan: Asker) -> None:
    """The flipped text's clip y points down, as Vulkan's own does."""
    plain = flat_pipeline(cull="back")
    flipped = flat_pipeline(vertex=FLIPPED, cull="back", flip_y=True)
    expected = vulkan.one(plain, draw_of(TOP_LEFT))
    assert expected[0, 0, 0] == 1.0
    assert np.array_equal(vulkan.one(flipped, draw_of(TOP_LEFT)), expected)


# --- depth and blending ------------------------------------------------------------------------


@pytest.mark.parametrize("order", [1, -1])
def test_the_nearer_wins(vulkan: Asker, order: int) -> None:
    parts = [(quad(-1, -1, 1, 1, 0.25), RED), (quad(-1, -1, 1, 1, 0.75), GREEN)][::order]
    places = [corner for corners, _ in parts for corner in corners]
    paints = [paint for corners, paint in parts for _ in corners]
    assert vulkan.one(painted_pipeline(), draw_of(places, paints))[3, 3].tolist() == RED


def test_of_equally_near_ones_the_first_stays(vulkan: Asker) -> None:
    paints = [RED] * 6 + [GREEN] * 6
    assert vulkan.one(painted_pipeline(), draw_of(WHOLE * 2, paints))[3, 3].tolist() == RED


@pytest.mark.parametrize(("depth", "there"), [(0.0, True), (0.999, True), (1.0, False)])
def test_depth_is_cleared_to_one(vulkan: Asker, depth: float, there: bool) -> None:
    picture = vulkan.one(flat_pipeline(), draw_of(quad(-1, -1, 1, 1, depth)))
    assert bool(picture.any()) == there


AT_HALF = ("less", "less_equal", "not_equal", "always")
"""The comparisons that a depth of 0.5 passes where 1 is stored."""
AT_ONE = ("equal", "less_equal", "greater_equal", "always")
"""The comparisons that a depth of 1 passes there."""


@pytest.mark.parametrize("compare", get_args(Compare))
def test_depths_are_compared(vulkan: Asker, compare: Compare) -> None:
    pipeline = flat_pipeline(depth=DepthState(compare))
    drawn = [
        bool(vulkan.one(pipeline, draw_of(quad(-1, -1, 1, 1, depth))).any()) for depth in (0.5, 1.0)
    ]
    assert drawn == [compare in AT_HALF, compare in AT_ONE]


def test_depths_that_are_not_written_hide_nothing(vulkan: Asker) -> None:
    places, paints = quad(-1, -1, 1, 1, 0.25) + quad(-1, -1, 1, 1, 0.75), [RED] * 6 + [GREEN] * 6
    pipeline = painted_pipeline(depth=DepthState(write=False))
    assert vulkan.one(pipeline, draw_of(places, paints))[3, 3].tolist() == GREEN


SOURCE = np.array([0.5, 0.25, 1.0, 0.25])
UNDER = np.array([0.125, 0.5, 0.75, 0.5])
CLEAR = ((0.125, 0.5, 0.75, 0.5),)
"""The clear colour of the only target, which is ``UNDER``."""
BLENDED = {
    "none": SOURCE,
    "alpha": [*(SOURCE * 0.25 + UNDER * 0.75)[:3], 0.25 + 0.5 * 0.75],
    "premultiplied": SOURCE + UNDER * 0.75,
    "add": SOURCE + UNDER,
    "multiply": SOURCE * UNDER,
}


@pytest.mark.parametrize("blend", BLENDED)
def test_blend_modes(vulkan: Asker, blend: str) -> None:
    pipeline = painted_pipeline(RenderTarget("rgba16float", named(blend)))
    draw = draw_of(TOP_LEFT, [SOURCE.tolist()] * 6)
    picture = vulkan.one(pipeline, draw, clear=CLEAR)
    assert picture[0, 0].tolist() == list(BLENDED[blend])
    assert picture[-1, -1].tolist() == UNDER.tolist()


CONSTANT = (0.5, 0.25, 0.75, 1.0)


@pytest.mark.parametrize("factor", get_args(Factor))
def test_every_factor(vulkan: Asker, factor: Factor) -> None:
    for blend in (both(factor, "one"), both("one", factor)):
        pipeline = painted_pipeline(RenderTarget("rgba32float", blend))
        draw = draw_of(TOP_LEFT, [SOURCE.tolist()] * 6)
        picture = vulkan.one(pipeline, draw, clear=CLEAR, blend_constant=CONSTANT)
        expected = blended(blend, SOURCE.tolist(), UNDER.tolist(), CONSTANT)
        assert picture[0, 0].tolist() == expected


@pytest.mark.parametrize("operation", get_args(Operation))
def test_every_operation(vulkan: Asker, operation: Operation) -> None:
    blend = both("one", "one", operation)
    pipeline = painted_pipeline(RenderTarget("rgba32float", blend))
    draw = draw_of(TOP_LEFT, [SOURCE.tolist()] * 6)
    expected = blended(blend, SOURCE.tolist(), UNDER.tolist())
    assert vulkan.one(pipeline, draw, clear=CLEAR)[0, 0].tolist() == expected


@pytest.mark.parametrize("mask", ["rgb", "ga", "none"])
def test_lanes_that_are_masked_keep_what_they_have(vulkan: Asker, mask: str) -> None:
    pipeline = painted_pipeline(RenderTarget("rgba32float", named("add"), mask))
    draw = draw_of(TOP_LEFT, [SOURCE.tolist()] * 6)
    added, written = SOURCE + UNDER, [mask != "none" and lane in mask for lane in "rgba"]
    expected = np.where(written, added, UNDER).tolist()
    assert vulkan.one(pipeline, draw, clear=CLEAR)[0, 0].tolist() == expected


def test_depths_are_cleared_as_asked(vulkan: Asker) -> None:
    places, paints = quad(-1, -1, 1, 1, 0.25) + quad(-1, 0, 0, 1, 0.75), [RED] * 6 + [GREEN] * 6
    pipeline = painted_pipeline(depth=DepthState("greater"))
    picture = vulkan.one(pipeline, draw_of(places, paints), clear_depth=0.5)
    assert picture[0, 0].tolist() == GREEN
    assert picture[-1, -1].tolist() == [0.0] * 4


# --- targets -----------------------------------------------------------------------------------


@pytest.mark.parametrize("target", get_args(TargetFormat))
def test_every_target_format(vulkan: Asker, target: TargetFormat) -> None:
    paint = [0.2, 0.4, 0.6, 0.8]
    picture = vulkan.one(painted_pipeline(RenderTarget(target)), draw_of(TOP_LEFT, [paint] * 6))
    lanes = TEXEL_LANES[target][0]
    tolerance = {"32float": 0.0, "16float": 2**-11, "8unorm": 0.5 / 255, "8unorm-srgb": 0.006}
    kind = target.lstrip("rgba")
    near = pytest.approx(paint[:lanes], abs=tolerance[kind], rel=1e-7)
    assert picture[0, 0].tolist()[:lanes] == near
    assert picture[0, 0].tolist()[lanes:] == [0.0, 0.0, 0.0, 1.0][lanes:]


def test_an_srgb_target_rounds_the_encoded_value(vulkan: Asker) -> None:
    """Near black its steps are finer than those of a linear target: 1/255/12.92."""
    pipeline = painted_pipeline(RenderTarget("rgba8unorm-srgb"))
    picture = vulkan.one(pipeline, draw_of(TOP_LEFT, [[0.001, 0.0005, 1.0, 0.001]] * 6))
    step = 1 / 255 / 12.92
    assert picture[0, 0].tolist() == pytest.approx([3 * step, 2 * step, 1.0, 0.0], rel=1e-6)


def test_two_targets_with_blend_modes_of_their_own(vulkan: Asker) -> None:
    both = """#version 450
    layout(location = 0) out vec4 first;
    layout(location = 1) out vec2 second;
    void main() { first = vec4(0.5); second = vec2(0.25, 0.75); }
    """
    targets = (RenderTarget("rgba32float"), RenderTarget("rg16float", named("add")))
    pipeline = flat_pipeline(both, targets=targets)
    clear = ((1.0, 1.0, 1.0, 1.0), (0.5, 0.125, 0.0, 0.0))
    (picture,) = vulkan.draw(draw_job(pipeline, (draw_of(TOP_LEFT),), clear=clear))
    assert pixels(picture, 0)[0, 0].tolist() == [0.5] * 4
    assert pixels(picture, 0)[-1, -1].tolist() == [1.0] * 4
    assert pixels(picture, 1)[0, 0].tolist() == [0.75, 0.875, 0.0, 1.0]
    assert pixels(picture, 1)[-1, -1].tolist() == [0.5, 0.125, 0.0, 1.0]


def test_draws_of_a_job_do_not_disturb_each_other(vulkan: Asker) -> None:
    pipeline = painted_pipeline()
    first = draw_of(TOP_LEFT, [RED] * 6)
    larger = draw_of(WHOLE, [GREEN] * 6, size=(32, 16))
    pictures = [pixels(each) for each in vulkan.draw(draw_job(pipeline, (first, larger, first)))]
    assert pictures[1].shape == (16, 32, 4)
    assert np.all(pictures[1] == GREEN)
    assert np.array_equal(pictures[0], pictures[2])
    assert not pictures[2][-1].any()


# --- vertices and blocks -----------------------------------------------------------------------


@pytest.mark.parametrize("kind", get_args(VertexFormat))
def test_every_vertex_format(vulkan: Asker, kind: VertexFormat) -> None:
    base, _, count = kind.partition("x")
    lanes = int(count or 1)
    scalar, prefix, letter = {
        "float32": ("float", "", "f"), "sint32": ("int", "i", "i"), "uint32": ("uint", "u", "I"),
    }[base]  # fmt: skip
    spelled = f"{prefix}vec{lanes}" if lanes > 1 else scalar
    vertex = f"""#version 450
    layout(location = 0) in vec3 place;
    layout(location = 3) in {spelled} given;
    layout(location = 0) flat out {spelled} passed;
    void main() {{ gl_Position = vec4(place, 1.0); passed = given; }}
    """
    rest = "".join([", 9.0"] * (4 - lanes))
    fragment = f"""#version 450
    layout(location = 0) flat in {spelled} passed;
    layout(location = 0) out vec4 target;
    void main() {{ target = vec4(passed{rest}); }}
    """
    values = [7, 100, 3, 65536] if base == "uint32" else [-7, 100, -3, 65536]
    pipeline = replace(
        flat_pipeline(fragment, vertex=vertex), inputs=(PLACE, VertexInput("given", 3, kind))
    )
    draw = draw_of(TOP_LEFT)
    given = struct.pack(f"<{lanes}{letter}", *values[:lanes]) * draw.vertex_count
    picture = vulkan.one(pipeline, replace(draw, vertices=(*draw.vertices, given)))
    assert picture[0, 0].tolist() == [*values[:lanes], *[9.0] * (4 - lanes)]


def test_the_first_vertex_is_the_provoking_one(vulkan: Asker) -> None:
    flat = """#version 450
    layout(location = 0) in vec3 place;
    layout(location = 1) in vec4 paint;
    layout(location = 0) flat out vec4 colour;
    void main() { gl_Position = vec4(place, 1.0); colour = paint; }
    """
    fragment = """#version 450
    layout(location = 0) flat in vec4 colour;
    layout(location = 0) out vec4 target;
    void main() { target = colour; }
    """
    stages = {"vertex": glsl("vert", flat), "fragment": glsl("frag", fragment)}
    pipeline = replace(painted_pipeline(), stages=stages)
    paints = [RED, GREEN, GREEN] * 2
    assert vulkan.one(pipeline, draw_of(TOP_LEFT, paints))[0, 0].tolist() == RED


def test_blocks_of_several_sets_reach_both_stages(vulkan: Asker) -> None:
    """Sets 1 and 2 have nothing in them."""
    vertex = """#version 450
    layout(location = 0) in vec3 place;
    layout(set = 3, binding = 1) uniform Move { vec4 by; };
    void main() { gl_Position = vec4(place + by.xyz, 1.0); }
    """
    fragment = """#version 450
    layout(set = 0, binding = 5) uniform Paint { mat3 pad; vec4 paint; };
    layout(set = 3, binding = 1) uniform Move { vec4 by; };
    layout(location = 0) out vec4 target;
    void main() { target = paint + by; }
    """
    blocks = (BlockSlot(Place("Paint", 0, 5), 64), BlockSlot(Place("Move", 3, 1), 16))
    pipeline = flat_pipeline(fragment, vertex=vertex, blocks=blocks)
    move = floats(1.0, -1.0, 0.0, 0.5)
    paint = bytes(48) + floats(0.25, 2.0, 0.125, 0.5)
    picture = vulkan.one(pipeline, draw_of(TOP_LEFT, blocks=(paint, move)))
    assert picture[-1, -1].tolist() == [1.25, 1.0, 0.125, 1.0]
    assert not picture[0, 0].any()


def test_each_draw_has_its_own_bytes(vulkan: Asker) -> None:
    fragment = """#version 450
    layout(set = 0, binding = 0) uniform Paint { vec4 paint; };
    layout(location = 0) out vec4 target;
    void main() { target = paint; }
    """
    pipeline = flat_pipeline(fragment, blocks=(BlockSlot(Place("Paint", 0, 0), 16),))
    draws = tuple(draw_of(WHOLE, blocks=[floats(*[float(n)] * 4)]) for n in range(5))
    found = [pixels(picture)[0, 0, 0] for picture in vulkan.draw(draw_job(pipeline, draws))]
    assert found == [0.0, 1.0, 2.0, 3.0, 4.0]
