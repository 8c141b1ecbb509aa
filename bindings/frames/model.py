"""The records of a frame in a binding: its resources, and what its function does, step by step."""

from __future__ import annotations

from typing import ClassVar, Literal

from ...compiler.documents.plan import (
    AttachmentRow,
    CopyStep,
    DrawStep,
    FramePlan,
    FrameTextureRow,
    RunStep,
)
from ...support.frozen import frozen
from ..fields import Field
from ..materials import Block, Material
from ..statements import Place


@frozen(kw_only=True)
class FrameTexture:
    """A texture that the host makes."""

    number: int
    name: str
    """The first result that it holds: ``shadow.depth``."""
    row: FrameTextureRow
    size: Field
    """The field of the frame's numbers that has the width and height of its first level."""


@frozen(kw_only=True)
class FrameBuffer:
    """A storage buffer that a kernel writes, or that has what one wrote in the last frame."""

    number: int
    name: str
    """The result that it holds."""
    count: Field
    """The field of the frame's numbers that has the number of elements."""
    stride: int
    """Bytes from one element to the next."""
    initial: int | None
    """What each 32 bits of it are set to before the kernel is run; ``None`` if it does not matter.
    """


@frozen(kw_only=True)
class Kept:
    """A texture, or a buffer, that is exchanged with the one of the last frame."""

    kind: Literal["texture", "buffer"]
    number: int
    previous: int


@frozen(kw_only=True)
class Resource:
    """A texture or a buffer."""

    kind: Literal["texture", "buffer", "host"]
    """``host`` is what the host has besides the frame, found by its name."""
    number: int
    """The number in ``Frame.textures`` or ``Frame.buffers``; -1 of the host's."""
    name: str
    """The result, or the name of the host's."""


@frozen(kw_only=True)
class Read:
    """A texture or a buffer of a shader that the frame decides."""

    name: str
    """The shader's name for it."""
    source: Resource
    initially: Resource | None
    """What is read in a first frame instead; ``None`` for the same."""


@frozen(kw_only=True)
class Give:
    """A field of a shader's block that the frame decides."""

    block: Block
    field: Field
    source: Place
    """A field of the frame's parameters or numbers; ``None`` in its way is the light's number."""
    initially: Place | None
    """The field that is given in a first frame instead."""


@frozen(kw_only=True)
class Use:
    """A shader, and what the frame gives it."""

    material: str | None
    """The material of the models that are drawn with it; ``None`` without models."""
    shader: Material
    gives: tuple[Give, ...]
    """In the order in which they are given: the number of an array's elements behind the array."""
    reads: tuple[Read, ...]
    layer: tuple[Block, Field] | None
    """The field that is set to the number of the layer, where each layer is a pass of its own."""


@frozen(kw_only=True)
class Lights:
    """The lights for each of which something is drawn once."""

    entry: str
    count: Field | None
    """The field of the frame's parameters with the number in use; ``None`` where all are."""
    capacity: int


@frozen(kw_only=True)
class Drawn:
    """Draws, one behind the other."""

    models: str | None
    """The tag of the models; ``None`` for vertices alone."""
    vertices: Field | None
    """The field of the frame's numbers that has the number of vertices."""
    light: Lights | None
    """The lights of an array; ``None`` where all is drawn once."""
    uses: tuple[Use, ...]


@frozen(kw_only=True)
class Attachment:
    """A target, or the depths, of a pass."""

    row: AttachmentRow
    texture: FrameTexture
    clear: Field | None
    """The field of the frame's numbers; ``None`` for transparent black, or a depth of 1."""


@frozen(kw_only=True)
class Pass:
    """A step that draws."""

    row: DrawStep
    layers: int
    """How often the pass is drawn, with a layer more each time; 1 where attachments say theirs."""
    targets: tuple[Attachment, ...]
    depth: Attachment | None
    viewport: Field | None
    scissor: Field | None
    blend_constant: Field | None
    draws: tuple[Drawn, ...]

    @property
    def uses(self) -> tuple[Use, ...]:
        """The uses of all that it draws."""
        return tuple(use for drawn in self.draws for use in drawn.uses)


@frozen(kw_only=True)
class Dispatch:
    """A step that runs a kernel."""

    row: RunStep
    use: Use
    groups: Field
    """The field of the frame's numbers that has the numbers of work groups along each axis."""
    images: tuple[tuple[str, FrameTexture], ...]
    """The textures that it writes, by the kernel's names."""
    buffers: tuple[tuple[str, FrameBuffer], ...]

    @property
    def uses(self) -> tuple[Use, ...]:
        """The use of the kernel, alone."""
        return (self.use,)


@frozen(kw_only=True)
class Copy:
    """A step that copies a whole texture."""

    uses: ClassVar[tuple[Use, ...]] = ()

    row: CopyStep
    source: FrameTexture
    target: FrameTexture


Step = Pass | Dispatch | Copy


@frozen(kw_only=True)
class Output:
    """What the frame makes for the host; behind ``end``, it is there."""

    name: str
    doc: str
    kind: Literal["texture", "buffer"]
    number: int
    """The number of the texture or buffer that has it behind the exchange of kept ones."""


@frozen(kw_only=True)
class Frame:
    """A frame."""

    name: str
    """Name in the binding."""
    plan: FramePlan
    parameters: Block
    numbers: Block
    textures: tuple[FrameTexture, ...]
    buffers: tuple[FrameBuffer, ...]
    kept: tuple[Kept, ...]
    steps: tuple[Step, ...]
    outputs: tuple[Output, ...]

    @property
    def asks_for_first(self) -> bool:
        """True if it matters whether a frame is the first one."""
        return any(
            step.row.only_first
            or any(each.initially is not None for use in step.uses for each in _given(use))
            for step in self.steps
        )


def _given(use: Use) -> tuple[Give | Read, ...]:
    return *use.gives, *use.reads
