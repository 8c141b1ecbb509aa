"""Writes a value into the bytes of a uniform block, at its offset in the reflection.

``Instance.blocks`` calls it for each parameter.
"""

from __future__ import annotations

import struct
from typing import Any

from ....compiler.documents.representations import Kind
from .shapes import Numbers, Shape, part

_CODES: dict[Kind, str] = {"float": "f", "int": "i", "uint": "I", "bool": "I"}


def write(block: bytearray, offset: int, shape: Shape, value: Any) -> None:
    """Write a complete value at an offset; gaps keep their bytes."""
    if isinstance(shape, Numbers):
        _write_numbers(block, offset, shape, value)
        return
    for position, inner in enumerate(value):
        _, further, inner_shape = part(shape, position)
        write(block, offset + further, inner_shape, inner)


def _write_numbers(block: bytearray, offset: int, shape: Numbers, lanes: Any) -> None:
    """Write little-endian lanes of 32 bits next to each other; a matrix column after column."""
    code = f"<{shape.lanes}{_CODES[shape.kind]}"
    for number, column in enumerate(lanes if shape.columns else (lanes,)):
        struct.pack_into(code, block, offset + number * shape.column_stride, *column)
