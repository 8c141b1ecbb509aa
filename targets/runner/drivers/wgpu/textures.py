"""Creates the textures and samplers of a draw."""

from __future__ import annotations

import struct
from typing import Any

import wgpu

from .....compiler.ir.types import DIMENSION_WORDS
from ..checks import level_size
from ..device import DriverError
from ..slots import TextureSlot
from ..texels import TEXELS, Image
from ..webgpu import DEPTH, sampler
from .device import Gpu


def make_sampler(gpu: Gpu, slot: TextureSlot) -> Any:
    """The sampler of a texture."""
    return gpu.device.create_sampler(**sampler(slot))


def make_view(gpu: Gpu, image: Image) -> Any:
    """A texture with all levels of an image, as a shader reads it."""
    if image.format == "rgba32float" and "float32-filterable" not in gpu.features:
        raise DriverError(f"{gpu.description.name} cannot filter rgba32float")
    is_depth = image.format == DEPTH
    usage = wgpu.TextureUsage.RENDER_ATTACHMENT if is_depth else wgpu.TextureUsage.COPY_DST
    texture = gpu.device.create_texture(
        format=image.format,
        dimension="3d" if image.dimension == "3d" else "2d",
        size=level_size(image, 0),
        mip_level_count=len(image.levels),
        usage=usage | wgpu.TextureUsage.TEXTURE_BINDING,
    )
    for level in range(len(image.levels)):
        if is_depth:
            _draw_depths(gpu, texture, image, level)
        else:
            _write(gpu, texture, image, level)
    return texture.create_view(dimension=DIMENSION_WORDS[image.dimension])


def _write(gpu: Gpu, texture: Any, image: Image, level: int) -> None:
    width, height, depth = level_size(image, level)
    layout = {"bytes_per_row": width * TEXELS[image.format].size, "rows_per_image": height}
    where = {"texture": texture, "mip_level": level}
    gpu.device.queue.write_texture(where, image.levels[level], layout, (width, height, depth))


DEPTHS = """
@group(0) @binding(0) var<storage, read> depths: array<f32>;
@group(0) @binding(1) var<uniform> width_and_first: vec2u;
@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1) * 4 - 1, f32(i >> 1) * 4 - 1, 0, 1);
}
@fragment fn depth(@builtin(position) at: vec4f) -> @builtin(frag_depth) f32 {
  let texel = vec2u(at.xy);
  return depths[width_and_first.y + texel.y * width_and_first.x + texel.x];
}
"""


def _draw_depths(gpu: Gpu, texture: Any, image: Image, level: int) -> None:
    """Upload depths by drawing them, layer by layer: WebGPU cannot copy to 32-bit depths."""
    device = gpu.device
    width, height, layers = level_size(image, level)
    module = device.create_shader_module(code=DEPTHS)
    pipeline = device.create_render_pipeline(
        layout="auto",
        vertex={"module": module, "entry_point": "corner", "buffers": []},
        fragment={"module": module, "entry_point": "depth", "targets": []},
        primitive={"topology": "triangle-list"},
        depth_stencil={"format": DEPTH, "depth_write_enabled": True, "depth_compare": "always"},
    )
    usage = wgpu.BufferUsage
    depths = device.create_buffer_with_data(data=image.levels[level], usage=usage.STORAGE)
    for layer in range(layers):
        first = struct.pack("<II", width, layer * width * height)
        place = device.create_buffer_with_data(data=first, usage=usage.UNIFORM)
        view = texture.create_view(
            dimension="2d", base_mip_level=level, mip_level_count=1,
            base_array_layer=layer, array_layer_count=1,
        )  # fmt: skip
        group = device.create_bind_group(
            layout=pipeline.get_bind_group_layout(0),
            entries=[
                {"binding": at, "resource": {"buffer": buffer}}
                for at, buffer in enumerate((depths, place))
            ],
        )
        encoder = device.create_command_encoder()
        drawn = encoder.begin_render_pass(
            color_attachments=[],
            depth_stencil_attachment={
                "view": view,
                "depth_clear_value": 0.0,
                "depth_load_op": "clear",
                "depth_store_op": "store",
            },
        )
        drawn.set_pipeline(pipeline)
        drawn.set_bind_group(0, group)
        drawn.draw(3)
        drawn.end()
        device.queue.submit([encoder.finish()])
