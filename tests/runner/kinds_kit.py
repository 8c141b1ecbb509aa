"""Draws reads of textures of every kind with all drivers: a slot, a picture, and an expression.

Expressions are written twice, in GLSL and in WGSL. The texture is called ``image``, and in WGSL its
sampler is called ``reader``. ``at`` goes from 0 to 1 over the picture, with y downwards.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import numpy as np
import numpy.typing as npt

from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.pipeline import Code, Pipeline
from burnish.targets.runner.drivers.render_state import RenderTarget
from burnish.targets.runner.drivers.slots import Place, TextureSlot
from burnish.targets.runner.drivers.texels import TEXELS, Dimension, Image, Sample, TextureFormat

from . import textual_kit, vulkan_kit
from .jobs_kit import draw_job

Floats = npt.NDArray[np.float32]

VULKAN = ("lavapipe", "swiftshader")
DRIVERS = (*VULKAN, *textual_kit.COMMANDS)

_SHAPES: dict[Dimension, str] = {
    "2d": "2D", "2d_array": "2DArray", "3d": "3D", "cube": "Cube", "cube_array": "CubeArray",
}  # fmt: skip
_PREFIXES: dict[Sample, str] = {"float": "", "depth": "", "sint": "i", "uint": "u"}
_WGSL_KINDS: dict[Sample, str] = {"float": "f32", "sint": "i32", "uint": "u32"}

_VULKAN_HEAD = """#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(location = 0) """
_WGSL_STAGE = """@fragment fn main(@location(0) color: vec4f) -> @location(0) vec4f {{
    let at = color.xy;
    return {read};
}}
"""
_GLSL_STAGE = """layout(location = 0) out vec4 target;
void main() {{ vec2 at = color.xy; target = {read}; }}
"""


def picture_of(
    dimension: Dimension, format: TextureFormat, *levels: npt.NDArray[np.generic]
) -> Image:
    """A picture of levels of shape (height, width, lanes) or (depth, height, width, lanes)."""
    whole = [level if level.ndim == 4 else level[np.newaxis] for level in levels]
    depth, height, width, lanes = whole[0].shape
    assert lanes == TEXELS[format].lanes
    data = tuple(level.astype(TEXELS[format].kind).tobytes() for level in whole)
    return Image(format, width, height, data, dimension, depth)


def slot_for(image: Image, **state: object) -> TextureSlot:
    """A slot that accepts a picture."""
    sample = TEXELS[image.format].sample
    whole: dict[str, object] = {"filter": "nearest", "mip": "nearest", "wrap": "clamp", **state}
    if sample != "float":
        whole["sampling"] = "comparison" if sample == "depth" else "non-filtering"
    reader = Place("reader", 0, 1) if whole.get("sampling", "filtering") else None
    slot = TextureSlot(Place("image", 0, 0), reader, dimension=image.dimension, sample=sample)
    return replace(slot, **whole)  # type: ignore[arg-type]


def read(driver: str, slot: TextureSlot, image: Image, glsl: str, wgsl: str) -> Floats:
    """The picture, 8 × 8 pixels, that shows the value of an expression."""
    return _shown(driver, [slot], [image], [""], glsl, wgsl)


def read_all(
    driver: str, slots: Sequence[TextureSlot], images: Sequence[Image], glsl: str, wgsl: str
) -> Floats:
    """The picture of an expression over several textures: ``image0`` with ``reader0`` and so on."""
    return _shown(driver, slots, images, list(map(str, range(len(slots)))), glsl, wgsl)


def _shown(
    driver: str,
    slots: Sequence[TextureSlot],
    images: Sequence[Image],
    names: Sequence[str],
    glsl: str,
    wgsl: str,
) -> Floats:
    placed = tuple(
        replace(
            slot,
            texture=Place(f"image{name}", 0, 2 * number),
            sampler=None if slot.sampling is None else Place(f"reader{name}", 0, 2 * number + 1),
        )
        for number, (slot, name) in enumerate(zip(slots, names, strict=True))
    )
    corners = textual_kit.CORNERS
    at = [(0.0, 1.0), (2.0, 1.0), (0.0, -1.0)]
    if driver in VULKAN:
        made, places = _vulkan_pipeline(placed, glsl), [(*each, 0.5) for each in corners]
        draw = vulkan_kit.draw_of(places, [(*each, 0.0, 0.0) for each in at], textures=images)
        return _vulkan(driver).one(made, draw)
    made = _textual_pipeline(driver, placed, glsl, wgsl)
    painted: Draw = textual_kit.mesh(corners, [(*each, 0, 0) for each in at])
    job = draw_job(made, (replace(painted, textures=tuple(images)),))
    return textual_kit.shoot(driver, job)


@cache
def _vulkan(driver: str) -> vulkan_kit.Asker:
    return vulkan_kit.Asker(driver)


def _names(slot: TextureSlot) -> tuple[str, str, str]:
    """The names of GLSL's texture and sampler, and of WGSL's texture."""
    shape, shadow = _SHAPES[slot.dimension], "Shadow" if slot.compare else ""
    prefix = _PREFIXES[slot.sample]
    in_wgsl = f"{slot.dimension}" if slot.sample == "depth" else slot.dimension
    kind = "" if slot.sample == "depth" else f"<{_WGSL_KINDS[slot.sample]}>"
    wgsl = f"texture_{'depth_' if not kind else ''}{in_wgsl}{kind}"
    return f"{prefix}texture{shape}", f"{prefix}sampler{shape}{shadow}", wgsl


def _vulkan_pipeline(slots: Sequence[TextureSlot], read: str) -> Pipeline:
    lines = [f"{_VULKAN_HEAD}in vec4 color;"]
    readers: dict[str, str] = {}
    for slot in slots:
        texture, sampler, _ = _names(slot)
        name, binding = slot.texture.identifier, slot.texture.binding
        lines.append(f"layout(set = 0, binding = {binding}) uniform {texture} {name}_texture;")
        if slot.sampler is None:
            readers[name] = f"{name}_texture"
            continue
        reader = "samplerShadow" if slot.compare else "sampler"
        binding = slot.sampler.binding
        lines.append(
            f"layout(set = 0, binding = {binding}) uniform {reader} {slot.sampler.identifier};"
        )
        readers[name] = f"{sampler}({name}_texture, {slot.sampler.identifier})"
    for name, reader in readers.items():
        read = re.sub(rf"\b{name}\b", reader, read)
    text = "\n".join([*lines, _GLSL_STAGE.format(read=read)])
    fragment = vulkan_kit.glsl("frag", text)
    made = vulkan_kit.shading(vulkan_kit.painted_pipeline(), fragment)
    return replace(made, textures=tuple(slots))


def _textual_pipeline(api: str, slots: Sequence[TextureSlot], glsl: str, wgsl: str) -> Pipeline:
    lines = [] if api == "webgpu" else [textual_kit.GLSL_HEADS[api], "in vec4 color;"]
    for slot in slots:
        _, sampler, texture = _names(slot)
        if api != "webgpu":
            lines.append(f"uniform highp {sampler} {slot.texture.identifier};")
            continue
        lines.append(_variable(slot.texture, texture))
        if slot.sampler is not None:
            kind = "sampler_comparison" if slot.compare else "sampler"
            lines.append(_variable(slot.sampler, kind))
    if api == "webgpu":
        text = "\n".join([*lines, _WGSL_STAGE.format(read=wgsl)])
    else:
        text = "\n".join([*lines, _GLSL_STAGE.format(read=glsl)])
        slots = [
            replace(slot, texture=Place(slot.texture.identifier, None, None), sampler=None)
            for slot in slots
        ]
    made = textual_kit.pipeline(api, targets=(RenderTarget("rgba32float"),))
    return replace(vulkan_kit.shading(made, Code("main", text)), textures=tuple(slots))


def _variable(place: Place, type_: str) -> str:
    return f"@group(0) @binding({place.binding}) var {place.identifier}: {type_};"


def faces(size: int, channels: Sequence[float] = (0.0, 0.0, 1.0)) -> npt.NDArray[np.float64]:
    """Six faces (6, size, size, 4), whose lanes are face, column and row, followed by the given
    ones."""
    face, row, column = np.meshgrid(np.arange(6), np.arange(size), np.arange(size), indexing="ij")
    return np.stack([face, column, row, np.full_like(face, channels[-1])], -1).astype(np.float64)
