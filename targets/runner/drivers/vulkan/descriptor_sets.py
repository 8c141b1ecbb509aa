"""Creates the descriptor sets, through which blocks, buffers, textures and samplers are bound."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any

import vulkan as vk

from ..pipeline import Pipeline
from ..slots import Place, TextureSlot
from .device import Gpu
from .memory import Buffer, make_buffer
from .texture_images import READ, make_sampler

STAGES = vk.VK_SHADER_STAGE_ALL
BLOCK = vk.VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
STORAGE = vk.VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
IMAGE = vk.VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
TEXTURE = vk.VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE
SAMPLER = vk.VK_DESCRIPTOR_TYPE_SAMPLER
COMBINED = vk.VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER

FATAL_BLOCK = 4
"""Mesa's lavapipe 22.3 may crash if a branch depends on the block with this number, counted from 1
through all sets (docs/drivers.md). So set 0 is filled up with unused ones, and no block has this
number unless set 0 has four of its own."""


@dataclass(frozen=True, slots=True)
class DescriptorSets:
    """The descriptor sets of a pipeline, whose contents change from draw to draw."""

    slots: Pipeline
    layouts: Sequence[Any]
    """The layouts of the sets, counted from 0 without gaps."""
    sets: Sequence[Any]
    blocks: Sequence[Buffer]
    samplers: Sequence[Any]

    def bind_blocks(self, contents: Sequence[bytes]) -> None:
        """Replace the bytes of all blocks."""
        for buffer, data in zip(self.blocks, contents, strict=True):
            buffer.write(data)

    def bind_textures(self, gpu: Gpu, views: Sequence[Any]) -> None:
        """Make the textures' descriptors refer to these views."""
        for slot, sampler, view in zip(self.slots.textures, self.samplers, views, strict=True):
            info = vk.VkDescriptorImageInfo(sampler=sampler, imageView=view, imageLayout=READ)
            self._write(gpu, slot.texture, _texture_type(slot), pImageInfo=[info])

    def bind_buffers(self, gpu: Gpu, buffers: Sequence[Buffer]) -> None:
        """Make the storage buffers' descriptors refer to these."""
        for slot, buffer in zip(self.slots.buffers, buffers, strict=True):
            part = vk.VkDescriptorBufferInfo(buffer=buffer.handle, range=buffer.size)
            self._write(gpu, slot.place, STORAGE, pBufferInfo=[part])

    def bind_images(self, gpu: Gpu, views: Sequence[Any]) -> None:
        """Make the descriptors of the images that a kernel writes refer to these views."""
        for slot, view in zip(self.slots.images, views, strict=True):
            info = vk.VkDescriptorImageInfo(imageView=view, imageLayout=vk.VK_IMAGE_LAYOUT_GENERAL)
            self._write(gpu, slot.place, IMAGE, pImageInfo=[info])

    def fill(self, gpu: Gpu) -> None:
        """Make the descriptors that never change refer to the blocks' buffers and the samplers."""
        for block, buffer in zip(self.slots.blocks, self.blocks, strict=True):
            if block.pushed:
                continue
            part = vk.VkDescriptorBufferInfo(buffer=buffer.handle, range=buffer.size)
            self._write(gpu, block.place, BLOCK, pBufferInfo=[part])
        for slot, sampler in zip(self.slots.textures, self.samplers, strict=True):
            if slot.sampler is not None:
                info = vk.VkDescriptorImageInfo(sampler=sampler)
                self._write(gpu, slot.sampler, SAMPLER, pImageInfo=[info])

    def _write(self, gpu: Gpu, place: Place, kind: int, **what: Any) -> None:
        assert place.group is not None
        write = vk.VkWriteDescriptorSet(
            dstSet=self.sets[place.group],
            dstBinding=place.binding,
            descriptorCount=1,
            descriptorType=kind,
            **what,
        )
        vk.vkUpdateDescriptorSets(gpu.device, 1, [write], 0, None)


def make_descriptor_sets(owned: ExitStack, gpu: Gpu, pipeline: Pipeline) -> DescriptorSets:
    """Descriptor sets with a buffer for each block and a sampler for each texture."""
    kinds = list(_descriptors(pipeline))
    layouts = _layouts(owned, gpu, kinds)
    block = vk.VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT
    bindings = DescriptorSets(
        pipeline,
        layouts,
        _sets(owned, gpu, layouts, [kind for _, kind in kinds]),
        [make_buffer(owned, gpu, block, slot.size) for slot in pipeline.blocks],
        [make_sampler(owned, gpu, slot) for slot in pipeline.textures],
    )
    bindings.fill(gpu)
    return bindings


def _descriptors(pipeline: Pipeline) -> Iterator[tuple[Place, int]]:
    """All descriptors with their types."""
    used = list(_used_descriptors(pipeline))
    yield from used
    if len(pipeline.blocks) >= FATAL_BLOCK:
        first = [(place.binding or 0, kind) for place, kind in used if place.group == 0]
        free = max((binding for binding, _ in first), default=-1) + 1
        missing = FATAL_BLOCK - sum(kind == BLOCK for _, kind in first)
        for number in range(missing):
            yield Place("", group=0, binding=free + number), BLOCK


def _used_descriptors(pipeline: Pipeline) -> Iterator[tuple[Place, int]]:
    for block in pipeline.blocks:
        if not block.pushed:
            yield block.place, BLOCK
    for buffer in pipeline.buffers:
        yield buffer.place, STORAGE
    for image in pipeline.images:
        yield image.place, IMAGE
    for slot in pipeline.textures:
        yield slot.texture, _texture_type(slot)
    yield from ((place, SAMPLER) for place in sampler_places(pipeline))


def sampler_places(pipeline: Pipeline) -> list[Place]:
    """The places of all samplers; several textures may share one."""
    places = (slot.sampler for slot in pipeline.textures if slot.sampler is not None)
    return list(dict.fromkeys(places))


def _texture_type(slot: TextureSlot) -> int:
    is_combined = slot.combined or (slot.sampler is None and slot.sampling is not None)
    return int(COMBINED if is_combined else TEXTURE)


def _layouts(owned: ExitStack, gpu: Gpu, kinds: Sequence[tuple[Place, int]]) -> list[Any]:
    by_set: defaultdict[int, list[Any]] = defaultdict(list)
    for place, kind in kinds:
        assert place.group is not None
        by_set[place.group].append(
            vk.VkDescriptorSetLayoutBinding(
                binding=place.binding, descriptorType=kind, descriptorCount=1, stageFlags=STAGES
            )
        )
    count = max(by_set, default=-1) + 1
    layouts = []
    for number in range(count):
        info = vk.VkDescriptorSetLayoutCreateInfo(pBindings=by_set[number])
        layouts.append(vk.vkCreateDescriptorSetLayout(gpu.device, info, None))
        owned.callback(vk.vkDestroyDescriptorSetLayout, gpu.device, layouts[-1], None)
    return layouts


def _sets(owned: ExitStack, gpu: Gpu, layouts: Sequence[Any], kinds: Sequence[int]) -> list[Any]:
    if not layouts:
        return []
    sizes = [
        vk.VkDescriptorPoolSize(type=kind, descriptorCount=kinds.count(kind)) for kind in set(kinds)
    ]
    pool_info = vk.VkDescriptorPoolCreateInfo(maxSets=len(layouts), pPoolSizes=sizes)
    pool = vk.vkCreateDescriptorPool(gpu.device, pool_info, None)
    owned.callback(vk.vkDestroyDescriptorPool, gpu.device, pool, None)
    info = vk.VkDescriptorSetAllocateInfo(descriptorPool=pool, pSetLayouts=layouts)
    return list(vk.vkAllocateDescriptorSets(gpu.device, info))
