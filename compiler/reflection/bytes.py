"""The bytes of blocks, structs and parameters."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain

from ..documents.digests import layout_digest
from ..documents.values import BlockMember, BlockRow, LayoutRow, StructMember, StructRow
from ..ir.leaves import Parameter
from ..ir.meaning import Meaning
from ..ir.node import Node
from ..ir.program import Block, Program, StageName
from ..ir.storage import LANE, byte_size, padding_names
from ..ir.types import FLOAT, Struct, Type
from ..packing import Packing
from .values import steps


def block_rows(program: Program, derived: Mapping[Parameter, Node]) -> Iterator[BlockRow]:
    """The blocks of a program as they lie in memory, padding included.

    ``derived`` are the values of the derived parameters.
    """
    read = {stage.name: {block.name for block in stage.blocks} for stage in program.stages}
    for block in program.blocks:
        stages = tuple([stage for stage, names in read.items() if block.name in names])
        yield _block_row(block, stages, derived)


def _block_row(
    block: Block, stages: tuple[StageName, ...], derived: Mapping[Parameter, Node]
) -> BlockRow:
    members, structs = tuple(_member_rows(block)), tuple(map(struct_row, block.structs))
    return BlockRow(
        name=block.name,
        group=block.group,
        derived=block.derived,
        extern=block.host is not None,
        size=block.size,
        stages=stages,
        layout_id=_layout_id(members, structs, _computed(block, derived), _enumerated(block)),
        members=members,
        structs=structs,
    )


def _computed(block: Block, derived: Mapping[Parameter, Node]) -> list[object]:
    """How a host computes the values of a derived block."""
    parameters = (member.parameter for member in block.members)
    values = [derived[each] for each in parameters if each is not None and each in derived]
    # The members of a table are computed one by one.
    parts = (value.operands if value.op == "struct" else (value,) for value in values)
    return [steps(part) for part in chain.from_iterable(parts)]


def _enumerated(block: Block) -> Iterator[object]:
    """What the numbers of values mean that are members of an enumeration."""
    for member in block.members:
        if member.parameter is not None:
            yield from _choices(member.name, member.parameter.meaning)


def _choices(name: str, meaning: Meaning | None) -> Iterator[object]:
    if meaning is None:
        return
    if meaning.enumeration is not None:
        yield name, meaning.enumeration.names
    for inner, each in meaning.members:
        yield from _choices(f"{name}.{inner}", each)


def _layout_id(
    members: Sequence[BlockMember],
    structs: Sequence[StructRow],
    computed: Sequence[object],
    enumerated: Iterable[object],
) -> str:
    """A digest of where everything lies and what it says.

    It is also one of how derived values are computed, and of the members of enumerations.
    """
    lies = [(member.name, member.type, member.offset) for member in members]
    return layout_digest(lies, structs, *computed, *enumerated)


def _member_rows(block: Block) -> Iterator[BlockMember]:
    """The members of a block, and between them the gaps that every language leaves by itself."""
    free = padding_names(f"{block.name.lower()}_pad", (member.name for member in block.members))
    end = 0
    for member in block.members:
        yield from _gap_rows(free, end, member.offset)
        parameter = member.parameter.name if member.parameter else None
        yield _member_row(member.name, member.type, member.offset, parameter)
        end = member.offset + member.size
    yield from _gap_rows(free, end, block.size)


def _gap_rows(names: Iterator[str], start: int, end: int) -> Iterator[BlockMember]:
    """A member for each lane of a gap."""
    for offset in range(start, end, LANE):
        yield _member_row(next(names), FLOAT, offset, None)


def _member_row(name: str, type_: Type, offset: int, parameter: str | None) -> BlockMember:
    return BlockMember(
        name=name, type=str(type_), offset=offset, size=byte_size(type_), parameter=parameter
    )


def struct_row(struct: Struct) -> StructRow:
    """A stored struct with its members, padding included."""
    rows = []
    offset = 0
    for name, type_ in struct.members:
        size = byte_size(type_)
        rows.append(StructMember(name=name, type=str(type_), offset=offset, size=size))
        offset += size
    return StructRow(name=struct.name, size=offset, members=tuple(rows))


def layout_row(packing: Packing) -> LayoutRow:
    """The layout of a value, for a writer."""
    is_matrix, is_array = bool(packing.column_stride), packing.count is not None
    return LayoutRow(
        stored=str(packing.stored),
        kind=packing.kind,
        lanes=None if packing.kind is None else packing.lanes,
        columns=packing.columns if is_matrix else None,
        column_stride=packing.column_stride if is_matrix else None,
        count=packing.count,
        stride=packing.stride if is_array else None,
    )
