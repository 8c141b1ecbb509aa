"""The shape of a parameter's value, and the offsets of its lanes: a row of the reflection, parsed.

A value has the form that the reference evaluator takes: a number is a tuple of one lane, a vector
is a tuple of its lanes, a matrix of its columns, an array of its elements, a structure of its
members. Numbers, vectors and matrices that nobody has set are ``None``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ....compiler.documents.representations import Kind, kind_of
from ....compiler.documents.values import DerivedRow, LayoutRow, MemberRow, ParameterRow

STORED: Mapping[Kind, str] = {"float": "<f4", "int": "<i4", "uint": "<u4", "bool": "<u4"}
"""The stored form of a lane, as NumPy spells it."""

WHOLE: Mapping[Kind, tuple[int, int]] = {"int": (-(2**31), 2**31 - 1), "uint": (0, 2**32 - 1)}
"""The smallest and the largest integer of a type."""


MOST_LANES = 4
"""The most lanes of a vector, and the most columns of a matrix."""


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
    choices: tuple[str, ...] = ()
    """The members of the enumeration that it is, by their numbers."""

    @property
    def meaning(self) -> str:
        """The written type without the names of spaces: ``direction``."""
        return self.type.partition("<")[0]

    @property
    def is_color(self) -> bool:
        """True if a colour literal may be given; as in the language, vectors accept one."""
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


def shape_of(row: ParameterRow | MemberRow | DerivedRow) -> Shape:
    """The shape that a row of ``parameters``, ``derived`` or ``members`` describes."""
    layout, type_ = row.layout, row.representation
    members: tuple[MemberRow, ...] = ()
    range_ = default = None
    choices: tuple[str, ...] = ()
    if not isinstance(row, DerivedRow):
        type_, members, range_, default = row.type, row.members, row.range, row.default
        choices = tuple(choice.name for choice in row.choices or ())
    if layout.count is None:
        one = one_of(type_, row.representation, layout, members, row.doc, range_, default)
        return _called(one, choices)
    element = type_.rpartition("[")[0]
    one = _called(one_of(element, row.representation, layout, members, row.doc, range_), choices)
    assert layout.stride is not None
    counter = row.count if isinstance(row, ParameterRow) else None
    return Elements(type_, one, layout.count, layout.stride, default, counter, row.doc)


def _called(one: Numbers | Members, choices: tuple[str, ...]) -> Numbers | Members:
    """The shape of a value of an enumeration with these members; of none if there are none."""
    return replace(one, choices=choices) if choices and isinstance(one, Numbers) else one


def one_of(
    type_: str,
    representation: str,
    layout: LayoutRow,
    members: Sequence[MemberRow],
    doc: str,
    range_: tuple[float, float] | None = None,
    default: Any = None,
) -> Numbers | Members:
    """The shape of a value that is no array, or of an array's elements."""
    if members:
        parts = (Member(each.name, each.offset, shape_of(each)) for each in members)
        return Members(type_, tuple(parts), default)
    assert layout.lanes is not None
    return Numbers(
        type=type_,
        kind=kind_of(representation.partition("[")[0]),
        lanes=layout.lanes,
        columns=layout.columns or 0,
        column_stride=layout.column_stride or 0,
        range=range_,
        default=default,
        doc=doc,
    )


def stored_as(representation: str) -> str:
    """The stored form of the lanes of a number or a vector, as NumPy spells it."""
    return STORED[kind_of(representation)]


def part(shape: Shape, position: int) -> tuple[str, int, Shape]:
    """The suffix of a part's name (``[2]``, ``.place``), its offset in bytes, and its shape."""
    if isinstance(shape, Elements):
        return f"[{position}]", position * shape.stride, shape.element
    assert isinstance(shape, Members)
    member = shape.members[position]
    return f".{member.name}", member.offset, member.shape
