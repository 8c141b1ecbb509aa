"""The textures of a frame: their images, a view for each use, and their barriers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

import vulkan as vk

from .....compiler.documents.plan import BufferState, TextureState
from ..frame_job import Barrier, FrameJob, FrameTexture
from .device import Gpu
from .formats import ASPECTS, DEPTHS, TARGETS, VIEWS
from .memory import ImageSpec, give_memory, image_without_memory, make_view

DRAWING = vk.VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT
TESTING = (
    vk.VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | vk.VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT
)
SHADERS = vk.VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT | vk.VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT
COPYING = vk.VK_PIPELINE_STAGE_TRANSFER_BIT

COLOURS = vk.VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | vk.VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT
TESTS = (
    vk.VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | vk.VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT
)


@dataclass(frozen=True, slots=True)
class BufferAccess:
    """The pipeline stages and memory accesses of one use of a buffer, for barriers."""

    stages: int
    access: int


@dataclass(frozen=True, slots=True)
class Use:
    """The layout, stages and accesses of one use of a texture, for barriers."""

    layout: int
    stages: int
    access: int


USES: Mapping[TextureState, Use] = {
    "undefined": Use(vk.VK_IMAGE_LAYOUT_UNDEFINED, vk.VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0),
    "target": Use(vk.VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, DRAWING, COLOURS),
    "depth": Use(vk.VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, TESTING, TESTS),
    "image": Use(
        vk.VK_IMAGE_LAYOUT_GENERAL, vk.VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
        vk.VK_ACCESS_SHADER_WRITE_BIT,
    ),
    "sampled": Use(
        vk.VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, SHADERS, vk.VK_ACCESS_SHADER_READ_BIT
    ),
    "copied_from": Use(
        vk.VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, COPYING, vk.VK_ACCESS_TRANSFER_READ_BIT
    ),
    "copied_to": Use(
        vk.VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, COPYING, vk.VK_ACCESS_TRANSFER_WRITE_BIT
    ),
}  # fmt: skip

BUFFER_USES: Mapping[BufferState, BufferAccess] = {
    "undefined": BufferAccess(SHADERS, 0),
    # Atomic operations also read the element.
    "written": BufferAccess(
        vk.VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
        vk.VK_ACCESS_SHADER_READ_BIT | vk.VK_ACCESS_SHADER_WRITE_BIT,
    ),
    "read": BufferAccess(SHADERS, vk.VK_ACCESS_SHADER_READ_BIT),
}

_COPIES = vk.VK_IMAGE_USAGE_TRANSFER_SRC_BIT | vk.VK_IMAGE_USAGE_TRANSFER_DST_BIT
_READS = vk.VK_IMAGE_USAGE_SAMPLED_BIT | _COPIES


@dataclass(slots=True)
class MadeTexture:
    """A texture on the device."""

    gpu: Gpu
    owned: ExitStack
    description: FrameTexture
    spec: ImageSpec
    image: Any
    view: Any
    """The view of the whole texture, by which shaders read."""
    parts: dict[tuple[int, int, int], Any] = field(default_factory=dict)
    """Views of some layers of a level, to which steps draw."""

    def part(self, layer: int, level: int, layers: int = 1) -> Any:
        """The view of the layers of a level to which a step draws."""
        key = layer, layers, level
        if key not in self.parts:
            self.parts[key] = self._part(*key)
        return self.parts[key]

    def _part(self, layer: int, layers: int, level: int) -> Any:
        whole = vk.VkImageSubresourceRange(
            aspectMask=self.spec.aspect, baseMipLevel=level, levelCount=1, baseArrayLayer=layer,
            layerCount=layers,
        )  # fmt: skip
        info = vk.VkImageViewCreateInfo(
            image=self.image,
            viewType=VIEWS["2d" if layers == 1 else "2d_array"],
            format=self.spec.format,
            subresourceRange=whole,
        )
        view = vk.vkCreateImageView(self.gpu.device, info, None)
        self.owned.callback(vk.vkDestroyImageView, self.gpu.device, view, None)
        return view

    def barrier(self, before: TextureState, after: TextureState) -> Any:
        """The image barrier between two uses."""
        return vk.VkImageMemoryBarrier(
            oldLayout=USES[before].layout,
            newLayout=USES[after].layout,
            srcAccessMask=self._writes if before == "undefined" else USES[before].access,
            dstAccessMask=USES[after].access,
            srcQueueFamilyIndex=vk.VK_QUEUE_FAMILY_IGNORED,
            dstQueueFamilyIndex=vk.VK_QUEUE_FAMILY_IGNORED,
            image=self.image,
            subresourceRange=self.spec.subresources(),
        )

    @property
    def _writes(self) -> int:
        """Accesses to wait for before the first use: writes of textures that share the memory."""
        is_shared = self.description.memory is not None
        return vk.VK_ACCESS_MEMORY_WRITE_BIT if is_shared else 0

    def clear(self, commands: Any) -> None:
        """Clear the texture to transparent black, or to the far plane, ready to be read."""
        record(commands, [self], [Barrier(0, "undefined", "copied_to")])
        layout, ranges = USES["copied_to"].layout, [self.spec.subresources()]
        if self.description.is_depth:
            far = vk.VkClearDepthStencilValue(depth=1.0)
            vk.vkCmdClearDepthStencilImage(commands, self.image, layout, far, 1, ranges)
        else:
            black = vk.VkClearColorValue(float32=[0.0, 0.0, 0.0, 0.0])
            vk.vkCmdClearColorImage(commands, self.image, layout, black, 1, ranges)
        record(commands, [self], [Barrier(0, "copied_to", "sampled")])


def make_frame_textures(
    owned: ExitStack, gpu: Gpu, job: FrameJob, drawn: Set[int], written: Set[int]
) -> list[MadeTexture]:
    """The textures of a frame, some of which passes have ``drawn`` or kernels have ``written``."""
    specs = [
        _spec(texture, drawn=number in drawn, written=number in written)
        for number, texture in enumerate(job.textures)
    ]
    images = [image_without_memory(owned, gpu, spec) for spec in specs]
    places: dict[object, list[Any]] = {}
    for number, texture in enumerate(job.textures):
        alone = ("alone", number)
        place = alone if texture.memory is None else ("shared", texture.memory)
        places.setdefault(place, []).append(images[number])
    for sharing in places.values():
        give_memory(owned, gpu, sharing)
    return [
        MadeTexture(gpu, owned, texture, spec, image, make_view(owned, gpu, spec, image))
        for texture, spec, image in zip(job.textures, specs, images, strict=True)
    ]


def _spec(wanted: FrameTexture, *, drawn: bool, written: bool) -> ImageSpec:
    attached = (
        vk.VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
        if wanted.is_depth
        else vk.VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
    )
    reads = _READS if wanted.samples == 1 else vk.VK_IMAGE_USAGE_TRANSFER_SRC_BIT
    usage = reads | (attached if drawn else 0)
    usage |= vk.VK_IMAGE_USAGE_STORAGE_BIT if written else 0
    colour, depth = vk.VK_IMAGE_ASPECT_COLOR_BIT, vk.VK_IMAGE_ASPECT_DEPTH_BIT
    match wanted.format:
        case "depth32float" | "depth32float-stencil8" as depths:
            format_, aspect, read = DEPTHS[depths], ASPECTS[depths], depth
        case colours:
            format_, aspect, read = TARGETS[colours], colour, colour
    return ImageSpec(
        format_, wanted.width, wanted.height, usage, wanted.levels, aspect, wanted.layers,
        VIEWS[wanted.dimension], wanted.samples, read,
    )  # fmt: skip


def record(commands: Any, textures: Sequence[MadeTexture], barriers: Sequence[Barrier]) -> None:
    """Record barriers, all of them at once."""
    if not barriers:
        return
    before = after = 0
    for barrier in barriers:
        before |= USES[barrier.before].stages
        after |= USES[barrier.after].stages
    found = [textures[each.texture].barrier(each.before, each.after) for each in barriers]
    vk.vkCmdPipelineBarrier(commands, before, after, 0, 0, None, 0, None, len(found), found)
