"""Draws a frame with a driver: makes a frame job of the plan, and returns what is read back.

All frames that are asked for are steps of one job, so that textures which one frame leaves for the
next stay on the device.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ....compiler.budget import Tally, check
from ....compiler.documents.plan import (
    AttachmentRow,
    CopyStep,
    DrawStep,
    FramePlan,
    KeptRow,
    PlanStep,
    ResolveRow,
    RunStep,
    WaitingRow,
)
from ....compiler.ir.formats import DEPTH_WORDS
from ...toolchain import Toolchain
from ..binding import FORMATS, pipeline
from ..codes import Codes, compile_one
from ..drivers.draws import Dispatch, Draw
from ..drivers.frame_job import (
    OWN,
    Attachment,
    Barrier,
    BufferBarrier,
    FrameBuffer,
    FrameDraw,
    FrameJob,
    FrameStep,
    FrameTexture,
    Resolve,
    TextureUse,
)
from ..drivers.pipeline import Pipeline
from ..drivers.readback import layers_of
from ..kernels import dispatch_of, full_screen_state, has_images, image_dispatch
from ..routes import Route
from ..runner import Runner
from .host import FrameHost
from .host import StepDraw as HostDraw
from .memory import bytes_of, taking_turns

Floats = NDArray[np.float64]
Given = TypeVar("Given", Draw, Dispatch)

WORD = 4
"""The bytes of a word."""


def draw_frames(
    host: FrameHost, route: Route, runner: Runner, toolchain: Toolchain, count: int = 1
) -> list[dict[str, Floats]]:
    """The outputs of some frames, by name: (layers, height, width, 4).

    Raises ``CodeError`` if a compiler refuses a text, and ``DriverError``.
    """
    codes = [compile_one(route, shader.files, toolchain) for shader in host.shaders]
    names = [row.name for row in host.plan.outputs if row.texture is not None]
    found = iter(runner.draw_frame(route, frame_job(host, route, codes, names, count)).texels)
    return [{name: layers_of(next(found)) for name in names} for _ in range(count)]


def frame_job(
    host: FrameHost, route: Route, codes: Sequence[Codes], outputs: Sequence[str], count: int
) -> FrameJob:
    """The job of a driver that draws some frames, and reads these outputs of each back.

    ``codes`` are those of the plan's shaders.
    """
    job = _Job(host, route, codes)
    for number in range(count):
        job.add_frame(number)
        job.add_reading(outputs)
    return job.whole()


@dataclass(slots=True)
class _Textures:
    """The textures of the job, and the present texture of the job for each of the plan."""

    made: list[FrameTexture] = field(default_factory=list)
    uses: list[TextureUse] = field(default_factory=list)
    at: dict[int, int] = field(default_factory=dict)
    """The present textures, by the plan's numbers."""


class _Job:
    def __init__(self, host: FrameHost, route: Route, codes: Sequence[Codes]) -> None:
        self._host = host
        self._plan = host.plan
        self._pipelines: list[Pipeline] = [
            pipeline(shader.reflection, route, code)
            for shader, code in zip(host.shaders, codes, strict=True)
        ]
        self._written_as = _use_of_written_images(host, self._pipelines)
        self._textures = _Textures()
        self._buffers: list[FrameBuffer] = []
        self._buffer_of: dict[str, int] = {}
        self._bytes = Tally("memory", f"the buffers and textures of {host.plan.frame} take")
        """Bytes of the buffers and textures that kernels write: their sizes are known when the
        kernels are run. ``_shared_memory`` counts all other textures."""
        self._memory: dict[int, int] = {}
        """For textures of the plan that share memory in turn, the number of that memory."""
        self._steps: list[FrameStep] = []

    def add_frame(self, number: int) -> None:
        """Add the steps of one frame; ``number`` is that of the frames before it."""
        is_first = number == 0
        self._host.begin(number)
        if is_first:
            self._memory = _shared_memory(self._host)
        for row in self._plan.kept:
            for texture in (row.texture, row.previous):
                if texture is not None and texture not in self._textures.at:
                    self._make(texture, is_black=texture == row.previous)
        for step in self._plan.steps:
            if is_first or not step.only_first:
                self._steps += self._translated(step, is_first)
            else:
                self._wait_at(step, is_first)
        self._wait_at(self._plan.end, is_first)
        for row in self._plan.kept:
            self._exchange(row)

    def add_reading(self, outputs: Sequence[str]) -> None:
        """Read these outputs back."""
        read = [self._output(name) for name in outputs]
        there = dict.fromkeys(read)
        barriers = tuple(Barrier(number, "sampled", "copied_from") for number in there)
        self._steps.append(FrameStep(barriers, read=tuple(read)))
        again = tuple(Barrier(number, "copied_from", "sampled") for number in there)
        self._steps.append(FrameStep(again))

    def whole(self) -> FrameJob:
        """The job."""
        return FrameJob(
            tuple(self._textures.made),
            tuple(self._buffers),
            tuple(self._pipelines),
            tuple(self._steps),
        )

    def _output(self, name: str) -> int:
        return self._textures.at[_texture_of(self._plan, name)]

    # --- textures and buffers --------------------------------------------------------------------

    def _make(self, number: int, *, is_black: bool = False) -> int:
        row = self._plan.textures[number]
        width, height = self._host.size_of(number)
        if row.size.value is None:
            self._bytes.add(bytes_of(row, (width, height)))
        name: Any = DEPTH_WORDS.get(row.format) or FORMATS[row.format]
        self._textures.made.append(
            FrameTexture(
                name,
                width,
                height,
                row.layers,
                row.levels,
                row.dimension,
                is_black,
                row.samples,
                self._memory.get(number),
            )
        )
        self._textures.uses.append("sampled" if is_black else "undefined")
        self._textures.at[number] = len(self._textures.made) - 1
        return self._textures.at[number]

    def _texture(self, number: int) -> int:
        found = self._textures.at.get(number)
        return self._make(number) if found is None else found

    def _exchange(self, row: KeptRow) -> None:
        one, other = row.texture, row.previous
        if one is None or other is None:
            name = row.result
            self._buffer_of[f"previous({name})"] = self._buffer_of.pop(name)
            return
        at = self._textures.at
        at[one], at[other] = at[other], at[one]

    # --- steps -----------------------------------------------------------------------------------

    def _translated(self, step: PlanStep, is_first: bool) -> list[FrameStep]:
        match step:
            case CopyStep():
                return [self._copied(step, is_first)]
            case RunStep():
                return [self._run(step, is_first)]
            case DrawStep():
                return self._drawn(step, is_first)

    def _wait_at(self, place: PlanStep | WaitingRow, is_first: bool) -> None:
        """Wait at barriers without a step: at the end, or in place of a step of the first frame."""
        barriers = self._barriers(place, is_first)
        buffers = self._buffer_barriers(place, is_first)
        if barriers or buffers:
            self._steps.append(FrameStep(barriers, buffer_barriers=buffers))

    def _barriers(self, place: PlanStep | WaitingRow, is_first: bool) -> tuple[Barrier, ...]:
        found = []
        for row in place.barriers:
            if row.only_first and not is_first:
                continue
            number = self._texture(row.texture)
            before, after = self._use(row.before), self._use(row.after)
            if before == "undefined" and self._textures.made[number].memory is None:
                # The last frame may still read the contents that it left there.
                before = self._textures.uses[number]
            found.append(Barrier(number, before, after))
            self._textures.uses[number] = after
        return tuple(found)

    def _buffer_barriers(
        self, place: PlanStep | WaitingRow, is_first: bool
    ) -> tuple[BufferBarrier, ...]:
        """The barriers of the job's own buffers; a kernel's buffers have been made."""
        return tuple(
            BufferBarrier(self._buffer_of[row.result], row.before, row.after)
            for row in place.buffer_barriers
            if is_first or not row.only_first
        )

    def _use(self, planned: TextureUse) -> TextureUse:
        return self._written_as if planned == "image" else planned

    def _copied(self, step: CopyStep, is_first: bool) -> FrameStep:
        barriers = self._barriers(step, is_first)
        source, target = (self._texture(end.texture) for end in (step.copied, step.into))
        return FrameStep(barriers, copied=(source, target))

    def _drawn(self, step: DrawStep, is_first: bool) -> list[FrameStep]:
        barriers = self._barriers(step, is_first)
        draws = list(self._host.draws(step, is_first=is_first))
        for draw in draws:
            self._tell_counts(draw)
        found, state = [], self._host.state_of(step)
        buffers = self._buffer_barriers(step, is_first)
        # A geometry stage reaches all layers in one draw; otherwise, each has draws of its own.
        at_once = self._pipelines[step.draws[0].uses[0].shader].layers or 1
        whole = self._plan.textures[step.attachments[0].texture].layers
        drawn = 1 if step.attachments[0].layer is not None else whole // at_once
        for layer in range(drawn):
            depth = None if step.depth is None else self._attachment(step.depth, layer, at_once)
            found.append(
                FrameStep(
                    barriers if layer == 0 else (),
                    tuple(self._attachment(target, layer, at_once) for target in step.targets),
                    depth,
                    tuple(self._draw(draw, layer) for draw in draws),
                    state.viewport,
                    state.scissor,
                    state.blend_constant,
                    buffer_barriers=buffers if layer == 0 else (),
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
            self._texture(target.texture), at, layers, target.level, target.load == "load",
            target.store, stencil is not None and stencil.store,
            self._host.clear_of(target), self._resolve(target.resolve),
        )  # fmt: skip

    def _resolve(self, row: ResolveRow | None) -> Resolve | None:
        if row is None:
            return None
        return Resolve(self._texture(row.texture), row.layer, row.level)

    def _draw(self, draw: HostDraw, layer: int) -> FrameDraw:
        state = draw.state.layers[layer] if draw.state.layers else draw.state
        textures, buffers = self._bound(draw)
        given = replace(state.draw(), layers=())
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
                words = self._buffers[self._buffer_of[read.result]].words
                draw.state.instance.set_bytes(name, bytes(words * WORD))

    def _bound(self, draw: HostDraw) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """For each texture and buffer that a shader reads, the job's own one or a new one."""
        textures = tuple(
            self._texture(read.texture) if read is not None and read.texture is not None else OWN
            for read in map(draw.reads.get, self._textures_of(draw.shader))
        )
        buffers = tuple(
            OWN if read is None else self._buffer_of[read.result]
            for read in map(draw.reads.get, self._buffers_of(draw.shader))
        )
        return textures, buffers

    def _run(self, step: RunStep, is_first: bool) -> FrameStep:
        draw = self._host.kernel(step, is_first=is_first)
        self._tell_counts(draw)
        barriers = self._barriers(step, is_first)
        instance, reflection = draw.state.instance, draw.state.instance.reflection
        textures, buffers = self._bound(draw)
        images = tuple(self._texture(row.texture) for row in step.images)
        described = self._pipelines[draw.shader]
        if has_images(reflection):
            given = full_screen_state(instance)
            if not described.images:
                return replace(
                    self._run_as_pass(replace(draw, state=given), barriers, images),
                    buffer_barriers=self._buffer_barriers(step, is_first),
                )
            dispatch = image_dispatch(given.draw())
        else:
            dispatch = dispatch_of(instance)
            buffers = (*buffers, *self._written(step, dispatch, len(buffers)))
        assert reflection.work_group is not None, "it is a kernel"
        carried = _carried(dispatch, textures, buffers)
        return FrameStep(
            barriers, draws=(FrameDraw(draw.shader, textures, buffers, dispatch=carried),),
            images=images, groups=dispatch.groups(reflection.work_group),
            buffer_barriers=self._buffer_barriers(step, is_first),
        )  # fmt: skip

    def _written(self, step: PlanStep, dispatch: Dispatch, first: int) -> list[int]:
        """The job's buffers for a kernel's results; each run has new ones."""
        found = []
        for row, data in zip(step.buffers, dispatch.buffers[first:], strict=True):
            self._bytes.add(len(data))
            initial = int.from_bytes(data[:WORD], "little")
            self._buffers.append(FrameBuffer(len(data) // WORD, initial))
            found.append(len(self._buffers) - 1)
            self._buffer_of[row.result] = found[-1]
        return found

    def _run_as_pass(
        self, draw: HostDraw, barriers: tuple[Barrier, ...], images: tuple[int, ...]
    ) -> FrameStep:
        """A kernel over images, on routes that draw these."""
        targets = tuple(Attachment(number) for number in images)
        return FrameStep(barriers, targets, None, (self._draw(draw, 0),))


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


def _texture_of(plan: FramePlan, output: str) -> int:
    """The texture of an output that is a picture."""
    texture = plan.output_texture(output)
    assert texture is not None, "it is no buffer"
    return texture


def _drawn_on(before: FrameStep, step: FrameStep) -> list[FrameStep]:
    """Two steps that draw to the same attachments, as one render pass if that is possible.

    The pass begins as the first step does, and leaves what the second one leaves. Its resolve
    targets are ready from the beginning. The steps stay two if their settings differ.
    """
    settings = [(each.viewport, each.scissor, each.blend_constant) for each in (before, step)]
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


def _shared_memory(host: FrameHost) -> dict[int, int]:
    """A number of memory for each texture that shares it with others in turn.

    Sizes that a kernel determines are known too late.
    """
    rows = host.plan.textures
    known = [number for number, row in enumerate(rows) if row.size.value is not None]
    needed = {number: bytes_of(rows[number], host.size_of(number)) for number in known}
    groups = taking_turns(host.plan, needed)
    said = f"the textures of {host.plan.frame} take"
    check("memory", sum(max(needed.get(each, 0) for each in group) for group in groups), said)
    groups = [group for group in groups if len(group) > 1]
    return {texture: number for number, group in enumerate(groups) for texture in group}


def _use_of_written_images(host: FrameHost, pipelines: Sequence[Pipeline]) -> TextureUse:
    """The use of the plan's images that kernels write: some routes draw them in a pass."""
    drawn = any(
        has_images(shader.reflection) and not made.images
        for shader, made in zip(host.shaders, pipelines, strict=True)
    )
    return "target" if drawn else "image"
