"""The shape of a parameter's value, and where its lanes lie: a row of the reflection, parsed.

A value has the form that the reference evaluator takes: a number is a tuple of one lane, a vector
is a tuple of its lanes, a matrix of its columns, an array of its elements, a structure of its
members. Numbers, vectors and matrices that nobody has set are ``None``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

Kind = Literal["float", "int", "uint", "bool"]

_VECTOR = re.compile(r"([iub]?)vec([234])")
_PREFIXES: dict[str, Kind] = {"": "float", "i": "int", "u": "uint", "b": "bool"}
_SCALARS: dict[str, Kind] = {"float": "float", "int": "int", "uint": "uint", "bool": "bool"}

STORED: Mapping[Kind, str] = {"float": "<f4", "int": "<i4", "uint": "<u4", "bool": "<u4"}
"""How a lane is stored, as NumPy spells it."""

WHOLE: Mapping[Kind, tuple[int, int]] = {"int": (-(2**31), 2**31 - 1), "uint": (0, 2**32 - 1)}
"""The least and the largest integer of a type."""


MOST_LANES = 4
"""Of a vector; a matrix has as many columns."""


@dataclass(frozen=True, slots=True)
class Numbers:
    """A number, a vector or a matrix."""

    type: str
    """The type as written: ``rgb``, ``direction<world>``."""
    kind: Kind
    lanes: int
    """The lanes of a number, a vector, or a column."""
    columns: int = 0
    """The columns of a matrix; 0 for anything else."""
    column_stride: int = 0
    """The distance between columns, in bytes."""
    range: tuple[float, float] | None = None
    """The lowest and the highest value that each lane may have."""
    default: Any = None
    doc: str = ""

    @property
    def meaning(self) -> str:
        """The written type without the names of spaces: ``direction``."""
        return self.type.partition("<")[0]

    @property
    def is_color(self) -> bool:
        """Whether it accepts a colour literal; as in the language, vectors do."""
        return self.kind == "float" and not self.columns and self.lanes in (3, 4)


@dataclass(frozen=True, slots=True)
class Elements:
    """An array."""

    type: str
    element: Shape
    count: int
    stride: int
    """The distance between elements, in bytes."""
    default: Any = None
    counter: str | None = None
    """The parameter that holds the number of elements in use; ``None`` if all are."""
    doc: str = ""


@dataclass(frozen=True, slots=True)
class Members:
    """A structure."""

    type: str
    members: tuple[Member, ...]
    default: Any = None


@dataclass(frozen=True, slots=True)
class Member:
    """A member of a structure, ``offset`` bytes after the start of the structure."""

    name: str
    offset: int
    shape: Shape


Shape = Numbers | Elements | Members


def shape_of(row: Mapping[str, Any]) -> Shape:
    """The shape that a row of ``parameters``, ``derived`` or ``members`` describes."""
    layout, type_ = row["layout"], row.get("type", row["representation"])
    if "count" not in layout:
        return _one(row, type_)
    one = _one({**row, "default": None}, type_.rpartition("[")[0])
    count, stride = layout["count"], layout["stride"]
    return Elements(type_, one, count, stride, row.get("default"), row.get("count"), row["doc"])


def _one(row: Mapping[str, Any], type_: str) -> Numbers | Members:
    """The shape of a row; if it is an array's, that of its elements."""
    layout, members = row["layout"], row.get("members")
    if members:
        parts = (Member(each["name"], each["offset"], shape_of(each)) for each in members)
        return Members(type_, tuple(parts), row.get("default"))
    range_ = row.get("range")
    return Numbers(
        type=type_,
        kind=kind_of(row["representation"].partition("[")[0]),
        lanes=layout["lanes"],
        columns=layout.get("columns", 0),
        column_stride=layout.get("column_stride", 0),
        range=(range_[0], range_[1]) if range_ else None,
        default=row.get("default"),
        doc=row["doc"],
    )


def kind_of(representation: str) -> Kind:
    """The type of the lanes of a number, vector or matrix; ``float`` for all other types."""
    vector = _VECTOR.fullmatch(representation)
    return _PREFIXES[vector[1]] if vector else _SCALARS.get(representation, "float")


def lanes_of(representation: str) -> int:
    """How many lanes a vector has; 1 for a number."""
    vector = _VECTOR.fullmatch(representation)
    return int(vector[2]) if vector else 1


def stored_as(representation: str) -> str:
    """How the lanes of a number or a vector are stored, as NumPy spells it."""
    return STORED[kind_of(representation)]


def part(shape: Shape, position: int) -> tuple[str, int, Shape]:
    """The suffix of a part's name (``[2]``, ``.place``), its offset in bytes, and its shape."""
    if isinstance(shape, Elements):
        return f"[{position}]", position * shape.stride, shape.element
    assert isinstance(shape, Members)
    member = shape.members[position]
    return f".{member.name}", member.offset, member.shape
