"""Runs a kernel: its pipeline, and a dispatch for each set of values."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any

import vulkan as vk

from ..checks import check_kernel
from ..kernel_job import Dispatch, KernelJob, Sides, Written
from ..pipeline import Pipeline
from .descriptor_sets import DescriptorSets, make_descriptor_sets
from .device import Gpu, recording
from .graphics_pipeline import make_layout, make_stage
from .limits import check_dispatches
from .memory import filled_buffer
from .texture_images import make_texture
from .written_images import make_images

COMPUTE = vk.VK_PIPELINE_BIND_POINT_COMPUTE
STORAGE = vk.VK_BUFFER_USAGE_STORAGE_BUFFER_BIT


def compute_job(gpu: Gpu, job: KernelJob) -> list[Written]:
    """What each dispatch writes. Raises ``DriverError``, and ``VkError`` for calls that fail."""
    check_kernel(job)
    check_dispatches(gpu, job)
    with ExitStack() as owned:
        bindings = make_descriptor_sets(owned, gpu, job.pipeline)
        layout = make_layout(owned, gpu, bindings.layouts)
        pipeline = make_compute_pipeline(owned, gpu, job.pipeline, layout)
        return [_run(gpu, job, bindings, layout, pipeline, d) for d in job.dispatches]


def make_compute_pipeline(owned: ExitStack, gpu: Gpu, description: Pipeline, layout: Any) -> Any:
    """The pipeline of a kernel."""
    with ExitStack() as modules:
        (code,) = description.stages.values()
        stage = make_stage(modules, gpu, vk.VK_SHADER_STAGE_COMPUTE_BIT, code)
        gpu.messages.check()
        infos = [vk.VkComputePipelineCreateInfo(stage=stage, layout=layout)]
        handle = vk.vkCreateComputePipelines(gpu.device, None, 1, infos, None)[0]
    owned.callback(vk.vkDestroyPipeline, gpu.device, handle, None)
    return handle


def _run(
    gpu: Gpu,
    job: KernelJob,
    bindings: DescriptorSets,
    layout: Any,
    pipeline: Any,
    dispatch: Dispatch,
) -> Written:
    with ExitStack() as owned:
        buffers = [filled_buffer(owned, gpu, STORAGE, data) for data in dispatch.buffers]
        bindings.bind_blocks(dispatch.blocks)
        bindings.bind_buffers(gpu, buffers)
        bindings.bind_textures(
            gpu, [make_texture(owned, gpu, image) for image in dispatch.textures]
        )
        images = make_images(owned, gpu, job.pipeline.images, dispatch.extent)
        bindings.bind_images(gpu, images.views)
        with recording(gpu) as commands:
            images.make_writable(commands)
            _record(commands, bindings, layout, pipeline, job.groups(dispatch))
            images.read_back(commands)
        pairs = zip(job.pipeline.buffers, buffers, strict=True)
        held = tuple(bytes(b.mapped[0 : b.size]) for slot, b in pairs if slot.written)
        return Written(held, images.texels())


def _record(
    commands: Any, bindings: DescriptorSets, layout: Any, pipeline: Any, groups: Sides
) -> None:
    vk.vkCmdBindPipeline(commands, COMPUTE, pipeline)
    if sets := bindings.sets:
        vk.vkCmdBindDescriptorSets(commands, COMPUTE, layout, 0, len(sets), sets, 0, None)
    vk.vkCmdDispatch(commands, *groups)
    barrier = vk.VkMemoryBarrier(
        srcAccessMask=vk.VK_ACCESS_SHADER_WRITE_BIT, dstAccessMask=vk.VK_ACCESS_HOST_READ_BIT
    )
    vk.vkCmdPipelineBarrier(
        commands,
        vk.VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
        vk.VK_PIPELINE_STAGE_HOST_BIT,
        0, 1, [barrier], 0, None, 0, None,
    )  # fmt: skip
