"""Runs the dispatches of a kernel, and reads back what they have written."""

from __future__ import annotations

from typing import Any

import wgpu

from ..draw import WORKGROUP, BlockSlot, BufferSlot, Dispatch, KernelJob, Pipeline, Written
from .device import Gpu, explained
from .pipeline import Bound, Groups, bound, layout_entries
from .textures import make_sampler, make_view

STORED = wgpu.BufferUsage.STORAGE | wgpu.BufferUsage.COPY_SRC


def compute_job(gpu: Gpu, job: KernelJob) -> list[Written]:
    """What each dispatch writes. Raises ``DriverError``."""
    with explained():
        groups = bound(job.pipeline)
        layouts = [
            gpu.device.create_bind_group_layout(
                entries=layout_entries(group, wgpu.ShaderStage.COMPUTE)
            )
            for group in groups
        ]
        (code,) = job.pipeline.stages.values()
        pipeline = gpu.device.create_compute_pipeline(
            layout=gpu.device.create_pipeline_layout(bind_group_layouts=layouts),
            compute={
                "module": gpu.device.create_shader_module(code=code.text),
                "entry_point": code.entry,
            },
        )
        return [_run(gpu, job.pipeline, pipeline, layouts, groups, d) for d in job.dispatches]


def _run(
    gpu: Gpu,
    description: Pipeline,
    pipeline: Any,
    layouts: list[Any],
    groups: Groups,
    dispatch: Dispatch,
) -> Written:
    given = iter(dispatch.buffers)
    buffers = [_buffer(gpu, slot, dispatch, None if slot.written else next(given))
               for slot in description.buffers]  # fmt: skip
    encoder = gpu.device.create_command_encoder()
    run = encoder.begin_compute_pass()
    run.set_pipeline(pipeline)
    for number, (layout, group) in enumerate(zip(layouts, groups, strict=True)):
        entries = [
            {"binding": at, "resource": _resource(gpu, what, dispatch, buffers)}
            for at, what in group.items()
        ]
        run.set_bind_group(number, gpu.device.create_bind_group(layout=layout, entries=entries))
    run.dispatch_workgroups(dispatch.groups(WORKGROUP), 1, 1)
    run.end()
    gpu.device.queue.submit([encoder.finish()])
    pairs = zip(description.buffers, buffers, strict=True)
    return Written(
        tuple(_read(gpu, b, dispatch.count * slot.stride) for slot, b in pairs if slot.written)
    )


def _buffer(gpu: Gpu, slot: BufferSlot, dispatch: Dispatch, data: bytes | None) -> Any:
    if data is None:
        size = max(dispatch.count, 1) * slot.stride
        return gpu.device.create_buffer(size=size, usage=STORED)
    return gpu.device.create_buffer_with_data(data=data, usage=wgpu.BufferUsage.STORAGE)


def _resource(gpu: Gpu, what: Bound, dispatch: Dispatch, buffers: list[Any]) -> Any:
    if isinstance(what.slot, BlockSlot):
        data = dispatch.blocks[what.number]
        usage = wgpu.BufferUsage.UNIFORM
        return {"buffer": gpu.device.create_buffer_with_data(data=data, usage=usage)}
    if isinstance(what.slot, BufferSlot):
        return {"buffer": buffers[what.number]}
    if what.is_sampler:
        return make_sampler(gpu, what.slot)
    return make_view(gpu, dispatch.textures[what.number])


def _read(gpu: Gpu, buffer: Any, size: int) -> bytes:
    return bytes(gpu.device.queue.read_buffer(buffer, 0, size)) if size else b""
