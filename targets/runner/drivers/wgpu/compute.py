"""Runs the dispatches of a kernel, and reads back what they have written."""

from __future__ import annotations

from typing import Any

import wgpu

from ..checks import check_groups
from ..kernel_job import Dispatch, KernelJob, Sides, Written
from ..slots import ImageSlot
from ..webgpu import COMPUTED, Groups, bound, layout_entries
from .bindings import bind_groups, make_storage
from .device import Gpu, explained
from .drawing import read_texels

MOST_GROUPS = "max-compute-workgroups-per-dimension"


def compute_job(gpu: Gpu, job: KernelJob) -> list[Written]:
    """What each dispatch writes. Raises ``DriverError``."""
    with explained():
        check_groups(job, [int(gpu.device.limits[MOST_GROUPS])] * 3)
        groups = bound(job.pipeline)
        layouts = [
            gpu.device.create_bind_group_layout(entries=layout_entries(group, COMPUTED))
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
        return [_run(gpu, job, pipeline, layouts, groups, d) for d in job.dispatches]


def _run(
    gpu: Gpu, job: KernelJob, pipeline: Any, layouts: list[Any], groups: Groups, dispatch: Dispatch
) -> Written:
    storage = make_storage(gpu, job.pipeline.buffers, dispatch.buffers)
    images = [_image(gpu, slot, dispatch.extent) for slot in job.pipeline.images]
    encoder = gpu.device.create_command_encoder()
    run = encoder.begin_compute_pass()
    run.set_pipeline(pipeline)
    for number, group in enumerate(bind_groups(gpu, layouts, groups, dispatch, storage, images)):
        run.set_bind_group(number, group)
    run.dispatch_workgroups(*job.groups(dispatch))
    run.end()
    gpu.device.queue.submit([encoder.finish()])
    pairs = zip(job.pipeline.buffers, storage, strict=True)
    held = tuple(bytes(gpu.device.queue.read_buffer(each)) for slot, each in pairs if slot.written)
    width, height, _ = dispatch.extent
    texels = (
        read_texels(gpu, image, slot.format, (width, height), "top")
        for slot, image in zip(job.pipeline.images, images, strict=True)
    )
    return Written(held, tuple(texels))


def _image(gpu: Gpu, slot: ImageSlot, size: Sides) -> Any:
    usage = wgpu.TextureUsage.STORAGE_BINDING | wgpu.TextureUsage.COPY_SRC
    return gpu.device.create_texture(format=slot.format, size=size, usage=usage)
