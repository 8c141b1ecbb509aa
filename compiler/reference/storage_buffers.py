"""Reads elements of storage buffers: the meaning of ``index``, for all pixels at once.

``HeldValues`` makes a ``BufferReader`` for each buffer and each type in which a graph reads it. It
is the value of the ``buffer`` leaf.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any
from uuid import UUID, uuid4

import numpy as np
from numpy.typing import NDArray

from ...support.frozen import cached_property
from ..ir.kernel import ends
from ..ir.leaves import Buffer
from ..ir.storage import (
    LANE,
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
    Type,
    Vector,
)
from .bounds import Bounded, between, given, remembered
from .namespace import Lanes
from .runs import Extremes

Table = Any
"""An element with a ``_Column`` for each lane, which holds that lane of all elements."""

_KINDS: Mapping[ScalarKind, str] = {"float": "<f4", "int": "<i4", "uint": "<u4", "bool": "<u4"}
_ANYTHING: Mapping[ScalarKind, tuple[int, int]] = {
    "int": ends(signed=True), "uint": ends(signed=False), "bool": (0, 1)
}  # fmt: skip
"""Between which numbers something is of which nothing is known."""


@dataclass(frozen=True, slots=True)
class Contents:
    """The content of a storage buffer: at least one element."""

    data: bytes
    ends: NDArray[np.float64] | None = None
    """The numbers that a kernel has written, with their bounds on a device, (3, words).

    There is one for each four bytes. It is not rounded to 32 bits, and float64 has every integer of
    32 bits. NaN stands for undefined numbers. Without it, devices have just the numbers of
    ``data``.
    """
    written: UUID = field(default_factory=uuid4, compare=False)
    """A name of its own.

    Two kernels that have written the same here may not on a device, but whoever reads the same
    contents finds the same numbers there.
    """


class BufferReader:
    """A buffer's elements as values of the type in which a graph reads them."""

    def __init__(self, contents: Contents, leaf: Buffer, type_: Type) -> None:
        """``type_`` is that of the leaf, or the stored one once reads are lowered."""
        assert isinstance(type_, RuntimeArray)
        is_stored = type_ == stored_type(leaf.type) and type_ != leaf.type
        stride = byte_size(type_.element) if is_stored else element_stride(leaf.type.element)
        self._rows = np.frombuffer(contents.data, np.uint8).reshape(-1, stride)
        written = contents.ends
        self._ends = None if written is None else written.reshape(3, -1, stride // LANE)
        self._table: Table = self._lanes(type_.element, 0, is_stored=is_stored)
        self._undecided = None if self._ends is None else np.isnan(self._ends[0]).any(axis=-1)
        """True for elements that are undefined in part; ``None`` if all are defined."""

    def element(self, position: Any) -> Lanes:
        """The elements at these positions, which lie within bounds or do not matter.

        Where rounding may tip which element is read, it may be any of them.
        """
        last = len(self._rows) - 1
        lanes: Lanes
        if isinstance(position, Bounded):
            lanes = _mapped(self._table, lambda column: column.bounded(position, last))
        else:
            at = np.clip(np.asarray(position), 0, last)
            lanes = _mapped(self._table, lambda column: column.plain(at))
        return lanes

    def is_undecided(self, position: Any) -> NDArray[np.bool_] | bool:
        """True where any of the elements at these positions is undefined."""
        if self._undecided is None or not self._undecided.any():
            return False
        found: NDArray[np.bool_] = self._undecided[np.clip(position, 0, len(self._rows) - 1)]
        return found

    # --- elements ---------------------------------------------------------------------------------

    def _lanes(self, type_: Type, offset: int, *, is_stored: bool) -> Table:
        match type_:
            case Scalar(kind):
                return (self._column(kind, offset),)
            case Vector(kind, size):
                return tuple(self._column(kind, offset + LANE * lane) for lane in range(size))
            case Matrix(columns, rows):
                return self._columns(columns, rows, offset)
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
            tuple(self._column("float", offset + ROW * column + LANE * row) for row in range(rows))
            for column in range(count)
        )

    def _column(self, kind: ScalarKind, offset: int) -> _Column:
        if self._ends is not None:
            value, low, high = _numbers(kind, self._ends[:, :, offset // LANE])
            is_exact = bool(((low == value) & (high == value)).all())
            return _Column(value) if is_exact else _Column(value, low, high)
        lane = np.ascontiguousarray(self._rows[:, offset : offset + LANE]).view(_KINDS[kind])
        return _Column(_as_arrays(kind, lane[:, 0]))


class _Column:
    """One lane of all elements."""

    def __init__(self, value: NDArray[Any], *off: NDArray[Any]) -> None:
        """``off`` are the bounds of a device's values, if they may differ."""
        self._value = value
        self._ends = off

    def plain(self, at: NDArray[Any]) -> Any:
        """The value at these positions; a plain number at a single one."""
        found = self._value[at]
        return found if at.ndim else found.item()

    def bounded(self, position: Bounded, last: int) -> Bounded:
        """The values of a device at these positions, of which ``last`` is the largest one."""
        value, low, high = (
            np.clip(end, 0, last) for end in (position.value, position.low, position.high)
        )
        found = self._value[value]
        if not position.is_exact:
            least, largest = self._extremes
            made = between(found, least.of(low, high), largest.of(low, high))
        elif self._ends:
            made = between(found, *(end[value] for end in self._ends))
        else:
            made = given(found)
        kept: Bounded = remembered(made)
        return kept

    @cached_property
    def _extremes(self) -> tuple[Extremes, Extremes]:
        whole = given(self._value)
        low, high = self._ends or (whole.low, whole.high)
        return Extremes(np.minimum, low), Extremes(np.maximum, high)


def _numbers(kind: ScalarKind, written: NDArray[np.float64]) -> Iterator[NDArray[Any]]:
    """A lane of all elements and its ends; whole numbers are anything where nothing is defined."""
    least, most = _ANYTHING.get(kind, (np.nan, np.nan))
    for end, unknown in zip(written, (least, least, most), strict=True):
        yield _as_arrays(kind, np.where(np.isnan(end), unknown, end))


def _as_arrays(kind: ScalarKind, numbers: NDArray[Any]) -> NDArray[Any]:
    if kind == "bool":
        return numbers.astype(np.bool_)
    return numbers.astype(np.float64 if kind == "float" else np.int64)


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


def _mapped(value: Any, change: Callable[[_Column], Any]) -> Any:
    if isinstance(value, tuple):
        return tuple(_mapped(part, change) for part in value)
    return change(value)
