"""The parts of a draw: vertex inputs, textures, targets, and the state of the pipeline."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from ...support.frozen import frozen
from ..constraints import Count, Length, Pattern, Positive, Range, Spelling
from ..ir.blending import Blend
from ..ir.formats import TARGET_WORDS, VertexFormat
from ..ir.primitives import DrawnPrimitive
from ..ir.render_state import (
    COMPARE_WORDS,
    WINDING_WORDS,
    Compare,
    Cull,
    DepthState,
    Fill,
    Samples,
    StencilState,
    Winding,
)
from ..ir.types import DIMENSION_WORDS, Border, Dimension, Intent, Sample, Wrap
from .steps import StepRow

Primitive = Literal["point", "line", "triangle", "line_adjacency", "triangle_adjacency", "patch"]
"""The primitive that vertices form, in turn."""
TOPOLOGY_WORDS: Spelling = {
    "point": "point-list",
    "line": "line-list",
    "triangle": "triangle-list",
    # WebGPU has none of these, and Vulkan names them so.
    "line_adjacency": "line-list-with-adjacency",
    "triangle_adjacency": "triangle-list-with-adjacency",
    "patch": "patch-list",
}
"""WebGPU's words for the primitives of a draw call, ``GPUPrimitiveTopology``."""
ADDRESS_MODES: Spelling = {
    "repeat": "repeat", "clamp": "clamp-to-edge", "mirror": "mirror-repeat",
    # WebGPU has none, and Vulkan and OpenGL name it so.
    "border": "clamp-to-border",
}  # fmt: skip
"""WebGPU's words for the texels beyond the edges, ``GPUAddressMode``."""


@frozen(kw_only=True)
class TextureLayout:
    """The entry of a WebGPU bind group layout for the texture, in WebGPU's words."""

    KEYS: ClassVar = {"view_dimension": "viewDimension", "sample_type": "sampleType"}

    WORDS: ClassVar = {"view_dimension": DIMENSION_WORDS}

    view_dimension: Dimension
    """GPUTextureViewDimension."""
    sample_type: Literal["float", "unfilterable-float", "depth", "sint", "uint"]
    """GPUTextureSampleType.

    It is ``unfilterable-float`` where nothing filters, so that formats fit that cannot be filtered.
    """
    sampler: Literal["filtering", "non-filtering", "comparison", None]
    """GPUSamplerBindingType; null where no sampler reads it."""


@frozen(kw_only=True)
class TextureRow:
    """A texture."""

    WORDS: ClassVar = {"dimension": DIMENSION_WORDS}

    name: str
    """Name as the host says it, ``lamps`` or ``torch.axis``."""
    type: str
    """Type as declared, such as ``texture2d`` or ``depth_cube``."""
    dimension: Dimension
    """Dimension."""
    sample: Sample
    """Content: colours, depths to compare with, or whole numbers.

    The format says whether colours are stored as sRGB, which is the host's affair.
    """
    intent: Intent
    """Intent of its numbers, by which a host chooses the format of a picture.

    ``color``: texels become colours, which the shader takes as linear light. Pictures whose colours
    are encoded as sRGB are bound in a format that decodes them. ``data``: the numbers are taken as
    they are.
    """
    layout: TextureLayout
    """The entry of a WebGPU bind group layout for the texture, in WebGPU's words."""
    group: str
    """Parameter group, which the host updates together.

    It is ``frame``, ``view``, ``rig``, ``material``, ``draw`` or a user's own.
    """
    default: str
    """Texture to bind before a host sets one, such as ``white``."""
    default_texel: tuple[float, ...]
    """The only texel of that texture, for each layer or face: the numbers that a shader reads.

    There are four of them, and one of depths.
    """
    stages: tuple[str, ...]
    """Stages that read it."""
    doc: str
    """Doc comment; empty where there is none."""
    library: str | None
    """Declaration of the library that it is, as for parameters; null where it is none of them."""
    declared_by: str | None = None
    """Declaration that declares it, as for parameters."""
    brought: bool
    """True if it is made by steps that a light brings to frames, such as its shadow map.

    Where there is no frame, a host that wants to see the result binds a texture of its own.
    """


@frozen(kw_only=True)
class SamplerState:
    """The state of a sampler: its filters, its comparison, and the texels beyond the edges."""

    WORDS: ClassVar = {
        **dict.fromkeys(("wrap", "wrap_u", "wrap_v", "wrap_w"), ADDRESS_MODES),
        "compare": COMPARE_WORDS,
    }

    filter: Literal["linear", "nearest"]
    """Filter between the texels of a level, a GPUFilterMode."""
    mip: Literal["linear", "nearest", "none"]
    """Filter between levels, a GPUMipmapFilterMode.

    ``none``: only the first level is read, for which hosts set the largest level of detail to 0.
    """
    wrap: Wrap
    """Texels beyond the edges, a GPUAddressMode: of each axis that says nothing else below."""
    wrap_u: Wrap | None = None
    """Texels beyond the left and the right edge; left out where ``wrap`` holds."""
    wrap_v: Wrap | None = None
    """Texels beyond the upper and the lower edge; left out where ``wrap`` holds."""
    wrap_w: Wrap | None = None
    """Texels beyond the first and the last slice; left out where ``wrap`` holds."""
    border: Border | None = None
    """Texel beyond the edges of an axis that is ``clamp-to-border``; left out where none is.

    ``transparent`` has zeros, ``black`` has an alpha of one, and all lanes of ``white`` are one. Of
    depths, ``black`` is 0 and ``white`` is 1.
    """
    anisotropy: Literal[2, 4, 8, 16] | None = None
    """Most samples along the longer side of a footprint, GPUSamplerDescriptor.maxAnisotropy.

    Left out where it is 1. A device that takes fewer gets as many as it takes.
    """
    compare: Compare | None
    """Comparison of a reference, on the left, with a depth, a GPUCompareFunction.

    Null where none is compared.
    """


@frozen(kw_only=True)
class SamplerRow:
    """The state of the sampler that reads a texture."""

    texture: str
    """The texture."""
    state: SamplerState
    """The state: filters, comparison, and the texels beyond the edges."""


@frozen(kw_only=True)
class InBuffer:
    """The storage buffer whose elements have its values, and their member that has them.

    There is one where a kernel captures vertices, or corners need more than 16 vertex inputs;
    otherwise null.
    """

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
    """Number of the column, from 0."""


@frozen(kw_only=True)
class MeshInputRow:
    """The meaning of this in the mesh, if each primitive is drawn as an instance; else null."""

    name: str
    """The vertex input as declared, or the number that the host counts."""
    corner: Count | None
    """Number of the corner whose value it is, from 0.

    It is a corner of the primitive, or of the pattern's triangle or line. Null where a whole
    instance of the mesh has one value, or a point of the pattern.
    """
    is_number: bool
    """True if it is the number of a vertex, an instance or a primitive of the mesh."""
    is_of_pattern: bool
    """True if it is the place of a point of the pattern in a patch."""


@frozen(kw_only=True)
class VertexInputRow:
    """A vertex input that the program reads."""

    name: str
    """Name as declared; of a matrix's column with its number, ``bend.0``."""
    type: str
    """The type as written: ``rgb``, ``direction<world>``, ``Lamp[8]``."""
    representation: str
    """The type on the machine: ``float``, ``vec3``, ``Lamp[8]``."""
    format: VertexFormat | None
    """Format, a GPUVertexFormat; null where a buffer has its values."""
    location: Count | None
    """Location; null where a buffer has its values."""
    buffer: InBuffer | None
    """The storage buffer whose elements have its values, and their member that has them.

    There is one where a kernel captures vertices, or corners need more than 16 vertex inputs;
    otherwise null.
    """
    step: Literal["vertex", "instance"]
    """The step of its values: one for each vertex, or one for each instance."""
    column: MatrixColumn | None
    """The declared matrix that this is a column of, and which; null for others."""
    mesh: MeshInputRow | None
    """The meaning of this in the mesh, if each primitive is drawn as an instance; else null."""
    doc: str
    """Doc comment; empty where there is none."""


@frozen(kw_only=True)
class CapturedRow:
    """A captured value."""

    name: str
    """Name of the value."""
    type: str
    """Type as declared."""
    representation: str
    """Type without meaning: a number of 32 bits, or a vector of these."""
    offset: Count
    """Bytes from where the vertex begins."""
    doc: str
    """Doc comment; empty where there is none."""


@frozen(kw_only=True)
class CaptureRow:
    """Captured vertices: all values of a vertex without gaps, one vertex behind the other."""

    WORDS: ClassVar = {
        "topology": {word: TOPOLOGY_WORDS[word] for word in ("point", "line", "triangle")}
    }

    topology: DrawnPrimitive
    """Captured primitives: points, lines of two vertices each, or triangles of three each.

    A GPUPrimitiveTopology, by which the vertices can be drawn again.
    """
    vertices: Positive
    """Largest number of vertices for each primitive that is drawn."""
    stride: Annotated[int, Range(least=4)]
    """Bytes of each vertex."""
    buffer: str | None
    """The result that has the vertices, where a kernel captures; null for a stream output."""
    there: int | None
    """Offset of a flag behind the values of a vertex, in bytes from where the vertex begins.

    The flag is 1 if the vertex is there, and 0 if not; the vertex then has 4 bytes more. A kernel
    writes it. Null where all vertices are there, and for a stream output.
    """
    members: Annotated[tuple[CapturedRow, ...], Length(1)]
    """The values, in order."""


@frozen(kw_only=True)
class LayersRow:
    """The layers of the render targets; null where these are single pictures."""

    count: Positive
    """Number of layers."""
    parameter: str | None
    """Parameter that says to which layer a draw belongs: there is one draw for each.

    Null where a single draw reaches all layers.
    """
    view_mask: Positive | None
    """View mask of the render pass, where a draw reaches all layers as views: bit 0 for layer 0.

    For Vulkan's ``VkRenderPassMultiviewCreateInfo``, or one of Direct3D's view instances for each
    bit. Null where the geometry stage chooses among layers, or each layer has a draw of its own.
    """


@frozen(kw_only=True)
class PatchLevels:
    """The levels of that pattern; null where the texts compute them."""

    edges: tuple[tuple[StepRow, ...], ...]
    """For each edge, the steps that compute its level.

    The edges of a triangle are those across from its ends; those of a quad are at u = 0, v = 0, u =
    1 and v = 1.
    """
    inside: tuple[tuple[StepRow, ...], ...]
    """The steps that compute the levels of the inside; of a quad along u, and along v."""


@frozen(kw_only=True)
class TessellationRow:
    """The division of each patch of a mesh."""

    kind: Literal["triangle", "quad", "isoline"]
    """Kind of patch."""
    ends: tuple[Count, ...]
    """The control points of a patch that are its corners.

    Those of a triangle have the weights x, y and z; those of a quad lie at (0, 0), (1, 0), (1, 1)
    and (0, 1); a line begins at the first one.
    """
    spacing: Literal["equal", "fractional_even", "fractional_odd"]
    """Spacing of the steps of edges: equal, or with two shorter ones of an even or odd number."""
    divided_by: Literal["evaluation", "instances"]
    """The means of division: the tessellation stages, or a draw of one instance for each patch.

    The vertices of an instance are the points of a pattern that the host makes, or they compute
    their places from their numbers.
    """
    levels: PatchLevels | None
    """The levels of that pattern; null where the texts compute them."""


@frozen(kw_only=True)
class DrawRow:
    """The draw call, and the primitives that it draws."""

    WORDS: ClassVar = {"topology": TOPOLOGY_WORDS}

    primitive: Primitive
    """Primitives of the mesh."""
    corners: Positive
    """Number of vertices of each of these primitives."""
    expanded_by: Literal["geometry", "instances", None]
    """The means of expansion: the geometry stage, or a draw of one instance for each primitive.

    Null where primitives are drawn as they are.
    """
    vertices: Annotated[int, Range(least=2)] | None
    """Largest number of vertices that a primitive, or a patch, turns into.

    For each instance, this is a list of triangles or lines. Null where they are drawn as they are,
    or where the host makes the pattern. Where it makes the pattern and all parts of that are
    expanded, it is the number for each of these parts.
    """
    topology: Primitive
    """Primitives of a draw call's vertices, in turn, for the host to tell the API.

    A GPUPrimitiveTopology; for those that WebGPU lacks, as Vulkan calls them: ``patch-list``.
    """
    layers: LayersRow | None
    """The layers of the render targets; null where these are single pictures."""
    tessellation: TessellationRow | None
    """Division of each patch; null where there are none."""


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

    WORDS: ClassVar = {"format": TARGET_WORDS}

    name: str
    """Name in the pass."""
    representation: str
    """Type that is written."""
    location: Count
    """Location."""
    format: str
    """Pixel format, a GPUTextureFormat: ``rgba8unorm``."""
    encoding: Literal["linear", "srgb"]
    """Encoding of colours. The shader writes linear light.

    ``srgb``: the hardware encodes it, and who shows the bytes as a picture shows them as they are.
    ``linear``: nobody has encoded it, and who shows or saves it as a picture encodes it first, or
    it looks too dark.
    """
    blend: Blend | None
    """Blending with the colour in the target; null where the new one takes its place."""
    mask: Annotated[str, Pattern("r?g?b?a?|none")]
    """Lanes that are written of those that the format has.

    Some of ``rgba``, in this order, or ``none``.
    """
    clear: tuple[float, float, float, float] | None
    """Value before anything is drawn, in four lanes; null where that is the host's affair."""
    doc: str
    """Doc comment; empty where there is none."""


@frozen(kw_only=True)
class RenderStateRow:
    """The state of the pipeline that the host sets, as the pass asks for it."""

    WORDS: ClassVar = {"front": WINDING_WORDS}

    cull: Cull
    """Triangles that are not drawn, by the side that is seen of them."""
    front: Winding
    """Order of the corners of a triangle whose front is seen.

    An API has to be told the backend's ``front_face``.
    """
    fill: Fill
    """Part of a triangle that is drawn: all of it, or its edges as lines."""
    samples: Samples
    """Number of samples of each pixel of the targets and of the depths.

    With several, the targets are resolved at the end: each pixel becomes the mean of its samples.
    """
    alpha_to_coverage: bool
    """True: the alpha of the first target says how many of the samples a fragment covers."""
    depth: DepthState
    """The depth test."""
    stencil: StencilState | None
    """The stencil test; null: there is none, and nothing is written.

    A host clears stencil values to 0.
    """
