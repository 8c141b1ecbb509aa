"""Reads elements of storage buffers: what ``index`` of a buffer means, for all pixels at once.

``HeldValues`` makes a ``BufferReader`` for each buffer and each type in which a graph reads it. It
is the value of the ``buffer`` leaf.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ir.leaves import Buffer
from ..ir.storage import (
    ROW,
    byte_size,
    element_stride,
    elements_in_row,
    place,
    stored_type,
)
from ..ir.types import (
    Array,
    Matrix,
    RuntimeArray,
    Scalar,
    ScalarKind,
    Struct,
    TallMatrix,
    Type,
    Vector,
)
from .bounds import Bounded, exact, given, hull
from .namespace import Lanes

Table = Any
"""An element with a column for each lane, which holds that lane of all elements."""

_KINDS: Mapping[ScalarKind, str] = {"float": "<f4", "int": "<i4", "uint": "<u4", "bool": "<u4"}

FEW = 16
"""Elements that are looked at one by one, where rounding may choose between some."""


@dataclass(frozen=True, slots=True)
class Contents:
    """The bytes of a storage buffer, at least one element of them."""

    data: bytes


class BufferReader:
    """A buffer's elements as values of the type in which a graph reads them."""

    def __init__(self, contents: Contents, leaf: Buffer, type_: Type) -> None:
        """``type_`` is that of the leaf, or the stored one once reads are lowered."""
        assert isinstance(type_, RuntimeArray)
        is_stored = type_ == stored_type(leaf.type) and type_ != leaf.type
        stride = byte_size(type_.element) if is_stored else element_stride(leaf.type.element)
        self._rows = np.frombuffer(contents.data, np.uint8).reshape(-1, stride)
        self._table: Table = self._lanes(type_.element, 0, is_stored=is_stored)

    def element(self, position: Any) -> Lanes:
        """The elements at these positions, which lie within bounds or do not matter."""
        if not isinstance(position, Bounded):
            return self._taken(position)
        if position.is_exact:
            return self._exactly(position.value)
        return self._between(position)

    # --- positions --------------------------------------------------------------------------------

    def _taken(self, position: Any) -> Lanes:
        at = np.clip(np.asarray(position), 0, len(self._rows) - 1)
        if at.ndim:
            taken: Lanes = _mapped(self._table, lambda column: column[at])
        else:
            taken = _mapped(self._table, lambda column: column[at].item())
        return taken

    def _exactly(self, position: Any) -> Lanes:
        lanes: Lanes = _mapped(self._taken(position), given)
        return lanes

    def _between(self, position: Bounded) -> Lanes:
        """Where rounding may tip which element is read: any of them."""
        last = len(self._rows) - 1
        low, high = (np.clip(end, 0, last) for end in (position.low, position.high))
        found: Lanes = self._exactly(position.value)
        if (high - low).max() > FEW:
            ends = _mapped(self._table, lambda column: (column.min(), column.max()))
            whole: Lanes = _joined(found, ends)
            return whole
        for step in range(int((high - low).max()) + 1):
            found = _hulls(found, self._exactly(np.minimum(low + step, high)))
        return found

    # --- elements ---------------------------------------------------------------------------------

    def _lanes(self, type_: Type, offset: int, *, is_stored: bool) -> Table:
        match type_:
            case Scalar(kind):
                return (self._column(kind, offset),)
            case Vector(kind, size):
                return tuple(self._column(kind, offset + 4 * lane) for lane in range(size))
            case Matrix(size):
                return self._columns(size, size, offset)
            case TallMatrix(columns):
                return self._columns(columns, 4, offset)
            case Struct():
                return tuple(
                    self._lanes(inner, offset + further, is_stored=is_stored)
                    for inner, further in _members(type_, is_stored=is_stored)
                )
            case Array(element, count):
                return tuple(
                    self._lanes(element, offset + i * _stride(type_), is_stored=is_stored)
                    for i in range(count)
                )
        raise TypeError(f"{type_} cannot be an element of a storage buffer")

    def _columns(self, count: int, rows: int, offset: int) -> Table:
        return tuple(
            tuple(self._column("float", offset + 16 * column + 4 * row) for row in range(rows))
            for column in range(count)
        )

    def _column(self, kind: ScalarKind, offset: int) -> NDArray[Any]:
        lane = np.ascontiguousarray(self._rows[:, offset : offset + 4]).view(_KINDS[kind])[:, 0]
        if kind == "bool":
            return np.asarray(lane, np.bool_)
        number: NDArray[Any] = np.asarray(lane, np.float64 if kind == "float" else np.int64)
        return number


def _members(struct: Struct, *, is_stored: bool) -> Iterator[tuple[Type, int]]:
    """The members of a structure with their offsets; of a stored one also those that fill gaps."""
    if is_stored:
        offset = 0
        for _, type_ in struct.members:
            yield type_, offset
            offset += byte_size(type_)
        return
    placed = place((name, stored_type(type_)) for name, type_ in struct.members)
    offsets = {row.name: row.offset for row in placed}
    yield from ((type_, offsets[name]) for name, type_ in struct.members)


def _stride(array: Array) -> int:
    """The distance between the elements of an array that is a member; rows may hold several."""
    if isinstance(array.element, Scalar | Vector):
        return ROW // elements_in_row(array.element)
    return byte_size(stored_type(array)) // array.count


def _mapped(value: Any, change: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(_mapped(part, change) for part in value)
    return change(value)


def _hulls(value: Any, other: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(_hulls(a, b) for a, b in zip(value, other, strict=True))
    return hull(value, other)


def _joined(value: Any, ends: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(_joined(a, b) for a, b in zip(value, ends, strict=True))
    low, high = ends
    return hull(hull(value, exact(low)), exact(high))
