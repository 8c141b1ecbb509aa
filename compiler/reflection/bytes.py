"""The bytes of blocks, structs and parameters as JSON."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..ir.program import Block, Program, StageName
from ..ir.storage import byte_size
from ..ir.types import Struct
from ..packing import Packing


def block_rows(program: Program) -> Iterator[dict[str, Any]]:
    """The blocks of a program as they lie in memory, padding included."""
    read = {stage.name: {block.name for block in stage.blocks} for stage in program.stages}
    for block in program.blocks:
        stages = [stage for stage, names in read.items() if block.name in names]
        yield _block_row(block, stages)


def _block_row(block: Block, stages: list[StageName]) -> dict[str, Any]:
    return {
        "name": block.name,
        "group": block.group,
        "derived": block.derived,
        "extern": block.host is not None,
        "size": block.size,
        "stages": stages,
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
