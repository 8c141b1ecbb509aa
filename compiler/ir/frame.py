"""Frames: steps that draw and compute, their outputs, and their reads of each other's results.

Semantics makes a ``Frame`` of a declaration; ``compiler/planning`` makes a plan of it, which hosts
execute. A frame has no order of its own: each step says what it needs.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from ...support.frozen import frozen, record
from ..diagnostics.source import Span
from .leaves import behind
from .node import Node
from .render_state import Samples
from .shader import BufferInfo, ParameterInfo, Shader, TextureInfo

ImageDimension = Literal["2d", "2d_array", "cube"]

DEPTH = "depth"
"""The name of the depths that a pass leaves, and the first part of the names of their formats."""


@frozen(eq=False)
class FrameShader:
    """One shader of a frame: a pass with a material and lights, or a kernel."""

    name: str
    """The name in the plan and of its files: ``Deferred.GBuffer.Plastic``."""
    shader: Shader


@frozen(eq=False)
class Size:
    """The size of an image."""

    value: int | None
    """The number of the value that says it, an ``ivec2``; ``None`` where a kernel says it."""
    kernel: str = ""
    """The step whose kernel says it by its extent."""
    level: int = 0
    """The mip level: the number of times that the size has been halved."""


@frozen(eq=False)
class StepTexture:
    """A texture that a step leaves: a target of a pass, its depths, or an image of a kernel."""

    step: str
    """The step that leaves it; where several draw to it, the equation that they repeat."""
    target: str
    """The name that the pass or the kernel gives it."""
    format: str
    """One of the formats of render targets, or of depths."""
    size: Size
    dimension: ImageDimension
    layers: int
    """The number of layers, or 6 of a cube; 1 where the dimension is ``2d``."""
    levels: int
    doc: str
    span: Span
    samples: Samples = 1
    """The number of samples of each pixel while steps draw to it.

    A step that reads the image gets their mean. Depths of several samples cannot be read.
    """

    @property
    def name(self) -> str:
        """The name in the plan: ``step.target``."""
        return behind(self.step, self.target)

    @property
    def is_depth(self) -> bool:
        """True if it holds depths."""
        return self.format.startswith(DEPTH)


@frozen(eq=False)
class Elements:
    """A storage buffer that a kernel leaves."""

    step: str
    """The step that leaves it."""
    info: BufferInfo
    doc: str
    span: Span

    @property
    def name(self) -> str:
        """The name in the plan: ``step.buffer``."""
        return behind(self.step, self.info.leaf.name)


@frozen(eq=False)
class FromHost:
    """A texture or a buffer that the host binds, by the frame's name for it."""

    name: str


@record
class Previous:
    """The content of an image or a buffer at the end of the last frame."""

    of: StepTexture | Elements | None = None
    """The result; unknown while the frame is checked, as it may be made later."""
    initially: StepTexture | Elements | FromHost | None = None
    """The source in the first frame; ``None`` for an image without anything drawn."""


Source = int | StepTexture | Elements | Previous | FromHost
"""The source of an input's value; a number is that of one of the frame's values."""


@frozen(eq=False)
class Given:
    """An input of a shader that the frame sets, by the name that hosts know it by."""

    name: str
    source: Source


@frozen(eq=False)
class Use:
    """A shader in a step, with the inputs that the frame sets there."""

    material: str
    """The material whose models the shader draws; empty where there are none."""
    shader: FrameShader
    given: tuple[Given, ...]


@frozen(eq=False)
class Drawn:
    """The draws of a step, one behind the other."""

    models: str
    """Models of the host's scene; empty for vertices that have nothing but their numbers."""
    vertices: int | None
    """The number of the value that says how many of these there are."""
    uses: tuple[Use, ...]
    """A shader for each material that the models may have."""
    light: str = ""
    """The entry of the rig for each of whose lights this is drawn once more."""


@frozen(eq=False)
class Attachment:
    """An image that one target of a pass, or its depths, is drawn to."""

    target: str
    image: StepTexture
    layer: int | None
    """The layer; ``None`` for all of them."""
    level: int
    over: StepTexture | None
    """The content to draw over, made by another step; ``None`` if it is cleared."""
    clear: int | None = None
    """The number of the clear value; ``None`` for transparent black, or a depth of 1."""


@frozen(eq=False)
class RenderStep:
    """A pass that is drawn."""

    name: str
    pass_name: str
    attachments: tuple[Attachment, ...]
    depth: Attachment | None
    draws: tuple[Drawn, ...]
    doc: str
    span: Span
    viewport: int | None = None
    scissor: int | None = None
    """The numbers of the values that limit where a step draws.

    They say into which part of the targets the clip volume is drawn, and which part is drawn to:
    left, top, width and height. ``None`` for all of it.
    """
    blend_constant: int | None = None
    """The value of the factor ``constant`` in all targets."""

    @property
    def uses(self) -> tuple[Use, ...]:
        """The shaders of the step, with their inputs."""
        return tuple(use for drawn in self.draws for use in drawn.uses)

    @property
    def drawn_to(self) -> tuple[Attachment, ...]:
        """The attachments that it draws to, its depths last."""
        return self.attachments if self.depth is None else (*self.attachments, self.depth)

    @property
    def settings(self) -> tuple[int, ...]:
        """The numbers of all values that are set for the step as a whole.

        They are its areas, the blend constant, and the values that it clears to.
        """
        every = (
            self.viewport, self.scissor, self.blend_constant,
            *(attachment.clear for attachment in self.drawn_to),
        )  # fmt: skip
        return tuple(number for number in every if number is not None)


@frozen(eq=False)
class KernelStep:
    """A kernel that is run."""

    name: str
    use: Use
    images: Mapping[str, StepTexture]
    buffers: Mapping[str, Elements]
    """The buffers, by the names of the kernel's results."""
    doc: str
    span: Span

    @property
    def uses(self) -> tuple[Use, ...]:
        """The kernel of the step, with the inputs of this."""
        return (self.use,)


Step = RenderStep | KernelStep


@frozen(eq=False)
class Models:
    """Models of the host's scene that the frame draws."""

    name: str
    materials: tuple[str, ...]
    """The materials that they may have."""
    doc: str
    span: Span


@frozen(eq=False)
class FrameOutput:
    """A result of a frame, for the host."""

    name: str
    source: StepTexture | Elements
    doc: str
    span: Span


@frozen(eq=False)
class Frame:
    """A frame, checked."""

    name: str
    doc: str
    span: Span
    rig: str
    values: tuple[Node, ...]
    """Numbers that the host computes, in terms of ``parameters`` and the sizes of ``textures``.
    Equal ones are one node."""
    parameters: tuple[ParameterInfo, ...]
    textures: tuple[TextureInfo, ...]
    buffers: tuple[BufferInfo, ...]
    models: tuple[Models, ...]
    shaders: tuple[FrameShader, ...]
    """The shaders that steps use."""
    steps: tuple[Step, ...]
    """The steps that outputs need, each behind those that it needs itself."""
    outputs: tuple[FrameOutput, ...]
