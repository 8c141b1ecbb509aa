"""Defines how values are stored in uniform blocks and storage buffers, so that all backends agree.

``compiler/layout.py`` asks for it when it lays out a shader's blocks, ``lower_reads`` when it reads
from them, and the reflection when it describes them to hosts. The three rule sets differ wherever
they have a choice, so the text leaves them none:

- a gap that some rule set would not leave is filled with scalar members (D3D would move a ``vec2``
  into it);
- arrays are ``vec4[n]`` with the elements in the lanes (std140 and D3D pad elements to 16 bytes,
  WGSL refuses element strides that are not multiples of 16);
- matrices have columns of four rows (a ``mat2`` column takes 8 bytes in WGSL and 16 elsewhere, and
  after a ``mat3`` D3D would move a scalar into the last column); in arrays of matrices, the columns
  are the elements;
- structs start at multiples of 16 bytes, and explicit padding makes them end at one;
- bools are uints (there is no size of a bool on which all rule sets agree).

Storage buffers follow std430, WGSL's rules, and those of Direct3D's structured buffers, which pad
nothing. There, structures are stored as in blocks, but a scalar or a vector of two lanes
has no padding between the elements.

Sources: OpenGL 4.6 specification, 7.6.2.2 "Standard Uniform Block Layout"; Microsoft, "Packing
Rules for Constant Variables"; WGSL, "Memory Layout" and "Address Space Layout Constraints".
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from itertools import count, filterfalse

from ...support.frozen import frozen
from .types import (
    FLOAT,
    Array,
    Matrix,
    RuntimeArray,
    Scalar,
    ScalarKind,
    Struct,
    Type,
    Vector,
)

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


def place(
    members: Iterable[tuple[str, Type]], padding: str = "pad", *, gaps: bool = False
) -> tuple[Placed, ...]:
    """Stored members in order, padded to a whole number of rows.

    ``padding`` is the stem of the padding members' names. With ``gaps``, there is no padding before
    a vector that every rule set moves to the next row by itself.
    """
    members = tuple(members)
    free = padding_names(padding, (name for name, _ in members))
    placed: list[Placed] = []
    end = 0

    def pad_to(alignment: int) -> None:
        nonlocal end
        while end % alignment:
            placed.append(Placed(next(free), FLOAT, end, padding=True))
            end += LANE

    for name, type_ in members:
        if gaps and _is_vector_in_new_row(type_, end):
            end = rounded_to_row(end)
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
        case Matrix(columns):
            return Matrix(columns, 4)
        case Array(element, count):
            return _stored_array(element, count)
        case RuntimeArray(element):
            return RuntimeArray(stored_element(element))
        case Struct():
            return stored_struct(type_)
        case _:
            raise TypeError(f"{type_} cannot be kept in a uniform block")


@cache
def stored_struct(struct: Struct) -> Struct:
    """A struct with stored members, in which gaps are members too."""
    placed = place((name, stored_type(type_)) for name, type_ in struct.members)
    return Struct(struct.name, tuple((row.name, row.type) for row in placed))


@cache
def stored_element(element: Type) -> Type:
    """The type of the elements of a storage buffer that hold values of ``element``.

    All rule sets agree on the distance between scalars, between vectors of two or four lanes, and
    between padded structures. A vector of three lanes takes four. A matrix is several elements, one
    for each column.
    """
    match element:
        case Vector(kind, 3):
            return Vector(_stored_kind(kind), 4)
        case Matrix():
            return Vector("float", 4)
        case Scalar() | Vector() | Struct():
            return stored_type(element)
        case _:
            raise TypeError(f"{element} cannot be an element of a storage buffer")


def stored_elements(element: Type) -> int:
    """The number of elements of the stored type that hold one value."""
    return element.columns if isinstance(element, Matrix) else 1


def element_stride(element: Type) -> int:
    """The distance in bytes from one value of a storage buffer to the next."""
    return stored_elements(element) * byte_size(stored_element(element))


def _stored_array(element: Type, count: int) -> Array:
    match element:
        case Scalar(kind) | Vector(kind):
            rows = -(-count // elements_in_row(element))
            return Array(Vector(_stored_kind(kind), 4), rows)
        case Matrix(columns):
            return Array(Vector("float", 4), columns * count)
        case Struct():
            return Array(stored_struct(element), count)
        case _:
            raise TypeError(f"an array of {element} cannot be kept in a uniform block")


def elements_in_row(element: Scalar | Vector) -> int:
    """The number of elements of an array in a ``vec4``: 4 scalars, 2 ``vec2``, 1 longer vector."""
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
        case Matrix(columns, 4):
            return columns * ROW
        case Array(element, count):
            return count * byte_size(element)
        case Struct(members=members):
            return sum(byte_size(type_) for _, type_ in members)
        case _:
            raise TypeError(f"{stored} is not a stored type")


def _is_vector_in_new_row(stored: Type, end: int) -> bool:
    """True if a vector would cross the end of a row: every rule set moves it to the next.

    D3D moves it for this reason; std140 and WGSL align vectors to their size, and a vec3 to 16.
    """
    return isinstance(stored, Vector) and end % ROW + byte_size(stored) > ROW


def rounded_to_row(end: int) -> int:
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


def padding_names(stem: str, taken: Iterable[str]) -> Iterator[str]:
    """``stem_0``, ``stem_1`` and so on, without the names that are taken."""
    return filterfalse(frozenset(taken).__contains__, (f"{stem}_{i}" for i in count()))


def structs_in(types: Iterable[Type]) -> tuple[Struct, ...]:
    """The structs that ``types`` use, each once; a struct comes after those that it contains."""
    found: dict[Struct, None] = {}
    for type_ in types:
        inner = type_.element if isinstance(type_, Array | RuntimeArray) else type_
        if isinstance(inner, Struct):
            found.update(dict.fromkeys(structs_in(member for _, member in inner.members)))
            found[inner] = None
    return tuple(found)


def place_in(element: Type, path: tuple[str | int, ...]) -> tuple[ScalarKind, int]:
    """The kind of the lanes of a part of a storage buffer's element, and its offset in bytes.

    ``path`` are the members and rows on the way to the part.
    """
    type_, offset = stored_element(element), 0
    for step in path:
        if isinstance(type_, Struct):
            names = [name for name, _ in type_.members]
            position = names.index(str(step))
            offset += sum(byte_size(inner) for _, inner in type_.members[:position])
            type_ = type_.members[position][1]
        else:
            assert isinstance(type_, Array) and isinstance(step, int)
            offset, type_ = offset + step * byte_size(type_.element), type_.element
    assert isinstance(type_, Scalar | Vector)
    return type_.kind, offset
