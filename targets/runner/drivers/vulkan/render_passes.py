"""The render passes of a frame job, with a framebuffer for each step that draws."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

import vulkan as vk

from ..frame_job import Attachment, FrameStep
from .device import Gpu
from .frame_textures import USES, MadeTexture

GRAPHICS = vk.VK_PIPELINE_BIND_POINT_GRAPHICS

_LOADS = {True: vk.VK_ATTACHMENT_LOAD_OP_LOAD, False: vk.VK_ATTACHMENT_LOAD_OP_CLEAR}
_STORES = {True: vk.VK_ATTACHMENT_STORE_OP_STORE, False: vk.VK_ATTACHMENT_STORE_OP_DONT_CARE}


@dataclass(slots=True)
class RenderPasses:
    """Makes render passes; steps with the same formats, loads and stores have the same one."""

    owned: ExitStack
    gpu: Gpu
    textures: Sequence[MadeTexture]
    _made: dict[object, Any] = field(default_factory=dict)

    def begin(self, commands: Any, step: FrameStep, size: tuple[int, int]) -> Any:
        """Record the beginning of a step's render pass over so many pixels; returns the pass."""
        render_pass = self._of(step)
        width, height = size
        attachments = step.drawn_to
        info = vk.VkFramebufferCreateInfo(
            renderPass=render_pass,
            pAttachments=[
                self.textures[each.texture].part(each.layer, each.level, each.layers)
                for each in attachments
            ],
            width=width,
            height=height,
            # With views, a draw goes to the layers of the attachments that the mask names.
            layers=1 if step.view_mask or not attachments else attachments[0].layers,
        )
        framebuffer = vk.vkCreateFramebuffer(self.gpu.device, info, None)
        self.owned.callback(vk.vkDestroyFramebuffer, self.gpu.device, framebuffer, None)
        begin = vk.VkRenderPassBeginInfo(
            renderPass=render_pass,
            framebuffer=framebuffer,
            renderArea=vk.VkRect2D(extent=vk.VkExtent2D(width, height)),
            pClearValues=[self._clear_value(each) for each in attachments],
        )
        vk.vkCmdBeginRenderPass(commands, begin, vk.VK_SUBPASS_CONTENTS_INLINE)
        return render_pass

    def _of(self, step: FrameStep) -> Any:
        attachments = tuple(
            (
                self.textures[each.texture].description.format,
                self.textures[each.texture].description.samples,
                each.loads,
                each.stores,
                each.stores_stencil,
                each.resolve is not None,
            )
            for each in step.drawn_to
        )
        key = attachments, step.view_mask
        if key not in self._made:
            self._made[key] = self._make(step)
        return self._made[key]

    def _make(self, step: FrameStep) -> Any:
        described = [self._described(each) for each in step.drawn_to]
        references = [
            vk.VkAttachmentReference(number, USES["target"].layout)
            for number in range(len(step.targets))
        ]
        depth = vk.VkAttachmentReference(len(step.targets), USES["depth"].layout)
        subpass = vk.VkSubpassDescription(
            pipelineBindPoint=GRAPHICS,
            pColorAttachments=references,
            pDepthStencilAttachment=None if step.depth is None else depth,
        )
        views = vk.VkRenderPassMultiviewCreateInfo(pViewMasks=[step.view_mask])
        info = vk.VkRenderPassCreateInfo(
            pNext=views if step.view_mask else None, pAttachments=described, pSubpasses=[subpass]
        )
        made = vk.vkCreateRenderPass(self.gpu.device, info, None)
        self.owned.callback(vk.vkDestroyRenderPass, self.gpu.device, made, None)
        return made

    def _described(self, attachment: Attachment) -> Any:
        texture = self.textures[attachment.texture]
        layout = USES["depth" if texture.description.is_depth else "target"].layout
        return vk.VkAttachmentDescription(
            format=texture.spec.format,
            samples=texture.spec.samples,
            loadOp=_LOADS[attachment.loads],
            storeOp=_STORES[attachment.stores or attachment.resolve is not None],
            stencilLoadOp=_LOADS[attachment.loads],
            stencilStoreOp=_STORES[attachment.stores_stencil],
            initialLayout=layout,
            finalLayout=layout,
        )

    def _clear_value(self, attachment: Attachment) -> Any:
        if self.textures[attachment.texture].description.is_depth:
            depth = vk.VkClearDepthStencilValue(depth=attachment.clear[0])
            return vk.VkClearValue(depthStencil=depth)
        return vk.VkClearValue(color=vk.VkClearColorValue(float32=list(attachment.clear)))
