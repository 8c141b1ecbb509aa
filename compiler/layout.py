"""Lays out uniform blocks: which parameters share a block, and where each of them lies in it.

The pass pipeline calls ``blocks_of`` once for each shader. The group of a parameter decides in
which block it lies, and the order of the declarations decides the order in the block.
``ir/storage.py`` defines how a single value is stored.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

from .ir.groups import STANDARD_GROUPS, block_name
from .ir.leaves import Parameter
from .ir.program import Block, StoredMember
from .ir.storage import (
    ROW,
    byte_size,
    padding_names,
    place,
    rounded_to_row,
    stored_type,
    structs_in,
)
from .ir.types import FLOAT, Array, Type, Vector

if TYPE_CHECKING:
    from .ir.shader import ExternInfo, Shader


def blocks_of(shader: Shader, derived: Sequence[Parameter]) -> tuple[Block, ...]:
    """The blocks of a shader, of which the host computes these derived parameters as well."""
    declared = shader.parameters
    docs = {info.leaf.name: info.comment for info in declared if info.comment}
    parameters = [*(info.leaf for info in declared), *derived]
    return layout_blocks(parameters, docs=docs, externs=shader.externs)


def layout_blocks(
    parameters: Sequence[Parameter],
    group_order: Sequence[str] = STANDARD_GROUPS,
    docs: Mapping[str, str] | None = None,
    externs: Sequence[ExternInfo] = (),
) -> tuple[Block, ...]:
    """One block for the parameters of each group, and one for the values derived from them.

    Groups that are not in ``group_order`` come last, in order of first appearance. ``docs`` are doc
    comments by parameter name. The layout depends only on the declarations. The host's own blocks,
    ``externs``, come first, because Burnish cannot change their names.
    """
    own = [parameter for parameter in parameters if parameter.host is None]
    groups = dict.fromkeys((*group_order, *(parameter.group for parameter in own)))
    blocks = [_extern_block(extern) for extern in externs if extern.members]
    taken = {block.name for block in blocks}
    for group in groups:
        for derived in (False, True):
            held = [p for p in own if p.group == group and p.derived == derived]
            if held:
                name = block_name(group, derived, taken)
                taken.add(name)
                told = tuple([docs.get(p.name, "") for p in held] if docs else [""] * len(held))
                blocks.append(_block(name, group, derived, tuple(held), told))
    return tuple(blocks)


def _extern_block(extern: ExternInfo) -> Block:
    """A block that the host owns, as it is declared, with every gap filled."""
    name = extern.place.name
    padding = padding_names(f"{name.lower()}_pad", (member.name for member in extern.members))
    members: list[StoredMember] = []
    end = 0
    for member in extern.members:
        for filler, offset in _fillers(end, member.offset):
            size = byte_size(filler)
            members.append(StoredMember(next(padding), filler, offset, size, None))
        stored, info = stored_type(member.info.leaf.type), member.info
        size = byte_size(stored)
        comment = info.comment
        members.append(StoredMember(member.name, stored, member.offset, size, info.leaf, comment))
        end = member.offset + size
    return Block(
        name=name,
        group=extern.group,
        derived=False,
        members=tuple(members),
        size=rounded_to_row(end),
        structs=structs_in(member.type for member in members),
        host=extern.place,
    )


def _fillers(start: int, end: int) -> Iterator[tuple[Type, int]]:
    """The types that fill a gap, with their offsets: scalars, and as many whole rows as
    possible."""
    while start < end:
        rows = (end - start) // ROW if start % ROW == 0 else 0
        filler: Type = Array(Vector("float", 4), rows) if rows else FLOAT
        yield filler, start
        start += byte_size(filler)


@lru_cache(maxsize=256)
def _block(
    name: str,
    group: str,
    derived: bool,
    parameters: tuple[Parameter, ...],
    docs: tuple[str, ...],
) -> Block:
    """The block of these parameters: kept, as most shaders share the groups of the library."""
    rows = [(suggested_name(p), stored_type(p.type)) for p in parameters]
    placed = place(rows, f"{name.lower()}_pad", gaps=True)
    size = rounded_to_row(placed[-1].offset + byte_size(placed[-1].type))
    # Every backend rounds the size of the whole block up by itself, so padding at the end is not
    # written.
    while placed[-1].padding:
        placed = placed[:-1]
    remaining = iter(zip(parameters, docs, strict=True))
    members = []
    for row in placed:
        parameter, doc = (None, "") if row.padding else next(remaining)
        own = byte_size(row.type)
        members.append(StoredMember(row.name, row.type, row.offset, own, parameter, doc))
    return Block(
        name=name,
        group=group,
        derived=derived,
        members=tuple(members),
        size=size,
        structs=structs_in(member.type for member in members),
    )


def suggested_name(parameter: Parameter) -> str:
    """A parameter's name as an identifier: ``sun_direction`` for ``sun.direction``.

    If there is also a parameter ``sun_direction``, a backend's namer distinguishes the two.
    """
    return parameter.name.replace(".", "_")
