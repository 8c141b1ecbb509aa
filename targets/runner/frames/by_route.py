"""Draws a frame with a driver: makes a frame job of the plan, and returns what is read back.

All frames that are asked for are steps of one job, so that textures which one frame leaves for the
next stay on the device. ``states.py`` makes a job of single shaders by the same steps.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ....compiler.documents.plan import (
    AttachmentRow,
    CopyStep,
    DrawStep,
    PlanStep,
    ResolveRow,
    RunStep,
    TextureState,
    WaitingRow,
)
from ....support.frozen import changed
from ...toolchain import Toolchain
from ..binding import pipeline
from ..codes import Codes, compile_one
from ..drivers.draws import Dispatch, Draw
from ..drivers.frame_job import OWN, Attachment, Barrier, Found, FrameDraw, FrameJob, FrameStep
from ..drivers.pipeline import Pipeline
from ..drivers.readback import layers_of
from ..kernels import dispatch_of, full_screen_state, has_images, image_dispatch
from ..routes import Route
from ..runner import Runner
from .checks.rows import END
from .host import FrameHost
from .job_resources import JobParts, JobResources
from .step_draws import StepDraw as HostDraw
from .step_draws import StepDraws

Floats = NDArray[np.float64]
Given = TypeVar("Given", Draw, Dispatch)


def draw_frames(
    host: FrameHost, route: Route, runner: Runner, toolchain: Toolchain, count: int = 1
) -> list[dict[str, Floats]]:
    """The outputs of some frames, by name, with their top rows first: (layers, height, width, 4).

    Raises ``CodeError`` if a compiler refuses a text, and ``DriverError``.
    """
    codes = [compile_one(route, shader.files, toolchain) for shader in host.shaders]
    names = [row.name for row in host.plan.outputs if row.texture is not None]
    job = frame_job(host, route, codes, names, count)
    found = upright(job, runner.draw_frame(route, job))
    return [{name: next(found) for name in names} for _ in range(count)]


def frame_job(
    host: FrameHost, route: Route, codes: Sequence[Codes], outputs: Sequence[str], count: int
) -> FrameJob:
    """The job of a driver that draws some frames, and reads these outputs of each back.

    ``codes`` are those of the plan's shaders.
    """
    parts = JobParts(
        tuple(
            pipeline(shader.reflection, route, code)
            for shader, code in zip(host.shaders, codes, strict=True)
        )
    )
    steps = HostSteps(host, StepDraws(host), parts)
    for number in range(count):
        steps.add_frame(number)
        steps.add_reading(outputs)
    return parts.whole()


def upright(job: FrameJob, found: Found) -> Iterator[Floats]:
    """The textures that a job has read back, with their top rows first.

    Texts of frames draw the top row to the first row of a texture. Those of single materials for
    OpenGL and its relatives begin with the bottom row; but not kernels that write images
    themselves.
    """
    is_turned = any(made.first_row == "bottom" and not made.images for made in job.pipelines)
    for each in found.texels:
        layers = layers_of(each)
        yield layers[:, ::-1] if is_turned else layers


class HostSteps:
    """Adds the steps of a host's frames to a job."""

    def __init__(
        self, host: FrameHost, draws: StepDraws, parts: JobParts, *, writes_to_black: bool = False
    ) -> None:
        """``writes_to_black`` is that of ``JobResources``."""
        self._host = host
        self._draws = draws
        self._plan = host.plan
        self._pipelines = parts.pipelines
        self._steps = parts.steps
        self._resources = JobResources(
            host,
            parts,
            _use_of_written_images(host, parts.pipelines),
            writes_to_black=writes_to_black,
        )

    def add_frame(self, number: int) -> None:
        """Add the steps of one frame; ``number`` is that of the frames before it."""
        is_first = number == 0
        self._host.begin(number)
        self._resources.begin(is_first=is_first)
        for step in self._plan.steps:
            if is_first or not step.only_first:
                self._steps += self._translated(step, is_first)
            else:
                self._wait_at(step, is_first)
        self._wait_at(self._plan.end, is_first)
        self._resources.end()

    def add_reading(self, outputs: Sequence[str]) -> None:
        """Read these outputs back."""
        textures = [self._plan.output_texture(name) for name in outputs]
        read = tuple(self._resources.texture(each) for each in textures if each is not None)
        results = {row.name: row.result for row in self._plan.outputs if row.texture is None}
        buffers = tuple(
            self._resources.left_buffer(results[each]) for each in outputs if each in results
        )
        there = dict.fromkeys(read)
        barriers = tuple(Barrier(number, "sampled", "copied_from") for number in there)
        name = f"the outputs of {self._plan.frame}"
        self._steps.append(FrameStep(barriers, read=read, read_buffers=buffers, name=name))
        if there:
            again = tuple(Barrier(number, "copied_from", "sampled") for number in there)
            self._steps.append(FrameStep(again, name=name))

    # --- steps -----------------------------------------------------------------------------------

    def _translated(self, step: PlanStep, is_first: bool) -> list[FrameStep]:
        match step:
            case CopyStep():
                return [self._copied(step, is_first)]
            case RunStep():
                return [self._run(step, is_first)]
            case DrawStep():
                return self._drawn(step, is_first)

    def _called(self, place: PlanStep | WaitingRow) -> str:
        """A step of the plan as errors of drivers call it."""
        name = END if isinstance(place, WaitingRow) else place.name
        return f"{self._plan.frame}, {name}"

    def _wait_at(self, place: PlanStep | WaitingRow, is_first: bool) -> None:
        """Wait at barriers without a step: at the end, or in place of a step of the first frame."""
        barriers = self._resources.barriers(place, is_first=is_first)
        buffers = self._resources.buffer_barriers(place, is_first=is_first)
        if barriers or buffers:
            name = self._called(place)
            self._steps.append(FrameStep(barriers, buffer_barriers=buffers, name=name))

    def _copied(self, step: CopyStep, is_first: bool) -> FrameStep:
        barriers = self._resources.barriers(step, is_first=is_first)
        source, target = (self._resources.texture(end.texture) for end in (step.copied, step.into))
        return FrameStep(barriers, copied=(source, target), name=self._called(step))

    def _drawn(self, step: DrawStep, is_first: bool) -> list[FrameStep]:
        barriers = self._resources.barriers(step, is_first=is_first)
        draws = list(self._draws.of(step, is_first=is_first))
        for draw in draws:
            self._tell_counts(draw)
        # The draw of each layer, for shaders that draw to one layer at a time, or the only one.
        given = [draw.state.draws() for draw in draws]
        found, state = [], self._host.state_of(step)
        buffers = self._resources.buffer_barriers(step, is_first=is_first)
        # One draw reaches all layers by a geometry stage, or as views; else each has its own draws.
        pipeline = self._pipelines[step.draws[0].uses[0].shader]
        at_once = pipeline.layers or 1
        whole = self._plan.textures[step.attachments[0].texture].layers
        drawn = 1 if step.attachments[0].layer is not None else whole // at_once
        for layer in range(drawn):
            depth = None if step.depth is None else self._attachment(step.depth, layer, at_once)
            found.append(
                FrameStep(
                    barriers if layer == 0 else (),
                    tuple(self._attachment(target, layer, at_once) for target in step.targets),
                    depth,
                    tuple(
                        self._draw(draw, each[layer if len(each) > 1 else 0])
                        for draw, each in zip(draws, given, strict=True)
                    ),
                    state.viewport,
                    state.scissor,
                    state.blend_constant,
                    pipeline.view_mask,
                    buffer_barriers=buffers if layer == 0 else (),
                    name=self._called(step),
                )
            )
        if step.continues:
            (alone,) = found
            return _drawn_on(self._steps.pop(), alone)
        return found

    def _attachment(self, target: AttachmentRow, layer: int, layers: int) -> Attachment:
        at = layer if target.layer is None else target.layer
        stencil = target.stencil
        return Attachment(
            self._resources.texture(target.texture), at, layers, target.level,
            target.load == "load", target.store, stencil is not None and stencil.store,
            self._host.clear_of(target), self._resolve(target.resolve),
        )  # fmt: skip

    def _resolve(self, row: ResolveRow | None) -> ResolveRow | None:
        if row is None:
            return None
        return changed(row, texture=self._resources.texture(row.texture))

    def _draw(self, draw: HostDraw, given: Draw) -> FrameDraw:
        textures, buffers = self._bound(draw)
        return FrameDraw(draw.shader, textures, buffers, _carried(given, textures, buffers))

    def _textures_of(self, shader: int) -> list[str]:
        """The names of the textures that a shader reads."""
        rows = self._host.shaders[shader].reflection.textures
        return [row.name for row in rows if row.stages]

    def _buffers_of(self, shader: int) -> list[str]:
        """The names of the storage buffers that a shader reads."""
        rows = self._host.shaders[shader].reflection.buffers
        return [row.name for row in rows if row.stages]

    def _tell_counts(self, draw: HostDraw) -> None:
        """Set a shader's counts of elements in the buffers that kernels have written.

        The zeros in these elements stay here: the shader reads the job's own buffer.
        """
        for name, read in draw.reads.items():
            if read.texture is None:
                zeros = bytes(self._resources.buffer_size(read.result))
                draw.state.instance.set_bytes(name, zeros)

    def _bound(self, draw: HostDraw) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """For each texture and buffer that a shader reads, the job's own one or a new one."""
        textures = tuple(
            self._resources.texture(read.texture)
            if read is not None and read.texture is not None
            else OWN
            for read in map(draw.reads.get, self._textures_of(draw.shader))
        )
        buffers = tuple(
            OWN if read is None else self._resources.buffer(read.result)
            for read in map(draw.reads.get, self._buffers_of(draw.shader))
        )
        return textures, buffers

    def _run(self, step: RunStep, is_first: bool) -> FrameStep:
        draw = self._draws.kernel(step, is_first=is_first)
        self._tell_counts(draw)
        barriers = self._resources.barriers(step, is_first=is_first)
        instance, reflection = draw.state.instance, draw.state.instance.reflection
        textures, buffers = self._bound(draw)
        images = tuple(self._resources.texture(row.texture) for row in step.images)
        described = self._pipelines[draw.shader]
        if has_images(reflection):
            given = self._draws.given or full_screen_state(instance)
            if not described.images:
                return replace(
                    self._run_as_pass(replace(draw, state=given), barriers, images),
                    buffer_barriers=self._resources.buffer_barriers(step, is_first=is_first),
                    name=self._called(step),
                )
            dispatch = image_dispatch(given.draw())
        else:
            dispatch = dispatch_of(instance)
            buffers = (*buffers, *self._resources.written(step, dispatch.buffers[len(buffers) :]))
        assert reflection.work_group is not None, "it is a kernel"
        carried = _carried(dispatch, textures, buffers)
        return FrameStep(
            barriers, draws=(FrameDraw(draw.shader, textures, buffers, dispatch=carried),),
            images=images, groups=dispatch.groups(reflection.work_group),
            buffer_barriers=self._resources.buffer_barriers(step, is_first=is_first),
            name=self._called(step),
        )  # fmt: skip

    def _run_as_pass(
        self, draw: HostDraw, barriers: tuple[Barrier, ...], images: tuple[int, ...]
    ) -> FrameStep:
        """A kernel over images, on routes that draw these."""
        cleared = zip(images, draw.state.clear, strict=True)
        targets = tuple(Attachment(number, clear=clear) for number, clear in cleared)
        return FrameStep(barriers, targets, None, (self._draw(draw, draw.state.draw()),))


def _carried(given: Given, textures: Sequence[int], buffers: Sequence[int]) -> Given:
    """A draw or a dispatch with only the textures and buffers that it brings itself."""
    return replace(
        given,
        textures=tuple(
            image for image, number in zip(given.textures, textures, strict=True) if number == OWN
        ),
        buffers=tuple(
            data for data, number in zip(given.buffers, buffers, strict=True) if number == OWN
        ),
    )


def _drawn_on(before: FrameStep, step: FrameStep) -> list[FrameStep]:
    """Two steps that draw to the same attachments, as one render pass if that is possible.

    The pass begins as the first step does, and leaves what the second one leaves. Its resolve
    targets are ready from the beginning. The steps stay two if their settings differ.
    """
    settings = [
        (each.viewport, each.scissor, each.blend_constant, each.view_mask)
        for each in (before, step)
    ]
    if settings[0] != settings[1]:
        return [before, step]

    def joined(first: Attachment, second: Attachment) -> Attachment:
        return replace(second, loads=first.loads, clear=first.clear)

    depth = step.depth and before.depth and joined(before.depth, step.depth)
    targets = tuple(map(joined, before.targets, step.targets))
    draws = (*before.draws, *step.draws)
    resolved = {each.resolve.texture for each in step.targets if each.resolve is not None}
    waiting = (each for each in step.barriers if each.texture in resolved)
    barriers = (*before.barriers, *waiting)
    return [replace(before, barriers=barriers, targets=targets, depth=depth, draws=draws)]


def _use_of_written_images(host: FrameHost, pipelines: Sequence[Pipeline]) -> TextureState:
    """The use of the plan's images that kernels write: some routes draw them in a pass."""
    drawn = any(
        has_images(shader.reflection) and not made.images
        for shader, made in zip(host.shaders, pipelines, strict=True)
    )
    return "target" if drawn else "image"
