"""Draws the pictures of a job, and reads them back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
import wgpu

from ..checks import lane_count
from ..draw_job import Draw, Job, Picture
from ..pipeline import Pipeline
from ..readback import TEXEL_LANES, to_float
from ..render_state import TargetFormat
from ..webgpu import DEPTH, Buffer
from .bindings import bind_groups, make_buffer, make_storage
from .device import Gpu, explained
from .pipeline import Made, make_pipeline

CLEARED_STENCIL = {
    "stencil_clear_value": 0,
    "stencil_load_op": "clear",
    "stencil_store_op": "discard",
}


def draw_job(gpu: Gpu, job: Job) -> list[Picture]:
    """A picture for each draw. Raises ``DriverError``."""
    with explained():
        made = make_pipeline(gpu, job.pipeline)
        return [_picture(gpu, job.pipeline, made, draw) for draw in job.draws]


def _picture(gpu: Gpu, pipeline: Pipeline, made: Made, draw: Draw) -> Picture:
    targets = [_target(gpu, target.format, draw) for target in pipeline.targets]
    drawn_to = targets
    if pipeline.samples > 1:
        drawn_to = [_target(gpu, each.format, draw, pipeline.samples) for each in pipeline.targets]
    encoder = gpu.device.create_command_encoder()
    drawn = encoder.begin_render_pass(
        color_attachments=[
            {
                "view": each.create_view(),
                "clear_value": clear,
                "load_op": "clear",
                **(_STORED if each is target else _resolved(target)),
            }
            for each, target, clear in zip(drawn_to, targets, draw.clear, strict=True)
        ],
        depth_stencil_attachment={
            "view": _target(gpu, pipeline.depth_format, draw, pipeline.samples).create_view(),
            "depth_clear_value": draw.clear_depth,
            "depth_load_op": "clear",
            "depth_store_op": "discard",
            **(CLEARED_STENCIL if pipeline.stencil else {}),
        },
    )
    drawn.set_pipeline(made.handle)
    drawn.set_blend_constant(draw.blend_constant)
    if pipeline.stencil is not None:
        drawn.set_stencil_reference(pipeline.stencil.reference)
    storage = make_storage(gpu, pipeline.buffers, draw.buffers)
    for number, group in enumerate(bind_groups(gpu, made.layouts, made.groups, draw, storage)):
        drawn.set_bind_group(number, group)
    if draw.indices:  # a buffer of no bytes cannot be made
        _mesh(gpu, drawn, made.buffers, draw)
    drawn.end()
    gpu.device.queue.submit([encoder.finish()])
    lanes = (
        read_texels(gpu, target, slot.format, (draw.width, draw.height), pipeline.first_row)
        for target, slot in zip(targets, pipeline.targets, strict=True)
    )
    return Picture(draw.width, draw.height, tuple(lanes))


_STORED = {"store_op": "store"}


def _resolved(target: Any) -> dict[str, Any]:
    """Nothing is kept of several samples but their mean, in another texture."""
    return {"store_op": "discard", "resolve_target": target.create_view()}


def _target(gpu: Gpu, format: str, draw: Draw, samples: int = 1) -> Any:
    usage = wgpu.TextureUsage.RENDER_ATTACHMENT
    if not format.startswith(DEPTH):
        usage |= wgpu.TextureUsage.COPY_SRC
    size = (draw.width, draw.height, 1)
    return gpu.device.create_texture(format=format, size=size, usage=usage, sample_count=samples)


def _mesh(gpu: Gpu, drawn: Any, buffers: Sequence[Buffer], draw: Draw) -> None:
    for number, buffer in enumerate(buffers):
        data = _interleaved(buffer, draw.vertices)
        drawn.set_vertex_buffer(number, make_buffer(gpu, data, wgpu.BufferUsage.VERTEX))
    drawn.set_index_buffer(make_buffer(gpu, draw.indices, wgpu.BufferUsage.INDEX), "uint32")
    drawn.draw_indexed(len(draw.indices) // 4, draw.instance_count)


def _interleaved(buffer: Buffer, vertices: Sequence[bytes]) -> bytes:
    """The attributes of one buffer, one vertex after the other."""
    columns = [
        np.frombuffer(vertices[number], np.uint8).reshape(-1, 4 * lane_count(each.format))
        for number, each, _ in buffer.members
    ]
    return np.concatenate(columns, axis=1).tobytes()


def read_texels(
    gpu: Gpu,
    target: Any,
    format: TargetFormat,
    size: tuple[int, int],
    first_row: Literal["top", "bottom"],
) -> bytes:
    """The texels of a render target, or of an image that a kernel has written, as floats."""
    (width, height), (count, kind) = size, TEXEL_LANES[format]
    texels = gpu.device.queue.read_texture(
        {"texture": target},
        {"bytes_per_row": width * count * kind.itemsize, "rows_per_image": height},
        (width, height, 1),
    )
    return to_float(bytes(texels), format, width, height, first_row)
