"""The table of stages: one row for each program that a pipeline can run, and what it delivers.

A value varies over a *domain*: it exists once for each vertex, say, or once for each fragment. A
stage is the program that computes the values of one domain, and a *chain* is a pipeline's stages in
the order in which they run. Semantics reads the rows to know which inputs a domain has and what can
be delivered from it; a shader then carries the rows of its own chain, and the passes, emission,
reflection and the runtime read them there.

To add a stage is to add a row; ``docs/architecture.md`` lists what else it needs.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...frozen import frozen
from .types import BOOL, UINT, VEC4, Type

CLIP_POSITION = "clip_position"
"""The kind of the result that places a vertex: a vec4 in clip space."""
TARGET = "target"
"""The kind of a result that is written to a render target."""
DISCARD = "discard"
"""The kind of the result that says where nothing is written."""
VARYING = "varying"
"""The kind of what a stage delivers to the next one; packing makes these results."""


@frozen
class SystemInput:
    """A value that the pipeline itself supplies to a stage."""

    name: str
    type: Type
    """The type that Burnish gives it; what a language has may differ."""
    per_instance: bool = False
    """Whether it is the same at all vertices of an instance."""


@frozen(key=True)
class StageRow:
    """What has to be known of a stage."""

    name: str
    domain: str
    """What it is run for, and so what the values vary over that it computes."""
    suffix: str
    """The file ending before that of the language, which is also what tools call the stage."""
    entry: str
    """The entry point in a text that holds several stages."""
    inputs: tuple[SystemInput, ...]
    """What it may read of the pipeline, besides what the stage before it hands on."""
    delivers: tuple[str, ...]
    """The kinds of results that it can have, besides varyings."""
    has_derivatives: bool = False
    """Whether it runs beside its neighbours, so that differences between them can be taken: by
    derivatives, and by reads of textures that choose their level themselves."""


VERTEX = StageRow(
    "vertex", "vertex", "vert", "vs_main",
    inputs=(
        SystemInput("vertex_index", UINT),
        SystemInput("instance_index", UINT, per_instance=True),
    ),
    delivers=(CLIP_POSITION,),
)  # fmt: skip

FRAGMENT = StageRow(
    "fragment", "fragment", "frag", "fs_main",
    inputs=(
        # Pixel centres lie at .5, y points down, and w is 1 / clip w.
        SystemInput("frag_coord", VEC4),
        # Whether the counter-clockwise side is seen.
        SystemInput("front_facing", BOOL),
    ),
    delivers=(TARGET, DISCARD),
    has_derivatives=True,
)  # fmt: skip

STAGES: Mapping[str, StageRow] = {row.name: row for row in (VERTEX, FRAGMENT)}
"""All stages by name."""

Chain = tuple[StageRow, ...]
"""The stages of a pipeline in the order in which they run; the first reads the vertex inputs."""

RASTERISED: Chain = (VERTEX, FRAGMENT)
"""What draws a mesh: the vertices of its triangles, and the fragments that these cover."""

SYSTEM_INPUTS: Mapping[str, SystemInput] = {
    supplied.name: supplied for row in STAGES.values() for supplied in row.inputs
}
"""What the pipeline supplies to any stage, by name."""
