"""Everything a host has to know about a compiled material, as one document."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Literal

from ...stdlib.builtins.geometry import SHORTEST
from ...support.frozen import changed
from ..documents.backends import BackendRow
from ..documents.drawing import (
    CapturedRow,
    CaptureRow,
    DrawRow,
    InBuffer,
    LayersRow,
    MatrixColumn,
    MeshInputRow,
    PatchLevels,
    RenderStateRow,
    TargetRow,
    TessellationRow,
    VaryingRow,
    VertexInputRow,
)
from ..documents.reflection import Conventions, Reflection
from ..documents.values import PromiseRow
from ..ir.blending import REPLACES
from ..ir.formats import VERTEX_FORMATS
from ..ir.leaves import Parameter
from ..ir.node import Node, reachable
from ..ir.primitives import DrawnPrimitive
from ..ir.program import Program
from ..ir.render_state import RenderState
from ..ir.shader import AttributeInfo, MeshInput, Shader
from ..ir.stages import (
    EDGE_LEVEL,
    EVALUATION,
    EXTENT,
    GEOMETRY,
    IMAGE,
    INNER_LEVEL,
    INSTANCES,
    LENGTH,
    PATCHES,
    TARGET,
    Domain,
)
from ..ir.tessellation import Tessellation
from ..promises import promises
from .buffers import buffer_rows, extent_steps, result_rows
from .bytes import block_rows
from .parameters import Places, Reads, derived_rows, light_rows, parameter_rows
from .textures import TextureRows
from .values import steps


def capture_row(shader: Shader) -> CaptureRow:
    """The buffer into which a pass captures, for a host."""
    capture = shader.capture
    assert capture is not None
    written = next(iter(shader.written), None)
    is_told = written is not None and written.each > capture.numbers
    return CaptureRow(
        topology=_primitive(shader),
        vertices=_vertices_each(shader),
        stride=capture.stride,
        buffer=None if written is None else written.leaf.name,
        there=capture.stride if is_told else None,
        members=tuple(
            CapturedRow(
                name=member.name,
                type=member.declared_type,
                representation=str(member.type),
                offset=member.offset,
                doc=member.doc,
            )
            for member in capture.members
        ),
    )


def _primitive(shader: Shader) -> DrawnPrimitive:
    """The kind of primitives of the captured vertices."""
    if shader.expansion is not None:
        return shader.expansion.emits
    return "triangle" if shader.tessellation is None else shader.tessellation.kind.drawn


def _vertices_each(shader: Shader) -> int:
    """The largest number of vertices for each primitive or patch that is drawn."""
    if shader.listed:
        return shader.listed
    return 3 if shader.expansion is None else shader.expansion.listed


FORMAT: Literal[3] = 3
"""Grows when a host that reads the document has to change."""

CONVENTIONS = Conventions(
    clip_space="x right, y up, z in 0..w",
    handedness="right",
    front_face="ccw",
    texture_origin="top_left",
    matrices="column",
)


def reflect(
    shader: Shader,
    program: Program,
    backends: Mapping[str, BackendRow],
    derived: Mapping[Parameter, Node] | None = None,
) -> Reflection:
    """The reflection of ``program``, which ``shader`` became.

    ``backends`` are the rows of the emitted profiles by profile name. ``derived`` are the values
    of the derived parameters in terms of the others, of declared types (not lowered to storage).
    """
    infos = shader.parameters
    places = Places(program.blocks)
    textures = TextureRows(shader.textures, program)
    return Reflection(
        format=FORMAT,
        material=shader.name,
        pass_=shader.pass_name,
        rig=shader.rig_name,
        doc=shader.doc,
        conventions=CONVENTIONS,
        blocks=tuple(block_rows(program, derived or {})),
        parameters=parameter_rows(infos, places, _reads(shader, program, derived or {})),
        derived=derived_rows(places, derived or {}, infos),
        promises=tuple(_promise_rows(shader)),
        lights=light_rows(infos),
        buffers=tuple(buffer_rows(shader.buffers, program)),
        results=tuple(result_rows(shader)),
        extent=extent_steps(shader),
        work_group=shader.work_group,
        textures=textures.textures(),
        samplers=textures.samplers(),
        draw=_draw_row(shader),
        invariant_position=shader.render_state.is_invariant,
        render_state=_render_state_row(shader.render_state),
        capture=None if shader.capture is None else capture_row(shader),
        vertex_inputs=(
            *_vertex_input_rows(shader.attributes, program),
            *_mesh_buffer_rows(shader),
        ),
        pipeline_inputs={stage.name: tuple(stage.builtin_inputs) for stage in program.stages},
        varyings=tuple(_varying_rows(program)),
        targets=tuple(_target_rows(shader)),
        backends=dict(sorted(backends.items())),
    )


def _reads(shader: Shader, program: Program, derived: Mapping[Parameter, Node]) -> Reads:
    """What the stages read, and the values that the host computes for them or for a draw."""
    found = Reads()
    for stage in program.stages:
        found.add(stage.nodes)
    computed = [result.value for kind in (EXTENT, LENGTH) for result in shader.results_of(kind)]
    levels = [level.value for level in shader.levels]
    found.add(reachable([*derived.values(), *computed, *levels]))
    return found


def _render_state_row(state: RenderState) -> RenderStateRow:
    """The state of the pipeline that a host sets, as the pass asks for it."""
    return RenderStateRow(
        cull=state.cull,
        front=state.front,
        fill=state.fill,
        samples=state.samples,
        alpha_to_coverage=state.alpha_to_coverage,
        depth=state.depth,
        stencil=state.stencil if state.stencil.is_used else None,
    )


def _promise_rows(shader: Shader) -> Iterator[PromiseRow]:
    for promise in promises(shader):
        yield PromiseRow(
            value=promise.value, least_length=SHORTEST, parameters=tuple(promise.parameters)
        )


def _vertex_input_rows(
    attributes: Iterable[AttributeInfo], program: Program
) -> Iterator[VertexInputRow]:
    declared = {info.leaf.name: info for info in attributes}
    for field in program.vertex_inputs:
        info = declared[field.name]
        yield VertexInputRow(
            name=field.name,
            type=info.declared_type,
            representation=str(field.type),
            format=VERTEX_FORMATS[str(field.type)],
            location=field.location,
            step=_step(field.step),
            column=_column_row(info),
            mesh=_mesh_row(info.mesh),
            buffer=None,
            doc=info.doc,
        )


def _mesh_buffer_rows(shader: Shader) -> Iterator[VertexInputRow]:
    """Vertex inputs that are storage buffers, for a kernel that captures."""
    for info in shader.buffers:
        for member, read in info.of_mesh:
            leaf = read.leaf
            yield VertexInputRow(
                name=leaf.name,
                type=read.declared_type,
                representation=str(leaf.type),
                format=None,
                location=None,
                step=_step(leaf.step),
                column=_column_row(read),
                mesh=_mesh_row(read.mesh),
                buffer=InBuffer(name=info.leaf.name, member=member),
                doc=read.doc,
            )


def _step(domain: Domain) -> Literal["vertex", "instance"]:
    """The word for when a vertex input has its next value."""
    return "instance" if domain == INSTANCES else "vertex"


def _column_row(info: AttributeInfo) -> MatrixColumn | None:
    return MatrixColumn(of=info.matrix, index=info.column) if info.matrix else None


def _mesh_row(mesh: MeshInput | None) -> MeshInputRow | None:
    if mesh is None:
        return None
    return MeshInputRow(
        name=mesh.name,
        corner=mesh.corner,
        is_number=mesh.is_number,
        is_of_pattern=mesh.is_of_pattern,
    )


def _draw_row(shader: Shader) -> DrawRow:
    """The draw of a host: the triangles of a mesh, or of its expanded primitives or patches."""
    expansion, patches = shader.expansion, shader.tessellation
    row = DrawRow(
        primitive="triangle", corners=3, expanded_by=None, vertices=None,
        topology="triangle", tessellation=None, layers=_layers_row(shader),
    )  # fmt: skip
    if patches is not None:
        row = changed(
            row,
            primitive=PATCHES,
            corners=patches.points,
            topology=PATCHES if EVALUATION in shader.chain else patches.kind.drawn,
            tessellation=_tessellation_row(shader, patches),
            vertices=shader.listed or None,
        )
    if expansion is not None:
        native = GEOMETRY in shader.chain
        if patches is None:
            row = changed(row, primitive=expansion.primitive, corners=expansion.corners)
        row = changed(
            row,
            topology=row.primitive if native else expansion.emits,
            expanded_by="geometry" if native else "instances",
            vertices=expansion.vertices if native else shader.listed or expansion.listed,
        )
    return row


def _tessellation_row(shader: Shader, patches: Tessellation) -> TessellationRow:
    return TessellationRow(
        kind=patches.patch,
        ends=tuple(patches.ends),
        spacing=patches.spacing,
        divided_by="evaluation" if EVALUATION in shader.chain else "instances",
        levels=_levels_row(shader) if shader.levels else None,
    )


def _levels_row(shader: Shader) -> PatchLevels:
    """The steps that compute how finely a host divides the edges and the inside of all patches."""
    edges, inside = (
        tuple(steps(level.value) for level in shader.levels if level.kind == kind)
        for kind in (EDGE_LEVEL, INNER_LEVEL)
    )
    return PatchLevels(edges=edges, inside=inside)


def _layers_row(shader: Shader) -> LayersRow | None:
    """The number of layers of the render targets, and the parameter of a draw to a single one."""
    if not shader.layers:
        return None
    return LayersRow(
        count=shader.layers,
        parameter=None if shader.layer is None else shader.layer.name,
        view_mask=2**shader.views - 1 or None,
    )


def _varying_rows(program: Program) -> Iterator[VaryingRow]:
    stages = {stage.row.domain: stage.name for stage in program.stages}
    for interface in program.interfaces:
        for field in interface.fields:
            yield VaryingRow(
                name=field.name,
                representation=str(field.type),
                location=field.location,
                mode=field.mode,
                from_stage=stages[interface.origin],
                to_stage=stages[interface.destination],
            )


def _target_rows(shader: Shader) -> Iterator[TargetRow]:
    """The render targets of a pass, or the images of a kernel, which it writes or draws."""
    written = (*shader.results_of(IMAGE), *shader.results_of(TARGET))
    for location, result in enumerate(written):
        state = result.state
        assert state is not None
        yield TargetRow(
            name=result.name,
            representation=str(result.value.type),
            location=location,
            format=state.format,
            encoding="srgb" if state.format.endswith("srgb") else "linear",
            blend=None if state.blend == REPLACES else state.blend,
            mask=state.mask,
            clear=state.clear,
            doc=result.doc,
        )
