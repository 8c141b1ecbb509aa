"""Makes the document of a plan, which hosts execute."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal

from ...support.frozen import cached_property
from ..diagnostics.source import Span
from ..documents.plan import (
    AttachmentRow,
    CopyEnd,
    CopyStep,
    DrawnRow,
    DrawStep,
    FramePlan,
    FrameResultRow,
    FrameTextureRow,
    HostSource,
    HostTextureRow,
    InputRow,
    KeptRow,
    ModelsRow,
    OutputRow,
    PlaceRow,
    PreviousSource,
    ResolveRow,
    ResultSource,
    RunStep,
    ShaderRow,
    SizeRow,
    StencilLoad,
    UseRow,
    ValueRow,
    ValueSource,
    WrittenBuffer,
    WrittenImage,
)
from ..ir.default_textures import OF_SAMPLES
from ..ir.frame import (
    Drawn,
    Elements,
    FrameShader,
    FromHost,
    Given,
    KernelStep,
    Previous,
    RenderStep,
    Source,
    StepTexture,
    Use,
)
from ..ir.leaves import Texture
from ..ir.node import reachable
from ..ir.shader import TextureInfo
from ..ir.types import TextureType
from ..planning.plan import Copy, Plan, PlannedStep, Target
from ..planning.textures import Shape
from .buffers import buffer_row
from .parameters import Places, Reads, light_rows, parameter_rows
from .values import steps

VERSION: Literal[2] = 2
"""Grows when a host that executes plans has to change."""


def plan_document(plan: Plan, reflections: Sequence[str]) -> FramePlan:
    """The document that a host needs to draw a frame, but for the reflections of its shaders.

    These are in files with the names ``reflections``.
    """
    return _Document(plan, reflections).made()


class _Document:
    def __init__(self, plan: Plan, reflections: Sequence[str]) -> None:
        self._plan = plan
        self._reflections = reflections
        self._frame = plan.frame
        self._shaders: Mapping[FrameShader, int] = {
            shader: number for number, shader in enumerate(self._frame.shaders)
        }
        self._previous = {kept.left: kept.previous for kept in plan.kept}
        self._values = {node: n for n, node in enumerate(dict.fromkeys(self._frame.values))}
        """Equal values are one node, and one row."""

    def made(self) -> FramePlan:
        frame = self._frame
        return FramePlan(
            plan=VERSION,
            frame=frame.name,
            doc=frame.doc,
            source=_place(frame.span),
            rig=frame.rig,
            parameters=parameter_rows(frame.parameters, Places(()), self._reads()),
            lights=light_rows(frame.parameters),
            host_textures=tuple(map(self._host_texture_row, frame.textures)),
            host_buffers=tuple(map(buffer_row, frame.buffers)),
            sources=dict(self._sources()),
            models=tuple(
                ModelsRow(
                    name=models.name,
                    materials=tuple(models.materials),
                    doc=models.doc,
                    source=_place(models.span),
                )
                for models in frame.models
            ),
            shaders=tuple(map(_shader_row, frame.shaders, self._reflections)),
            values=tuple(
                ValueRow(representation=str(value.type), steps=steps(value))
                for value in self._values
            ),
            textures=tuple(self._texture_rows()),
            results=tuple(self._result_rows()),
            steps=tuple(map(self._step, self._plan.steps)),
            end=self._plan.end,
            kept=tuple(
                KeptRow(result=kept.left.name, texture=kept.texture, previous=kept.previous)
                for kept in self._plan.kept
            ),
            outputs=tuple(
                OutputRow(
                    name=output.name,
                    result=output.source.name,
                    texture=self._texture(output.source),
                    doc=output.doc,
                    source=_place(output.span),
                )
                for output in frame.outputs
            ),
        )

    def _reads(self) -> Reads:
        """What the values of the frame read, and of lights what its shaders do."""
        found = Reads()
        found.add(reachable(self._frame.values))
        for each in self._frame.shaders:
            of_shader = Reads()
            of_shader.add(reachable(each.shader.roots))
            found.add_of_lights(of_shader, each.shader.parameters)
        return found

    # --- resources ---

    def _sources(self) -> Iterator[tuple[str, PlaceRow]]:
        """Yields the declarations of everything that the host sets."""
        frame = self._frame
        for info in frame.parameters:
            yield info.leaf.name, _place(info.span)
        for texture in frame.textures:
            yield texture.leaf.name, _place(texture.span)
        for buffer in frame.buffers:
            yield buffer.leaf.name, _place(buffer.span)

    def _host_texture_row(self, info: TextureInfo) -> HostTextureRow:
        texture: Texture = info.leaf
        assert isinstance(texture.type, TextureType)
        return HostTextureRow(
            name=texture.name,
            type=str(texture.type),
            dimension=texture.type.dimension,
            sample=texture.type.sample,
            intent=info.intent or ("color" if texture.name in self._colors else "data"),
            group=texture.group,
            default=texture.default,
            default_texel=OF_SAMPLES[texture.type.sample][texture.default],
            doc=info.doc,
        )

    @cached_property
    def _colors(self) -> frozenset[str]:
        """The host's textures whose texels become colours in one of the shaders that read them."""
        return frozenset(
            source.name
            for step in self._frame.steps
            for use in step.uses
            for given in use.given
            for source in _sources_of(given)
            if isinstance(source, FromHost) and given.name in _color_textures(use.shader)
        )

    def _texture_rows(self) -> Iterator[FrameTextureRow]:
        for texture in self._plan.textures:
            shape = texture.shape
            yield FrameTextureRow(
                format=shape.format,
                dimension=shape.dimension,
                size=self._size_row(shape),
                layers=shape.layers,
                levels=shape.levels,
                samples=shape.samples,
                uses=tuple(texture.uses),
                kept=texture.kept,
                results=tuple(each.name for each in texture.images),
            )

    def _size_row(self, shape: Shape) -> SizeRow:
        if isinstance(shape.size, str):
            return SizeRow(value=None, extent_of=shape.size, level=shape.halved)
        return SizeRow(value=self._values[shape.size], extent_of=None, level=shape.halved)

    def _value(self, number: int) -> int:
        """The row of one of the frame's values."""
        return self._values[self._frame.values[number]]

    def _optional(self, number: int | None) -> int | None:
        return None if number is None else self._value(number)

    def _result_rows(self) -> Iterator[FrameResultRow]:
        numbers = {planned.step: n for n, planned in enumerate(self._plan.steps)}
        steps_ = self._frame.steps
        lifetimes = self._plan.lifetimes
        for left, first in lifetimes.first.items():
            last = min(lifetimes.last[left], len(steps_) - 1)
            yield FrameResultRow(
                name=left.name,
                kind="buffer" if isinstance(left, Elements) else "texture",
                texture=self._texture(left),
                first=numbers[steps_[first]],
                last=numbers[steps_[last]],
                doc=left.doc,
                source=_place(left.span),
            )

    def _texture(self, left: StepTexture | Elements) -> int | None:
        return self._plan.texture_of.get(left) if isinstance(left, StepTexture) else None

    # --- steps ---

    def _step(self, planned: PlannedStep) -> DrawStep | RunStep | CopyStep:
        waiting = planned.waiting
        match planned.step:
            case Copy() as copy:
                return CopyStep(
                    kind="copy",
                    barriers=waiting.barriers,
                    buffer_barriers=waiting.buffer_barriers,
                    only_first=planned.only_first,
                    copied=self._copy_end(copy.image),
                    into=self._copy_end(copy.into),
                )
            case RenderStep() as step:
                return DrawStep(
                    kind="draw",
                    name=step.name,
                    pass_=step.pass_name,
                    barriers=waiting.barriers,
                    buffer_barriers=waiting.buffer_barriers,
                    only_first=planned.only_first,
                    continues=planned.continues,
                    targets=tuple(map(self._attachment, planned.targets)),
                    depth=None if planned.depth is None else self._attachment(planned.depth),
                    viewport=self._optional(step.viewport),
                    scissor=self._optional(step.scissor),
                    blend_constant=self._optional(step.blend_constant),
                    draws=tuple(map(self._drawn, step.draws)),
                    source=_place(step.span),
                )
            case KernelStep() as step:
                return RunStep(
                    kind="run",
                    name=step.name,
                    barriers=waiting.barriers,
                    buffer_barriers=waiting.buffer_barriers,
                    only_first=planned.only_first,
                    use=self._used(step.use),
                    images=tuple(
                        WrittenImage(
                            name=name, result=image.name, texture=self._plan.texture_of[image]
                        )
                        for name, image in step.images.items()
                    ),
                    buffers=tuple(
                        WrittenBuffer(name=name, result=elements.name)
                        for name, elements in step.buffers.items()
                    ),
                    source=_place(step.span),
                )

    def _copy_end(self, image: StepTexture) -> CopyEnd:
        return CopyEnd(result=image.name, texture=self._plan.texture_of[image])

    def _attachment(self, target: Target) -> AttachmentRow:
        attachment = target.attachment
        texture, layer, level = target.place
        return AttachmentRow(
            name=attachment.target,
            result=attachment.image.name,
            texture=texture,
            layer=layer,
            level=level,
            load=_load(target),
            clear=None if target.loads else self._optional(attachment.clear),
            store=target.stores,
            resolve=_resolve_row(target),
            over=None if attachment.over is None else attachment.over.name,
            stencil=_stencil_load(target) if target.has_stencil else None,
        )

    def _drawn(self, drawn: Drawn) -> DrawnRow:
        return DrawnRow(
            models=drawn.models or None,
            vertices=None if drawn.vertices is None else self._value(drawn.vertices),
            light=drawn.light or None,
            uses=tuple(self._used(use) for use in drawn.uses),
        )

    def _used(self, use: Use) -> UseRow:
        return UseRow(
            material=use.material or None,
            shader=self._shaders[use.shader],
            inputs=tuple(map(self._input, use.given)),
        )

    def _input(self, given: Given) -> InputRow:
        source = given.source
        if isinstance(source, int):
            return InputRow(
                name=given.name, source=ValueSource(kind="value", value=self._value(source))
            )
        if isinstance(source, Previous):
            return InputRow(name=given.name, source=self._before(source))
        return InputRow(name=given.name, source=self._read(source))

    def _before(self, previous: Previous) -> PreviousSource | ResultSource | HostSource:
        """The result of the last frame; or, if none of it is kept, the initial one."""
        assert previous.of is not None
        initially = None if previous.initially is None else self._read(previous.initially)
        if initially is not None and previous.of not in self._previous:
            return initially
        return PreviousSource(
            kind="previous",
            previous=previous.of.name,
            texture=self._previous[previous.of],
            initially=initially,
        )

    def _read(self, source: StepTexture | Elements | FromHost) -> ResultSource | HostSource:
        if isinstance(source, FromHost):
            return HostSource(kind="host", host=source.name)
        return self._result(source)

    def _result(self, left: StepTexture | Elements) -> ResultSource:
        return ResultSource(kind="result", result=left.name, texture=self._texture(left))


def _load(target: Target) -> Literal["load", "clear"]:
    return "load" if target.loads else "clear"


def _resolve_row(target: Target) -> ResolveRow | None:
    at = target.attachment
    if target.resolved is None:
        return None
    assert at.layer is not None, "samples have one layer"
    return ResolveRow(texture=target.resolved, layer=at.layer, level=at.level)


def _stencil_load(target: Target) -> StencilLoad:
    return StencilLoad(load=_load(target), store=target.stores_stencil, clear=0)


def _shader_row(shader: FrameShader, reflection: str) -> ShaderRow:
    made = shader.shader
    return ShaderRow(
        name=shader.name,
        reflection=reflection,
        pass_=made.pass_name or None,
        rig=made.rig_name or None,
    )


def _sources_of(given: Given) -> tuple[Source | None, ...]:
    """The source of an input, and that in the first frame if it is another."""
    source = given.source
    return (source, source.initially) if isinstance(source, Previous) else (source,)


def _color_textures(shader: FrameShader) -> frozenset[str]:
    """The textures of a shader that hold colours."""
    infos = shader.shader.textures
    return frozenset(info.leaf.name for info in infos if info.intent == "color")


def _place(span: Span) -> PlaceRow:
    """The place of a declaration: lines and columns count from 1."""
    line, column = span.source.position(span.start)
    return PlaceRow(
        file=span.source.name_in_outputs,
        line=line,
        column=column,
        length=span.end - span.start,
    )
