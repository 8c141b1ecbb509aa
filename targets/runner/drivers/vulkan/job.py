"""Draws a job: makes what its draws share once, and destroys everything at the end."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack, nullcontext
from typing import Any

import vulkan as vk

from ..checks import check
from ..draw_job import Draw, Job, Picture
from ..texels import Image
from .canvas import Canvas, make_canvas, make_render_pass
from .descriptor_sets import make_descriptor_sets
from .device import Gpu, recording
from .graphics_pipeline import make_layout, make_pipeline, viewport
from .limits import check_limits
from .memory import Buffer, filled_buffer
from .texture_images import make_texture

INDEX_SIZE = 4

GRAPHICS = vk.VK_PIPELINE_BIND_POINT_GRAPHICS
STORAGE = vk.VK_BUFFER_USAGE_STORAGE_BUFFER_BIT
MESH = vk.VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | vk.VK_BUFFER_USAGE_INDEX_BUFFER_BIT

Around = Callable[[Any], AbstractContextManager[None]]
"""Given the command buffer, records commands before and behind a draw call."""


def _nothing(_commands: Any) -> AbstractContextManager[None]:
    return nullcontext()


def draw_job(gpu: Gpu, job: Job) -> list[Picture]:
    """A picture for each draw. Raises ``DriverError``, and ``VkError`` for calls that fail."""
    check(job)
    check_limits(gpu, job)
    with ExitStack() as owned:
        painter = Painter(owned, gpu, job)
        return [painter.draw(draw) for draw in job.draws]


class Painter:
    """The pipeline and everything that drawing needs; draws often share meshes and textures."""

    def __init__(self, owned: ExitStack, gpu: Gpu, job: Job) -> None:
        self._owned = owned
        self._gpu = gpu
        self._description = job.pipeline
        self._render_pass = make_render_pass(owned, gpu, job.pipeline)
        self._bindings = make_descriptor_sets(owned, gpu, job.pipeline)
        self._layout = make_layout(owned, gpu, self._bindings.layouts)
        self._pipeline = make_pipeline(owned, gpu, job.pipeline, self._layout, self._render_pass)
        self._canvases: dict[tuple[int, int], Canvas] = {}
        self._textures: dict[Image, Any] = {}
        self._buffers: dict[tuple[int, bytes], Buffer] = {}

    def draw(self, draw: Draw) -> Picture:
        """One picture."""
        canvas = self._canvas(draw.width, draw.height)
        self.render(draw, _nothing, canvas.read_back)
        return canvas.picture()

    def render(self, draw: Draw, around: Around, read_back: Callable[[Any], None]) -> None:
        """Run one draw.

        ``around`` records what comes before and behind the draw call, and ``read_back``, when the
        render pass is over, what lets the host read what was written.
        """
        gpu = self._gpu
        self._bindings.bind_blocks(draw.blocks)
        self._bindings.bind_buffers(gpu, [self._buffer(STORAGE, data) for data in draw.buffers])
        self._bindings.bind_textures(gpu, [self._texture(image) for image in draw.textures])
        canvas = self._canvas(draw.width, draw.height)
        with recording(gpu) as commands:
            self._render(commands, canvas, draw, around)
            read_back(commands)

    def _render(self, commands: Any, canvas: Canvas, draw: Draw, around: Around) -> None:
        area = vk.VkRect2D(extent=vk.VkExtent2D(draw.width, draw.height))
        begin = vk.VkRenderPassBeginInfo(
            renderPass=self._render_pass,
            framebuffer=canvas.framebuffer,
            renderArea=area,
            pClearValues=_clear_values(draw),
        )
        vk.vkCmdBeginRenderPass(commands, begin, vk.VK_SUBPASS_CONTENTS_INLINE)
        view = viewport(self._description, 0, 0, draw.width, draw.height)
        vk.vkCmdSetViewport(commands, 0, 1, [view])
        vk.vkCmdSetScissor(commands, 0, 1, [area])
        vk.vkCmdSetBlendConstants(commands, draw.blend_constant)
        self._draw_mesh(commands, draw, around)
        vk.vkCmdEndRenderPass(commands)

    def _draw_mesh(self, commands: Any, draw: Draw, around: Around) -> None:
        vk.vkCmdBindPipeline(commands, GRAPHICS, self._pipeline)
        if sets := self._bindings.sets:
            vk.vkCmdBindDescriptorSets(
                commands, GRAPHICS, self._layout, 0, len(sets), sets, 0, None
            )
        with around(commands):
            if draw.indices:  # a buffer of no bytes cannot be made
                self._draw_primitives(commands, draw)

    def _draw_primitives(self, commands: Any, draw: Draw) -> None:
        if vertices := [self._buffer(MESH, data).handle for data in draw.vertices]:
            offsets = [0] * len(vertices)
            vk.vkCmdBindVertexBuffers(commands, 0, len(vertices), vertices, offsets)
        indices = self._buffer(MESH, draw.indices).handle
        vk.vkCmdBindIndexBuffer(commands, indices, 0, vk.VK_INDEX_TYPE_UINT32)
        count = len(draw.indices) // INDEX_SIZE
        vk.vkCmdDrawIndexed(commands, count, draw.instance_count, 0, 0, 0)

    def _canvas(self, *size: int) -> Canvas:
        width, height = size
        if (width, height) not in self._canvases:
            self._canvases[width, height] = make_canvas(
                self._owned, self._gpu, self._description, self._render_pass, (width, height)
            )
        return self._canvases[width, height]

    def _texture(self, image: Image) -> Any:
        if image not in self._textures:
            self._textures[image] = make_texture(self._owned, self._gpu, image)
        return self._textures[image]

    def _buffer(self, usage: int, data: bytes) -> Buffer:
        key = usage, data
        if key not in self._buffers:
            self._buffers[key] = filled_buffer(self._owned, self._gpu, usage, data)
        return self._buffers[key]


def _clear_values(draw: Draw) -> list[Any]:
    """The clear colours of the targets, the depth that is cleared to, and a stencil value of 0."""
    cleared = [
        vk.VkClearValue(color=vk.VkClearColorValue(float32=list(each))) for each in draw.clear
    ]
    far = vk.VkClearValue(depthStencil=vk.VkClearDepthStencilValue(depth=draw.clear_depth))
    return [*cleared, far]
