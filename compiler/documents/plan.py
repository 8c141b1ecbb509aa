"""The plan of a frame: the textures that a host makes, and the steps that draw them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from ...support.frozen import frozen
from ..constraints import Count, Length, Positive
from ..ir.formats import DEPTH_WORDS, TARGET_WORDS
from ..ir.render_state import Samples
from ..ir.types import DIMENSION_WORDS, Dimension, Intent, Sample
from .steps import StepRow
from .values import BufferRow, LightRow, ParameterRow

TextureUse = Literal["target", "depth", "image", "sampled", "copied_from", "copied_to"]
"""A use of a texture: drawn to, written by a kernel, read, copied."""
TextureState = Literal[
    "undefined", "target", "depth", "image", "sampled", "copied_from", "copied_to"
]
"""The use of a texture so far; at first it has no contents."""
BufferUse = Literal["written", "read"]
"""A use of a buffer: written by a kernel, or read by one or by a pass."""
BufferState = Literal["undefined", "written", "read"]
"""The use of a buffer so far, likewise."""


@frozen(kw_only=True)
class PlaceRow:
    """The place in a file where something is written; lines and columns count from 1."""

    file: str
    """The file, from the folder of the compiled one; the library's files begin with ``std/``."""
    line: Positive
    """The line."""
    column: Positive
    """The column."""
    length: Count
    """The number of characters."""


@frozen(kw_only=True)
class HostTextureRow:
    """A texture of the host."""

    WORDS: ClassVar = {"dimension": DIMENSION_WORDS}

    name: str
    """Name of the texture."""
    type: str
    """Type as declared."""
    dimension: Dimension
    """Dimension."""
    sample: Sample
    """Kind of its values."""
    intent: Intent
    """Intent of its numbers, by which a host chooses the format of a picture.

    ``color``: texels become colours, which the shader takes as linear light. Pictures whose colours
    are encoded as sRGB are bound in a format that decodes them. ``data``: the numbers are taken as
    they are.
    """
    default: str
    """Texture until the host binds one."""
    default_texel: tuple[float, ...]
    """The only texel of that texture, for each layer or face: the numbers that a shader reads.

    There are four of them, and one of depths.
    """
    doc: str
    """Doc comment."""
    group: str
    """Parameter group, which says how often the host changes it."""


@frozen(kw_only=True)
class ModelsRow:
    """Models of the host's scene."""

    name: str
    """Tag of these models in the host's scene; all models of the scene are called ``scene``."""
    materials: tuple[str, ...]
    """The materials that they may have. Every ``uses`` for them has a shader for each."""
    doc: str
    """The doc comment."""
    source: PlaceRow


@frozen(kw_only=True)
class ShaderRow:
    """A shader."""

    name: str
    """Name of the shader."""
    reflection: str
    """The file with its reflection."""
    pass_: str | None
    """The pass; null of a kernel."""
    rig: str | None
    """The rig; null of a kernel."""


@frozen(kw_only=True)
class ValueRow:
    """A number, vector or matrix."""

    representation: str
    """Type without meaning: the numbers of the value."""
    steps: Annotated[tuple[StepRow, ...], Length(1)]
    """Steps that compute it, operands before users; the last one is the value."""


@frozen(kw_only=True)
class SizeRow:
    """The size of a texture."""

    value: int | None
    """The number of the value that says it, an ``ivec2``; null where ``extent_of`` says it."""
    extent_of: str | None
    """Name of the step whose kernel says the size, by the ``extent`` of its reflection.

    Null where ``value`` says it.
    """
    level: Count
    """Number of times that both sides are halved then, rounded down, but not below 1."""


@frozen(kw_only=True)
class FrameTextureRow:
    """A texture."""

    WORDS: ClassVar = {
        "format": {**TARGET_WORDS, **DEPTH_WORDS},
        "dimension": {word: DIMENSION_WORDS[word] for word in ("2d", "2d_array", "cube")},
    }

    format: str
    """Format of a render target or of depths, a GPUTextureFormat.

    ``rgba16float`` are floats, ``rgba8unorm`` numbers from 0 to 1.
    """
    dimension: Literal["2d", "2d_array", "cube"]
    """Dimension."""
    size: SizeRow
    layers: Positive
    """Layers, 6 of a cube."""
    levels: Positive
    """Mip levels."""
    samples: Samples
    """Number of samples of each texel.

    A texture with several has one layer and one level, is drawn to, and is not read.
    """
    uses: tuple[TextureUse, ...]
    """Uses of the texture by steps, and by the host or the next frame behind them.

    For the two textures of a row of ``kept``, these are the uses of either.
    """
    kept: bool
    """True if a row of ``kept`` names it.

    Contents of others are needed in the next frame only where a step with ``only_first`` drew them.
    """
    results: tuple[str, ...]
    """The results that it holds, one after the other."""


@frozen(kw_only=True)
class FrameResultRow:
    """A result of a step."""

    name: str
    """The step's name and that of its target."""
    kind: Literal["texture", "buffer"]
    """Kind of the result."""
    texture: int | None
    """Number of the texture that holds it.

    Null for a buffer, which is the result's own, and for samples that are not resolved.
    """
    first: Count
    """The step that makes it first."""
    last: Count
    """The last step of the frame that needs it.

    An output, a kept result, and a result of a step with ``only_first`` are needed after the frame,
    too.
    """
    doc: str
    """Doc comment."""
    source: PlaceRow


@frozen(kw_only=True)
class BarrierRow:
    """A change of a texture's use from here on.

    Earlier writes have to be complete; ``undefined`` means that the texture has no contents yet.
    """

    only_first: bool
    """True if the barrier stands in the first frame only."""
    texture: Count
    """The texture."""
    before: TextureState
    """Use before."""
    after: TextureUse
    """Use from here on."""


@frozen(kw_only=True)
class BufferBarrierRow:
    """A change of a result's buffer's use from here on.

    Earlier writes and reads have to be complete.
    """

    result: str
    """The result."""
    before: BufferState
    """Use before; ``undefined`` means that its contents do not matter."""
    after: BufferUse
    """Use from here on."""
    only_first: bool
    """True if the barrier stands in the first frame only."""


@frozen(kw_only=True)
class ResolveRow:
    """The texture to which the mean of each texel's samples is written behind the step."""

    texture: Count
    """A texture with one sample, in which others find the result."""
    layer: Count
    """Layer."""
    level: Count
    """Mip level."""


@frozen(kw_only=True)
class StencilLoad:
    """The handling of the stencil values beside depths, if there are any."""

    load: Literal["load", "clear"]
    """Start of the step: keep the values, or clear them."""
    store: bool
    """True if a later step reads them."""
    clear: Literal[0]
    """Value that they are cleared to."""


@frozen(kw_only=True)
class AttachmentRow:
    """An attachment: a texture that a target of the pass, or its depths, is drawn to."""

    name: str
    """The target of the pass, or ``depth``."""
    result: str
    """The result."""
    texture: Count
    """Texture."""
    layer: int | None
    """The layer that is drawn to; null for all, as the reflection's ``draw.layers`` says."""
    level: Count
    """The mip level."""
    load: Literal["load", "clear"]
    """Start of the step: keep the contents, or clear them."""
    clear: Count | None
    """Number of the value that it is cleared to: a ``vec4``, or a ``float`` of depths.

    Null for transparent black, or a depth of 1. The value of the pass itself is contained in it.
    """
    store: bool
    """True if anybody reads the result."""
    resolve: ResolveRow | None
    """Texture to which the mean of each texel's samples is written behind the step.

    It is that of an attachment with several samples; null if nobody reads it.
    """
    over: str | None
    """The result that is there before and is drawn over."""
    stencil: StencilLoad | None
    """Handling of the stencil values beside depths; null if there are none."""

    @property
    def places(self) -> tuple[AttachmentRow | ResolveRow, ...]:
        """The textures that keep it: its samples and, where there are any, their means."""
        return (self,) if self.resolve is None else (self, self.resolve)


@frozen(kw_only=True)
class ValueSource:
    """A number that the host computes."""

    kind: Literal["value"]
    value: Count
    """The number of the value."""


@frozen(kw_only=True)
class ResultSource:
    """A result of a step of this frame."""

    kind: Literal["result"]
    result: str
    """The result."""
    texture: int | None
    """The number of its texture; null of a buffer."""


@frozen(kw_only=True)
class HostSource:
    """A texture or a buffer of the host."""

    kind: Literal["host"]
    host: str
    """Name of the texture or buffer."""


@frozen(kw_only=True)
class PreviousSource:
    """A result of a step of the last frame."""

    kind: Literal["previous"]
    previous: str
    """The result."""
    texture: int | None
    """The number of the texture that has it now; null of a buffer."""
    initially: ResultSource | HostSource | None
    """Source in the first frame; null for a texture without contents."""


Source = ValueSource | ResultSource | HostSource | PreviousSource
"""The source of an input's value."""


@frozen(kw_only=True)
class InputRow:
    """An input of a shader that the frame sets."""

    name: str
    """The parameter, texture or buffer, as the shader's reflection calls it."""
    source: Source
    """Source of its value."""


@frozen(kw_only=True)
class UseRow:
    """A shader for the models of one material."""

    material: str | None
    """The material; null where vertices without models are drawn, and of a kernel."""
    shader: Count
    """The number of the shader."""
    inputs: tuple[InputRow, ...]
    """Inputs that the frame sets."""


@frozen(kw_only=True)
class DrawnRow:
    """The draws, one behind the other."""

    models: str | None
    """Models, in the order of the scene; null for vertices without vertex inputs."""
    vertices: int | None
    """The number of the value that says how many vertices are drawn; null for models."""
    light: str | None
    """The entry of the rig for each of whose lights all of this is drawn once.

    For an array, it is drawn for as many lights as its ``count`` says. The shader has the
    parameters of a single light of this name, which both documents may call by the name of the rig,
    too: ``Studio.lamps``.
    """
    uses: tuple[UseRow, ...]
    """The shaders."""


@frozen(kw_only=True)
class DrawStep:
    """A pass that is drawn."""

    images: ClassVar[tuple[WrittenImage, ...]] = ()
    buffers: ClassVar[tuple[WrittenBuffer, ...]] = ()
    written: ClassVar[tuple[WrittenImage | WrittenBuffer, ...]] = ()

    kind: Literal["draw"]
    name: str
    """The step."""
    pass_: str
    """The pass."""
    barriers: tuple[BarrierRow, ...]
    """The textures that are waited for."""
    buffer_barriers: tuple[BufferBarrierRow, ...]
    """The buffers of results that are waited for."""
    only_first: bool
    """True if it is needed in the first frame only."""
    targets: tuple[AttachmentRow, ...]
    """The targets, in the order of their locations."""
    depth: AttachmentRow | None
    """The depths; null where the pass has none.

    Then there is no depth test, whatever ``render_state`` of its reflection says.
    """
    viewport: Count | None
    """Number of the value that says into which part of the targets the clip volume is drawn.

    It is an ``ivec4`` of left, top, width and height, in texels; null for all of the targets.
    """
    scissor: Count | None
    """Number of the value that says which part of the targets is drawn to, likewise.

    A part outside of the targets is cut off.
    """
    blend_constant: Count | None
    """The number of the value, a ``vec4``, that the factor ``constant`` means in all targets."""
    draws: tuple[DrawnRow, ...]
    """The draws."""
    source: PlaceRow
    continues: bool
    """True if it draws on to all attachments of the step before, and waits for nothing else.

    A host can then draw both in one render pass, without storing and loading in between.
    """

    @property
    def attachments(self) -> tuple[AttachmentRow, ...]:
        """All attachments that it draws to, its depths last."""
        return self.targets if self.depth is None else (*self.targets, self.depth)

    @property
    def uses(self) -> tuple[UseRow, ...]:
        """The shaders of all that it draws."""
        return tuple(use for drawn in self.draws for use in drawn.uses)


@frozen(kw_only=True)
class WrittenImage:
    """An image."""

    name: str
    """The kernel's name for it."""
    result: str
    """The result."""
    texture: Count
    """Texture."""


@frozen(kw_only=True)
class WrittenBuffer:
    """A buffer."""

    name: str
    """The kernel's name for it."""
    result: str
    """The result."""


@frozen(kw_only=True)
class RunStep:
    """A kernel that is run."""

    draws: ClassVar[tuple[DrawnRow, ...]] = ()
    attachments: ClassVar[tuple[AttachmentRow, ...]] = ()

    kind: Literal["run"]
    name: str
    """The step."""
    barriers: tuple[BarrierRow, ...]
    """The textures that are waited for."""
    buffer_barriers: tuple[BufferBarrierRow, ...]
    """The buffers of results that are waited for."""
    only_first: bool
    """True if it is needed in the first frame only."""
    use: UseRow
    """The kernel, and its inputs that the frame sets."""
    images: tuple[WrittenImage, ...]
    """The images that it writes."""
    buffers: tuple[WrittenBuffer, ...]
    """The buffers that it writes."""
    source: PlaceRow

    @property
    def uses(self) -> tuple[UseRow, ...]:
        """The use of the kernel, alone."""
        return (self.use,)

    @property
    def written(self) -> tuple[WrittenImage | WrittenBuffer, ...]:
        """All images and buffers that it writes."""
        return *self.images, *self.buffers


@frozen(kw_only=True)
class CopyEnd:
    """One end of a copy."""

    result: str
    """The result."""
    texture: Count
    """The number of its texture."""


@frozen(kw_only=True)
class CopyStep:
    """A copy of a whole texture, before a step draws over a result that others need as it was."""

    name: ClassVar[str] = "a copy"
    draws: ClassVar[tuple[DrawnRow, ...]] = ()
    attachments: ClassVar[tuple[AttachmentRow, ...]] = ()
    images: ClassVar[tuple[WrittenImage, ...]] = ()
    buffers: ClassVar[tuple[WrittenBuffer, ...]] = ()
    written: ClassVar[tuple[WrittenImage | WrittenBuffer, ...]] = ()
    uses: ClassVar[tuple[UseRow, ...]] = ()

    kind: Literal["copy"]
    barriers: tuple[BarrierRow, ...]
    """The textures that are waited for."""
    buffer_barriers: tuple[BufferBarrierRow, ...]
    """The buffers of results that are waited for."""
    copied: CopyEnd
    """Source of the copy."""
    into: CopyEnd
    """Destination of the copy."""
    only_first: bool
    """True if the first frame is enough."""


PlanStep = DrawStep | RunStep | CopyStep
"""A step of a host."""


@frozen(kw_only=True)
class WaitingRow:
    """The barriers behind the last step and before the exchange of ``kept``.

    The host can then read the outputs, and the next frame the kept textures and buffers.
    """

    barriers: tuple[BarrierRow, ...]
    """The textures that are waited for."""
    buffer_barriers: tuple[BufferBarrierRow, ...]
    """The buffers of results that are waited for."""


@frozen(kw_only=True)
class KeptRow:
    """A texture or a buffer that the next frame reads."""

    result: str
    """The result."""
    texture: int | None
    """Texture; null of a buffer."""
    previous: int | None
    """Number of the texture that has the result of the last frame; null for a buffer."""


@frozen(kw_only=True)
class OutputRow:
    """An output of the frame."""

    name: str
    """Name of the output."""
    result: str
    """The result."""
    texture: int | None
    """Texture; null of a buffer."""
    doc: str
    """Doc comment."""
    source: PlaceRow


@frozen(kw_only=True)
class FramePlan:
    """All that a host does to draw a frame: its textures, and the steps that it executes in order.

    Each shader has a reflection of its own.
    """

    VERSION: ClassVar = "plan"

    plan: Literal[2]
    """Version of this document's format. A host refuses versions that it does not know."""
    frame: str
    """The frame."""
    doc: str
    """The frame's doc comment; empty where there is none."""
    source: PlaceRow
    rig: str
    """The rig of lights under which models are drawn."""
    parameters: tuple[ParameterRow, ...]
    """Parameters that the host sets for the whole frame, as in reflections. No block holds them.

    Parameters of lights are among them, and are those of the same name in each shader, with or
    without the name of the rig before it; shaders get others through the values of inputs alone.
    """
    lights: tuple[LightRow, ...]
    """The lights of the rig, as in reflections."""
    host_textures: tuple[HostTextureRow, ...]
    """Textures that the host binds for the whole frame."""
    host_buffers: tuple[BufferRow, ...]
    """Storage buffers that the host binds for the whole frame."""
    sources: Mapping[str, PlaceRow]
    """Declarations of everything that the host sets, by name."""
    models: tuple[ModelsRow, ...]
    """Models of the host's scene that passes draw."""
    shaders: tuple[ShaderRow, ...]
    """The shaders; steps name them by their numbers here."""
    values: tuple[ValueRow, ...]
    """Numbers that the host computes once for each frame, before the first step.

    It computes them from the parameters, from those of the lights, and from the sizes of its
    textures. Steps and textures name them by their numbers here.
    """
    textures: tuple[FrameTextureRow, ...]
    """The textures that the host makes, by number. Each serves one result after the other."""
    results: tuple[FrameResultRow, ...]
    """Results of the steps."""
    steps: tuple[PlanStep, ...]
    """The steps of the host, in this order."""
    end: WaitingRow
    """The barriers behind the last step and before the exchange of ``kept``.

    The host can then read the outputs, and the next frame the kept textures and buffers.
    """
    kept: tuple[KeptRow, ...]
    """Results that the next frame reads.

    Behind the last step the host exchanges each texture (or, where the numbers are null, the
    result's buffer) with the previous one. Before the first frame, these textures are transparent
    black, or depths of 1.
    """
    outputs: tuple[OutputRow, ...]
    """Outputs of the frame, to be read behind the last step and before the exchange of ``kept``."""

    def output_texture(self, name: str) -> int | None:
        """The texture of an output behind the exchange of kept ones; ``None`` for a buffer."""
        output = next(row for row in self.outputs if row.name == name)
        kept = {row.result: row.previous for row in self.kept}
        return kept.get(output.result, output.texture)
