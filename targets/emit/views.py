"""The records that a skeleton gets to print: all texts in them are finished.

The emitter makes them, and ``skeleton.j2`` puts them together. What belongs between the elements of
a list, or around them, is the skeleton's business.
"""

from __future__ import annotations

from ...compiler.ir.program import StageName
from ...frozen import frozen
from ..legalise.bindings import BindingSlot


@frozen
class MemberView:
    """A member of a struct or block."""

    typed: str
    comment: str = ""
    is_padding: bool = False
    """Whether it only keeps the others at their places."""


@frozen
class StructView:
    """A struct that members of blocks use."""

    name: str
    members: tuple[MemberView, ...]


@frozen
class BlockView:
    """A uniform block."""

    name: str
    variable: str
    """The variable that it is, in languages where members are reached through one."""
    slot: BindingSlot
    register: str
    """The slot in the language's own words, where it has such."""
    argument: str
    """The block as a parameter of a function."""
    members: tuple[MemberView, ...]


@frozen
class BufferView:
    """A storage buffer."""

    name: str
    block: str
    """What the interface block around it is called, in languages where there is one."""
    element: str
    """The type of its elements."""
    slot: BindingSlot
    register: str
    argument: str
    """The buffer as a parameter of a function."""
    written: bool
    """Whether a kernel writes it; all others are only read."""
    scattered: bool
    """Whether it does so by joining values with elements that are there already."""


@frozen
class ImageView:
    """An image that a kernel writes."""

    name: str
    type: str
    format: str
    """That of its texels, in Burnish's word."""
    slot: BindingSlot
    register: str


@frozen
class TextureView:
    """A texture or a sampler, or both in one."""

    name: str
    type: str
    slot: BindingSlot
    register: str


@frozen
class FieldView:
    """A stage's input or output."""

    name: str
    type: str
    typed: str
    location: int
    semantic: str
    crosses: bool
    """Whether it goes from one stage to the next."""
    flat: bool
    comment: str
    of_patch: bool = False
    """Whether it is the same all over a patch."""
    per_corner: bool = False
    """Whether there is one for each corner of a primitive, or for each control point."""
    invariant: bool = False
    """Whether the text has to say that it is the same, bit by bit, in all shaders that compute it
    in this way."""
    captured_at: str = ""
    """At which byte of a vertex it is captured, where the text says so."""


@frozen
class InputView:
    """A value from the pipeline that the text has to declare."""

    typed: str
    semantic: str


@frozen
class FunctionView:
    """A function."""

    comments: tuple[str, ...]
    head: str
    lines: list[str]


@frozen
class StoreView:
    """An output's final value."""

    name: str
    value: str


@frozen
class ExpansionView:
    """What a stage does that gets whole primitives and emits vertices."""

    primitive: str
    """In the language's own word."""
    corners: int
    emitted: str
    """What it emits: the language's word for streams of points, lines or triangles."""
    places: bool
    """Whether it says where vertices go; those that are captured go nowhere."""
    vertices: int
    """How many it emits at most."""
    is_layered: bool
    """Whether it says to which layer of the render targets they belong."""


@frozen
class TessellationView:
    """How patches are divided, for the two stages that do it."""

    patch: str
    """Their kind, in the language's own word."""
    lines: bool
    """Whether they are divided into lines, and not into triangles."""
    spacing: str
    """How edges are divided, likewise."""
    points: int
    """How many control points each has."""
    edge_levels: int
    """How many levels there are."""
    inner_levels: int
    is_control: bool
    """Whether it is the stage that computes the levels."""
    own: list[FieldView]
    """What is the same all over a patch: this stage computes it, the other one reads it."""
    handing: list[StoreView]
    """What is handed on of each control point: the outputs, and the inputs that they are."""


@frozen
class EntryView:
    """One stage's entry point and what belongs to it alone."""

    stage: StageName
    name: str
    inputs: list[FieldView]
    pipeline_inputs: list[InputView]
    outputs: list[FieldView]
    blocks: list[BlockView]
    """What this stage reads of the file's blocks."""
    buffers: list[BufferView]
    """Likewise."""
    images: list[ImageView]
    """Those that it writes."""
    textures: list[TextureView]
    """What it reads of the file's textures."""
    functions: list[FunctionView]
    lines: list[str]
    stores: list[StoreView]
    shared: list[str]
    """Declarations of variables that the invocations of a work group share."""
    written: list[str]
    """Lines with which a kernel writes elements of buffers and texels of images."""
    position: str
    """Clip-space position; empty in stages that do not deliver it."""
    invariant: bool
    """Whether positions are the same, bit by bit, in all shaders that compute them in this way:
    where they are delivered, and how finely patches are divided."""
    opening: list[str]
    """The statements that tell a kernel's invocations apart; none in other stages."""
    guard: str
    """Where a kernel's invocation has nothing to do; empty in other stages, and where all
    invocations go on to the end."""
    work_group: tuple[int, ...]
    """How many invocations a kernel runs together along x, y and z; empty in other stages."""
    discard: list[str]
    """Lines that give the pixel up where it has to be; empty where nothing is discarded."""
    capture_stride: int = 0
    """The bytes of each vertex that is captured, where the text says so; else 0."""
    expansion: ExpansionView | None = None
    """Of a stage that emits vertices."""
    tessellation: TessellationView | None = None
    """Of the stages that divide patches."""


@frozen
class FileView:
    """One file."""

    opening: list[str]
    """Lines that have to come before all others, besides those of the profile."""
    header: list[str]
    structs: list[StructView]
    blocks: list[BlockView]
    buffers: list[BufferView]
    images: list[ImageView]
    textures: list[TextureView]
    """Each followed by its sampler, if that is an object of its own."""
    helpers: list[str]
    """Functions of the language's own, texts of some lines."""
    host_uniforms: list[str]
    """Loose float uniforms."""
    entries: list[EntryView]
