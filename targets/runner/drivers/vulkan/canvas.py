"""Creates render targets of one size, and buffers that bring their pictures back to the host."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from typing import Any

import vulkan as vk

from ..draw_job import Picture
from ..pipeline import Pipeline
from ..readback import TEXEL_LANES, to_float
from ..render_state import RenderTarget
from .device import Gpu
from .formats import ASPECTS, DEPTHS, TARGETS
from .memory import Buffer, ImageSpec, make_buffer, make_image

DRAWING = vk.VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL
DRAWN = vk.VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL
"""The layouts of the targets in the render pass and after it."""
_WRITTEN_ALL = vk.VK_ATTACHMENT_LOAD_OP_DONT_CARE
_STORE, _DROP = vk.VK_ATTACHMENT_STORE_OP_STORE, vk.VK_ATTACHMENT_STORE_OP_DONT_CARE

DRAWN_USAGE = vk.VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
TARGET_USAGE = DRAWN_USAGE | vk.VK_IMAGE_USAGE_TRANSFER_SRC_BIT


@dataclass(frozen=True, slots=True)
class Canvas:
    """Targets, a depth buffer, and a buffer for each target to read it back."""

    width: int
    height: int
    layers: int
    targets: Sequence[RenderTarget]
    framebuffer: Any
    images: Sequence[Any]
    buffers: Sequence[Buffer]

    def read_back(self, commands: Any) -> None:
        """Record commands that copy the targets to where ``picture`` reads them."""
        part = vk.VkImageSubresourceLayers(
            aspectMask=vk.VK_IMAGE_ASPECT_COLOR_BIT, layerCount=self.layers
        )
        copy = vk.VkBufferImageCopy(
            imageSubresource=part, imageExtent=vk.VkExtent3D(self.width, self.height, 1)
        )
        for image, buffer in zip(self.images, self.buffers, strict=True):
            vk.vkCmdCopyImageToBuffer(commands, image, DRAWN, buffer.handle, 1, [copy])
        barrier = vk.VkMemoryBarrier(
            srcAccessMask=vk.VK_ACCESS_TRANSFER_WRITE_BIT, dstAccessMask=vk.VK_ACCESS_HOST_READ_BIT
        )
        before, after = vk.VK_PIPELINE_STAGE_TRANSFER_BIT, vk.VK_PIPELINE_STAGE_HOST_BIT
        vk.vkCmdPipelineBarrier(commands, before, after, 0, 1, [barrier], 0, None, 0, None)

    def picture(self) -> Picture:
        """The picture that was copied last."""
        rows = self.height * self.layers
        return Picture(
            self.width,
            rows,
            tuple(
                to_float(buffer.mapped[:], target.format, self.width, rows, "top")
                for target, buffer in zip(self.targets, self.buffers, strict=True)
            ),
        )


def make_canvas(
    owned: ExitStack,
    gpu: Gpu,
    pipeline: Pipeline,
    render_pass: Any,
    size: tuple[int, int],
) -> Canvas:
    """A canvas of ``size`` (width, height) pixels for a pipeline and its render pass."""
    (width, height), targets, layers = size, pipeline.targets, pipeline.layers
    view = vk.VK_IMAGE_VIEW_TYPE_2D_ARRAY if layers else vk.VK_IMAGE_VIEW_TYPE_2D
    count = layers or 1
    specs = [
        ImageSpec(TARGETS[target.format], width, height, TARGET_USAGE, depth=count, view=view)
        for target in targets
    ]
    made = [make_image(owned, gpu, spec) for spec in specs]
    drawn = made
    if pipeline.samples > 1:
        drawn = [
            make_image(owned, gpu, replace(spec, usage=DRAWN_USAGE, samples=pipeline.samples))
            for spec in specs
        ]
    depth = ImageSpec(
        DEPTHS[pipeline.depth_format], width, height,
        vk.VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
        aspect=ASPECTS[pipeline.depth_format], depth=count, view=view, samples=pipeline.samples,
    )  # fmt: skip
    _, depth_view = make_image(owned, gpu, depth)
    resolved = made if pipeline.samples > 1 else []
    info = vk.VkFramebufferCreateInfo(
        renderPass=render_pass,
        pAttachments=[
            *(view for _, view in drawn),
            depth_view,
            *(view for _, view in resolved),
        ],
        width=width,
        height=height,
        layers=count,
    )
    framebuffer = vk.vkCreateFramebuffer(gpu.device, info, None)
    owned.callback(vk.vkDestroyFramebuffer, gpu.device, framebuffer, None)
    usage = vk.VK_BUFFER_USAGE_TRANSFER_DST_BIT
    buffers = [
        make_buffer(owned, gpu, usage, width * height * count * _texel_size(target))
        for target in targets
    ]
    images = [image for image, _ in made]
    return Canvas(width, height, count, targets, framebuffer, images, buffers)


def _texel_size(target: RenderTarget) -> int:
    lanes, kind = TEXEL_LANES[target.format]
    return lanes * int(kind.itemsize)


def make_render_pass(owned: ExitStack, gpu: Gpu, pipeline: Pipeline) -> Any:
    """A render pass that clears targets, depths and stencil values, draws, resolves samples if
    there are several, and makes the targets ready to copy."""
    targets, samples = pipeline.targets, pipeline.samples
    formats = [TARGETS[target.format] for target in targets]
    if samples == 1:
        colours, resolved = [_attachment(each, DRAWN, _STORE) for each in formats], []
    else:
        colours = [_attachment(each, DRAWING, _DROP, samples) for each in formats]
        resolved = [_attachment(each, DRAWN, _STORE, load=_WRITTEN_ALL) for each in formats]
    depth_layout = vk.VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
    depth = _attachment(DEPTHS[pipeline.depth_format], depth_layout, _DROP, samples)
    references = [
        vk.VkAttachmentReference(index, DRAWING)
        for index in range(len(targets) + 1 + len(resolved))
    ]
    subpass = vk.VkSubpassDescription(
        pipelineBindPoint=vk.VK_PIPELINE_BIND_POINT_GRAPHICS,
        pColorAttachments=references[: len(targets)],
        pResolveAttachments=references[len(targets) + 1 :] or None,
        pDepthStencilAttachment=vk.VkAttachmentReference(len(targets), depth_layout),
    )
    copied = vk.VkSubpassDependency(
        srcSubpass=0,
        dstSubpass=vk.VK_SUBPASS_EXTERNAL,
        srcStageMask=vk.VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
        dstStageMask=vk.VK_PIPELINE_STAGE_TRANSFER_BIT,
        srcAccessMask=vk.VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
        dstAccessMask=vk.VK_ACCESS_TRANSFER_READ_BIT,
    )
    info = vk.VkRenderPassCreateInfo(
        pAttachments=[*colours, depth, *resolved], pSubpasses=[subpass], pDependencies=[copied]
    )
    render_pass = vk.vkCreateRenderPass(gpu.device, info, None)
    owned.callback(vk.vkDestroyRenderPass, gpu.device, render_pass, None)
    return render_pass


def _attachment(
    vk_format: int,
    final_layout: int,
    store: int,
    samples: int = vk.VK_SAMPLE_COUNT_1_BIT,
    load: int = vk.VK_ATTACHMENT_LOAD_OP_CLEAR,
) -> Any:
    return vk.VkAttachmentDescription(
        format=vk_format,
        samples=samples,
        loadOp=load,
        storeOp=store,
        stencilLoadOp=vk.VK_ATTACHMENT_LOAD_OP_CLEAR,
        stencilStoreOp=vk.VK_ATTACHMENT_STORE_OP_DONT_CARE,
        initialLayout=vk.VK_IMAGE_LAYOUT_UNDEFINED,
        finalLayout=final_layout,
    )
