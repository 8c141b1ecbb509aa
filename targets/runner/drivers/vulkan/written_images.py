"""Creates the images that a kernel writes, and brings their texels back to the host."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any

import vulkan as vk

from ..kernel_job import Sides
from ..readback import TEXEL_LANES, to_float
from ..slots import ImageSlot
from .device import Gpu
from .formats import TARGETS
from .memory import Buffer, ImageSpec, make_buffer, make_image

WRITABLE = vk.VK_IMAGE_LAYOUT_GENERAL
"""The layout in which kernels write images."""
CLEARED = vk.VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL
READABLE = vk.VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL
"""The ones in which they are made black, and from which they are copied."""

SHADER = vk.VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT
COPY = vk.VK_PIPELINE_STAGE_TRANSFER_BIT
START = vk.VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT
CLEARING = vk.VK_ACCESS_TRANSFER_WRITE_BIT
WRITING = vk.VK_ACCESS_SHADER_WRITE_BIT


@dataclass(frozen=True, slots=True)
class WrittenImages:
    """The images of one dispatch, each with a buffer to read it back."""

    slots: Sequence[ImageSlot]
    size: Sides
    images: Sequence[Any]
    views: Sequence[Any]
    buffers: Sequence[Buffer]

    def make_writable(self, commands: Any) -> None:
        """Record commands that get the images ready to be written; until then they are black."""
        undefined = vk.VK_IMAGE_LAYOUT_UNDEFINED
        self._change(commands, (undefined, CLEARED), (START, COPY), (0, CLEARING))
        black = vk.VkClearColorValue(float32=[0.0, 0.0, 0.0, 0.0])
        for image in self.images:
            vk.vkCmdClearColorImage(commands, image, CLEARED, black, 1, [_whole()])
        self._change(commands, (CLEARED, WRITABLE), (COPY, SHADER), (CLEARING, WRITING))

    def read_back(self, commands: Any) -> None:
        """Record commands that copy the images to where ``texels`` reads them."""
        reading = vk.VK_ACCESS_TRANSFER_READ_BIT
        self._change(commands, (WRITABLE, READABLE), (SHADER, COPY), (WRITING, reading))
        part = vk.VkImageSubresourceLayers(aspectMask=vk.VK_IMAGE_ASPECT_COLOR_BIT, layerCount=1)
        copy = vk.VkBufferImageCopy(imageSubresource=part, imageExtent=vk.VkExtent3D(*self.size))
        for image, buffer in zip(self.images, self.buffers, strict=True):
            vk.vkCmdCopyImageToBuffer(commands, image, READABLE, buffer.handle, 1, [copy])
        barrier = vk.VkMemoryBarrier(
            srcAccessMask=vk.VK_ACCESS_TRANSFER_WRITE_BIT, dstAccessMask=vk.VK_ACCESS_HOST_READ_BIT
        )
        host = vk.VK_PIPELINE_STAGE_HOST_BIT
        vk.vkCmdPipelineBarrier(commands, COPY, host, 0, 1, [barrier], 0, None, 0, None)

    def texels(self) -> tuple[bytes, ...]:
        """The texels that were copied last."""
        width, height, _ = self.size
        return tuple(
            to_float(buffer.mapped[:], slot.format, width, height, "top")
            for slot, buffer in zip(self.slots, self.buffers, strict=True)
        )

    def _change(
        self,
        commands: Any,
        layouts: tuple[int, int],
        stages: tuple[int, int],
        accesses: tuple[int, int],
    ) -> None:
        """Record that the layout of all images changes, behind some work and before other work."""
        barriers = [
            vk.VkImageMemoryBarrier(
                oldLayout=layouts[0],
                newLayout=layouts[1],
                srcAccessMask=accesses[0],
                dstAccessMask=accesses[1],
                srcQueueFamilyIndex=vk.VK_QUEUE_FAMILY_IGNORED,
                dstQueueFamilyIndex=vk.VK_QUEUE_FAMILY_IGNORED,
                image=image,
                subresourceRange=_whole(),
            )
            for image in self.images
        ]
        vk.vkCmdPipelineBarrier(commands, *stages, 0, 0, None, 0, None, len(barriers), barriers)


def _whole() -> Any:
    return vk.VkImageSubresourceRange(
        aspectMask=vk.VK_IMAGE_ASPECT_COLOR_BIT, levelCount=1, layerCount=1
    )


def make_images(
    owned: ExitStack, gpu: Gpu, slots: Sequence[ImageSlot], size: Sides
) -> WrittenImages:
    """Images of one size for a kernel to write."""
    width, height, _ = size
    copied = vk.VK_IMAGE_USAGE_TRANSFER_SRC_BIT | vk.VK_IMAGE_USAGE_TRANSFER_DST_BIT
    usage = vk.VK_IMAGE_USAGE_STORAGE_BIT | copied
    made = [
        make_image(owned, gpu, ImageSpec(TARGETS[slot.format], width, height, usage))
        for slot in slots
    ]
    back = vk.VK_BUFFER_USAGE_TRANSFER_DST_BIT
    buffers = [make_buffer(owned, gpu, back, width * height * _size(slot)) for slot in slots]
    images, views = [image for image, _ in made], [view for _, view in made]
    return WrittenImages(slots, size, images, views, buffers)


def _size(slot: ImageSlot) -> int:
    lanes, kind = TEXEL_LANES[slot.format]
    return lanes * int(kind.itemsize)
