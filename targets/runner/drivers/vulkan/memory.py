"""Creates buffers and images with their memory; an ``ExitStack`` destroys them."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any

import vulkan as vk

from ..device import DriverError
from .device import Gpu

MAPPED = vk.VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | vk.VK_MEMORY_PROPERTY_HOST_COHERENT_BIT


@dataclass(frozen=True, slots=True)
class Buffer:
    """A buffer whose bytes the host can access."""

    handle: Any
    size: int
    mapped: Any
    """The buffer's bytes, mapped and writable."""

    def write(self, data: bytes) -> None:
        """Replace the first bytes. Nothing may be drawing with the buffer."""
        self.mapped[0 : len(data)] = data


def make_buffer(owned: ExitStack, gpu: Gpu, usage: int, size: int) -> Buffer:
    """A buffer of ``size`` bytes; ``usage`` is a ``VK_BUFFER_USAGE`` bit."""
    info = vk.VkBufferCreateInfo(size=size, usage=usage, sharingMode=vk.VK_SHARING_MODE_EXCLUSIVE)
    handle = vk.vkCreateBuffer(gpu.device, info, None)
    owned.callback(vk.vkDestroyBuffer, gpu.device, handle, None)
    needs = vk.vkGetBufferMemoryRequirements(gpu.device, handle)
    memory = _allocate(owned, gpu, needs, MAPPED)
    vk.vkBindBufferMemory(gpu.device, handle, memory, 0)
    return Buffer(handle, size, vk.vkMapMemory(gpu.device, memory, 0, size, 0))


def filled_buffer(owned: ExitStack, gpu: Gpu, usage: int, data: bytes) -> Buffer:
    """A buffer that contains exactly these bytes."""
    buffer = make_buffer(owned, gpu, usage, len(data))
    buffer.write(data)
    return buffer


@dataclass(frozen=True, slots=True)
class ImageSpec:
    """An image to create, together with a view of all of it."""

    format: int
    """A Vulkan format."""
    width: int
    height: int
    usage: int
    """``VK_IMAGE_USAGE`` bits."""
    levels: int = 1
    aspect: int = vk.VK_IMAGE_ASPECT_COLOR_BIT
    depth: int = 1
    """The number of slices of a 3D texture, of layers, or of faces of a cube."""
    view: int = vk.VK_IMAGE_VIEW_TYPE_2D
    samples: int = vk.VK_SAMPLE_COUNT_1_BIT
    """A ``VK_SAMPLE_COUNT`` bit, which is the number itself."""
    read_aspect: int = 0
    """The aspect that the view shows, if not all: shaders read depths without stencil values."""

    @property
    def is_volume(self) -> bool:
        """True for a 3D texture, which has a single layer."""
        return bool(self.view == vk.VK_IMAGE_VIEW_TYPE_3D)

    @property
    def layers(self) -> int:
        """The number of layers in Vulkan's sense: a cube has six."""
        return 1 if self.is_volume else self.depth

    def subresources(self, aspect: int = 0) -> Any:
        """A ``VkImageSubresourceRange`` of all levels and layers."""
        return vk.VkImageSubresourceRange(
            aspectMask=aspect or self.aspect, levelCount=self.levels, layerCount=self.layers
        )


def make_image(owned: ExitStack, gpu: Gpu, spec: ImageSpec) -> tuple[Any, Any]:
    """The image, in memory of its own, and a view of all of it."""
    image = image_without_memory(owned, gpu, spec)
    give_memory(owned, gpu, [image])
    return image, make_view(owned, gpu, spec, image)


def image_without_memory(owned: ExitStack, gpu: Gpu, spec: ImageSpec) -> Any:
    """An image without memory: ``give_memory`` has to be called before the image is used."""
    is_cube = spec.view in (vk.VK_IMAGE_VIEW_TYPE_CUBE, vk.VK_IMAGE_VIEW_TYPE_CUBE_ARRAY)
    info = vk.VkImageCreateInfo(
        flags=vk.VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT if is_cube else 0,
        imageType=vk.VK_IMAGE_TYPE_3D if spec.is_volume else vk.VK_IMAGE_TYPE_2D,
        format=spec.format,
        extent=vk.VkExtent3D(spec.width, spec.height, spec.depth if spec.is_volume else 1),
        mipLevels=spec.levels,
        arrayLayers=spec.layers,
        samples=spec.samples,
        tiling=vk.VK_IMAGE_TILING_OPTIMAL,
        usage=spec.usage,
        sharingMode=vk.VK_SHARING_MODE_EXCLUSIVE,
        initialLayout=vk.VK_IMAGE_LAYOUT_UNDEFINED,
    )
    image = vk.vkCreateImage(gpu.device, info, None)
    owned.callback(vk.vkDestroyImage, gpu.device, image, None)
    return image


def give_memory(owned: ExitStack, gpu: Gpu, images: Sequence[Any]) -> None:
    """Give images the same memory.

    Images that a device keeps in different kinds of memory share it with their own kind only.
    """
    kinds: dict[int, list[tuple[Any, Any]]] = {}
    for image in images:
        needs = vk.vkGetImageMemoryRequirements(gpu.device, image)
        kinds.setdefault(needs.memoryTypeBits, []).append((image, needs))
    for alike in kinds.values():
        largest = max((needs for _, needs in alike), key=lambda needs: needs.size)
        memory = _allocate(owned, gpu, largest, vk.VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)
        for image, _ in alike:
            vk.vkBindImageMemory(gpu.device, image, memory, 0)


def make_view(owned: ExitStack, gpu: Gpu, spec: ImageSpec, image: Any) -> Any:
    """A view of all of an image."""
    view_info = vk.VkImageViewCreateInfo(
        image=image,
        viewType=spec.view,
        format=spec.format,
        subresourceRange=spec.subresources(spec.read_aspect),
    )
    view = vk.vkCreateImageView(gpu.device, view_info, None)
    owned.callback(vk.vkDestroyImageView, gpu.device, view, None)
    return view


def _allocate(owned: ExitStack, gpu: Gpu, needs: Any, properties: int) -> Any:
    info = vk.VkMemoryAllocateInfo(
        allocationSize=needs.size, memoryTypeIndex=_memory_type(gpu, needs, properties)
    )
    memory = vk.vkAllocateMemory(gpu.device, info, None)
    owned.callback(vk.vkFreeMemory, gpu.device, memory, None)
    return memory


def _memory_type(gpu: Gpu, needs: Any, properties: int) -> int:
    for index in range(gpu.memory.memoryTypeCount):
        allowed = needs.memoryTypeBits >> index & 1
        if allowed and gpu.memory.memoryTypes[index].propertyFlags & properties == properties:
            return index
    raise DriverError("the device has no memory of the kind that is needed")
