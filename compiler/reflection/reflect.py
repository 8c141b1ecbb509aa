"""Everything a host has to know about a compiled material, as one JSON document."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ...stdlib.builtins.geometry import SHORTEST
from ..diagnostics.source import Span
from ..ir.leaves import Parameter
from ..ir.node import Node
from ..ir.program import Program
from ..ir.shader import AttributeInfo, MeshInput, Shader
from ..ir.stages import EDGE_LEVEL, EVALUATION, GEOMETRY, IMAGE, INNER_LEVEL, TARGET
from ..ir.tessellation import Tessellation
from ..promises import promises
from .buffers import buffer_rows, extent_steps, result_rows
from .bytes import block_rows
from .parameters import Places, derived_rows, light_rows, parameter_row
from .tables import BackendTable, BindingPoint
from .textures import TextureRows
from .values import steps

FORMAT = 1
"""Grows when a host that reads the document has to change."""

CONVENTIONS = {
    "clip_space": "x right, y up, z in 0..w",
    "handedness": "right",
    "front_face": "ccw",
    "texture_origin": "top_left",
    "matrices": "column",
}


def reflect(
    shader: Shader,
    program: Program,
    backends: Mapping[str, BackendTable],
    derived: Mapping[Parameter, Node] | None = None,
) -> dict[str, Any]:
    """The reflection of ``program``, which ``shader`` became.

    ``backends`` are the tables of the emitted profiles by profile name. ``derived`` are the values
    of the derived parameters in terms of the others, of declared types (not lowered to storage).
    """
    infos = shader.parameters
    names = frozenset(info.parameter.name for info in infos)
    places = Places(program.blocks)
    textures = TextureRows(shader.resources, program)
    return {
        "format": FORMAT,
        "material": shader.name,
        "pass": shader.pass_name,
        "rig": shader.rig_name,
        "doc": shader.doc,
        "conventions": dict(CONVENTIONS),
        "blocks": list(block_rows(program)),
        "parameters": [parameter_row(info, names, places) for info in infos],
        "derived": derived_rows(places, derived or {}),
        "promises": list(_promise_rows(shader)),
        "lights": light_rows(infos),
        "buffers": list(buffer_rows(shader.buffers, program)),
        "results": list(result_rows(shader)),
        "extent": extent_steps(shader),
        "work_group": None if shader.work_group is None else list(shader.work_group),
        "textures": textures.textures(),
        "samplers": textures.samplers(),
        "draw": _draw_row(shader),
        "vertex_inputs": list(_vertex_input_rows(shader.attributes, program)),
        "pipeline_inputs": {stage.name: list(stage.builtin_inputs) for stage in program.stages},
        "varyings": list(_varying_rows(program)),
        "targets": list(_target_rows(shader, program)),
        "backends": {name: _backend_row(table) for name, table in sorted(backends.items())},
    }


def _promise_rows(shader: Shader) -> Iterator[dict[str, Any]]:
    for promise in promises(shader):
        yield {
            "value": promise.value,
            "least_length": SHORTEST,
            "parameters": list(promise.parameters),
        }


def _vertex_input_rows(
    attributes: Iterable[AttributeInfo], program: Program
) -> Iterable[dict[str, Any]]:
    declared = {info.attribute.name: info for info in attributes}
    for field in program.vertex_inputs:
        info = declared[field.name]
        yield {
            "name": field.name,
            "type": info.declared_type,
            "representation": str(field.type),
            "location": field.location,
            "step": field.step,
            "column": {"of": info.matrix, "index": info.column} if info.matrix else None,
            "mesh": None if info.mesh is None else _mesh_row(info.mesh),
            "doc": info.doc,
        }


def _mesh_row(mesh: MeshInput) -> dict[str, Any]:
    return {
        "name": mesh.name,
        "corner": mesh.corner,
        "is_number": mesh.is_number,
        "is_of_pattern": mesh.is_of_pattern,
    }


def _draw_row(shader: Shader) -> dict[str, Any]:
    """What a host draws: the triangles of a mesh, or what its primitives or patches turn into."""
    expansion, patches = shader.expansion, shader.tessellation
    row: dict[str, Any] = {
        "primitive": "triangle", "corners": 3, "expanded_by": None, "vertices": None,
        "tessellation": None,
    }  # fmt: skip
    if patches is not None:
        row |= {
            "primitive": "patch",
            "corners": patches.points,
            "tessellation": _tessellation_row(shader, patches),
            "vertices": shader.listed or None,
        }
    if expansion is not None:
        native = GEOMETRY in shader.chain
        row |= {
            "primitive": expansion.primitive,
            "corners": expansion.corners,
            "expanded_by": GEOMETRY.name if native else "instances",
            "vertices": expansion.vertices if native else expansion.listed,
        }
    return row


def _tessellation_row(shader: Shader, patches: Tessellation) -> dict[str, Any]:
    native = EVALUATION in shader.chain
    return {
        "patch": patches.patch,
        "ends": list(patches.ends),
        "spacing": patches.spacing,
        "divided_by": EVALUATION.name if native else "instances",
        "levels": _levels_row(shader) if shader.levels else None,
    }


def _levels_row(shader: Shader) -> dict[str, Any]:
    """The steps that compute how finely a host divides the edges and the inside of all patches."""
    return {
        name: [steps(level.value) for level in shader.levels if level.kind == kind]
        for name, kind in (("edges", EDGE_LEVEL), ("inside", INNER_LEVEL))
    }


def _varying_rows(program: Program) -> Iterator[dict[str, Any]]:
    stages = {stage.row.domain: stage.name for stage in program.stages}
    for interface in program.interfaces:
        for field in interface.fields:
            yield {
                "name": field.name,
                "representation": str(field.type),
                "location": field.location,
                "mode": field.mode,
                "from": stages[interface.origin],
                "to": stages[interface.destination],
            }


def _target_rows(shader: Shader, program: Program) -> Iterable[dict[str, Any]]:
    """The render targets of a pass; of a kernel over images, these, which it draws or writes."""
    kind = IMAGE if program.images else TARGET
    for result, output in zip(shader.results_of(kind), program.results_of(kind), strict=True):
        state, field = result.state, output.field
        assert state is not None and field is not None
        yield {
            "name": field.name,
            "representation": str(field.type),
            "location": field.location,
            "format": state.format,
            "blend": state.blend,
            "doc": field.doc,
        }


def _backend_row(table: BackendTable) -> dict[str, Any]:
    return {
        "language": table.language,
        "clip_depth": table.clip_depth,
        "clip_control": list(table.clip_control),
        "flip_y": table.flip_y,
        "front_face": table.front_face,
        "first_row": table.first_row,
        "files": [
            {"stage": row.stage, "file": row.file, "entry_point": row.entry_point}
            for row in table.files
        ],
        "blocks": {
            name: {**_binding_row(point), "members": dict(point.members)}
            for name, point in table.blocks.items()
        },
        "buffers": {name: _binding_row(point) for name, point in table.buffers.items()},
        "textures": {name: _binding_row(point) for name, point in table.textures.items()},
        "samplers": {name: _binding_row(point) for name, point in table.samplers.items()},
        "vertex_inputs": {
            name: {"identifier": row.identifier, "semantic": row.semantic or None}
            for name, row in table.vertex_inputs.items()
        },
        "host_uniforms": list(table.host_uniforms),
        "source_maps": {
            name: _source_map(spans) for name, spans in sorted(table.source_maps.items())
        },
    }


def _source_map(spans: Mapping[int, Span]) -> dict[str, Any]:
    """Rows of a line of the text, and of source, line, column and length in Burnish."""
    sources = tuple({span.source.name_in_outputs: None for span in spans.values()})
    numbers = {source: number for number, source in enumerate(sources)}
    return {
        "sources": list(sources),
        "lines": [
            [
                line,
                numbers[span.source.name_in_outputs],
                *span.source.position(span.start),
                span.end - span.start,
            ]
            for line, span in sorted(spans.items())
        ],
    }


def _binding_row(point: BindingPoint) -> dict[str, Any]:
    return {
        "identifier": point.identifier,
        "group": point.group,
        "binding": point.binding,
        "register": point.register or None,
    }
