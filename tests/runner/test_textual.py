"""Pictures that OpenGL, WebGPU and WebGL 2 draw alike: conventions and fixed functions."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt
import pytest

from burnish.compiler.ir.blending import NAMED, Blend, BlendEquation, Factor, Operation
from burnish.compiler.ir.render_state import Compare, Cull, DepthState
from burnish.targets.runner.drivers.render_state import RenderTarget, TargetFormat

from . import textual_kit as kit
from . import textual_shaders as shaders
from .blends import blended, both, named
from .jobs_kit import draw_job
from .textual_kit import (
    BLUE,
    CORNERS,
    GREEN,
    NUMBERS_DATA,
    RED,
    SIZE,
    full,
    mesh,
    numbers,
    pipeline,
    shoot,
)

APIS = tuple(kit.COMMANDS)

pytestmark = pytest.mark.parametrize("api", APIS)

TOP_LEFT = ((-1, 1), (-1, 0), (0, 1))
"""Counter-clockwise, in the upper left quarter, with its right angle in the corner."""


def test_device(api: str) -> None:
    device = kit.asker(api).device()
    software = "llvmpipe" if api == "opengl" else "swiftshader"
    assert software in device.name.lower()
    assert ("Mesa" if api == "opengl" else "Chromium") in device.version
    assert 4 <= device.subpixel_bits <= 8


def test_first_row_is_the_top(api: str) -> None:
    picture = shoot(api, draw_job(pipeline(api), (mesh(TOP_LEFT, RED),)))
    assert (picture[0, 0] == RED).all()
    covered = picture[..., 3] == 1
    assert covered[: SIZE // 2, : SIZE // 2].sum() == covered.sum() > 0
    assert (picture[~covered] == 0).all()


def test_a_turned_text_is_not_turned_back(api: str) -> None:
    turned = replace(pipeline(api), first_row="bottom" if api == "webgpu" else "top")
    assert (shoot(api, draw_job(turned, (mesh(TOP_LEFT, RED),)))[-1, 0] == RED).all()


def test_interpolates(api: str) -> None:
    picture = shoot(api, draw_job(pipeline(api), (mesh(CORNERS, [(0, 0, 0, 1), RED, GREEN]),)))
    centres = (np.arange(SIZE) + 0.5) / SIZE / 2
    expected = np.zeros((SIZE, SIZE, 4))
    expected[..., 0] = centres
    expected[..., 1] = centres[::-1, None]
    expected[..., 3] = 1
    np.testing.assert_allclose(picture, expected, atol=1e-6)


@pytest.mark.parametrize("cull", get_args(Cull))
@pytest.mark.parametrize("front", ["ccw", "cw"])
def test_culling(api: str, cull: Cull, front: Literal["ccw", "cw"]) -> None:
    chosen = replace(pipeline(api), cull=cull, front_face=front)
    counter, clockwise = full(RED), mesh(CORNERS[::-1], RED)
    drawn = [
        kit.pixels(p).any() for p in kit.asker(api).draw(draw_job(chosen, (counter, clockwise)))
    ]
    faces = ["front", "back"] if front == "ccw" else ["back", "front"]
    assert drawn == [face != cull for face in faces]


def test_nearer_wins_in_any_order(api: str) -> None:
    near, far = [(x, y, 0.25) for x, y in CORNERS], [(x, y, 0.75) for x, y in CORNERS]
    paints = np.repeat([GREEN, RED], 3, axis=0)
    draws = (mesh(near + far, paints), mesh(far + near, paints[::-1]))
    for picture in kit.asker(api).draw(draw_job(pipeline(api), draws)):
        assert (kit.pixels(picture) == GREEN).all()


AT_HALF = ("less", "less_equal", "not_equal", "always")
"""The comparisons that a depth of 0.5 passes where 1 is stored."""
AT_ONE = ("equal", "less_equal", "greater_equal", "always")
"""The comparisons that a depth of 1 passes there."""


@pytest.mark.parametrize("compare", get_args(Compare))
def test_depths_are_compared(api: str, compare: Compare) -> None:
    chosen = replace(pipeline(api), depth=DepthState(compare))
    draws = tuple(mesh([(x, y, z) for x, y in CORNERS], RED) for z in (0.5, 1.0))
    drawn = [kit.pixels(p).any() for p in kit.asker(api).draw(draw_job(chosen, draws))]
    assert drawn == [compare in AT_HALF, compare in AT_ONE]


def test_depths_that_are_not_written_hide_nothing(api: str) -> None:
    near, far = [(x, y, 0.25) for x, y in CORNERS], [(x, y, 0.75) for x, y in CORNERS]
    draw = mesh(near + far, np.repeat([GREEN, RED], 3, axis=0))
    for writes, seen in ((False, RED), (True, GREEN), (False, RED)):
        chosen = replace(pipeline(api), depth=DepthState(write=writes))
        for picture in kit.asker(api).draw(draw_job(chosen, (draw, draw))):
            assert (kit.pixels(picture) == seen).all()


def test_equal_depth_keeps_the_first(api: str) -> None:
    twice = mesh(CORNERS * 2, np.repeat([GREEN, RED], 3, axis=0))
    assert (shoot(api, draw_job(pipeline(api), (twice,))) == GREEN).all()


def test_depth_has_32_bits(api: str) -> None:
    """Near 0 floats lie close together; a depth of 24 bits cannot tell these two apart.

    On its way through OpenGL's own range, which ends at -1, the difference would be lost.
    """
    glsl = shaders.PAINT_GLSL.replace("2.0 * place.z - 1.0", "place.z")
    near, far = (2.0**-26, 2.0**-25) if api == "webgpu" else (-1 + 2.0**-24, -1 + 2.0**-23)
    places = [(x, y, z) for z in (far, near) for x, y in CORNERS]
    draw = mesh(places, np.repeat([RED, GREEN], 3, axis=0))
    assert (shoot(api, draw_job(pipeline(api, glsl), (draw,))) == GREEN).all()


def test_beyond_the_clip_volume(api: str) -> None:
    for z in (-0.5, 1.5):
        outside = mesh([(x, y, z) for x, y in CORNERS], RED)
        assert not shoot(api, draw_job(pipeline(api), (outside,))).any()


Floats = npt.NDArray[np.float64]

SOURCE = np.array([0.5, 0.25, 1.0, 0.25])
TARGET = np.array([0.25, 1.0, 0.5, 0.5])
CLEAR = ((0.25, 1.0, 0.5, 0.5),)
"""The clear colour of the only target, which is ``TARGET``."""

CONSTANT = (0.5, 0.25, 0.75, 1.0)


def with_words(mode: str) -> Floats:
    """The colours that the blend states with names of their own result in."""
    alpha = SOURCE[3]
    color = SOURCE[:3] * alpha + TARGET[:3] * (1 - alpha)
    results: dict[str, Floats] = {
        "alpha": np.array([*color, alpha + TARGET[3] * (1 - alpha)]),
        "none": SOURCE,
        "premultiplied": SOURCE + TARGET * (1 - alpha),
        "add": SOURCE + TARGET,
        "multiply": SOURCE * TARGET,
    }
    return results[mode]


@pytest.mark.parametrize("format", ["rgba32float", "rgba16float"])
@pytest.mark.parametrize("mode", NAMED)
def test_blending(api: str, mode: str, format: TargetFormat) -> None:
    chosen = pipeline(api, targets=[RenderTarget(format, named(mode))])
    found = shoot(api, draw_job(chosen, (full(SOURCE),), clear=CLEAR))
    assert (found == with_words(mode)).all()


def test_every_factor(api: str) -> None:
    for factor in get_args(Factor):
        for state in (both(factor, "one"), both("one", factor)):
            chosen = pipeline(api, targets=[RenderTarget("rgba32float", state)])
            job = draw_job(chosen, (full(SOURCE),), clear=CLEAR, blend_constant=CONSTANT)
            found = shoot(api, job)
            expected = blended(state, SOURCE.tolist(), TARGET.tolist(), CONSTANT)
            assert (found == np.array(expected)).all(), state


def test_every_operation(api: str) -> None:
    for operation in get_args(Operation):
        state = Blend(BlendEquation("one", "one", operation), BlendEquation("one", "zero"))
        chosen = pipeline(api, targets=[RenderTarget("rgba32float", state)])
        found = shoot(api, draw_job(chosen, (full(SOURCE),), clear=CLEAR))
        assert (found == np.array(blended(state, SOURCE.tolist(), TARGET.tolist()))).all(), state


@pytest.mark.parametrize("mask", ["rgb", "ga", "none"])
def test_lanes_that_are_masked_keep_what_they_have(api: str, mask: str) -> None:
    chosen = pipeline(api, targets=[RenderTarget("rgba32float", None, mask)])
    draw = full(SOURCE)
    written = [mask != "none" and lane in mask for lane in "rgba"]
    # Twice, as what clears the second picture must not obey the first one's mask.
    pictures = kit.asker(api).draw(draw_job(chosen, (draw, draw), clear=CLEAR))
    for picture in pictures:
        assert (kit.pixels(picture, 0) == np.where(written, SOURCE, TARGET)).all()


def test_depths_are_cleared_as_asked(api: str) -> None:
    chosen = replace(pipeline(api), depth=DepthState("greater"))
    for depth, drawn in ((0.25, True), (0.75, False)):
        draw = mesh([(x, y, 0.5) for x, y in CORNERS], RED)
        assert (shoot(api, draw_job(chosen, (draw,), clear_depth=depth)) == RED).all() == drawn


@pytest.mark.parametrize("format", get_args(TargetFormat))
def test_target_formats(api: str, format: TargetFormat) -> None:
    paint = np.array([0.2, 0.4, 0.6, 0.8], np.float32)
    picture = shoot(api, draw_job(pipeline(api, targets=[RenderTarget(format)]), (full(paint),)))
    lanes = next(n for n, letter in enumerate(format) if letter.isdigit())
    expected = np.array([0, 0, 0, 1], np.float32)
    expected[:lanes] = paint[:lanes]
    tolerance = 0.0
    if "16" in format:
        tolerance = 2.0**-11
    elif "unorm" in format:
        # Half a step of 1/255, where sRGB's curve is steepest three times that.
        tolerance = (3.0 if "srgb" in format else 1.01) * 0.5 / 255
    np.testing.assert_allclose(picture, np.broadcast_to(expected, picture.shape), atol=tolerance)


def test_srgb_target_is_encoded(api: str) -> None:
    """Near black a step of sRGB is 1/(255 · 12.92), far below one of linear 8 bits."""
    dark = shoot(
        api,
        draw_job(pipeline(api, targets=[RenderTarget("rgba8unorm-srgb")]), (full((0.001,) * 4),)),
    )
    np.testing.assert_allclose(dark[..., :3], 0.001, atol=0.5 / 255 / 12.92 + 1e-6)
    assert (dark[..., 3] == 0).all()


def test_two_targets_each_with_its_own(api: str) -> None:
    """Format, clear colour and blending."""
    targets = [RenderTarget("rgba8unorm"), RenderTarget("rg32float", named("add"))]
    draw = mesh(TOP_LEFT, (1, 0, 0.25, 1))
    chosen = pipeline(api, shaders.TWO_GLSL, shaders.TWO_WGSL, targets=targets)
    job = draw_job(chosen, (draw,), clear=((0, 1, 0, 1), (0.5, 8, 0, 0)))
    (picture,) = kit.asker(api).draw(job)
    first, second = kit.pixels(picture, 0), kit.pixels(picture, 1)
    assert np.allclose(first[0, 0], (1, 0, 0.25, 1), atol=0.5 / 255)
    assert first[-1, -1].tolist() == [0, 1, 0, 1]
    assert second[0, 0].tolist() == [0.75, 9, 0, 1]
    assert second[-1, -1].tolist() == [0.5, 8, 0, 1]


@pytest.mark.parametrize("first", [0, 1, 2])
def test_flat_varyings_come_from_the_first_index(api: str, first: int) -> None:
    order = [(first + n) % 3 for n in range(3)]
    draw = replace(mesh(CORNERS, [RED, GREEN, BLUE]), indices=kit.indices(*order))
    picture = shoot(api, draw_job(pipeline(api, shaders.FLAT_GLSL, shaders.FLAT_WGSL), (draw,)))
    assert (picture == (RED, GREEN, BLUE)[first]).all()


def test_integers_and_blocks(api: str) -> None:
    draw = kit.with_blocks(mesh(CORNERS, (-5, 3, 2**20), "<i4"), NUMBERS_DATA)
    picture = shoot(api, draw_job(numbers(api), (draw,)))
    assert (picture == (-12, 3 + 2**20, 2**20 + 3, 16777213)).all()


def test_many_draws_are_apart(api: str) -> None:
    draws = [replace(full((n, 0, 0, 1)), width=n + 1, height=2 * n + 1) for n in range(5)]
    for n, picture in enumerate(kit.asker(api).draw(draw_job(pipeline(api), tuple(draws)))):
        assert kit.pixels(picture).shape == (2 * n + 1, n + 1, 4)
        assert (kit.pixels(picture) == (n, 0, 0, 1)).all()
