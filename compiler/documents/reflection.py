"""The reflection: everything a host has to know about one material."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar, Literal

from ...support.frozen import frozen
from ..constraints import Positive
from .backends import BackendRow
from .drawing import (
    CaptureRow,
    DrawRow,
    PatchLevels,
    RenderStateRow,
    SamplerRow,
    TargetRow,
    TextureRow,
    VaryingRow,
    VertexInputRow,
)
from .steps import StepRow
from .values import (
    BlockRow,
    BufferRow,
    DerivedRow,
    LightRow,
    ParameterRow,
    PromiseRow,
    ResultRow,
)


@frozen(kw_only=True)
class Conventions:
    """The conventions of all materials and backends.

    A backend's own row says where its text differs.
    """

    clip_space: Literal["x right, y up, z in 0..w"]
    """Clip space of the material's meaning."""
    handedness: Literal["right"]
    """Handedness of world space."""
    front_face: Literal["ccw"]
    """Winding of front faces."""
    texture_origin: Literal["top_left"]
    """Texel at the origin of texture coordinates; v points down."""
    matrices: Literal["column"]
    """Vectors are columns, and matrices are stored column after column."""


@frozen(kw_only=True)
class Reflection:
    """Everything a host has to know about one material under one pass and one rig."""

    VERSION: ClassVar = "format"

    format: Literal[3]
    """Version of this document's format."""
    material: str
    """The material."""
    pass_: str
    """The pass."""
    rig: str
    """The rig."""
    doc: str
    """The material's doc comment; empty where there is none."""
    conventions: Conventions
    """The conventions of all materials and backends.

    A backend's own row says where its text differs.
    """
    blocks: tuple[BlockRow, ...]
    """Uniform blocks in binding order."""
    parameters: tuple[ParameterRow, ...]
    """Declared parameters in order of declaration."""
    derived: tuple[DerivedRow, ...]
    """Values of the derived blocks."""
    promises: tuple[PromiseRow, ...]
    """Promises of the host by ``nonzero``, besides ranges and directions."""
    lights: tuple[LightRow, ...]
    """Lights of the rig."""
    buffers: tuple[BufferRow, ...]
    """Storage buffers in order of declaration."""
    results: tuple[ResultRow, ...]
    """Storage buffers that a kernel writes, in order of declaration; none for a material."""
    extent: tuple[StepRow, ...] | None
    """Steps that compute the number of elements of each of a kernel's results.

    For images, they compute the width and height. Null for a material.
    """
    work_group: tuple[Positive, Positive, Positive] | None
    """Size of a kernel's work group in invocations, along x, y and z; null for a material."""
    textures: tuple[TextureRow, ...]
    """Textures in order of declaration."""
    samplers: tuple[SamplerRow, ...]
    """Sampler states, one for each texture that is not merely loaded."""
    draw: DrawRow
    invariant_position: bool
    """True if the position of a vertex is invariant.

    It is then the same number, bit by bit, in all programs that compute it in the same way, so that
    their depths are equal. The texts say so.
    """
    render_state: RenderStateRow
    """State of the pipeline that the host sets, as the pass asks for it."""
    capture: CaptureRow | None
    """Values of each vertex that are written to one buffer, instead of drawing.

    Null for a pass that draws, and for a kernel.
    """
    vertex_inputs: tuple[VertexInputRow, ...]
    """Vertex inputs."""
    pipeline_inputs: Mapping[str, tuple[str, ...]]
    """Inputs that the pipeline itself supplies, by stage: one row for each stage that there is."""
    varyings: tuple[VaryingRow, ...]
    """Varyings."""
    targets: tuple[TargetRow, ...]
    """Render targets.

    For a kernel over images, they are its images in order of declaration, which are the render
    targets of its full-screen pass.
    """
    backends: Mapping[str, BackendRow]
    """Emitted profiles by name."""

    @property
    def levels(self) -> PatchLevels | None:
        """The levels of the pattern that a host makes of patches; ``None`` where it makes none."""
        division = self.draw.tessellation
        return None if division is None else division.levels

    @property
    def computed(self) -> Iterator[tuple[StepRow, ...]]:
        """Yields the steps of all that the host computes.

        These are derived values, the extent of a kernel and the lengths of its results, and the
        levels of patches.
        """
        yield from (row.steps for row in self.derived)
        yield self.extent or ()
        yield from (row.count for row in self.results)
        if self.levels is not None:
            yield from (*self.levels.edges, *self.levels.inside)
