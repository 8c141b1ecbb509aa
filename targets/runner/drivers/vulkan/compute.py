"""Creates the pipeline of a kernel."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any

import vulkan as vk

from ..pipeline import Pipeline
from .device import Gpu
from .graphics_pipeline import make_stage

COMPUTE = vk.VK_PIPELINE_BIND_POINT_COMPUTE


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
