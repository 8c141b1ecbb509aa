"""Textures as Vulkan reads them, on both software drivers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from burnish.compiler.ir.types import Wrap
from burnish.targets.runner.drivers.slots import BlockSlot, Mip, Place, TextureSlot
from burnish.targets.runner.drivers.texels import Image, TextureFormat

from .jobs_kit import draw_job
from .vulkan_kit import SIZE, WHOLE, Asker, Floats, draw_of, flat_pipeline, floats, pixels

READ = """#version 450
layout(set = 2, binding = 1) uniform texture2D image;
layout(set = 2, binding = 4) uniform sampler reader;
layout(set = 2, binding = 7) uniform Where { vec4 scale; };
layout(location = 0) out vec4 target;
void main() { target = texture(sampler2D(image, reader), gl_FragCoord.xy * scale.xy + scale.zw); }
"""
IMAGE, READER = Place("image", 2, 1), Place("reader", 2, 4)
WHERE = BlockSlot(Place("Where", 2, 7), 16)


def read(
    vulkan: Asker, slot: TextureSlot, image: Image, scale: tuple[float, float, float, float]
) -> Floats:
    """A picture of the texture at pixel centres times the scale's xy, plus its zw."""
    pipeline = flat_pipeline(READ, blocks=(WHERE,), textures=(slot,))
    return vulkan.one(pipeline, draw_of(WHOLE, blocks=[floats(*scale)], textures=[image]))


NEAREST = TextureSlot(IMAGE, READER, filter="nearest", mip="none")
RAMP = Image("rgba32float", 4, 4, (floats(*(float(n) for n in range(64))),))
"""An image whose first lanes are 0, 4, 8, 12 in the first row, and 16 more in each further row."""
ONE_TO_ONE = (0.25, 0.25, 0.0, 0.0)


def test_the_first_texel_is_the_top_left(vulkan: Asker) -> None:
    picture = read(vulkan, NEAREST, RAMP, (1 / SIZE, 1 / SIZE, 0.0, 0.0))
    assert picture[0, 0].tolist() == [0.0, 1.0, 2.0, 3.0]
    assert picture[0, -1, 0] == 12.0
    assert picture[-1, 0, 0] == 48.0


@pytest.mark.parametrize(
    ("wrap", "columns"),
    [("repeat", [0, 1, 2, 3, 0, 1, 2, 3]), ("clamp", [0, 0, 0, 1, 2, 3, 3, 3]),
     ("mirror", [1, 0, 0, 1, 2, 3, 3, 2])],
)  # fmt: skip
def test_wrap(vulkan: Asker, wrap: Wrap, columns: list[int]) -> None:
    shift = 0.0 if wrap == "repeat" else -0.5
    slot = replace(NEAREST, wrap=wrap)
    picture = read(vulkan, slot, RAMP, (0.25, 0.25, shift, shift))
    expected = [[16.0 * row + 4.0 * column for column in columns] for row in columns]
    assert picture[:, :, 0].tolist() == expected


@pytest.mark.parametrize("form", ["rgba8unorm", "rgba32float"])
def test_linear_filtering_is_exact(vulkan: Asker, form: TextureFormat) -> None:
    """Weights have 8 bits at least; lavapipe's short cut for rgba8 would be off by 5e-3."""
    texels = np.array([[0, 255], [60, 10]], "u1")
    lanes = np.repeat(texels[:, :, None], 4, axis=2)
    data = lanes.tobytes() if form == "rgba8unorm" else (lanes / 255.0).astype("f4").tobytes()
    slot = replace(NEAREST, filter="linear", wrap="clamp")
    step = 0.5 / SIZE
    picture = read(vulkan, slot, Image(form, 2, 2, (data,)), (step, step, 0.25, 0.25))
    weights = (np.arange(SIZE) + 0.5) / SIZE
    rows = np.outer(1 - weights, texels[0] / 255) + np.outer(weights, texels[1] / 255)
    expected = rows[:, :1] * (1 - weights) + rows[:, 1:] * weights
    assert np.abs(picture[:, :, 0] - expected).max() < 1e-6


def mips() -> Image:
    """A texture whose levels of 16 to 1 texels hold the number of the level."""
    sizes = [16, 8, 4, 2, 1]
    levels = tuple(floats(*[float(n)] * (4 * size**2)) for n, size in enumerate(sizes))
    return Image("rgba32float", 16, 16, levels)


@pytest.mark.parametrize(
    ("mip", "stride", "level"),
    [
        ("none", 4.0, 0.0),
        ("nearest", 1.0, 0.0),
        ("nearest", 4.0, 2.0),
        ("nearest", 3.0, 2.0),
        ("nearest", 2.6, 1.0),
        ("linear", 0.5, 0.0),
        ("linear", 2.0, 1.0),
        ("linear", 3.0, 1.585),
        ("linear", 64.0, 4.0),
    ],
)
def test_mip_levels(vulkan: Asker, mip: Mip, stride: float, level: float) -> None:
    """``stride`` is how many texels lie between pixels; levels have 4 bits behind the point."""
    step = stride / 16
    picture = read(vulkan, TextureSlot(IMAGE, READER, "nearest", mip), mips(), (step, step, 0, 0))
    assert np.abs(picture[:, :, 0] - level).max() <= 1 / 16


def test_levels_that_are_not_given_are_not_read(vulkan: Asker) -> None:
    image = replace(mips(), levels=mips().levels[:2])
    picture = read(vulkan, TextureSlot(IMAGE, READER), image, (1.0, 1.0, 0.0, 0.0))
    assert np.all(picture[:, :, 0] == 1.0)


def test_srgb_texels_are_decoded(vulkan: Asker) -> None:
    """Colours are decoded to within half a step of the encoding; alpha is linear."""
    texel = bytes([0, 10, 128, 128])
    picture = read(vulkan, NEAREST, Image("rgba8unorm-srgb", 1, 1, (texel,)), ONE_TO_ONE)
    low, middle, alpha = picture[0, 0, 1:].tolist()
    assert picture[0, 0, 0] == 0.0
    assert 9.5 / 255 / 12.92 < low < linear(10.5)
    assert linear(127.5) < middle < linear(128.5)
    assert alpha == pytest.approx(128 / 255, abs=1e-6)


def linear(code: float) -> float:
    """An sRGB code beyond the first ten as linear light."""
    return float(((code / 255 + 0.055) / 1.055) ** 2.4)


def test_a_texture_that_is_not_square(vulkan: Asker) -> None:
    """The last levels of a wide texture are one texel wide: 4 × 2, 2 × 1, 1 × 1."""
    levels = tuple(floats(*[float(n)] * (4 * size)) for n, size in enumerate((8, 2, 1)))
    image = Image("rgba32float", 4, 2, levels)
    picture = read(vulkan, TextureSlot(IMAGE, READER), image, (1.0, 2.0, 0.0, 0.0))
    assert np.all(picture[:, :, 0] == 2.0)


def test_textures_that_are_one_with_their_samplers(vulkan: Asker) -> None:
    combined = """#version 450
    layout(set = 0, binding = 1) uniform sampler2D image;
    layout(location = 0) out vec4 target;
    void main() { target = texture(image, gl_FragCoord.xy * 0.25); }
    """
    slot = TextureSlot(Place("image", 0, 1), None, filter="nearest", mip="none")
    pipeline = flat_pipeline(combined, textures=(slot,))
    picture = vulkan.one(pipeline, draw_of(WHOLE, textures=[RAMP]))
    assert picture[1, 2].tolist() == [24.0, 25.0, 26.0, 27.0]


def test_each_draw_has_its_own_textures(vulkan: Asker) -> None:
    pipeline = flat_pipeline(READ, blocks=(WHERE,), textures=(NEAREST,))
    images = [Image("rgba32float", 1, 1, (floats(*[float(n)] * 4),)) for n in (1, 2, 1)]
    draws = tuple(
        draw_of(WHOLE, blocks=[floats(*ONE_TO_ONE)], textures=[image]) for image in images
    )
    assert [pixels(each)[0, 0, 0] for each in vulkan.draw(draw_job(pipeline, draws))] == [
        1.0,
        2.0,
        1.0,
    ]
