"""The contents of storage buffers as the bytes that a GPU reads.

``Instance`` keeps one ``Contents`` for each buffer; ``buffers.py`` makes them from a host's values.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

from ....compiler.documents.values import BufferRow
from .shapes import Elements, Members, Numbers, Shape, one_of, part
from .values import plain


@dataclass(frozen=True, slots=True)
class Layout:
    """One row of the reflection's ``buffers``, parsed."""

    name: str
    type: str
    element: Shape
    stride: int
    """The distance between elements, in bytes."""
    counter: str
    """The parameter with the number of elements."""


@dataclass(frozen=True, slots=True)
class Contents:
    """The elements of a storage buffer, with their layout."""

    layout: Layout
    count: int
    data: bytes

    @property
    def bound(self) -> bytes:
        """The bytes for a GPU: one element of zeros if the buffer has no elements."""
        return self.data or bytes(self.layout.stride)

    def elements(self) -> tuple[Any, ...]:
        """The elements in the form that hosts use: numbers, tuples, mappings for structures."""
        shape, stride = self.layout.element, self.layout.stride
        return tuple(plain(shape, _read(self.data, i * stride, shape)) for i in range(self.count))


def layout_of(row: BufferRow) -> Layout:
    """The layout that a row of ``buffers`` describes."""
    element = one_of(
        row.type.removesuffix("[]"), row.representation, row.layout, row.members, row.doc
    )
    return Layout(row.name, row.type, element, row.stride, row.count)


def empty(layout: Layout) -> Contents:
    """A buffer without elements, as every one is until a host sets it."""
    return Contents(layout, 0, b"")


_CODES = {"float": "f", "int": "i", "uint": "I", "bool": "I"}


def _read(data: bytes, offset: int, shape: Shape) -> Any:
    """The value at an offset, in the form of ``shapes``."""
    if isinstance(shape, Numbers):
        code = f"<{shape.lanes}{_CODES[shape.kind]}"
        columns = [
            struct.unpack_from(code, data, offset + number * shape.column_stride)
            for number in range(max(shape.columns, 1))
        ]
        if shape.kind == "bool":
            columns = [tuple(map(bool, lanes)) for lanes in columns]
        return tuple(columns) if shape.columns else columns[0]
    count = shape.count if isinstance(shape, Elements) else len(shape.members)
    rows = (part(shape, position) for position in range(count))
    return tuple(_read(data, offset + further, inner) for _, further, inner in rows)


def numbers_in(shape: Shape, offset: int = 0, name: str = "") -> list[tuple[str, int, Numbers]]:
    """The numbers, vectors and matrices that an element consists of: name, offset and shape."""
    if isinstance(shape, Numbers):
        return [(name, offset, shape)]
    assert isinstance(shape, Elements | Members)
    count = shape.count if isinstance(shape, Elements) else len(shape.members)
    found: list[tuple[str, int, Numbers]] = []
    for position in range(count):
        suffix, further, inner = part(shape, position)
        found += numbers_in(inner, offset + further, name + suffix)
    return found
