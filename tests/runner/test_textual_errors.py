"""Mistakes in a job, and what OpenGL, WebGPU and WebGL 2 say of them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.pipeline import VertexInput
from burnish.targets.runner.drivers.render_state import RenderTarget
from burnish.targets.runner.drivers.slots import BlockSlot, BufferSlot

from . import textual_kit as kit
from . import textual_shaders as shaders
from .jobs_kit import draw_job
from .textual_kit import (
    CORNERS,
    NEAREST,
    NUMBERS,
    NUMBERS_DATA,
    RED,
    TEXELS,
    full,
    image,
    mesh,
    numbers,
    pipeline,
    place,
    read,
    shoot,
)

APIS = tuple(kit.COMMANDS)

pytestmark = pytest.mark.parametrize("api", APIS)


def wrong(api: str, job: FrameJob, *words: str) -> None:
    """The job is refused with these words, and the worker still draws."""
    with pytest.raises(DriverError) as refused:
        kit.asker(api).draw(job)
    for word in words:
        assert word in str(refused.value)
    assert (shoot(api, draw_job(pipeline(api), (full(RED),))) == RED).all()


def test_text_that_does_not_compile(api: str) -> None:
    glsl = shaders.PAINT_GLSL.replace("color = paint", "color = nonsense")
    wgsl = shaders.PAINT_WGSL.replace("Between(paint", "Between(nonsense")
    wrong(api, draw_job(pipeline(api, glsl, wgsl), (full(RED),)), "nonsense")


def test_stages_that_do_not_fit(api: str) -> None:
    glsl = shaders.PAINT_GLSL.replace("|in vec4 color", "|in vec3 color").replace(
        "target = color", "target = vec4(color, 1.0)"
    )
    wgsl = shaders.PAINT_WGSL.replace(
        "|@fragment fn main(@location(0) color: vec4f",
        "|@fragment fn main(@location(0) color: vec4u",
    )
    wrong(api, draw_job(pipeline(api, glsl, wgsl), (full(RED),)))


def test_attribute_that_the_job_lacks(api: str) -> None:
    chosen = pipeline(api)
    draw = full(RED)
    lacking = replace(chosen, inputs=chosen.inputs[:1])
    word = "1" if api == "webgpu" else "paint"
    wrong(api, draw_job(lacking, (replace(draw, vertices=draw.vertices[:1]),)), word)


def test_attribute_of_another_kind(api: str) -> None:
    job = draw_job(pipeline(api, paint="uint32x4"), (mesh(CORNERS, (1, 0, 0, 1), "<u4"),))
    wrong(api, job, "INVALID_OPERATION" if api == "webgl2" else "")


def test_names_that_the_text_lacks(api: str) -> None:
    chosen, draw = pipeline(api), full(RED)
    stranger = VertexInput("stranger", 2, "float32")
    more = replace(draw, vertices=(*draw.vertices, kit.floats([1, 2, 3])))
    wrong(api, draw_job(replace(chosen, inputs=(*chosen.inputs, stranger)), (more,)), "stranger")
    block = BlockSlot(place("stranger", 0, 0), 16)
    wrong(
        api,
        draw_job(replace(chosen, blocks=(block,)), (kit.with_blocks(draw, bytes(16)),)),
        "uniform block 'stranger'",
    )
    slot = replace(NEAREST, texture=place("stranger", 0, 0))
    textured = replace(draw, textures=(image(TEXELS),))
    wrong(api, draw_job(replace(chosen, textures=(slot,)), (textured,)), "texture 'stranger'")
    wrong(
        api,
        draw_job(replace(chosen, host_uniforms=("stranger",)), (draw,)),
        "uniform 'stranger'",
    )


def lacking(api: str, name: str) -> str:
    """A part of what is said of a text that reads what no slot of the pipeline stands for."""
    return {
        "opengl": f"'{name}', which the job does not have",
        "webgpu": "binding",
        "webgl2": f"'{name}', which its reflection does not have",
    }[api]


def test_block_that_the_job_lacks(api: str) -> None:
    draw = mesh(CORNERS, (-5, 3, 7), "<i4")
    wrong(api, draw_job(replace(numbers(api), blocks=()), (draw,)), lacking(api, "Numbers"))


def test_block_that_is_too_small(api: str) -> None:
    draw = kit.with_blocks(mesh(CORNERS, (-5, 3, 7), "<i4"), NUMBERS_DATA[:48])
    wrong(api, draw_job(numbers(api, replace(NUMBERS, size=48)), (draw,)), "48", "64")


def test_texture_that_the_job_lacks(api: str) -> None:
    job = draw_job(pipeline(api, shaders.TEXTURED_GLSL, shaders.TEXTURED_WGSL), (full(RED),))
    wrong(api, job, lacking(api, "image"))


def test_unused_is_no_error(api: str) -> None:
    """A resource that is declared but not used may be bound."""
    glsl = "|layout(std140) uniform Idle { vec4 nothing; };\nuniform sampler2D image;\n"
    wgsl = """|@group(0) @binding(0) var<uniform> Idle: vec4f;
@group(0) @binding(1) var image: texture_2d<f32>;
@group(0) @binding(2) var reader: sampler;
"""
    chosen = pipeline(
        api, shaders.PAINT_GLSL.replace("|", glsl), shaders.PAINT_WGSL.replace("|", wgsl),
        blocks=[BlockSlot(place("Idle", 0, 0), 16)],
    )  # fmt: skip
    sampler = place("reader", 0, 2) if api == "webgpu" else None
    slot = replace(NEAREST, texture=place("image", 0, 1), sampler=sampler)
    draw = replace(kit.with_blocks(full(RED), bytes(16)), textures=(image(TEXELS),))
    assert (shoot(api, draw_job(replace(chosen, textures=(slot,)), (draw,))) == RED).all()


def test_bytes_that_do_not_fit(api: str) -> None:
    chosen, draw = pipeline(api), full(RED)
    short = replace(draw, vertices=(draw.vertices[0], draw.vertices[1][:-4]))
    wrong(api, draw_job(chosen, (draw, short)), "draw 1", "'paint'", "44", "48")
    wrong(api, draw_job(chosen, (replace(draw, vertices=draw.vertices[:1]),)), "vertex buffers")
    wrong(api, draw_job(chosen, (replace(draw, indices=kit.indices(0, 1, 3)),)), "index 3")
    wrong(
        api,
        draw_job(chosen, (replace(draw, indices=kit.indices(0, 1)),)),
        "whole primitives of 3",
    )
    block = kit.with_blocks(mesh(CORNERS, (-5, 3, 7), "<i4"), NUMBERS_DATA + bytes(16))
    wrong(api, draw_job(numbers(api), (block,)), "80", "64")


def test_more_instances_than_there_are_values(api: str) -> None:
    chosen, draw = pipeline(api), full(RED)
    where, paint = chosen.inputs
    each = replace(chosen, inputs=(where, replace(paint, step="instance")))
    two = (draw.vertices[0], draw.vertices[1][:32])
    wrong(
        api,
        draw_job(each, (replace(draw, vertices=two, instance_count=3),)),
        "draw 0: vertex attribute 'paint' is given 32 bytes, and takes 48",
    )


def test_storage_buffers_that_are_no_whole_elements(api: str) -> None:
    chosen = replace(pipeline(api), buffers=(BufferSlot(place("items", 0, 0), 16),))
    for data in (b"", bytes(15), bytes(24)):
        wrong(
            api,
            draw_job(chosen, (replace(full(RED), buffers=(data,)),)),
            f"draw 0: storage buffer 'items' is given {len(data)} bytes, and its elements have 16",
        )
    wrong(
        api,
        draw_job(chosen, (full(RED),)),
        "draw 0: 0 storage buffers are given, and the pipeline has 1",
    )


def test_texels_that_do_not_fit(api: str) -> None:
    for picture, word in (
        (replace(image(TEXELS), levels=(bytes(60),)), "60"),
        (replace(image(TEXELS), levels=()), "0 mip levels"),
        (replace(image(TEXELS), levels=(TEXELS.tobytes(), bytes(16), bytes(16))), "3 mip levels"),
        (replace(image(TEXELS), format="bc7"), "bc7"),  # type: ignore[arg-type]
    ):
        with pytest.raises(DriverError, match=word):
            read(api, NEAREST, picture, (0, 1))


def test_unknown_target_format(api: str) -> None:
    strange = RenderTarget("rgb9float")  # type: ignore[arg-type]
    wrong(api, draw_job(pipeline(api, targets=[strange]), (full(RED),)), "rgb9float")


def test_huge_pictures(api: str) -> None:
    wrong(api, draw_job(pipeline(api), (replace(full(RED), width=100_000),)))
    wrong(api, draw_job(pipeline(api), (replace(full(RED), width=0),)))
