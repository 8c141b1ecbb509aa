"""The bytes of blocks, structs and parameters as JSON."""

from __future__ import annotations

from typing import Any

from ..ir.program import Block, Program
from ..ir.storage import byte_size
from ..ir.types import Struct
from ..packing import Packing


def block_row(block: Block, program: Program) -> dict[str, Any]:
    """A block as it lies in memory, padding included."""
    return {
        "name": block.name,
        "group": block.group,
        "derived": block.derived,
        "extern": block.host is not None,
        "size": block.size,
        "stages": [stage.name for stage in program.stages if block in stage.blocks],
        "members": [
            {
                "name": member.name,
                "type": str(member.type),
                "offset": member.offset,
                "size": member.size,
                "parameter": member.parameter.name if member.parameter else None,
            }
            for member in block.members
        ],
        "structs": [_struct_row(struct) for struct in block.structs],
    }


def _struct_row(struct: Struct) -> dict[str, Any]:
    rows = []
    offset = 0
    for name, type_ in struct.members:
        size = byte_size(type_)
        rows.append({"name": name, "type": str(type_), "offset": offset, "size": size})
        offset += size
    return {"name": struct.name, "size": offset, "members": rows}


def layout_row(packing: Packing) -> dict[str, Any]:
    """What a writer has to know of a value; what does not apply to its type is left out."""
    row: dict[str, Any] = {"stored": str(packing.stored)}
    if packing.kind is not None:
        row |= {"kind": packing.kind, "lanes": packing.lanes}
    if packing.column_stride:
        row |= {"columns": packing.columns, "column_stride": packing.column_stride}
    if packing.count is not None:
        row |= {"count": packing.count, "stride": packing.stride}
    return row
