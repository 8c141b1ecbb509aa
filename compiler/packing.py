"""Describes how a host writes a value into the bytes that ``layout`` assigned to it.

The reflection contains a ``Packing`` for each parameter, and the runtime follows it. A writer only
needs arithmetic on offsets: element ``i`` of an array is ``i * stride`` bytes after element 0,
column ``c`` of a matrix is ``c * column_stride`` bytes after column 0, and lane ``l`` is ``4 * l``
bytes after lane 0. All lanes are little-endian and 32 bits wide.
"""

from __future__ import annotations

from typing import Literal

from ..support.frozen import changed, frozen
from .ir.storage import (
    ROW,
    byte_size,
    element_stride,
    elements_in_row,
    place,
    stored_element,
    stored_type,
)
from .ir.types import Array, Matrix, Scalar, Struct, Type, Vector, width

LaneKind = Literal["float", "int", "uint"]
"""The kind of number in a lane; bools are uints 0 and 1."""


@frozen
class Packing:
    """The bytes of a value of one declared type, counted from the start of the value."""

    type: Type
    """The declared type, without its meaning."""
    stored: Type
    size: int
    """The number of bytes of the stored form, including padding."""
    kind: LaneKind | None
    """The type that a lane is written as: a bool is the uint 0 or 1. ``None`` for structs."""
    lanes: int
    """The number of lanes of a scalar, a vector or a matrix's column; 0 for structs."""
    columns: int = 1
    column_stride: int = 0
    """The distance between columns of a matrix, in bytes."""
    count: int | None = None
    """The number of elements of an array; the other fields then describe one element."""
    stride: int = 0
    """The distance between elements of an array, or of a storage buffer, in bytes."""
    members: tuple[PackedMember, ...] = ()
    """The members of a struct, or of an array's elements, without padding."""


@frozen
class PackedMember:
    """A member of a struct, ``offset`` bytes after the start of the struct."""

    name: str
    offset: int
    packing: Packing


def packing(type_: Type) -> Packing:
    """The places of the lanes of a value of ``type_`` in its stored form."""
    stored = stored_type(type_)
    size = byte_size(stored)
    match type_:
        case Scalar() | Vector():
            return Packing(type_, stored, size, _kind(stored), width(type_))
        case Matrix(columns, rows):
            return Packing(type_, stored, size, "float", rows, columns, ROW)
        case Struct():
            return Packing(type_, stored, size, None, 0, members=_members(type_))
        case Array(element, count):
            return _array(type_, element, count)
        case _:
            raise TypeError(f"{type_} cannot be kept in a uniform block")


def element_packing(type_: Type) -> Packing:
    """The places of the lanes of an element of a storage buffer, and the stride of elements."""
    return changed(packing(type_), stored=stored_element(type_), stride=element_stride(type_))


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
    """One member of the structures of an array, as an array of its own with gaps between elements.

    It starts at this member of the first structure.
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


def _kind(stored: Type) -> LaneKind:
    assert isinstance(stored, Scalar | Vector) and stored.kind != "bool"
    return stored.kind
