"""The bytes of blocks, structs and parameters as JSON."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..ir.program import Block, Program, StageName
from ..ir.storage import LANE, byte_size, padding_names
from ..ir.types import FLOAT, Struct, Type
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
        "members": list(_member_rows(block)),
        "structs": [struct_row(struct) for struct in block.structs],
    }


def _member_rows(block: Block) -> Iterator[dict[str, Any]]:
    """The members of a block, and between them the gaps that every language leaves by itself."""
    free = padding_names(f"{block.name.lower()}_pad", (member.name for member in block.members))
    end = 0
    for member in block.members:
        yield from _gap_rows(free, end, member.offset)
        parameter = member.parameter.name if member.parameter else None
        yield _member_row(member.name, member.type, member.offset, parameter)
        end = member.offset + member.size
    yield from _gap_rows(free, end, block.size)


def _gap_rows(names: Iterator[str], start: int, end: int) -> Iterator[dict[str, Any]]:
    """A member for each lane of a gap."""
    for offset in range(start, end, LANE):
        yield _member_row(next(names), FLOAT, offset, None)


def _member_row(name: str, type_: Type, offset: int, parameter: str | None) -> dict[str, Any]:
    size = byte_size(type_)
    return {
        "name": name,
        "type": str(type_),
        "offset": offset,
        "size": size,
        "parameter": parameter,
    }


def struct_row(struct: Struct) -> dict[str, Any]:
    """A stored struct with its members, padding included."""
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
