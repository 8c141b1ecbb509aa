"""Uniform blocks: which parameters share one, and where each of them lies in it.

A parameter's group decides the block, and the order of declarations decides the order in it. What
the members look like, so that std140, D3D and WGSL agree, is ``ir/storage.py``'s business.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from .ir.leaves import Parameter
from .ir.program import Block, StoredMember
from .ir.storage import ROW, byte_size, padding_names, place, rounded_to_row, stored_type
from .ir.types import FLOAT, Array, Struct, Type, Vector

if TYPE_CHECKING:
    from .ir.shader import ExternInfo

STANDARD_GROUPS = ("frame", "view", "rig", "material", "draw")
"""The groups that every shader has, in binding order."""


def layout_blocks(
    parameters: Sequence[Parameter],
    group_order: Sequence[str] = STANDARD_GROUPS,
    docs: Mapping[str, str] | None = None,
    externs: Sequence[ExternInfo] = (),
) -> tuple[Block, ...]:
    """One block for each group's parameters, each followed by the one of what is derived there.

    Groups that ``group_order`` does not name come last, in order of first appearance. ``docs``
    are doc comments by parameter name. Nothing but the declarations decides the layout. The host's
    own blocks, ``externs``, come first, as their names are not ours to change.
    """
    own = [parameter for parameter in parameters if parameter.host is None]
    groups = dict.fromkeys((*group_order, *(parameter.group for parameter in own)))
    blocks = [_extern_block(extern) for extern in externs if extern.members]
    taken = frozenset(block.name for block in blocks)
    for group in groups:
        for derived in (False, True):
            held = [p for p in own if p.group == group and p.derived == derived]
            if held:
                name = block_name(group, derived, taken)
                blocks.append(_block(name, group, derived, held, docs or {}))
    return tuple(blocks)


def _extern_block(extern: ExternInfo) -> Block:
    """A block of the host's as it says, with every gap filled."""
    name = extern.place.name
    padding = padding_names(f"{name.lower()}_pad", (member.name for member in extern.members))
    members: list[StoredMember] = []
    end = 0
    for member in extern.members:
        for filler, offset in _fillers(end, member.offset):
            size = byte_size(filler)
            members.append(StoredMember(next(padding), filler, offset, size, None))
        stored, info = stored_type(member.info.parameter.type), member.info
        size = byte_size(stored)
        members.append(
            StoredMember(member.name, stored, member.offset, size, info.parameter, info.doc)
        )
        end = member.offset + size
    return Block(
        name=name,
        group=extern.group,
        derived=False,
        members=tuple(members),
        size=rounded_to_row(end),
        structs=_structs(member.type for member in members),
        host=extern.place,
    )


def _fillers(start: int, end: int) -> Iterator[tuple[Type, int]]:
    """What fills a gap: scalars, and whole rows at once."""
    while start < end:
        rows = (end - start) // ROW if start % ROW == 0 else 0
        filler: Type = Array(Vector("float", 4), rows) if rows else FLOAT
        yield filler, start
        start += byte_size(filler)


def block_name(group: str, derived: bool, taken: frozenset[str] = frozenset()) -> str:
    """Suggested identifier of a group's block: ``Material``, ``MaterialDerived``."""
    name = group[:1].upper() + group[1:] + ("Derived" if derived else "")
    while name in taken:
        name += "Group"
    return name


def _block(
    name: str, group: str, derived: bool, parameters: list[Parameter], docs: Mapping[str, str]
) -> Block:
    rows = [(suggested_name(p), stored_type(p.type)) for p in parameters]
    placed = place(rows, f"{name.lower()}_pad", gaps=True)
    size = rounded_to_row(placed[-1].offset + byte_size(placed[-1].type))
    # Every backend rounds a whole block up by itself; only gaps before a member have to be said.
    while placed[-1].padding:
        placed = placed[:-1]
    remaining = iter(parameters)
    members = []
    for row in placed:
        parameter = None if row.padding else next(remaining)
        doc = docs.get(parameter.name, "") if parameter else ""
        own = byte_size(row.type)
        members.append(StoredMember(row.name, row.type, row.offset, own, parameter, doc))
    return Block(
        name=name,
        group=group,
        derived=derived,
        members=tuple(members),
        size=size,
        structs=_structs(member.type for member in members),
    )


def suggested_name(parameter: Parameter) -> str:
    """``sun.direction`` as an identifier.

    A backend's namer keeps it apart from a ``sun_direction`` that may stand beside it.
    """
    return parameter.name.replace(".", "_")


def _structs(types: Iterable[Type]) -> tuple[Struct, ...]:
    """The structs that ``types`` use, those inside others first, each once."""
    found: dict[Struct, None] = {}
    for type_ in types:
        inner = type_.element if isinstance(type_, Array) else type_
        if isinstance(inner, Struct):
            found.update(dict.fromkeys(_structs(member for _, member in inner.members)))
            found[inner] = None
    return tuple(found)
