"""The storage buffers' side of the reflection: what a host binds, and how elements lie in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from ..ir.kernel import neutral
from ..ir.program import Program
from ..ir.shader import BufferInfo, Shader
from ..ir.stages import EXTENT, LENGTH
from ..ir.storage import stored_type, structs_in
from ..ir.types import INT
from ..packing import element_packing
from .bytes import layout_row, struct_row
from .parameters import member_rows
from .values import steps


def buffer_rows(infos: Sequence[BufferInfo], program: Program) -> Iterator[dict[str, Any]]:
    """A row for each declared buffer."""
    read = {stage.name: frozenset(stage.buffers) for stage in program.stages}
    for info in infos:
        stages = [name for name, buffers in read.items() if info.buffer in buffers]
        yield {**buffer_row(info), "count": info.buffer.count.name, "stages": stages}


def result_rows(shader: Shader) -> Iterator[dict[str, Any]]:
    """A row for each buffer that a kernel writes."""
    extents = shader.results_of(EXTENT)
    scattered = {r.store: r.value for r in shader.results_of(LENGTH) if r.store is not None}
    lengths = {store.buffer: (store.operator, length) for store, length in scattered.items()}
    for info in shader.written:
        operator, count = lengths.get(info.buffer, (None, extents[0].value))
        signed = info.buffer.type.element == INT
        row = buffer_row(info)
        yield {
            **row,
            "stride": row["stride"] * info.each,
            "count": steps(count),
            "scattered": operator,
            "initial": None if operator is None else neutral(operator, signed=signed),
        }


def extent_steps(shader: Shader) -> list[dict[str, Any]] | None:
    """The steps that compute how many elements a kernel's results have; ``None`` for others."""
    extents = shader.results_of(EXTENT)
    return steps(extents[0].value) if extents else None


def buffer_row(info: BufferInfo) -> dict[str, Any]:
    """What both kinds of buffers have."""
    buffer, packed = info.buffer, element_packing(info.buffer.type.element)
    return {
        "name": buffer.name,
        "type": f"{info.element.declared_type}[]",
        "representation": str(buffer.type),
        "group": buffer.group,
        "stride": packed.stride,
        "layout": layout_row(packed),
        "members": member_rows(packed, info.element.members),
        "structs": [struct_row(struct) for struct in structs_in([stored_type(buffer.type)])],
        "doc": info.doc,
    }
