"""Textures of every kind, read by all drivers: a slot, a picture, and an expression that reads it.

Expressions are written twice, in GLSL and in WGSL. The texture is ``image``; in WGSL its sampler is
``reader``. ``at`` runs from 0 to 1 over the picture, its y down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import numpy as np
import numpy.typing as npt

from burnish.targets.runner.drivers.draw import (
    TEXELS,
    Code,
    Dimension,
    Draw,
    Image,
    Job,
    Pipeline,
    Place,
    Sample,
    Target,
    TextureFormat,
    TextureSlot,
)

from . import textual_kit, vulkan_kit

Floats = npt.NDArray[np.float32]

VULKAN = ("lavapipe", "swiftshader")
DRIVERS = (*VULKAN, *textual_kit.COMMANDS)

_SHAPES: dict[Dimension, str] = {"2d": "2D", "2d_array": "2DArray", "3d": "3D", "cube": "Cube"}
_PREFIXES: dict[Sample, str] = {"float": "", "depth": "", "sint": "i", "uint": "u"}
_WGSL_KINDS: dict[Sample, str] = {"float": "f32", "sint": "i32", "uint": "u32"}

_GLSL = """in vec4 color;
uniform highp {sampler} image;
layout(location = 0) out vec4 target;
void main() {{ vec2 at = color.xy; target = {read}; }}
"""
_VULKAN = """#version 450
layout(location = 0) in vec4 color;
layout(set = 0, binding = 0) uniform {texture} image_texture;
layout(set = 0, binding = 1) uniform {reader} reader;
layout(location = 0) out vec4 target;
#define image {sampler}(image_texture, reader)
void main() {{ vec2 at = color.xy; target = {read}; }}
"""
_WGSL = """@group(0) @binding(0) var image: {texture};
@group(0) @binding(1) var reader: {reader};
@fragment fn main(@location(0) color: vec4f) -> @location(0) vec4f {{
    let at = color.xy;
    return {read};
}}
"""


def picture_of(
    dimension: Dimension, format: TextureFormat, *levels: npt.NDArray[np.generic]
) -> Image:
    """A picture from its levels, (height, width, lanes) or (depth, height, width, lanes)."""
    whole = [level if level.ndim == 4 else level[np.newaxis] for level in levels]
    depth, height, width, lanes = whole[0].shape
    assert lanes == TEXELS[format].lanes
    data = tuple(level.astype(TEXELS[format].kind).tobytes() for level in whole)
    return Image(format, width, height, data, dimension, depth)


def slot_for(image: Image, **state: object) -> TextureSlot:
    """A slot that takes a picture."""
    sample = TEXELS[image.format].sample
    whole = {"filter": "nearest", "mip": "nearest", "wrap": "clamp", **state}
    if sample != "float":
        whole["sampling"] = "comparison" if sample == "depth" else "non-filtering"
    slot = TextureSlot(
        Place("image", 0, 0), Place("reader", 0, 1), dimension=image.dimension, sample=sample
    )
    return replace(slot, **whole)  # type: ignore[arg-type]


def read(driver: str, slot: TextureSlot, image: Image, glsl: str, wgsl: str) -> Floats:
    """The picture of an expression, 8 × 8."""
    corners = textual_kit.CORNERS
    at = [(0.0, 1.0), (2.0, 1.0), (0.0, -1.0)]
    if driver in VULKAN:
        made, places = _vulkan_pipeline(slot, glsl), [(*each, 0.5) for each in corners]
        draw = vulkan_kit.draw_of(places, [(*each, 0.0, 0.0) for each in at], textures=[image])
        return _vulkan(driver).one(made, draw)
    made = _textual_pipeline(driver, slot, glsl, wgsl)
    painted: Draw = textual_kit.mesh(corners, [(*each, 0, 0) for each in at])
    return textual_kit.shoot(driver, Job(made, (replace(painted, textures=(image,)),)))


@cache
def _vulkan(driver: str) -> vulkan_kit.Asker:
    return vulkan_kit.Asker(driver)


def _names(slot: TextureSlot) -> tuple[str, str, str]:
    """GLSL's texture and sampler, and WGSL's texture."""
    shape, shadow = _SHAPES[slot.dimension], "Shadow" if slot.compare else ""
    prefix = _PREFIXES[slot.sample]
    in_wgsl = f"{slot.dimension}" if slot.sample == "depth" else slot.dimension
    kind = "" if slot.sample == "depth" else f"<{_WGSL_KINDS[slot.sample]}>"
    wgsl = f"texture_{'depth_' if not kind else ''}{in_wgsl}{kind}"
    return f"{prefix}texture{shape}", f"{prefix}sampler{shape}{shadow}", wgsl


def _vulkan_pipeline(slot: TextureSlot, read: str) -> Pipeline:
    texture, sampler, _ = _names(slot)
    reader = "samplerShadow" if slot.compare else "sampler"
    text = _VULKAN.format(texture=texture, sampler=sampler, reader=reader, read=read)
    fragment = vulkan_kit.glsl("frag", text)
    return replace(vulkan_kit.painted_pipeline(), fragment=fragment, textures=(slot,))


def _textual_pipeline(api: str, slot: TextureSlot, glsl: str, wgsl: str) -> Pipeline:
    _, sampler, texture = _names(slot)
    if api == "webgpu":
        reader = "sampler_comparison" if slot.compare else "sampler"
        text = _WGSL.format(texture=texture, reader=reader, read=wgsl)
    else:
        text = textual_kit.GLSL_HEADS[api] + _GLSL.format(sampler=sampler, read=glsl)
        slot = replace(slot, texture=Place("image", None, None), sampler=None)
    made = textual_kit.pipeline(api, targets=(Target("rgba32float"),))
    return replace(made, fragment=Code("main", text), textures=(slot,))


def faces(size: int, channels: Sequence[float] = (0.0, 0.0, 1.0)) -> npt.NDArray[np.float64]:
    """Six faces (6, size, size, 4) whose lanes are face, column and row, and then what is given."""
    face, row, column = np.meshgrid(np.arange(6), np.arange(size), np.arange(size), indexing="ij")
    return np.stack([face, column, row, np.full_like(face, channels[-1])], -1).astype(np.float64)
