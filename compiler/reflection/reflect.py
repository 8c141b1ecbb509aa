"""Everything a host has to know about a compiled material, as one JSON document."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ...stdlib.builtins.geometry import SHORTEST
from ..diagnostics.source import Span
from ..ir.blending import REPLACES, Blend
from ..ir.leaves import Parameter
from ..ir.node import Node
from ..ir.program import Program
from ..ir.render_state import DepthState, RenderState, StencilSide, StencilState
from ..ir.shader import AttributeInfo, MeshInput, Shader
from ..ir.stages import (
    EDGE_LEVEL,
    EVALUATION,
    GEOMETRY,
    IMAGE,
    INNER_LEVEL,
    PATCHES,
    TARGET,
)
from ..ir.tessellation import Tessellation
from ..promises import promises
from .buffers import buffer_rows, extent_steps, result_rows
from .bytes import block_rows
from .captures import capture_row
from .parameters import Places, derived_rows, light_rows, parameter_row
from .tables import BackendTable, BindingPoint, FieldName
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
        "invariant_position": program.invariant,
        "render_state": _render_state_row(shader.render_state),
        "capture": None if shader.capture is None else capture_row(shader),
        "vertex_inputs": [
            *_vertex_input_rows(shader.attributes, program),
            *_mesh_buffer_rows(shader),
        ],
        "pipeline_inputs": {stage.name: list(stage.builtin_inputs) for stage in program.stages},
        "varyings": list(_varying_rows(program)),
        "targets": list(_target_rows(shader)),
        "backends": {
            name: _backend_row(table, shader.render_state)
            for name, table in sorted(backends.items())
        },
    }


def _render_state_row(state: RenderState) -> dict[str, Any]:
    """What a host sets of the pipeline, as the pass asks for it."""
    return {
        "cull": state.cull,
        "front": state.front,
        "fill": state.fill,
        "samples": state.samples,
        "depth": _depth_row(state.depth),
        "stencil": _stencil_row(state.stencil) if state.stencil.is_used else None,
    }


def _depth_row(state: DepthState) -> dict[str, Any]:
    bias = {"constant": state.bias, "slope": state.slope_bias, "clamp": state.bias_clamp}
    return {
        "compare": state.compare,
        "write": state.write,
        "clear": state.clear,
        "bias": bias if state.is_biased else None,
    }


def _stencil_row(state: StencilState) -> dict[str, Any]:
    return {
        "front": _stencil_side_row(state.front),
        "back": _stencil_side_row(state.back),
        "reference": state.reference,
        "read_mask": state.read_mask,
        "write_mask": state.write_mask,
    }


def _stencil_side_row(side: StencilSide) -> dict[str, Any]:
    return {
        "compare": side.compare,
        "fail": side.fail_op,
        "depth_fail": side.depth_fail_op,
        "pass": side.pass_op,
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
            "buffer": None,
            "doc": info.doc,
        }


def _mesh_buffer_rows(shader: Shader) -> Iterator[dict[str, Any]]:
    """What a kernel that captures reads of the mesh: vertex inputs that are storage buffers."""
    for info in shader.buffers:
        for member, read in info.of_mesh:
            leaf = read.attribute
            yield {
                "name": leaf.name,
                "type": read.declared_type,
                "representation": str(leaf.type),
                "location": None,
                "step": leaf.step,
                "column": {"of": read.matrix, "index": read.column} if read.matrix else None,
                "mesh": None if read.mesh is None else _mesh_row(read.mesh),
                "buffer": {"name": info.buffer.name, "member": member},
                "doc": read.doc,
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
        "topology": "triangle", "tessellation": None, "layers": _layers_row(shader),
    }  # fmt: skip
    if patches is not None:
        row |= {
            "primitive": PATCHES,
            "corners": patches.points,
            "topology": PATCHES if EVALUATION in shader.chain else patches.kind.drawn,
            "tessellation": _tessellation_row(shader, patches),
            "vertices": shader.listed or None,
        }
    if expansion is not None:
        native = GEOMETRY in shader.chain
        if patches is None:
            row |= {"primitive": expansion.primitive, "corners": expansion.corners}
        row |= {
            "topology": row["primitive"] if native else expansion.emits,
            "expanded_by": GEOMETRY.name if native else "instances",
            "vertices": expansion.vertices if native else shader.listed or expansion.listed,
        }
    return row


def _tessellation_row(shader: Shader, patches: Tessellation) -> dict[str, Any]:
    native = EVALUATION in shader.chain
    return {
        "kind": patches.patch,
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


def _layers_row(shader: Shader) -> dict[str, Any] | None:
    """How many layers the render targets have, and what a host sets if it draws to one of them at a
    time."""
    if not shader.layers:
        return None
    return {"count": shader.layers, "parameter": shader.layer and shader.layer.name}


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


def _target_rows(shader: Shader) -> Iterable[dict[str, Any]]:
    """The render targets of a pass, or the images of a kernel, which it writes or draws."""
    written = (*shader.results_of(IMAGE), *shader.results_of(TARGET))
    for location, result in enumerate(written):
        assert result.state is not None
        yield {
            "name": result.name,
            "representation": str(result.value.type),
            "location": location,
            "format": result.state.format,
            "blend": _blend_row(result.state.blend),
            "mask": result.state.mask,
            "clear": result.state.clear and list(result.state.clear),
            "doc": result.doc,
        }


def _blend_row(blend: Blend) -> dict[str, Any] | None:
    """Both equations; ``None`` where nothing is blended."""
    if blend == REPLACES:
        return None
    return {
        part: {
            "source": equation.source,
            "destination": equation.destination,
            "operation": equation.operation,
        }
        for part, equation in (("color", blend.color), ("alpha", blend.alpha))
    }


def _backend_row(table: BackendTable, state: RenderState) -> dict[str, Any]:
    return {
        "language": table.language,
        "clip_depth": table.clip_depth,
        "clip_control": list(table.clip_control),
        "flip_y": table.flip_y,
        "front_face": _front_face(table, state),
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
        "images": {name: _binding_row(point) for name, point in table.images.items()},
        "textures": {name: _binding_row(point) for name, point in table.textures.items()},
        "samplers": {name: _binding_row(point) for name, point in table.samplers.items()},
        "vertex_inputs": {name: _field_name_row(row) for name, row in table.vertex_inputs.items()},
        "stream_output": table.stream_output or None,
        "captures": {name: _field_name_row(row) for name, row in table.captures.items()},
        "host_uniforms": list(table.host_uniforms),
        "source_maps": {
            name: _source_map(spans) for name, spans in sorted(table.source_maps.items())
        },
    }


def _front_face(table: BackendTable, state: RenderState) -> str:
    """The winding that a host sets as front: that of the pass, which some texts turn over."""
    is_turned = table.front_face == "cw"
    return "cw" if (state.front == "clockwise") != is_turned else "ccw"


def _field_name_row(row: FieldName) -> dict[str, Any]:
    return {"identifier": row.identifier, "semantic": row.semantic or None}


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
