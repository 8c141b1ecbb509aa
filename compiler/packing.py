"""How a host writes a declared value into the bytes that ``layout`` gave it.

Everything a writer needs is arithmetic on offsets: element ``i`` of an array lies ``i * stride``
bytes after element 0, column ``c`` of a matrix ``c * column_stride`` after column 0, and lane ``l``
four bytes times ``l`` after lane 0. All lanes are little-endian and 32 bits wide.
"""

from __future__ import annotations

from ..frozen import changed, frozen
from .ir.storage import ROW, byte_size, elements_in_row, place, stored_type
from .ir.types import Array, Matrix, Scalar, ScalarKind, Struct, Type, Vector, width


@frozen
class Packing:
    """The bytes of a value of one declared type, counted from where the value starts."""

    type: Type
    """As declared, in representation."""
    stored: Type
    size: int
    """Bytes of the stored form, padding included."""
    kind: ScalarKind | None
    """What a lane is written as: a bool as the uint 0 or 1. ``None`` for structs."""
    lanes: int
    """Lanes of a scalar or vector, or of a matrix's column; 0 for structs."""
    columns: int = 1
    column_stride: int = 0
    """Bytes from column to column of a matrix."""
    count: int | None = None
    """Elements of an array, whose elements are what the other fields describe."""
    stride: int = 0
    """Bytes from element to element of an array."""
    members: tuple[PackedMember, ...] = ()
    """Of a struct, or of an array's elements; padding left out."""


@frozen
class PackedMember:
    """A struct's member, ``offset`` bytes into the struct."""

    name: str
    offset: int
    packing: Packing


def packing(type_: Type) -> Packing:
    """Where the lanes of a value of ``type_`` lie in its stored form."""
    stored = stored_type(type_)
    size = byte_size(stored)
    match type_:
        case Scalar() | Vector():
            return Packing(type_, stored, size, _kind(stored), width(type_))
        case Matrix(columns):
            return Packing(type_, stored, size, "float", columns, columns, ROW)
        case Struct():
            return Packing(type_, stored, size, None, 0, members=_members(type_))
        case Array(element, count):
            return _array(type_, element, count)
        case _:
            raise TypeError(f"{type_} cannot be kept in a uniform block")


def _array(array: Array, element: Type, count: int) -> Packing:
    one = packing(element)
    stored = stored_type(array)
    match element:
        case Scalar() | Vector():
            stride = ROW // elements_in_row(element)
        case _:
            stride = byte_size(stored) // count
    return Packing(
        type=array,
        stored=stored,
        size=byte_size(stored),
        kind=one.kind,
        lanes=one.lanes,
        columns=one.columns,
        column_stride=one.column_stride,
        count=count,
        stride=stride,
        members=one.members,
    )


def spread(table: Packing, member: PackedMember) -> Packing:
    """One member of the structures of an array, as an array of its own with gaps between.

    It starts where the member of the first structure does.
    """
    one, count = member.packing, table.count
    assert count is not None and one.count is None
    return changed(
        one,
        type=Array(one.type, count),
        size=(count - 1) * table.stride + one.size,
        count=count,
        stride=table.stride,
    )


def _members(struct: Struct) -> tuple[PackedMember, ...]:
    placed = place((name, stored_type(type_)) for name, type_ in struct.members)
    offsets = {row.name: row.offset for row in placed}
    return tuple(
        PackedMember(name, offsets[name], packing(type_)) for name, type_ in struct.members
    )


def _kind(stored: Type) -> ScalarKind:
    assert isinstance(stored, Scalar | Vector) and stored.kind != "bool"
    return stored.kind
