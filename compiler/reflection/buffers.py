"""The storage buffers' side of the reflection: what a host binds, and how elements lie in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from ..ir.program import Program
from ..ir.shader import BufferInfo
from ..ir.storage import stored_type, structs_in
from ..packing import element_packing
from .bytes import layout_row, struct_row
from .parameters import member_rows


def buffer_rows(infos: Sequence[BufferInfo], program: Program) -> Iterator[dict[str, Any]]:
    """A row for each declared buffer."""
    read = {stage.name: frozenset(stage.buffers) for stage in program.stages}
    for info in infos:
        buffer, packed = info.buffer, element_packing(info.buffer.type.element)
        yield {
            "name": buffer.name,
            "type": f"{info.element.declared_type}[]",
            "representation": str(buffer.type),
            "group": buffer.group,
            "count": buffer.count.name,
            "stride": packed.stride,
            "layout": layout_row(packed),
            "members": member_rows(packed, info.element.members),
            "structs": [struct_row(struct) for struct in structs_in([stored_type(buffer.type)])],
            "stages": [name for name, buffers in read.items() if buffer in buffers],
            "doc": info.doc,
        }
