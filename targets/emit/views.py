"""The records that a skeleton prints: all texts in them are finished.

The emitter makes them, and ``skeleton.j2`` puts them together. Separators and brackets of lists are
the skeleton's business.
"""

from __future__ import annotations

from ...compiler.ir.program import StageName
from ...support.frozen import frozen
from ..legalise.bindings import BindingSlot


@frozen
class MemberView:
    """A member of a struct or block."""

    typed: str
    comment: str = ""
    is_padding: bool = False
    """True if the member only keeps the others at their offsets."""


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
    """The variable that holds the block, in languages where members are reached through one."""
    slot: BindingSlot
    register: str
    """The binding in the language's own words, if it has such."""
    argument: str
    """The block as a parameter of a function."""
    members: tuple[MemberView, ...]


@frozen
class BufferView:
    """A storage buffer."""

    name: str
    block: str
    """The name of the interface block around the buffer, in languages that have one."""
    element: str
    """The type of its elements."""
    slot: BindingSlot
    register: str
    argument: str
    """The buffer as a parameter of a function."""
    written: bool
    """True if a kernel writes the buffer; all others are only read."""
    scattered: bool
    """True if the kernel writes by combining values with elements that are there already
    (atomics)."""


@frozen
class ImageView:
    """An image that a kernel writes."""

    name: str
    type: str
    format: str
    """The format of the image's texels, in Burnish's word."""
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
    """True if the field goes from one stage to the next."""
    flat: bool
    comment: str
    of_patch: bool = False
    """True if the field is the same for a whole patch."""
    per_corner: bool = False
    """True if there is one value for each corner of a primitive, or for each control point."""
    invariant: bool = False
    """True if the text has to declare the field invariant: the same, bit by bit, in all shaders
    that compute it in this way."""
    captured_at: str = ""
    """The byte of a vertex at which the field is captured, if the text says so."""


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
    """The primitives that a geometry stage gets, and the vertices that it emits."""

    primitive: str
    """The kind of primitive that the stage gets, in the language's own word."""
    corners: int
    emitted: str
    """The language's word for the stream that the stage emits: points, lines or triangles."""
    places: bool
    """True if the stage delivers positions; captured vertices have none."""
    vertices: int
    """The largest number of vertices that the stage emits."""
    is_layered: bool
    """True if the stage says to which layer of the render targets its vertices belong."""


@frozen
class TessellationView:
    """The division of patches, for the two tessellation stages."""

    patch: str
    """The kind of the patches, in the language's own word."""
    lines: bool
    """True if patches are divided into lines, and not into triangles."""
    spacing: str
    """The division of edges, in the language's own word."""
    points: int
    """The number of control points of each patch."""
    edge_levels: int
    """The number of tessellation levels of the edges."""
    inner_levels: int
    is_control: bool
    """True in the stage that computes the tessellation levels."""
    own: list[FieldView]
    """The fields that are the same for a whole patch: the control stage computes them, the
    evaluation stage reads them."""
    handing: list[StoreView]
    """The outputs of each control point, with the inputs that they hand on."""


@frozen
class EntryView:
    """One stage's entry point and what belongs to it alone."""

    stage: StageName
    name: str
    inputs: list[FieldView]
    pipeline_inputs: list[InputView]
    outputs: list[FieldView]
    blocks: list[BlockView]
    """The file's blocks that this stage reads."""
    buffers: list[BufferView]
    """The file's buffers that this stage reads or writes."""
    images: list[ImageView]
    """The images that this stage writes."""
    textures: list[TextureView]
    """The file's textures that this stage reads."""
    functions: list[FunctionView]
    lines: list[str]
    stores: list[StoreView]
    shared: list[str]
    """Declarations of variables that the invocations of a work group share."""
    written: list[str]
    """Lines by which a kernel writes elements of buffers and texels of images."""
    position: str
    """Clip-space position; empty in stages that do not deliver it."""
    invariant: bool
    """True if positions, and the tessellation levels, have to be the same, bit by bit, in all
    shaders that compute them in this way."""
    opening: list[str]
    """The first statements of a kernel, which compute its index; none in other stages."""
    guard: str
    """The condition under which a kernel's invocation has nothing to do. Empty in other stages, and
    in kernels in which all invocations go on to the end."""
    work_group: tuple[int, ...]
    """The size of a kernel's work group along x, y and z; empty in other stages."""
    depth: str
    """The depth of the fragment, if it has one of its own; else empty."""
    discard: list[str]
    """Lines that discard the fragment; empty if nothing is discarded."""
    capture_stride: int = 0
    """The bytes of each captured vertex, if the text states them; else 0."""
    expansion: ExpansionView | None = None
    """The expansion of a stage that emits vertices; else ``None``."""
    tessellation: TessellationView | None = None
    """The division of patches in tessellation stages; else ``None``."""


@frozen
class FileView:
    """One file."""

    opening: list[str]
    """Lines that have to come before all others, after those of the profile."""
    header: list[str]
    structs: list[StructView]
    blocks: list[BlockView]
    buffers: list[BufferView]
    images: list[ImageView]
    textures: list[TextureView]
    """The textures; each is followed by its sampler, if that is an object of its own."""
    helpers: list[str]
    """Helper functions of the language, each a text of several lines."""
    host_uniforms: list[str]
    """Loose float uniforms."""
    entries: list[EntryView]


@frozen
class PartView:
    """A part as the skeleton prints it."""

    lines: tuple[str, ...]


@frozen
class FunctionFileView:
    """A file of functions."""

    header: list[str]
    parts: list[PartView]
