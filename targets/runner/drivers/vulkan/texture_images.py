"""Creates textures with their mip levels, and samplers."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any

import vulkan as vk

from .....compiler.ir.render_state import Compare
from .....compiler.ir.types import Border, Wrap
from ..checks import level_size
from ..slots import Filter, Mip, TextureSlot
from ..texels import TEXELS, Image
from .device import Gpu, recording
from .formats import TEXTURES, VIEWS
from .memory import ImageSpec, filled_buffer, make_image

READ = vk.VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
WRITTEN = vk.VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL

FILTERS: dict[Filter, int] = {"linear": vk.VK_FILTER_LINEAR, "nearest": vk.VK_FILTER_NEAREST}
MIPS: dict[Mip, int] = {
    "linear": vk.VK_SAMPLER_MIPMAP_MODE_LINEAR,
    "nearest": vk.VK_SAMPLER_MIPMAP_MODE_NEAREST,
    "none": vk.VK_SAMPLER_MIPMAP_MODE_NEAREST,
}
WRAPS: dict[Wrap, int] = {
    "repeat": vk.VK_SAMPLER_ADDRESS_MODE_REPEAT,
    "clamp": vk.VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
    "mirror": vk.VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
    "border": vk.VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER,
}
BORDERS: dict[Border, int] = {
    "transparent": vk.VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK,
    "black": vk.VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK,
    "white": vk.VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE,
}
COMPARES: dict[Compare, int] = {
    "never": vk.VK_COMPARE_OP_NEVER,
    "less": vk.VK_COMPARE_OP_LESS,
    "equal": vk.VK_COMPARE_OP_EQUAL,
    "less_equal": vk.VK_COMPARE_OP_LESS_OR_EQUAL,
    "greater": vk.VK_COMPARE_OP_GREATER,
    "not_equal": vk.VK_COMPARE_OP_NOT_EQUAL,
    "greater_equal": vk.VK_COMPARE_OP_GREATER_OR_EQUAL,
    "always": vk.VK_COMPARE_OP_ALWAYS,
}


def make_sampler(owned: ExitStack, gpu: Gpu, slot: TextureSlot) -> Any:
    """The sampler that a slot describes. Without mip levels it only reads the first level."""
    across, down, behind = (WRAPS[wrap] for wrap in slot.wraps)
    info = vk.VkSamplerCreateInfo(
        magFilter=FILTERS[slot.filter],
        minFilter=FILTERS[slot.filter],
        mipmapMode=MIPS[slot.mip],
        addressModeU=across,
        addressModeV=down,
        addressModeW=behind,
        borderColor=BORDERS[slot.border or "transparent"],
        compareEnable=slot.compare is not None,
        compareOp=COMPARES[slot.compare or "never"],
        maxLod=0.0 if slot.mip == "none" else vk.VK_LOD_CLAMP_NONE,
    )
    sampler = vk.vkCreateSampler(gpu.device, info, None)
    owned.callback(vk.vkDestroySampler, gpu.device, sampler, None)
    return sampler


def make_texture(owned: ExitStack, gpu: Gpu, image: Image) -> Any:
    """A view of a texture with its texels uploaded."""
    is_depth = TEXELS[image.format].sample == "depth"
    spec = ImageSpec(
        TEXTURES[image.format],
        image.width,
        image.height,
        vk.VK_IMAGE_USAGE_TRANSFER_DST_BIT | vk.VK_IMAGE_USAGE_SAMPLED_BIT,
        len(image.levels),
        vk.VK_IMAGE_ASPECT_DEPTH_BIT if is_depth else vk.VK_IMAGE_ASPECT_COLOR_BIT,
        image.depth,
        VIEWS[image.dimension],
    )
    handle, view = make_image(owned, gpu, spec)
    usage = vk.VK_BUFFER_USAGE_TRANSFER_SRC_BIT
    with ExitStack() as scratch, recording(gpu) as commands:
        staging = filled_buffer(scratch, gpu, usage, b"".join(map(_aligned, image.levels)))
        _to_be_written(commands, handle, spec)
        copies = _copies(image, spec)
        vk.vkCmdCopyBufferToImage(commands, staging.handle, handle, WRITTEN, len(copies), copies)
        _to_be_read(commands, handle, spec)
    return view


def _copies(image: Image, spec: ImageSpec) -> list[Any]:
    """A ``VkBufferImageCopy`` for each level with all its layers.

    The levels follow each other in the buffer, each at a multiple of four bytes, as Vulkan
    requires.
    """
    copies = []
    offset = 0
    for level, data in enumerate(image.levels):
        width, height, depth = level_size(image, level)
        part = vk.VkImageSubresourceLayers(
            aspectMask=spec.aspect, mipLevel=level, layerCount=spec.layers
        )
        copies.append(
            vk.VkBufferImageCopy(
                bufferOffset=offset,
                imageSubresource=part,
                imageExtent=vk.VkExtent3D(width, height, depth if spec.is_volume else 1),
            )
        )
        offset += len(_aligned(data))
    return copies


def _aligned(data: bytes) -> bytes:
    return data + bytes(-len(data) % 4)


def _to_be_written(commands: Any, image: Any, spec: ImageSpec) -> None:
    barrier = _barrier(image, spec, (vk.VK_IMAGE_LAYOUT_UNDEFINED, WRITTEN))
    barrier.dstAccessMask = vk.VK_ACCESS_TRANSFER_WRITE_BIT
    before, after = vk.VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, vk.VK_PIPELINE_STAGE_TRANSFER_BIT
    vk.vkCmdPipelineBarrier(commands, before, after, 0, 0, None, 0, None, 1, [barrier])


def _to_be_read(commands: Any, image: Any, spec: ImageSpec) -> None:
    barrier = _barrier(image, spec, (WRITTEN, READ))
    barrier.srcAccessMask = vk.VK_ACCESS_TRANSFER_WRITE_BIT
    barrier.dstAccessMask = vk.VK_ACCESS_SHADER_READ_BIT
    before, after = vk.VK_PIPELINE_STAGE_TRANSFER_BIT, vk.VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT
    vk.vkCmdPipelineBarrier(commands, before, after, 0, 0, None, 0, None, 1, [barrier])


def _barrier(image: Any, spec: ImageSpec, layouts: tuple[int, int]) -> Any:
    """A ``VkImageMemoryBarrier`` from one layout to another."""
    return vk.VkImageMemoryBarrier(
        oldLayout=layouts[0],
        newLayout=layouts[1],
        srcQueueFamilyIndex=vk.VK_QUEUE_FAMILY_IGNORED,
        dstQueueFamilyIndex=vk.VK_QUEUE_FAMILY_IGNORED,
        image=image,
        subresourceRange=spec.subresources(),
    )
