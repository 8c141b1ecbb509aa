"""Values in bytes: written as ``packing`` says, read back as a stored type lies."""

from __future__ import annotations

import struct
from typing import Any

from burnish.compiler.ir.storage import byte_size
from burnish.compiler.ir.types import (
    Array,
    Matrix,
    Scalar,
    Struct,
    Type,
    Vector,
)
from burnish.compiler.packing import Packing

Value = Any
"""A scalar, or a tuple of lanes, columns, elements or a struct's members in order."""

CODES = {"float": "<f", "int": "<i", "uint": "<I"}


def write(target: bytearray, start: int, packing: Packing, value: Value) -> None:
    """Writes a declared value with nothing but the packing's numbers."""
    if packing.count is None:
        _write_one(target, start, packing, value)
        return
    for number, element in enumerate(value):
        _write_one(target, start + number * packing.stride, packing, element)


def _write_one(target: bytearray, start: int, packing: Packing, value: Value) -> None:
    if packing.kind is None:
        for member, inside in zip(packing.members, value, strict=True):
            write(target, start + member.offset, member.packing, inside)
        return
    columns = value if packing.columns > 1 else (value,)
    for number, column in enumerate(columns):
        lanes = column if packing.lanes > 1 else (column,)
        at = start + number * packing.column_stride
        for lane, scalar in enumerate(lanes):
            number_ = float(scalar) if packing.kind == "float" else int(scalar)
            struct.pack_into(CODES[packing.kind], target, at + 4 * lane, number_)


def read(source: bytes, start: int, stored: Type) -> Value:
    """The value of a stored type, whose parts follow one another without gaps."""
    match stored:
        case Scalar(kind):
            return struct.unpack_from(CODES[kind], source, start)[0]
        case Vector(kind, size):
            return _run(source, start, [Scalar(kind)] * size)
        case Matrix(columns, 4):
            return _run(source, start, [Vector("float", 4)] * columns)
        case Array(element, count):
            return _run(source, start, [element] * count)
        case Struct(members=members):
            return _run(source, start, [type_ for _, type_ in members])
        case _:
            raise TypeError(stored)


def _run(source: bytes, start: int, parts: list[Type]) -> Value:
    values = []
    for part in parts:
        values.append(read(source, start, part))
        start += byte_size(part)
    return tuple(values)
