"""Executes a frame job with WebGPU, step by step. WebGPU itself waits where a barrier stands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from typing import Any

import wgpu

from ..device import DriverError
from ..draws import Dispatch, Draw
from ..frame_job import OWN, Attachment, Found, FrameDraw, FrameJob, FrameStep, FrameTexels
from ..webgpu import interleaved
from .bindings import DrawnData, bind_groups
from .device import Gpu, explained
from .frame_textures import MadeTexture, make_frame_texture
from .pipeline import MadePipeline, make_kernel, make_pipeline

_STORES = {True: "store", False: "discard"}
_LOADS = {True: "load", False: "clear"}


def draw_frame(gpu: Gpu, job: FrameJob) -> Found:
    """Do a frame job: returns what it reads back, step by step. Raises ``DriverError``."""
    with explained(), ExitStack() as owned:
        return _Frame(gpu, job, owned).found()


class _Frame:
    """Everything that a frame job makes."""

    def __init__(self, gpu: Gpu, job: FrameJob, owned: ExitStack) -> None:
        self._gpu = gpu
        self._job = job
        written = {image for step in job.steps for image in step.images}
        self._textures: list[MadeTexture] = []
        for number, texture in enumerate(job.textures):
            made = make_frame_texture(gpu, texture, written=number in written)
            self._textures.append(made)
            owned.callback(made.texture.destroy)
        usage = wgpu.BufferUsage.STORAGE | wgpu.BufferUsage.COPY_SRC
        self._uploads = DrawnData(gpu)
        self._buffers = [
            gpu.device.create_buffer_with_data(data=each.contents, usage=usage)
            for each in job.buffers
        ]
        self._pipelines: dict[tuple[int, str | None], MadePipeline] = {}

    def found(self) -> Found:
        """Do all steps."""
        for texture in self._textures:
            texture.clear()
        texels: list[FrameTexels] = []
        contents: list[bytes] = []
        for step in self._job.steps:
            self._do(step)
            texels += (self._textures[number].read() for number in step.read)
            queue = self._gpu.device.queue
            contents += (bytes(queue.read_buffer(self._buffers[n])) for n in step.read_buffers)
        return Found(tuple(texels), tuple(contents))

    def _do(self, step: FrameStep) -> None:
        if step.captures is not None:
            raise DriverError("WebGPU has no stream output")
        encoder = self._gpu.device.create_command_encoder()
        if step.copied:
            source, target = (self._textures[number] for number in step.copied)
            source.copy_to(encoder, target)
        elif step.drawn_to:
            self._draw(encoder, step)
        elif step.draws:
            self._run(encoder, step)
        self._gpu.device.queue.submit([encoder.finish()])

    # --- draws -----------------------------------------------------------------------------------

    def _draw(self, encoder: Any, step: FrameStep) -> None:
        drawing = encoder.begin_render_pass(
            color_attachments=[self._target(each) for each in step.targets],
            depth_stencil_attachment=None if step.depth is None else self._depth(step.depth),
        )
        first = step.drawn_to[0]
        viewport, drawn_to = step.areas(*self._textures[first.texture].size(first.level))
        drawing.set_viewport(*viewport, 0.0, 1.0)
        drawing.set_scissor_rect(*drawn_to)
        drawing.set_blend_constant(step.blend_constant)
        for drawn in step.draws:
            self._draw_one(drawing, step, drawn)
        drawing.end()

    def _target(self, attachment: Attachment) -> Mapping[str, Any]:
        if attachment.layers > 1:
            raise DriverError("WebGPU draws to one layer at a time")
        found = {
            "view": self._textures[attachment.texture].part(attachment.layer, attachment.level),
            "clear_value": attachment.clear,
            "load_op": _LOADS[attachment.loads],
            "store_op": _STORES[attachment.stores],
        }
        if (resolve := attachment.resolve) is not None:
            found["resolve_target"] = self._textures[resolve.texture].part(
                resolve.layer, resolve.level
            )
        return found

    def _depth(self, attachment: Attachment) -> Mapping[str, Any]:
        made = self._textures[attachment.texture]
        found = {
            "view": made.part(attachment.layer, attachment.level),
            "depth_clear_value": attachment.clear[0],
            "depth_load_op": _LOADS[attachment.loads],
            "depth_store_op": _STORES[attachment.stores],
        }
        if made.description.has_stencil:
            found |= {
                "stencil_clear_value": 0,
                "stencil_load_op": _LOADS[attachment.loads],
                "stencil_store_op": _STORES[attachment.stores_stencil],
            }
        return found

    def _draw_one(self, drawing: Any, step: FrameStep, drawn: FrameDraw) -> None:
        draw, pipeline = drawn.draw, self._job.pipelines[drawn.pipeline]
        assert draw is not None
        depths = None if step.depth is None else self._job.textures[step.depth.texture].format
        key = drawn.pipeline, depths
        if key not in self._pipelines:
            self._pipelines[key] = make_pipeline(self._gpu, pipeline, depths)
        made = self._pipelines[key]
        if not draw.indices:  # A buffer of no bytes cannot be made.
            return
        drawing.set_pipeline(made.handle)
        if pipeline.stencil is not None:
            drawing.set_stencil_reference(pipeline.stencil.reference)
        for number, group in enumerate(self._bound(made, drawn, draw, ())):
            drawing.set_bind_group(number, group)
        for number, buffer in enumerate(made.buffers):
            data = interleaved(buffer, draw.vertices)
            drawing.set_vertex_buffer(number, self._uploads.buffer(data, wgpu.BufferUsage.VERTEX))
        indices = self._uploads.buffer(draw.indices, wgpu.BufferUsage.INDEX)
        drawing.set_index_buffer(indices, "uint32")
        drawing.draw_indexed(len(draw.indices) // 4, draw.instance_count)

    # --- kernels ---------------------------------------------------------------------------------

    def _run(self, encoder: Any, step: FrameStep) -> None:
        (drawn,) = step.draws
        pipeline, dispatch = self._job.pipelines[drawn.pipeline], drawn.dispatch
        assert dispatch is not None
        key = drawn.pipeline, None
        if key not in self._pipelines:
            self._pipelines[key] = make_kernel(self._gpu, pipeline)
        made = self._pipelines[key]
        running = encoder.begin_compute_pass()
        running.set_pipeline(made.handle)
        for number, group in enumerate(self._bound(made, drawn, dispatch, step.images)):
            running.set_bind_group(number, group)
        running.dispatch_workgroups(*step.groups)
        running.end()

    def _bound(
        self,
        made: MadePipeline,
        drawn: FrameDraw,
        given: Draw | Dispatch,
        images: Sequence[int],
    ) -> list[Any]:
        """The bind groups of a draw, over the resources that it carries and those of the frame."""
        own_textures, own_buffers = iter(given.textures), iter(given.buffers)
        views = [
            self._uploads.view(next(own_textures))
            if number == OWN
            else self._textures[number].view(is_read=True)
            for number in drawn.textures
        ]
        storage = [
            self._uploads.buffer(next(own_buffers), wgpu.BufferUsage.STORAGE)
            if number == OWN
            else self._buffers[number]
            for number in drawn.buffers
        ]
        written = [self._textures[number].view() for number in images]
        return bind_groups(self._uploads, made, given.blocks, views, storage, written)
