"""Executes a frame job with OpenGL, step by step. OpenGL itself waits where a barrier stands."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import moderngl

from ..device import DriverError
from ..draws import Dispatch, Draw
from ..frame_job import (
    OWN,
    Attachment,
    Captured,
    Found,
    FrameDraw,
    FrameJob,
    FrameStep,
    FrameTexels,
)
from ..pipeline import Pipeline
from .bindings import Linked, bound, bound_at
from .capture import captured
from .context import (
    GL_COLOR,
    GL_COLOR_ATTACHMENT0,
    GL_COLOR_BUFFER_BIT,
    GL_DRAW_FRAMEBUFFER,
    GL_FRAMEBUFFER,
    GL_NEAREST,
    GL_SCISSOR_TEST,
    Functions,
)
from .formats import clear_depths
from .frame_textures import make_frame_texture
from .program import link, link_kernel
from .state import set_blending, set_state, write_all_lanes
from .vertices import MODES, vertices

NO_ERROR = "GL_NO_ERROR"


class ContextError(DriverError):
    """OpenGL reports an error. The context may be lost, so that another one has to be made."""


def draw_frame(context: moderngl.Context, functions: Functions, job: FrameJob) -> Found:
    """Do a frame job: returns what it reads back, step by step. Raises ``DriverError``."""
    with ExitStack() as owned:
        try:
            found = _Frame(owned, context, functions, job).found()
        except moderngl.Error as error:
            # A text that does not link leaves the context as it was, and nothing is reported.
            kind = DriverError if context.error == NO_ERROR else ContextError
            raise kind(f"OpenGL: {error}") from None
    if (reported := context.error) != NO_ERROR:
        raise ContextError(f"OpenGL reports {reported}")
    return found


class _Frame:
    """Everything that a frame job makes."""

    def __init__(
        self, owned: ExitStack, context: moderngl.Context, functions: Functions, job: FrameJob
    ) -> None:
        self._owned = owned
        self._context = context
        self._functions = functions
        self._job = job
        self._textures = [make_frame_texture(functions, texture) for texture in job.textures]
        for texture in self._textures:
            owned.callback(texture.release)
        self._buffers = [context.buffer(each.contents) for each in job.buffers]
        self._programs: dict[int, Any] = {}

    def found(self) -> Found:
        """Do all steps."""
        for texture in self._textures:
            if texture.description.is_black:
                texture.clear()
        texels: list[FrameTexels] = []
        contents: list[bytes] = []
        captured: list[Captured] = []
        for step in self._job.steps:
            if step.captures is not None:
                captured.append(self._captured(step.draws[0], step.captures))
            else:
                self._do(step)
            texels += (self._textures[number].read() for number in step.read)
            contents += (self._buffers[number].read() for number in step.read_buffers)
        return Found(tuple(texels), tuple(contents), tuple(captured))

    def _do(self, step: FrameStep) -> None:
        if step.copied:
            source, target = (self._textures[number] for number in step.copied)
            source.copy_to(target)
        elif step.drawn_to:
            self._draw(step)
        elif step.draws:
            self._run(step)

    def _program(self, drawn: FrameDraw) -> Any:
        if drawn.pipeline not in self._programs:
            pipeline = self._job.pipelines[drawn.pipeline]
            make = link if drawn.dispatch is None else link_kernel
            program = make(self._context, self._functions, pipeline)
            self._owned.callback(program.release)
            self._programs[drawn.pipeline] = program
        return self._programs[drawn.pipeline]

    def _draw(self, step: FrameStep) -> None:
        first = step.drawn_to[0]
        width, height = self._textures[first.texture].size(first.level)
        for drawn in step.draws:
            self._program(drawn)  # moderngl may bind a framebuffer when it links
        with self._framebuffer(step):
            write_all_lanes(self._functions, len(step.targets))
            for number, target in enumerate(step.targets):
                self._clear(target, number)
            if step.depth is not None and not step.depth.loads:
                made = self._textures[step.depth.texture]
                clear_depths(self._functions, step.depth.clear[0], made.point(0))
            with self._within(step, width, height):
                for drawn in step.draws:
                    self._draw_one(step, drawn)
            self._resolve(step, width, height)

    @contextmanager
    def _within(self, step: FrameStep, width: int, height: int) -> Iterator[None]:
        """Draw to the viewport and the scissor of a step, which count from the first row: texts
        of frames have the top one there."""
        viewport, drawn_to = step.areas(width, height)
        self._functions.glViewport(*viewport)
        self._functions.glScissor(*drawn_to)
        self._functions.glEnable(GL_SCISSOR_TEST)
        try:
            yield
        finally:
            self._functions.glDisable(GL_SCISSOR_TEST)

    def _resolve(self, step: FrameStep, width: int, height: int) -> None:
        """Write the means of samples from the bound framebuffer to the resolve targets."""
        functions = self._functions
        for number, target in enumerate(step.targets):
            if target.resolve is None:
                continue
            with self._bound_framebuffer(GL_DRAW_FRAMEBUFFER):
                made = self._textures[target.resolve.texture]
                made.attach(target.resolve, 0, GL_DRAW_FRAMEBUFFER)
                functions.glReadBuffer(GL_COLOR_ATTACHMENT0 + number)
                area = (0, 0, width, height)
                functions.glBlitFramebuffer(*area, *area, GL_COLOR_BUFFER_BIT, GL_NEAREST)

    @contextmanager
    def _bound_framebuffer(self, to: int) -> Iterator[None]:
        """A new framebuffer, with nothing attached yet."""
        functions, name = self._functions, ctypes.c_uint()
        functions.glGenFramebuffers(1, ctypes.byref(name))
        functions.glBindFramebuffer(to, name)
        try:
            yield
        finally:
            functions.glBindFramebuffer(to, 0)
            functions.glDeleteFramebuffers(1, ctypes.byref(name))

    @contextmanager
    def _framebuffer(self, step: FrameStep) -> Iterator[None]:
        """A framebuffer with all attachments of a step."""
        with self._bound_framebuffer(GL_FRAMEBUFFER):
            self._attach(step)
            yield

    def _attach(self, step: FrameStep) -> None:
        for number, target in enumerate(step.targets):
            self._textures[target.texture].attach(target, number)
        if step.depth is not None:
            self._textures[step.depth.texture].attach(step.depth, 0)
        drawn = [GL_COLOR_ATTACHMENT0 + number for number in range(len(step.targets))] or [0]
        self._functions.glDrawBuffers(len(drawn), (ctypes.c_uint * len(drawn))(*drawn))

    def _clear(self, target: Attachment, number: int) -> None:
        if not target.loads:
            lanes = (ctypes.c_float * len(target.clear))(*target.clear)
            self._functions.glClearBufferfv(GL_COLOR, number, lanes)

    def _draw_one(self, step: FrameStep, drawn: FrameDraw) -> None:
        draw, pipeline = drawn.draw, self._job.pipelines[drawn.pipeline]
        assert draw is not None
        if not draw.indices:  # A buffer of no bytes cannot be made.
            return
        set_state(self._context, self._functions, pipeline, has_depth=step.depth is not None)
        set_blending(self._functions, pipeline.targets, step.blend_constant)
        program = self._program(drawn)
        with (
            vertices(self._context, program, pipeline, draw) as array,
            self._bound(program, pipeline, drawn, draw),
        ):
            array.render(MODES[pipeline.primitive], instances=draw.instance_count)

    def _captured(self, drawn: FrameDraw, most: int) -> Captured:
        """The vertices that a draw captures: ``most`` at most."""
        draw, pipeline = drawn.draw, self._job.pipelines[drawn.pipeline]
        assert draw is not None
        program = self._program(drawn)
        if not draw.indices:  # A buffer of no bytes cannot be made.
            return Captured(0, b"")
        with (
            vertices(self._context, program, pipeline, draw) as array,
            self._bound(program, pipeline, drawn, draw),
        ):
            return captured(self._context, self._functions, pipeline, draw, (program, array), most)

    def _run(self, step: FrameStep) -> None:
        (drawn,) = step.draws
        pipeline, dispatch = self._job.pipelines[drawn.pipeline], drawn.dispatch
        assert dispatch is not None
        program = self._program(drawn)
        with self._bound(program, pipeline, drawn, dispatch):
            for number, (slot, image) in enumerate(zip(pipeline.images, step.images, strict=True)):
                self._textures[image].bind_image(bound_at(slot.place, number))
            if all(step.groups):
                program.run(*step.groups)
            self._context.memory_barrier()

    @contextmanager
    def _bound(
        self, program: Linked, pipeline: Pipeline, drawn: FrameDraw, values: Draw | Dispatch
    ) -> Iterator[None]:
        """Bind the resources that a draw carries, and those of the frame."""
        images, contents = iter(values.textures), iter(values.buffers)
        textures: list[Any] = [
            next(images) if number == OWN else self._textures[number] for number in drawn.textures
        ]
        buffers = [
            self._context.buffer(next(contents)) if number == OWN else self._buffers[number]
            for number in drawn.buffers
        ]
        given = values.blocks, textures, buffers
        with bound(self._context, self._functions, program, pipeline, *given):
            yield
