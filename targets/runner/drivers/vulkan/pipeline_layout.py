"""Creates pipeline layouts, and sets the push constants of draws."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from typing import Any

import vulkan as vk

from ..pipeline import Pipeline
from .descriptor_sets import STAGES, DescriptorSets
from .device import Gpu


def make_layout(owned: ExitStack, gpu: Gpu, bound: DescriptorSets) -> Any:
    """A pipeline layout from the layouts of descriptor sets, and the range of push constants."""
    ranges = [
        vk.VkPushConstantRange(stageFlags=STAGES, offset=0, size=bound.slots.blocks[number].size)
        for number in _pushed(bound.slots)
    ]
    info = vk.VkPipelineLayoutCreateInfo(pSetLayouts=bound.layouts, pPushConstantRanges=ranges)
    layout = vk.vkCreatePipelineLayout(gpu.device, info, None)
    owned.callback(vk.vkDestroyPipelineLayout, gpu.device, layout, None)
    return layout


def push(commands: Any, layout: Any, pipeline: Pipeline, contents: Sequence[bytes]) -> None:
    """Set the push constants of the next draw or dispatch, if the pipeline has any.

    ``contents`` are the bytes of all blocks.
    """
    for number in _pushed(pipeline):
        data = contents[number]
        vk.vkCmdPushConstants(commands, layout, STAGES, 0, len(data), vk.ffi.from_buffer(data))


def _pushed(pipeline: Pipeline) -> list[int]:
    """The number of the block that is push constants; there is one at most."""
    return [n for n, block in enumerate(pipeline.blocks) if block.pushed]
