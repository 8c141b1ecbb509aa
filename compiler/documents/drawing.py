"""What a host draws: vertex inputs, textures, targets, and the state of the pipeline."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from ...frozen import frozen
from ..constraints import Count, Length, Pattern, Positive, Range
from ..ir.blending import Blend
from ..ir.primitives import DrawnPrimitive
from ..ir.render_state import Cull, DepthState, Fill, Samples, StencilState, Winding
from ..ir.types import Dimension, Sample
from .steps import StepRow

Primitive = Literal["point", "line", "triangle", "line_adjacency", "triangle_adjacency", "patch"]
"""What vertices are, in turn."""


@frozen(kw_only=True)
class TextureLayout:
    """What a WebGPU bind group layout says of it, in WebGPU's words."""

    KEYS: ClassVar = {"view_dimension": "viewDimension", "sample_type": "sampleType"}

    view_dimension: Literal["2d", "2d-array", "3d", "cube"]
    """GPUTextureViewDimension."""
    sample_type: Literal["float", "unfilterable-float", "depth", "sint", "uint"]
    """GPUTextureSampleType; ``unfilterable-float`` where nothing filters, so that formats fit that
    cannot be filtered."""
    sampler: Literal["filtering", "non-filtering", "comparison", None]
    """GPUSamplerBindingType; null where no sampler reads it."""


@frozen(kw_only=True)
class TextureRow:
    """A texture."""

    name: str
    """Name as the host says it, ``lamps`` or ``torch.axis``."""
    type: str
    """Type as declared, such as ``texture2d`` or ``depth_cube``."""
    dimension: Dimension
    """Dimension."""
    sample: Sample
    """What it holds: colours, depths to compare with, or whole numbers. Whether colours are stored
    as sRGB is the format's business, and so the host's."""
    layout: TextureLayout
    """What a WebGPU bind group layout says of it, in WebGPU's words."""
    group: str
    """Group the host updates together: ``frame``, ``view``, ``rig``, ``material``, ``draw`` or a
    user's own."""
    default: str
    """What to bind before a host sets one, such as ``white``."""
    stages: tuple[str, ...]
    """Stages that read it."""
    doc: str
    """Doc comment; empty where there is none."""
    library: str | None
    """Which declaration of the library it is, as for parameters; null where it is none of them."""
    brought: bool
    """Whether it is made by steps that a light brings to frames, such as its shadow map. Where
    there is no frame, a host that wants to see what they make binds a texture of its own."""


@frozen(kw_only=True)
class SamplerState:
    """Its state: what is filtered and compared, and what lies beyond the edges."""

    filter: Literal["linear", "nearest"]
    """How texels of a level are joined."""
    mip: Literal["linear", "nearest", "none"]
    """How levels are joined; ``none``: only the first one is read."""
    wrap: Literal["repeat", "clamp", "mirror"]
    """What lies beyond the edges."""
    compare: Literal["less", "less_equal", "greater", "greater_equal"] | None
    """How a reference, on the left, has to compare with a depth; null where none is compared."""


@frozen(kw_only=True)
class SamplerRow:
    """The state of the sampler that reads a texture."""

    texture: str
    """The texture."""
    state: SamplerState
    """Its state: what is filtered and compared, and what lies beyond the edges."""


@frozen(kw_only=True)
class InBuffer:
    """Where a kernel captures vertices, or corners need more than 16 vertex inputs, the storage
    buffer whose elements have its values, and the member that does; else null."""

    name: str
    """The buffer."""
    member: str
    """The member of its elements."""


@frozen(kw_only=True)
class MatrixColumn:
    """The declared matrix that this is a column of, and which; null for others."""

    of: str
    """The matrix."""
    index: Count
    """From 0."""


@frozen(kw_only=True)
class MeshInputRow:
    """Where each primitive of a mesh is drawn as an instance, what this is in the mesh; null
    elsewhere."""

    name: str
    """The vertex input as declared, or the number that the host counts."""
    corner: Count | None
    """The corner of the primitive whose value it is, from 0, or of the pattern's triangle or line;
    null where a whole instance of the mesh has one value, or a point of the pattern."""
    is_number: bool
    """Whether it is the number of a vertex, an instance or a primitive of the mesh."""
    is_of_pattern: bool
    """Whether it is where a point of the pattern lies in a patch."""


@frozen(kw_only=True)
class VertexInputRow:
    """A vertex input that the program reads."""

    name: str
    """Name as declared; of a matrix's column with its number, ``bend.0``."""
    type: str
    """The type as written: ``rgb``, ``direction<world>``, ``Lamp[8]``."""
    representation: str
    """The type on the machine: ``float``, ``vec3``, ``Lamp[8]``."""
    location: Count | None
    """Location; null where a buffer has its values."""
    buffer: InBuffer | None
    """Where a kernel captures vertices, or corners need more than 16 vertex inputs, the storage
    buffer whose elements have its values, and the member that does; else null."""
    step: Literal["vertex", "instance"]
    """Whether each vertex has a value of its own, or each instance."""
    column: MatrixColumn | None
    """The declared matrix that this is a column of, and which; null for others."""
    mesh: MeshInputRow | None
    """Where each primitive of a mesh is drawn as an instance, what this is in the mesh; null
    elsewhere."""
    doc: str
    """Doc comment; empty where there is none."""


@frozen(kw_only=True)
class CapturedRow:
    """A captured value."""

    name: str
    """Its name."""
    type: str
    """As declared."""
    representation: str
    """Its type without meaning: a number of 32 bits, or a vector of these."""
    offset: Count
    """Bytes from where the vertex begins."""
    doc: str
    """Its doc comment; empty where there is none."""


@frozen(kw_only=True)
class CaptureRow:
    """Captured vertices: all values of a vertex without gaps, one vertex behind the other."""

    primitive: DrawnPrimitive
    """What the captured vertices are: points, lines of two each, or triangles of three each."""
    vertices: Positive
    """How many vertices come of each primitive that is drawn, at most."""
    stride: Annotated[int, Range(least=4)]
    """Bytes of each vertex."""
    buffer: str | None
    """The result that has the vertices, where a kernel captures; null for a stream output."""
    there: int | None
    """Where a kernel writes of each vertex, behind its values, whether it is there, 1 or 0: in
    bytes from where the vertex begins, which then has 4 bytes more. Null where all vertices are
    there, and for a stream output."""
    members: Annotated[tuple[CapturedRow, ...], Length(1)]
    """The values, in order."""


@frozen(kw_only=True)
class LayersRow:
    """The layers of the render targets; null where these are single pictures."""

    count: Positive
    """How many there are."""
    parameter: str | None
    """The parameter that says to which layer a draw belongs: there is one draw for each. Null where
    a single draw reaches all layers."""


@frozen(kw_only=True)
class PatchLevels:
    """The levels of that pattern; null where the texts compute them."""

    edges: tuple[tuple[StepRow, ...], ...]
    """For each edge the steps that compute its level: of a triangle those across from its ends, of
    a quad those at u = 0, v = 0, u = 1 and v = 1."""
    inside: tuple[tuple[StepRow, ...], ...]
    """Likewise for the inside; of a quad along u, and along v."""


@frozen(kw_only=True)
class TessellationRow:
    """How each patch of a mesh is divided."""

    kind: Literal["triangle", "quad", "isoline"]
    """What is divided."""
    ends: tuple[Count, ...]
    """Which of a patch's control points are its corners. Those of a triangle have the weights x, y
    and z; those of a quad lie at (0, 0), (1, 0), (1, 1) and (0, 1); a line begins at the first
    one."""
    spacing: Literal["equal", "fractional_even", "fractional_odd"]
    """How edges are divided: equally, or so that two of an even or odd number of steps are
    shorter."""
    divided_by: Literal["evaluation", "instances"]
    """What divides them: the tessellation stages, or a draw of one instance for each: its vertices
    are the points of a pattern that the host makes, or they find out by their numbers where they
    lie."""
    levels: PatchLevels | None
    """The levels of that pattern; null where the texts compute them."""


@frozen(kw_only=True)
class DrawRow:
    """What is drawn, and how."""

    primitive: Primitive
    """What the mesh consists of."""
    corners: Positive
    """How many vertices each of these has."""
    expanded_by: Literal["geometry", "instances", None]
    """What turns each primitive into others: the geometry stage, or a draw of one instance for
    each; null where they are drawn as they are."""
    vertices: Annotated[int, Range(least=2)] | None
    """How many vertices a primitive, or a patch, turns into at most: of each instance, a list of
    triangles or lines; null where they are drawn as they are, or where the host makes the pattern.
    Where it makes the pattern and all parts of that are expanded, how many vertices each of these
    turns into."""
    topology: Primitive
    """What the vertices of a draw call are, in turn: what the host tells the API."""
    layers: LayersRow | None
    """The layers of the render targets; null where these are single pictures."""
    tessellation: TessellationRow | None
    """How each patch is divided; null where there are none."""


@frozen(kw_only=True)
class VaryingRow:
    """Values that cross from one stage to the next."""

    name: str
    """Name of the slot."""
    representation: str
    """The type on the machine: ``float``, ``vec3``, ``Lamp[8]``."""
    location: Count
    """Location."""
    mode: Literal["perspective", "flat", "corner"]
    """Interpolation. ``corner``: there is none, since the next stage reads each corner."""
    from_stage: str
    """The stage that computes it, ``vertex``."""
    to_stage: str
    """The stage that reads it, ``fragment``."""


@frozen(kw_only=True)
class TargetRow:
    """A render target and the fixed-function state it wants."""

    name: str
    """Name in the pass."""
    representation: str
    """Type that is written."""
    location: Count
    """Location."""
    format: str
    """Pixel format, ``rgba8``."""
    encoding: Literal["linear", "srgb"]
    """How colours are stored. The shader writes linear light. ``srgb``: the hardware encodes it,
    and who shows the bytes as a picture shows them as they are. ``linear``: nobody has encoded it,
    and who shows or saves it as a picture encodes it first, or it looks too dark."""
    blend: Blend | None
    """How what is drawn is blended with what is there; null where it takes its place."""
    mask: Annotated[str, Pattern("r?g?b?a?|none")]
    """Which lanes are written of those that the format has: some of ``rgba``, in this order, or
    ``none``."""
    clear: tuple[float, float, float, float] | None
    """What is there before anything is drawn, in four lanes; null where that is the host's
    affair."""
    doc: str
    """Doc comment; empty where there is none."""


@frozen(kw_only=True)
class RenderStateRow:
    """What the host sets of the pipeline, as the pass asks for it."""

    cull: Cull
    """Which triangles are not drawn, by the side that is seen of them."""
    front: Winding
    """How the corners of a triangle go around if its front is seen. What an API has to be told is
    the backend's ``front_face``."""
    fill: Fill
    """What is drawn of a triangle: all of it, or its edges as lines."""
    samples: Samples
    """How many samples each pixel of the targets and of the depths has. With several, the targets
    are resolved at the end: each pixel becomes the mean of its samples."""
    depth: DepthState
    """The depth test."""
    stencil: StencilState | None
    """The stencil test; null: there is none, and nothing is written. A host clears stencil values
    to 0."""
