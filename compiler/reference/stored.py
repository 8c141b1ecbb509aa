"""Converts the value of a parameter to the form in which a uniform block stores it.

The pictures need it for the program of a profile: after the pass ``lower_reads``, a ``parameter``
node has the stored type, and what follows in the graph takes it apart. ``ir/storage.py`` says which
type that is.
"""

from __future__ import annotations

from ..ir.storage import elements_in_row, place, stored_type
from ..ir.types import Array, Matrix, Scalar, Struct, Type, Vector
from .namespace import Lanes

_ROW = 4
"""Lanes in a row of a block."""


def stored(type_: Type, value: Lanes) -> Lanes:
    """The stored form of a value whose declared type is ``type_``; numbers keep their precision."""
    match type_:
        case Scalar("bool") | Vector("bool"):
            return tuple(int(lane) for lane in value)
        case Matrix(size) if size < _ROW:
            return tuple((*column, *[0.0] * (_ROW - size)) for column in value)
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
