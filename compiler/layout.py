"""One byte layout for uniform blocks, on which std140, D3D and WGSL agree.

The pass pipeline calls ``layout_blocks`` once for each shader. The reflection and the checks of
``extern`` blocks use the other functions. The three rule sets differ as soon as they have a choice,
so the text leaves them none:

- a gap that some rule set would not leave is filled with scalar members (D3D would move a ``vec2``
  into it);
- arrays are ``vec4[n]`` with the elements in the lanes (std140 and D3D pad elements to 16 bytes,
  WGSL refuses element strides that are not multiples of 16);
- matrices have columns of four rows (a ``mat2`` column takes 8 bytes in WGSL and 16 elsewhere, and
  after a ``mat3`` D3D would move a scalar into the last column); in arrays of matrices, the columns
  are the elements;
- structs start at multiples of 16 bytes, and explicit padding makes them end at one;
- bools are uints (there is no size of a bool on which all rule sets agree).

Sources: OpenGL 4.6 specification, 7.6.2.2 "Standard Uniform Block Layout"; Microsoft, "Packing
Rules for Constant Variables"; WGSL, "Memory Layout" and "Address Space Layout Constraints".
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import count, filterfalse
from typing import TYPE_CHECKING

from ..frozen import frozen
from .ir.leaves import Parameter
from .ir.program import Block, StoredMember
from .ir.types import FLOAT, Array, Matrix, Scalar, ScalarKind, Struct, TallMatrix, Type, Vector

if TYPE_CHECKING:
    from .ir.shader import ExternInfo

STANDARD_GROUPS = ("frame", "view", "rig", "material", "draw")
"""The groups that exist in every shader, in the order of their bindings."""

ROW = 16
"""The size of a ``vec4`` in bytes, which is the unit of arrays, matrices, structs and blocks."""

LANE = 4
"""The size of a scalar in bytes."""


@frozen
class Placed:
    """A stored member with its offset in bytes."""

    name: str
    type: Type
    offset: int
    padding: bool = False


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
    taken = frozenset(block.name for block in blocks)
    for group in groups:
        for derived in (False, True):
            held = [p for p in own if p.group == group and p.derived == derived]
            if held:
                name = block_name(group, derived, taken)
                blocks.append(_block(name, group, derived, held, docs or {}))
    return tuple(blocks)


def _extern_block(extern: ExternInfo) -> Block:
    """A block that the host owns, as it is declared, with every gap filled."""
    name = extern.place.name
    padding = _padding_names(f"{name.lower()}_pad", (member.name for member in extern.members))
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
        size=_rounded(end),
        structs=_structs(member.type for member in members),
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


def _padding_names(stem: str, taken: Iterable[str]) -> Iterator[str]:
    """``stem_0``, ``stem_1`` and so on, without the names that are taken."""
    return filterfalse(frozenset(taken).__contains__, (f"{stem}_{i}" for i in count()))


def block_name(group: str, derived: bool, taken: frozenset[str] = frozenset()) -> str:
    """The suggested identifier of a group's block: ``Material``, ``MaterialDerived``."""
    name = group[:1].upper() + group[1:] + ("Derived" if derived else "")
    while name in taken:
        name += "Group"
    return name


def _block(
    name: str, group: str, derived: bool, parameters: list[Parameter], docs: Mapping[str, str]
) -> Block:
    rows = [(suggested_name(p), stored_type(p.type)) for p in parameters]
    placed = place(rows, f"{name.lower()}_pad", gaps=True)
    size = _rounded(placed[-1].offset + byte_size(placed[-1].type))
    # Every backend rounds the size of the whole block up by itself, so padding at the end is not
    # written.
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
    """A parameter's name as an identifier: ``sun_direction`` for ``sun.direction``.

    If there is also a parameter ``sun_direction``, a backend's namer distinguishes the two.
    """
    return parameter.name.replace(".", "_")


def place(
    members: Iterable[tuple[str, Type]], padding: str = "pad", *, gaps: bool = False
) -> tuple[Placed, ...]:
    """Stored members in order, padded to a whole number of rows.

    ``padding`` is the stem of the padding members' names. With ``gaps``, there is no padding before
    a vector that every rule set moves to the next row by itself.
    """
    members = tuple(members)
    free = _padding_names(padding, (name for name, _ in members))
    placed: list[Placed] = []
    end = 0

    def pad_to(alignment: int) -> None:
        nonlocal end
        while end % alignment:
            placed.append(Placed(next(free), FLOAT, end, padding=True))
            end += LANE

    for name, type_ in members:
        if gaps and _is_vector_in_new_row(type_, end):
            end = _rounded(end)
        pad_to(alignment(type_))
        placed.append(Placed(name, type_, end))
        end += byte_size(type_)
    pad_to(ROW)
    return tuple(placed)


@cache
def stored_type(type_: Type) -> Type:
    """The type by which a block stores a value of ``type_``; a stored type stays as it is."""
    match type_:
        case Scalar(kind):
            return Scalar(_stored_kind(kind))
        case Vector(kind, size):
            return Vector(_stored_kind(kind), size)
        case Matrix(size):
            return type_ if size == 4 else TallMatrix(size)
        case TallMatrix():
            return type_
        case Array(element, count):
            return _stored_array(element, count)
        case Struct():
            return stored_struct(type_)
        case _:
            raise TypeError(f"{type_} cannot be kept in a uniform block")


@cache
def stored_struct(struct: Struct) -> Struct:
    """A struct with stored members, in which gaps are members too."""
    placed = place((name, stored_type(type_)) for name, type_ in struct.members)
    return Struct(struct.name, tuple((row.name, row.type) for row in placed))


def _stored_array(element: Type, count: int) -> Array:
    match element:
        case Scalar(kind) | Vector(kind):
            rows = -(-count // elements_in_row(element))
            return Array(Vector(_stored_kind(kind), 4), rows)
        case Matrix(size):
            return Array(Vector("float", 4), size * count)
        case Struct():
            return Array(stored_struct(element), count)
        case _:
            raise TypeError(f"an array of {element} cannot be kept in a uniform block")


def elements_in_row(element: Scalar | Vector) -> int:
    """How many elements of an array share a ``vec4``: 4 scalars, 2 ``vec2``, 1 longer vector."""
    match element:
        case Scalar():
            return 4
        case Vector(size=2):
            return 2
        case _:
            return 1


def _stored_kind(kind: ScalarKind) -> ScalarKind:
    return "uint" if kind == "bool" else kind


def byte_size(stored: Type) -> int:
    """The number of bytes of a stored type. Gaps are members, so no rounding is needed."""
    match stored:
        case Scalar():
            return LANE
        case Vector(size=size):
            return LANE * size
        case Matrix(4 as columns) | TallMatrix(columns):
            return columns * ROW
        case Array(element, count):
            return count * byte_size(element)
        case Struct(members=members):
            return sum(byte_size(type_) for _, type_ in members)
        case _:
            raise TypeError(f"{stored} is not a stored type")


def _is_vector_in_new_row(stored: Type, end: int) -> bool:
    """Whether a vector would cross the end of a row, so that every rule set moves it to the next.

    D3D moves it for this reason; std140 and WGSL align vectors to their size, and a vec3 to 16.
    """
    return isinstance(stored, Vector) and end % ROW + byte_size(stored) > ROW


def _rounded(end: int) -> int:
    return -(-end // ROW) * ROW


def alignment(stored: Type) -> int:
    """The number of bytes of which the offset of a stored type must be a multiple."""
    match stored:
        case Scalar():
            return LANE
        case Vector(size=2):
            return 2 * LANE
        case _:
            return ROW


def _structs(types: Iterable[Type]) -> tuple[Struct, ...]:
    """The structs that ``types`` use, each once; a struct comes after those that it contains."""
    found: dict[Struct, None] = {}
    for type_ in types:
        inner = type_.element if isinstance(type_, Array) else type_
        if isinstance(inner, Struct):
            found.update(dict.fromkeys(_structs(member for _, member in inner.members)))
            found[inner] = None
    return tuple(found)
