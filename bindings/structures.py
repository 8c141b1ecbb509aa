"""Makes the fields of blocks and structures from the rows of a reflection."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..compiler.documents.representations import kind_of
from ..compiler.documents.values import DerivedRow, LayoutRow, MemberRow, ParameterRow
from .fields import Field, Numbers, Structure

_ROW = 16
"""Bytes in which a column and an element of three lanes have one that is not read."""


class Structures:
    """The structures of a binding, each of which has a name of its own."""

    def __init__(self) -> None:
        self._found: dict[str, Structure] = {}

    @property
    def found(self) -> tuple[Structure, ...]:
        """All structures, those inside others first."""
        return tuple(self._found.values())

    def structure(self, name: str, size: int, fields: tuple[Field, ...]) -> Structure:
        """The structure of these fields; another one that has the name already is kept."""
        for number in range(1, len(self._found) + 2):
            called = name if number == 1 else f"{name}{number}"
            new = Structure(name=called, size=size, fields=fields)
            if self._found.setdefault(called, new) == new:
                return new
        raise AssertionError(name)

    def field(
        self, row: ParameterRow | MemberRow, word: str, offset: int, counts: str = ""
    ) -> Field:
        """The field of a parameter or of a member."""
        layout = row.layout
        counter = row.count if isinstance(row, ParameterRow) else None
        return Field(
            name=row.name, word=word, type=self._type(row), offset=offset,
            stride=layout.stride or 0, capacity=layout.count or 0, default=row.default,
            range=row.range, choices=tuple(each.name for each in row.choices or ()),
            meaning=row.type, doc=row.doc,
            role=row.role if isinstance(row, ParameterRow) else None,
            counter=(counter or "").replace(".", "_"), counts=counts,
        )  # fmt: skip

    def _type(self, row: ParameterRow | MemberRow) -> Numbers | Structure:
        if not row.members:
            return numbers(row.layout, row.representation)
        name = row.layout.stored.partition("[")[0]
        fields = tuple(
            self.field(each, each.name, each.offset)
            for each in sorted(row.members, key=lambda each: each.offset)
        )
        size = row.size if row.layout.count is None else row.layout.stride or 0
        return self.structure(name, size, fields)


def numbers(layout: LayoutRow, representation: str) -> Numbers:
    """The type of numbers that lie so in memory."""
    assert layout.kind is not None and layout.lanes is not None
    columns, lanes = layout.columns or 0, layout.lanes
    fills_row = columns or (layout.stride == _ROW and lanes == 3)
    return Numbers(
        kind=layout.kind, truth=kind_of(representation.partition("[")[0]) == "bool", lanes=lanes,
        columns=columns, stored_lanes=4 if fills_row else lanes,
    )  # fmt: skip


def table(
    structures: Structures, name: str, size: int, rows: Sequence[DerivedRow], offset: int
) -> Structure:
    """The structure of the elements of a table of derived values."""
    return structures.structure(name, size, tuple(_members(rows, offset)))


def derived_field(row: DerivedRow, word: str, offset: int, *, is_member: bool = False) -> Field:
    """The field of a derived value, or the member of a table that has it for each element."""
    layout = row.layout
    return Field(
        name=row.name, word=word, type=_plain(row, is_member), offset=offset,
        stride=0 if is_member else layout.stride or 0,
        capacity=0 if is_member else layout.count or 0,
        meaning=row.representation, doc=row.doc, role=row.role, computed=True,
    )  # fmt: skip


def _plain(row: DerivedRow, is_member: bool) -> Numbers:
    found = numbers(row.layout, row.representation)
    if is_member and not found.columns:
        return Numbers(
            kind=found.kind, truth=found.truth, lanes=found.lanes, stored_lanes=found.lanes
        )
    return found


def _members(rows: Iterable[DerivedRow], offset: int) -> Iterable[Field]:
    for row in rows:
        assert row.offset is not None
        word = row.name.rpartition(".")[2]
        yield derived_field(row, word, row.offset - offset, is_member=True)
