"""The values that the host holds for a shader: parameters and storage buffers as leaves of a graph.

Pictures, kernels and the attribution of errors read these leaves through ``HeldValues``. A graph
may have them as they are declared or, after the pass ``lower_reads``, as they are stored in blocks:
``stored`` makes integers of bools, and rows of four lanes of columns and of elements of arrays.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..ir.leaves import Buffer, Parameter
from ..ir.node import Node
from ..ir.operations import BUFFER, PARAMETER
from ..ir.storage import elements_in_row, place, stored_type
from ..ir.types import Array, Matrix, Scalar, Struct, Type, Vector
from .bounds.bounded import constant
from .kept_numbers import KeptNumbers
from .namespace import Lanes
from .storage_buffers import BufferReader, Contents

_ROW = 4
"""Lanes in a row of a block."""


def stored(type_: Type, value: Lanes) -> Lanes:
    """The stored form of a value whose declared type is ``type_``; numbers keep their precision."""
    match type_:
        case Scalar("bool") | Vector("bool"):
            return tuple(int(lane) for lane in value)
        case Matrix(rows=rows) if rows < _ROW:
            return tuple((*column, *[0.0] * (_ROW - rows)) for column in value)
        case Array(Scalar() | Vector() as element, _):
            lanes = [lane for part in value for lane in _row_part(element, stored(element, part))]
            lanes += [0] * (-len(lanes) % _ROW)
            return tuple(tuple(lanes[at : at + _ROW]) for at in range(0, len(lanes), _ROW))
        case Array(Matrix() as element, _):
            return tuple(column for part in value for column in stored(element, part))
        case Array(element, _):
            return tuple(stored(element, part) for part in value)
        case Struct(members=members):
            return _with_padding(members, value)
        case _:
            return value


def _row_part(element: Scalar | Vector, value: Lanes) -> Lanes:
    """An element of an array with the lanes of its row that no other element uses."""
    room = _ROW // elements_in_row(element)
    return (*value, *[0] * (room - len(value)))


def _with_padding(members: tuple[tuple[str, Type], ...], value: Lanes) -> Lanes:
    """The members of a structure, and zeros for those that only fill gaps."""
    parts = {name: stored(type_, v) for (name, type_), v in zip(members, value, strict=True)}
    rows = place((name, stored_type(type_)) for name, type_ in members)
    return tuple((0.0,) if row.padding else parts[row.name] for row in rows)


class HeldValues:
    """The values of a shader's parameters and storage buffers, by name."""

    def __init__(
        self,
        values: Mapping[str, Any],
        seen: Callable[[Lanes], Lanes] | None = None,
        kept: KeptNumbers | None = None,
    ) -> None:
        """``seen`` makes a device's value of a parameter's value.

        Buffers hold numbers of the device already. ``kept`` has parameters of earlier draws.
        """
        self._values = values
        self._seen = seen
        self._kept = kept
        self._found: dict[tuple[Parameter | Buffer, Type], Lanes] = {}

    def value(self, node: Node) -> Lanes | None:
        """The value of a parameter or a buffer; ``None`` for any other node.

        Raises ``ValueError`` for one that has no value.
        """
        leaf = node.data
        if not isinstance(leaf, Parameter | Buffer):
            return None
        key = leaf, node.type
        if key not in self._found:
            read = self._parameter if isinstance(leaf, Parameter) else self._buffer
            self._found[key] = read(node)
        return self._found[key]

    def _parameter(self, node: Node) -> Lanes:
        leaf = PARAMETER.data(node)
        if leaf.name not in self._values:
            raise ValueError(f"The parameter `{leaf.name}` has no value.")
        value: Lanes = self._values[leaf.name]
        if node.type != leaf.type:
            value = stored(leaf.type, value)
        if self._seen is not None:
            value = self._seen(value)
        return value if self._kept is None else self._kept.parameter(leaf, node.type, value)

    def _buffer(self, node: Node) -> Lanes:
        leaf = BUFFER.data(node)
        contents = self._values.get(leaf.name)
        if not isinstance(contents, Contents):
            raise ValueError(f"The buffer `{leaf.name}` has no contents.")
        return (BufferReader(contents, leaf, node.type),)


def as_rounded(value: Any) -> Any:
    """A value, floats of which a device has as the nearest float32.

    This is so for the constants of a text, and for numbers that a host computes in float64 and
    rounds. A number that is a float32 stays exact.
    """
    if isinstance(value, tuple):
        return tuple(map(as_rounded, value))
    return constant(value) if isinstance(value, float) else value


def rounded_constants(node: Node, _operands: list[Lanes], value: Lanes) -> Lanes:
    """The value of a node for an ``Evaluator``: a constant is rounded as in a text."""
    made: Lanes = as_rounded(value) if node.op == "constant" else value
    return made
