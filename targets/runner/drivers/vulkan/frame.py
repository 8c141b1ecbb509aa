"""Executes a frame job: its steps up to one that reads something back are one submission."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import replace
from typing import Any

import vulkan as vk

from .....compiler.documents.plan import ResolveRow, TextureState
from ..draws import Draw
from ..frame_job import (
    Area,
    Attachment,
    Barrier,
    BufferBarrier,
    Captured,
    Found,
    FrameDraw,
    FrameJob,
    FrameStep,
    FrameTexels,
)
from ..readback import TEXEL_LANES, depths_to_float, to_float
from .capture import Captures, saying_places
from .compute import COMPUTE, make_compute_pipeline
from .descriptor_sets import DescriptorSets
from .device import Gpu, recording
from .formats import DEPTHS
from .frame_textures import BUFFER_USES, USES, MadeTexture, make_frame_textures, record
from .graphics_pipeline import make_pipeline, viewport
from .memory import Buffer, filled_buffer, make_buffer
from .pipeline_layout import make_layout, push
from .render_passes import GRAPHICS, RenderPasses
from .uploads import MESH, STORAGE, Uploads

DEPTH_BYTES, INDEX_SIZE = 4, 4


def draw_frame(gpu: Gpu, job: FrameJob) -> Found:
    """Do a frame job: returns what it reads back, step by step.

    Raises ``DriverError``, and ``VkError`` for calls that fail.
    """
    with ExitStack() as owned:
        return _Frame(owned, gpu, job).found()


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
        self._buffers = [filled_buffer(owned, gpu, STORAGE, each.contents) for each in job.buffers]
        self._uploads = Uploads(owned, gpu)
        self._passes = RenderPasses(owned, gpu, self._textures)
        self._pipelines: dict[object, tuple[Any, Any]] = {}
        self._texels: list[FrameTexels] = []
        self._contents: list[bytes] = []
        self._captured: list[Captured] = []

    def found(self) -> Found:
        """Do all steps."""
        is_first = True
        for steps in _submissions(self._job.steps):
            self._submit(steps, is_first=is_first)
            is_first = False
        return Found(tuple(self._texels), tuple(self._contents), tuple(self._captured))

    def _submit(self, steps: Sequence[FrameStep], *, is_first: bool) -> None:
        """Do some steps; the last of them may read something back."""
        with ExitStack() as once:
            self._do_all(once, steps, is_first=is_first)

    def _do_all(self, once: ExitStack, steps: Sequence[FrameStep], *, is_first: bool) -> None:
        """Do some steps; ``once`` owns everything that only these need.

        A job may have many such submissions.
        """
        last = steps[-1]
        bound = [[self._bound(once, step, draw) for draw in step.draws] for step in steps]
        back = [self._back(once, number) for number in last.read]
        captures = self._captures(once, last)
        with recording(self._gpu) as commands:
            for texture in self._textures if is_first else ():
                if texture.description.is_black:
                    texture.clear(commands)
            for step, sets in zip(steps, bound, strict=True):
                record(commands, self._textures, step.barriers)
                self._wait_for_buffers(commands, step.buffer_barriers)
                self._do(commands, step, sets, captures)
            for number, buffer in zip(last.read, back, strict=True):
                self._read_back(commands, number, buffer)
            _wait_for_host(commands)
        self._texels += map(self._found, last.read, back)
        self._contents += (bytes(self._buffers[each].mapped[:]) for each in last.read_buffers)
        if captures is not None:
            self._captured.append(captures.captured())

    def _bound(self, once: ExitStack, step: FrameStep, drawn: FrameDraw) -> DescriptorSets:
        """The descriptor sets of a draw of a step; everything that the draw carries is uploaded."""
        pipeline = self._job.pipelines[drawn.pipeline]
        made = self._textures, self._buffers, step.images
        return self._uploads.bound(once, pipeline, drawn, *made)

    def _captures(self, once: ExitStack, step: FrameStep) -> Captures | None:
        if step.captures is None:
            return None
        stream = self._job.pipelines[step.draws[0].pipeline].stream_output
        assert stream is not None
        return Captures.of(once, self._gpu, step.captures, stream.stride)

    # --- steps -----------------------------------------------------------------------------------

    def _do(
        self,
        commands: Any,
        step: FrameStep,
        sets: Sequence[DescriptorSets],
        captures: Captures | None,
    ) -> None:
        if step.copied:
            self._copy(commands, *(self._textures[number] for number in step.copied))
        elif step.captures is not None:
            assert captures is not None
            self._capture(commands, step, sets[0], captures)
        elif step.drawn_to:
            self._draw(commands, step, sets)
        elif sets:
            self._run(commands, step, sets[0])

    def _draw(self, commands: Any, step: FrameStep, sets: Sequence[DescriptorSets]) -> None:
        for part in self._parts(step):
            self._draw_part(commands, part, sets)
        for target in step.targets:
            if target.resolve is not None:
                self._resolve(commands, target.texture, target.resolve)

    def _parts(self, step: FrameStep) -> Sequence[FrameStep]:
        """The step itself or, where several views at once go wrong, one for each view.

        lavapipe draws what it has to clip to the last of the views.
        """
        if not self._gpu.mixes_views:
            return (step,)
        bits = [1 << view for view in range(step.view_mask.bit_length())]
        return [replace(step, view_mask=bit) for bit in bits if bit & step.view_mask] or (step,)

    def _draw_part(self, commands: Any, step: FrameStep, sets: Sequence[DescriptorSets]) -> None:
        width, height = self._size(step.drawn_to[0])
        render_pass = self._passes.begin(commands, step, (width, height))
        port, drawn_to = step.areas(width, height)
        vk.vkCmdSetScissor(commands, 0, 1, [_rectangle(drawn_to)])
        vk.vkCmdSetBlendConstants(commands, step.blend_constant)
        for drawn, bound in zip(step.draws, sets, strict=True):
            view = viewport(self._job.pipelines[drawn.pipeline], *port)
            vk.vkCmdSetViewport(commands, 0, 1, [view])
            self._bind(commands, drawn, bound, render_pass)
            assert drawn.draw is not None
            self._draw_mesh(commands, drawn.draw)
        vk.vkCmdEndRenderPass(commands)

    def _capture(
        self, commands: Any, step: FrameStep, bound: DescriptorSets, captures: Captures
    ) -> None:
        """Draw with the rasterizer off, into the buffer for vertices."""
        (drawn,) = step.draws
        draw = drawn.draw
        assert draw is not None
        size = draw.width, draw.height
        render_pass = self._passes.begin(commands, step, size)
        vk.vkCmdSetScissor(commands, 0, 1, [_rectangle((0, 0, *size))])
        vk.vkCmdSetBlendConstants(commands, step.blend_constant)
        view = viewport(self._job.pipelines[drawn.pipeline], 0, 0, *size)
        vk.vkCmdSetViewport(commands, 0, 1, [view])
        self._bind(commands, drawn, bound, render_pass)
        with captures.recording(commands):
            self._draw_mesh(commands, draw)
        vk.vkCmdEndRenderPass(commands)
        captures.wait_for_host(commands)

    def _resolve(self, commands: Any, drawn: int, to: ResolveRow) -> None:
        """Write the means of samples to a resolve target.

        A render pass could do so, but lavapipe writes to the first layer then, whichever is meant.
        """
        used: tuple[tuple[int, TextureState], ...] = (
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

    def _bind(
        self, commands: Any, drawn: FrameDraw, bound: DescriptorSets, render_pass: Any
    ) -> None:
        """Bind the pipeline of a draw, and the resources that it reads."""
        key = drawn.pipeline, bound.slots.targets, render_pass
        if key not in self._pipelines:
            layout = make_layout(self._owned, self._gpu, bound)
            described = saying_places(bound.slots)
            made = make_pipeline(self._owned, self._gpu, described, layout, render_pass)
            self._pipelines[key] = made, layout
        pipeline, layout = self._pipelines[key]
        vk.vkCmdBindPipeline(commands, GRAPHICS, pipeline)
        if bound.sets:
            vk.vkCmdBindDescriptorSets(
                commands, GRAPHICS, layout, 0, len(bound.sets), bound.sets, 0, None
            )
        push(commands, layout, bound.slots, drawn.values.blocks)

    def _draw_mesh(self, commands: Any, draw: Draw) -> None:
        if not draw.indices:  # A buffer of no bytes cannot be made.
            return
        if vertices := [self._uploads.buffer(MESH, data).handle for data in draw.vertices]:
            vk.vkCmdBindVertexBuffers(commands, 0, len(vertices), vertices, [0] * len(vertices))
        indices = self._uploads.buffer(MESH, draw.indices).handle
        vk.vkCmdBindIndexBuffer(commands, indices, 0, vk.VK_INDEX_TYPE_UINT32)
        count = len(draw.indices) // INDEX_SIZE
        vk.vkCmdDrawIndexed(commands, count, draw.instance_count, 0, 0, 0)

    def _run(self, commands: Any, step: FrameStep, bound: DescriptorSets) -> None:
        key = step.draws[0].pipeline
        if key not in self._pipelines:
            layout = make_layout(self._owned, self._gpu, bound)
            made = make_compute_pipeline(self._owned, self._gpu, bound.slots, layout)
            self._pipelines[key] = made, layout
        pipeline, layout = self._pipelines[key]
        vk.vkCmdBindPipeline(commands, COMPUTE, pipeline)
        if bound.sets:
            vk.vkCmdBindDescriptorSets(
                commands, COMPUTE, layout, 0, len(bound.sets), bound.sets, 0, None
            )
        push(commands, layout, bound.slots, step.draws[0].values.blocks)
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

    def _size(self, attachment: Attachment) -> tuple[int, int]:
        return _halved(self._textures[attachment.texture], attachment.level)

    # --- read-back -------------------------------------------------------------------------------

    def _back(self, once: ExitStack, number: int) -> Buffer:
        texture = self._job.textures[number]
        size = texture.width * texture.height * texture.layers * _texel_size(texture.format)
        usage = vk.VK_BUFFER_USAGE_TRANSFER_DST_BIT
        return make_buffer(once, self._gpu, usage, size)

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
                texels = to_float(data, colours, texture.width, rows)
        return FrameTexels(texture.width, texture.height, texture.layers, texels)


def _submissions(steps: Sequence[FrameStep]) -> Iterator[Sequence[FrameStep]]:
    """The steps in portions, each of which ends with a step that reads something back."""
    first = 0
    for number, step in enumerate(steps):
        if step.read or step.read_buffers or step.captures is not None or step is steps[-1]:
            yield steps[first : number + 1]
            first = number + 1


def _resolves(step: FrameStep) -> list[ResolveRow]:
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
    """Let the host read copied texels, and buffers that kernels have written."""
    barrier = vk.VkMemoryBarrier(
        srcAccessMask=vk.VK_ACCESS_TRANSFER_WRITE_BIT | vk.VK_ACCESS_SHADER_WRITE_BIT,
        dstAccessMask=vk.VK_ACCESS_HOST_READ_BIT,
    )
    before = vk.VK_PIPELINE_STAGE_TRANSFER_BIT | vk.VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT
    after = vk.VK_PIPELINE_STAGE_HOST_BIT
    vk.vkCmdPipelineBarrier(commands, before, after, 0, 1, [barrier], 0, None, 0, None)
