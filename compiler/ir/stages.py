"""The table of stages: one row for each program that a pipeline can run, and what it delivers.

A value varies over a *domain*: it exists once for each vertex, say, or once for each fragment. A
stage is the program that computes the values of one domain, and a *chain* is a pipeline's stages in
the order in which they run. Semantics reads the rows to know which inputs a domain has and what can
be delivered from it; a shader then carries the rows of its own chain, and the passes, emission,
reflection and the runtime read them there.

To add a stage is to add a row; ``docs/architecture.md`` lists what else it needs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import Literal

from ...support.frozen import frozen
from .types import BOOL, INT, IVEC2, UINT, VEC2, VEC3, VEC4, Type

Domain = str
"""The name of a domain: one of these, or that of another stage's row."""
VERTICES: Domain = "vertex"
PATCHES: Domain = "patch"
"""The patches of a mesh that is tessellated."""
TESSELLATED: Domain = "tessellated"
"""The vertices of the triangles or lines into which patches are divided."""
EMITTED: Domain = "emitted"
"""The vertices of the primitives that those of a mesh turn into."""
FRAGMENTS: Domain = "fragment"
INVOCATIONS: Domain = "invocation"
INSTANCES: Domain = "instance"
"""A domain without a stage: each vertex of an instance has the values of the instance."""
VIEWS: Domain = "view"
"""A domain without a stage: all that is drawn of a view has the values of the view."""

CLIP_POSITION = "clip_position"
"""The kind of the result that places a vertex: a vec4 in clip space."""
TARGET = "target"
"""The kind of a result that is written to a render target."""
DISCARD = "discard"
"""The kind of the result that says where nothing is written."""
FRAGMENT_DEPTH = "fragment_depth"
"""The kind of the result that takes the place of the depth of the face, in 0..1."""
EDGE_LEVEL = "edge_level"
"""The kind of the results that say into how many steps each edge of a patch is divided.

They are in the order of ``tessellation.PatchKind.edges``.
"""
INNER_LEVEL = "inner_level"
"""The kind of those that say the same of the inside: of a quad along u, and then along v."""
EMITTING = "emitting"
"""The kind of the results that say, each for one group of strips, which of these there are."""
PLACING = frozenset((CLIP_POSITION, EDGE_LEVEL, INNER_LEVEL, EMITTING))
"""The kinds of the results that decide which vertices there are, and where."""
LAYER = "layer"
"""The kind of the result that says to which layer of the render targets a strip is drawn."""
CAPTURE = "capture"
"""The kind of a result that is written to a buffer for each vertex, instead of drawing."""
STORE = "store"
"""The kind of a result that is written to an element of a storage buffer."""
IMAGE = "image"
"""The kind of a result that is written to a texel of an image."""
SCATTER = "scatter"
"""The kind of a result that is joined with an element that the invocation chooses.

Each has results of the next three kinds beside it, whose ``store`` is the same.
"""
PLACE = "place"
"""The kind of a result that says which element that is."""
CONDITION = "condition"
"""The kind of a condition: something is joined, and there is such an element."""
LENGTH = "length"
"""The kind of a result that is the number of a buffer's elements.

It exists where a buffer has not as many elements as invocations; only a host asks for it.
"""
EXTENT = "extent"
"""The kind of the result that says for how many elements a kernel is run.

For images, it is the number of texels in a row and in a column.
"""
VALUE = "value"
"""The kind of a result that a function returns to the engine that calls it, instead of a stage."""
SURFACE = "surface"
"""The kind of a varying that an engine has itself, such as the place of a pixel in the world.

Functions get it as an argument; it is no result for anybody else.
"""
VARYING = "varying"
"""The kind of a varying that a stage delivers to the next one; packing makes these results."""


InterpolationMode = Literal["perspective", "flat", "corner"]


@frozen(key=True)
class Crossing:
    """The data of a ``cross`` node: how a value gets from the domain of one stage to the next."""

    origin: Domain
    """The domain of its operand."""
    destination: Domain
    """The domain of the node."""
    mode: InterpolationMode
    """The interpolation.

    The value is a weighted mean of several values, or one of them: that of a corner whose number is
    the second operand, or (``flat``) always that of the first one.
    """

    def __str__(self) -> str:
        return f"{self.origin} to {self.destination}, {self.mode}"


SMOOTH = Crossing(VERTICES, FRAGMENTS, "perspective")
"""Interpolated over a triangle."""
FLAT = Crossing(VERTICES, FRAGMENTS, "flat")
"""The value at the first of a triangle's vertices."""
CORNER = Crossing(VERTICES, EMITTED, "corner")
"""The value at one corner of the primitive that is being expanded."""
TESSELLATED_CORNER = Crossing(TESSELLATED, EMITTED, "corner")
"""The value at one corner of a primitive into which a patch is divided, and which is expanded."""
INTO_EMITTED: Mapping[Domain, Crossing] = {
    crossing.origin: crossing for crossing in (CORNER, TESSELLATED_CORNER)
}
"""The crossings to emitted vertices, from the domains of the corners of a primitive."""
PATCH_CORNER = Crossing(VERTICES, PATCHES, "corner")
"""The value at one control point of the patch whose levels are computed."""
CONTROL_POINT = Crossing(VERTICES, TESSELLATED, "corner")
"""The value at one control point of the patch a vertex of which is computed."""
SMOOTH_TESSELLATED = Crossing(TESSELLATED, FRAGMENTS, "perspective")
FLAT_TESSELLATED = Crossing(TESSELLATED, FRAGMENTS, "flat")
OF_PATCH = Crossing(PATCHES, TESSELLATED, "flat")
"""The crossing of values that are the same all over a patch."""
SMOOTH_EMITTED = Crossing(EMITTED, FRAGMENTS, "perspective")
FLAT_EMITTED = Crossing(EMITTED, FRAGMENTS, "flat")

INTO_FRAGMENTS: Mapping[Domain, tuple[Crossing, Crossing]] = {
    smooth.origin: (smooth, flat)
    for smooth, flat in (
        (SMOOTH, FLAT),
        (SMOOTH_TESSELLATED, FLAT_TESSELLATED),
        (SMOOTH_EMITTED, FLAT_EMITTED),
    )
}
"""The crossings to fragments from the vertices of the triangles around them.

Of each pair, the first one is interpolated; the second one serves all other values.
"""


@frozen(key=True)
class SystemInput:
    """A value that the pipeline itself supplies to a stage."""

    name: str
    type: Type
    """The type in Burnish; that of a language may differ."""
    domain: Domain
    """The domain of the stage that reads it, or ``INSTANCES`` or ``VIEWS``."""
    most: int | None = None
    """The largest value that it can have, of one that counts from 0."""

    def __str__(self) -> str:
        return self.name


@frozen(key=True)
class StageRow:
    """A stage of the pipeline."""

    name: str
    domain: Domain
    """The domain of the values that it computes: it runs once for each element."""
    suffix: str
    """The file ending before that of the language, which is also the tools' name of the stage."""
    entry: str
    """The entry point in a text that holds several stages."""
    inputs: tuple[SystemInput, ...]
    """The inputs that it may read from the pipeline, besides those from the stage before it."""
    delivers: tuple[str, ...]
    """The kinds of results that it can have, besides varyings."""
    hands_on: bool = False
    """True if the stage behind it reads the same vertices, besides the values of this one."""
    has_derivatives: bool = False
    """True if it runs beside its neighbours, so that differences between them can be taken.

    Derivatives take them, and reads of textures that choose their level themselves.
    """


VIEW_INDEX = SystemInput("view_index", INT, VIEWS)
"""The number of the view that is drawn, in a pass that draws several views."""

VERTEX = StageRow(
    "vertex", VERTICES, "vert", "vs_main",
    inputs=(
        SystemInput("vertex_index", UINT, VERTICES),
        SystemInput("instance_index", UINT, INSTANCES),
        VIEW_INDEX,
    ),
    delivers=(CLIP_POSITION, CAPTURE, VALUE),
)  # fmt: skip

PATCH_INDEX = SystemInput("patch_index", UINT, PATCHES)
"""The number of the patch in the draw."""

CONTROL = StageRow(
    "control", PATCHES, "tesc", "hs_main",
    inputs=(PATCH_INDEX,),
    delivers=(EDGE_LEVEL, INNER_LEVEL),
    hands_on=True,
)  # fmt: skip

PATCH_WEIGHTS = SystemInput("patch_weights", VEC3, TESSELLATED)
"""The barycentric coordinates of a vertex in a triangle: the weights of its three ends."""
PATCH_COORDINATE = SystemInput("patch_coordinate", VEC2, TESSELLATED)
"""The coordinates of a vertex in a quad (u, v), or on the lines of an isoline patch.

There u goes along a line, and v tells the lines apart.
"""
PATTERN_VERTEX = SystemInput("pattern_vertex", INT, TESSELLATED)
"""The number of a vertex among those of its patch, as a list.

No pipeline supplies it: it becomes that of a vertex in a draw of instances.
"""

EVALUATION = StageRow(
    "evaluation", TESSELLATED, "tese", "ds_main",
    inputs=(PATCH_WEIGHTS, PATCH_COORDINATE),
    delivers=(CLIP_POSITION, CAPTURE),
)  # fmt: skip

PRIMITIVE_INDEX = SystemInput("primitive_index", UINT, EMITTED)
GROUP = SystemInput("emitted_group", INT, EMITTED)
"""The number of a group of strips in an expansion. No pipeline supplies this and the following two:
they become numbers of the loops in which vertices are emitted, or of a list of vertices."""
STRIP = SystemInput("emitted_strip", INT, EMITTED)
"""The number of a strip in its group."""
STRIP_VERTEX = SystemInput("emitted_vertex", INT, EMITTED)
"""The number of an emitted vertex in its strip."""

GEOMETRY = StageRow(
    "geometry", EMITTED, "geom", "gs_main",
    inputs=(PRIMITIVE_INDEX,),
    delivers=(CLIP_POSITION, LAYER, EMITTING, CAPTURE),
)  # fmt: skip

FRAGMENT = StageRow(
    "fragment", FRAGMENTS, "frag", "fs_main",
    inputs=(
        # Pixel centres lie at .5, y points down, and w is 1 / clip w.
        SystemInput("frag_coord", VEC4, FRAGMENTS),
        # True if the counter-clockwise side is seen.
        SystemInput("front_facing", BOOL, FRAGMENTS),
        VIEW_INDEX,
    ),
    delivers=(TARGET, DISCARD, FRAGMENT_DEPTH, VALUE, SURFACE),
    has_derivatives=True,
)  # fmt: skip

COMPUTE = StageRow(
    "compute", INVOCATIONS, "comp", "cs_main",
    inputs=(
        # The number of the element that is computed.
        SystemInput("index", INT, INVOCATIONS, most=2**31 - 1),
        # The place of the texel that is computed: from the left, and from the top.
        SystemInput("texel", IVEC2, INVOCATIONS),
    ),
    delivers=(STORE, SCATTER, PLACE, CONDITION, LENGTH, IMAGE, EXTENT),
)  # fmt: skip

STAGES: Mapping[str, StageRow] = {
    row.name: row for row in (VERTEX, CONTROL, EVALUATION, GEOMETRY, FRAGMENT, COMPUTE)
}
"""All stages by name."""

ENTRY_POINTS = tuple(row.entry for row in STAGES.values())
"""Names that a text of several stages uses for itself."""

Chain = tuple[StageRow, ...]
"""The stages of a pipeline in the order in which they run; the first reads the vertex inputs."""

RASTERISED: Chain = (VERTEX, FRAGMENT)
"""Draws a mesh: the vertices of its triangles, and the fragments that these cover."""

EXPANDED: Chain = (VERTEX, GEOMETRY, FRAGMENT)
"""Turns each primitive of a mesh into others before these are drawn."""

CAPTURED: Chain = (VERTEX,)
"""Writes the vertices of a mesh's triangles to a buffer, and draws nothing."""

CAPTURED_EXPANDED: Chain = (VERTEX, GEOMETRY)
"""Expands each primitive of a mesh, and writes the vertices to a buffer."""

TESSELLATED_CHAIN: Chain = (VERTEX, CONTROL, EVALUATION, FRAGMENT)
"""Divides each patch of a mesh into triangles or lines before these are drawn."""

TESSELLATED_EXPANDED: Chain = (VERTEX, CONTROL, EVALUATION, GEOMETRY, FRAGMENT)
"""Divides each patch, and expands each of its triangles or lines before these are drawn."""

COMPUTED: Chain = (COMPUTE,)
"""Computes the elements of buffers or the texels of images, each by an invocation of its own."""


def inputs_of(chain: Iterable[StageRow]) -> dict[str, SystemInput]:
    """The inputs that the pipeline supplies to these stages, by name."""
    return {supplied.name: supplied for row in chain for supplied in row.inputs}


def joined_in(chain: Chain) -> set[tuple[Domain, Domain]]:
    """The pairs of domains between which values may cross.

    They are those of stages that follow each other, and those with a stage between them that hands
    its vertices on.
    """
    found = set(pairwise(row.domain for row in chain))
    for before, row, behind in zip(chain, chain[1:], chain[2:], strict=False):
        if row.hands_on:
            found.add((before.domain, behind.domain))
    return found
