"""Executes a frame job: all of its steps in one submission, and then reads back what is wanted."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from typing import Any

import vulkan as vk

from ..draw_job import Draw
from ..frame_job import (
    Area,
    Attachment,
    Barrier,
    BufferBarrier,
    FrameDraw,
    FrameJob,
    FrameStep,
    FrameTexels,
    Resolve,
    TextureUse,
)
from ..readback import TEXEL_LANES, depths_to_float, to_float
from ..texels import Image
from .compute import COMPUTE, make_compute_pipeline
from .descriptor_sets import DescriptorSets, make_descriptor_sets
from .device import Gpu, recording
from .formats import DEPTHS
from .frame_textures import BUFFER_USES, USES, MadeTexture, make_frame_textures, record
from .graphics_pipeline import make_layout, make_pipeline, viewport
from .job import GRAPHICS, INDEX_SIZE, MESH, STORAGE
from .memory import Buffer, filled_buffer, make_buffer
from .texture_images import make_texture

DEPTH_BYTES = 4

_LOADS = {True: vk.VK_ATTACHMENT_LOAD_OP_LOAD, False: vk.VK_ATTACHMENT_LOAD_OP_CLEAR}
_STORES = {True: vk.VK_ATTACHMENT_STORE_OP_STORE, False: vk.VK_ATTACHMENT_STORE_OP_DONT_CARE}


def draw_frame(gpu: Gpu, job: FrameJob) -> list[FrameTexels]:
    """What is read back, step by step. Raises ``DriverError``, and ``VkError`` for calls that
    fail."""
    with ExitStack() as owned:
        return _Frame(owned, gpu, job).texels()


class _Frame:
    """Everything that a frame job makes."""

    def __init__(self, owned: ExitStack, gpu: Gpu, job: FrameJob) -> None:
        self._owned = owned
        self._gpu = gpu
        self._job = job
        written = {image for step in job.steps for image in step.images}
        drawn = {each.texture for step in job.steps for each in step.drawn_to}
        drawn |= {each.texture for step in job.steps for each in _resolves(step)}
        self._textures = make_frame_textures(owned, gpu, job, drawn, written)
        self._buffers = [
            filled_buffer(owned, gpu, STORAGE, each.initial.to_bytes(4, "little") * each.words)
            for each in job.buffers
        ]
        self._passes: dict[object, Any] = {}
        self._pipelines: dict[object, tuple[Any, Any]] = {}
        self._images: dict[Image, Any] = {}
        self._data: dict[tuple[int, bytes], Buffer] = {}

    def texels(self) -> list[FrameTexels]:
        """Do all steps."""
        recorded = [self._prepared(step) for step in self._job.steps]
        back = [(number, self._back(number)) for step in self._job.steps for number in step.read]
        waiting = iter(back)
        with recording(self._gpu) as commands:
            for texture in self._textures:
                if texture.description.is_black:
                    texture.clear(commands)
            for step, sets in zip(self._job.steps, recorded, strict=True):
                record(commands, self._textures, step.barriers)
                self._wait_for_buffers(commands, step.buffer_barriers)
                self._do(commands, step, sets)
                for number in step.read:
                    self._read_back(commands, number, next(waiting)[1])
            _wait_for_host(commands)
        return [self._found(number, buffer) for number, buffer in back]

    # --- before it is recorded -------------------------------------------------------------------

    def _prepared(self, step: FrameStep) -> list[DescriptorSets]:
        """The descriptor sets of the draws of a step; textures and buffers are uploaded."""
        return [self._bound(step, draw) for draw in step.draws]

    def _bound(self, step: FrameStep, drawn: FrameDraw) -> DescriptorSets:
        gpu, given = self._gpu, drawn.draw or drawn.dispatch
        assert given is not None
        sets = make_descriptor_sets(self._owned, gpu, self._job.pipelines[drawn.pipeline])
        sets.bind_blocks(given.blocks)
        textures, buffers = iter(given.textures), iter(given.buffers)
        sets.bind_textures(
            gpu,
            [
                self._image(next(textures)) if number < 0 else self._textures[number].view
                for number in drawn.textures
            ],
        )
        sets.bind_buffers(
            gpu,
            [
                self._filled(STORAGE, next(buffers)) if number < 0 else self._buffers[number]
                for number in drawn.buffers
            ],
        )
        if step.images:
            sets.bind_images(gpu, [self._textures[number].view for number in step.images])
        if drawn.draw is not None:
            for data in (*drawn.draw.vertices, drawn.draw.indices):
                if data:
                    self._filled(MESH, data)
        return sets

    def _image(self, image: Image) -> Any:
        if image not in self._images:
            self._images[image] = make_texture(self._owned, self._gpu, image)
        return self._images[image]

    def _filled(self, usage: int, data: bytes) -> Buffer:
        key = usage, data
        if key not in self._data:
            self._data[key] = filled_buffer(self._owned, self._gpu, usage, data)
        return self._data[key]

    # --- steps -----------------------------------------------------------------------------------

    def _do(self, commands: Any, step: FrameStep, sets: Sequence[DescriptorSets]) -> None:
        if step.copied:
            self._copy(commands, *(self._textures[number] for number in step.copied))
        elif step.targets or step.depth is not None:
            self._draw(commands, step, sets)
        elif sets:
            self._run(commands, step, sets[0])

    def _draw(self, commands: Any, step: FrameStep, sets: Sequence[DescriptorSets]) -> None:
        attachments = step.drawn_to
        render_pass = self._render_pass(step)
        width, height = self._size(attachments[0])
        views = [
            self._textures[each.texture].part(each.layer, each.level, each.layers)
            for each in attachments
        ]
        info = vk.VkFramebufferCreateInfo(
            renderPass=render_pass,
            pAttachments=views,
            width=width,
            height=height,
            layers=attachments[0].layers,
        )
        framebuffer = vk.vkCreateFramebuffer(self._gpu.device, info, None)
        self._owned.callback(vk.vkDestroyFramebuffer, self._gpu.device, framebuffer, None)
        area = vk.VkRect2D(extent=vk.VkExtent2D(width, height))
        begin = vk.VkRenderPassBeginInfo(
            renderPass=render_pass,
            framebuffer=framebuffer,
            renderArea=area,
            pClearValues=[self._clear_value(each) for each in attachments],
        )
        vk.vkCmdBeginRenderPass(commands, begin, vk.VK_SUBPASS_CONTENTS_INLINE)
        port, drawn_to = step.areas(width, height)
        vk.vkCmdSetScissor(commands, 0, 1, [_rectangle(drawn_to)])
        vk.vkCmdSetBlendConstants(commands, step.blend_constant)
        for drawn, bound in zip(step.draws, sets, strict=True):
            description = self._job.pipelines[drawn.pipeline]
            view = viewport(description, *port)
            vk.vkCmdSetViewport(commands, 0, 1, [view])
            self._draw_one(commands, drawn, bound, render_pass)
        vk.vkCmdEndRenderPass(commands)
        for target in step.targets:
            if target.resolve is not None:
                self._resolve(commands, target.texture, target.resolve)

    def _resolve(self, commands: Any, drawn: int, to: Resolve) -> None:
        """Write the means of samples to where they belong. A render pass could do so, but lavapipe
        writes to the first layer then, whichever is meant."""
        used: tuple[tuple[int, TextureUse], ...] = (
            (drawn, "copied_from"),
            (to.texture, "copied_to"),
        )
        record(commands, self._textures, [Barrier(n, "target", use) for n, use in used])
        source, target = self._textures[drawn], self._textures[to.texture]
        region = vk.VkImageResolve(
            srcSubresource=_layers(source, 0),
            dstSubresource=vk.VkImageSubresourceLayers(
                aspectMask=target.spec.aspect, mipLevel=to.level, baseArrayLayer=to.layer,
                layerCount=1,
            ),
            extent=vk.VkExtent3D(*_halved(target, to.level), 1),
        )  # fmt: skip
        layouts = USES["copied_from"].layout, USES["copied_to"].layout
        vk.vkCmdResolveImage(
            commands, source.image, layouts[0], target.image, layouts[1], 1, [region]
        )
        record(commands, self._textures, [Barrier(n, use, "target") for n, use in used])

    def _draw_one(
        self, commands: Any, drawn: FrameDraw, bound: DescriptorSets, render_pass: Any
    ) -> None:
        draw = drawn.draw
        assert draw is not None
        key = drawn.pipeline, bound.slots.targets, render_pass
        if key not in self._pipelines:
            layout = make_layout(self._owned, self._gpu, bound.layouts)
            made = make_pipeline(self._owned, self._gpu, bound.slots, layout, render_pass)
            self._pipelines[key] = made, layout
        pipeline, layout = self._pipelines[key]
        vk.vkCmdBindPipeline(commands, GRAPHICS, pipeline)
        if bound.sets:
            vk.vkCmdBindDescriptorSets(
                commands, GRAPHICS, layout, 0, len(bound.sets), bound.sets, 0, None
            )
        self._draw_mesh(commands, draw)

    def _draw_mesh(self, commands: Any, draw: Draw) -> None:
        if not draw.indices:
            return
        if vertices := [self._filled(MESH, data).handle for data in draw.vertices]:
            vk.vkCmdBindVertexBuffers(commands, 0, len(vertices), vertices, [0] * len(vertices))
        indices = self._filled(MESH, draw.indices).handle
        vk.vkCmdBindIndexBuffer(commands, indices, 0, vk.VK_INDEX_TYPE_UINT32)
        count = len(draw.indices) // INDEX_SIZE
        vk.vkCmdDrawIndexed(commands, count, draw.instance_count, 0, 0, 0)

    def _run(self, commands: Any, step: FrameStep, bound: DescriptorSets) -> None:
        key = step.draws[0].pipeline
        if key not in self._pipelines:
            layout = make_layout(self._owned, self._gpu, bound.layouts)
            made = make_compute_pipeline(self._owned, self._gpu, bound.slots, layout)
            self._pipelines[key] = made, layout
        pipeline, layout = self._pipelines[key]
        vk.vkCmdBindPipeline(commands, COMPUTE, pipeline)
        if bound.sets:
            vk.vkCmdBindDescriptorSets(
                commands, COMPUTE, layout, 0, len(bound.sets), bound.sets, 0, None
            )
        vk.vkCmdDispatch(commands, *step.groups)

    def _wait_for_buffers(self, commands: Any, barriers: Sequence[BufferBarrier]) -> None:
        """Record barriers, all of them at once."""
        if not barriers:
            return
        before = after = 0
        for barrier in barriers:
            before |= BUFFER_USES[barrier.before].stages
            after |= BUFFER_USES[barrier.after].stages
        found = [
            vk.VkBufferMemoryBarrier(
                srcAccessMask=BUFFER_USES[each.before].access,
                dstAccessMask=BUFFER_USES[each.after].access,
                srcQueueFamilyIndex=vk.VK_QUEUE_FAMILY_IGNORED,
                dstQueueFamilyIndex=vk.VK_QUEUE_FAMILY_IGNORED,
                buffer=self._buffers[each.buffer].handle,
                offset=0,
                size=self._buffers[each.buffer].size,
            )
            for each in barriers
        ]
        vk.vkCmdPipelineBarrier(commands, before, after, 0, 0, None, len(found), found, 0, None)

    def _copy(self, commands: Any, source: MadeTexture, target: MadeTexture) -> None:
        copies = [
            vk.VkImageCopy(
                srcSubresource=_layers(source, level),
                dstSubresource=_layers(target, level),
                extent=vk.VkExtent3D(*_halved(source, level), 1),
            )
            for level in range(source.description.levels)
        ]
        layouts = USES["copied_from"].layout, USES["copied_to"].layout
        vk.vkCmdCopyImage(
            commands, source.image, layouts[0], target.image, layouts[1], len(copies), copies
        )

    # --- render passes ---------------------------------------------------------------------------

    def _size(self, attachment: Attachment) -> tuple[int, int]:
        return _halved(self._textures[attachment.texture], attachment.level)

    def _clear_value(self, attachment: Attachment) -> Any:
        if self._job.textures[attachment.texture].is_depth:
            depth = vk.VkClearDepthStencilValue(depth=attachment.clear[0])
            return vk.VkClearValue(depthStencil=depth)
        return vk.VkClearValue(color=vk.VkClearColorValue(float32=list(attachment.clear)))

    def _render_pass(self, step: FrameStep) -> Any:
        """The render pass for the formats of a step, and for what it loads and stores."""
        attachments = step.drawn_to
        key = tuple(
            (
                self._job.textures[each.texture].format,
                self._job.textures[each.texture].samples,
                each.loads,
                each.stores,
                each.stores_stencil,
                each.resolve is not None,
            )
            for each in attachments
        )
        if key not in self._passes:
            self._passes[key] = self._made_pass(step)
        return self._passes[key]

    def _made_pass(self, step: FrameStep) -> Any:
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
        info = vk.VkRenderPassCreateInfo(pAttachments=described, pSubpasses=[subpass])
        made = vk.vkCreateRenderPass(self._gpu.device, info, None)
        self._owned.callback(vk.vkDestroyRenderPass, self._gpu.device, made, None)
        return made

    def _described(self, attachment: Attachment) -> Any:
        texture = self._textures[attachment.texture]
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

    # --- what comes back -------------------------------------------------------------------------

    def _back(self, number: int) -> Buffer:
        texture = self._job.textures[number]
        size = texture.width * texture.height * texture.layers * _texel_size(texture.format)
        usage = vk.VK_BUFFER_USAGE_TRANSFER_DST_BIT
        return make_buffer(self._owned, self._gpu, usage, size)

    def _read_back(self, commands: Any, number: int, buffer: Buffer) -> None:
        texture = self._textures[number]
        copy = vk.VkBufferImageCopy(
            imageSubresource=_layers(texture, 0, texture.spec.read_aspect),
            imageExtent=vk.VkExtent3D(texture.description.width, texture.description.height, 1),
        )
        layout = USES["copied_from"].layout
        vk.vkCmdCopyImageToBuffer(commands, texture.image, layout, buffer.handle, 1, [copy])

    def _found(self, number: int, buffer: Buffer) -> FrameTexels:
        texture = self._job.textures[number]
        rows, data = texture.height * texture.layers, bytes(buffer.mapped[:])
        match texture.format:
            case "depth32float" | "depth32float-stencil8":
                texels = depths_to_float(data)
            case colours:
                texels = to_float(data, colours, texture.width, rows, "top")
        return FrameTexels(texture.width, texture.height, texture.layers, texels)


def _resolves(step: FrameStep) -> list[Resolve]:
    return [target.resolve for target in step.targets if target.resolve is not None]


def _texel_size(format_: Any) -> int:
    if format_ in DEPTHS:
        return DEPTH_BYTES
    lanes, kind = TEXEL_LANES[format_]
    return lanes * int(kind.itemsize)


def _rectangle(area: Area) -> Any:
    left, top, width, height = area
    return vk.VkRect2D(vk.VkOffset2D(left, top), vk.VkExtent2D(width, height))


def _halved(texture: MadeTexture, level: int) -> tuple[int, int]:
    described = texture.description
    return max(described.width >> level, 1), max(described.height >> level, 1)


def _layers(texture: MadeTexture, level: int, aspect: int = 0) -> Any:
    return vk.VkImageSubresourceLayers(
        aspectMask=aspect or texture.spec.aspect,
        mipLevel=level,
        layerCount=texture.description.layers,
    )


def _wait_for_host(commands: Any) -> None:
    barrier = vk.VkMemoryBarrier(
        srcAccessMask=vk.VK_ACCESS_TRANSFER_WRITE_BIT, dstAccessMask=vk.VK_ACCESS_HOST_READ_BIT
    )
    before, after = vk.VK_PIPELINE_STAGE_TRANSFER_BIT, vk.VK_PIPELINE_STAGE_HOST_BIT
    vk.vkCmdPipelineBarrier(commands, before, after, 0, 1, [barrier], 0, None, 0, None)
