"""Makes the fields of blocks and structures from the rows of a reflection."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TypeVar

from ..compiler.documents.reflection import Reflection
from ..compiler.documents.representations import kind_of
from ..compiler.documents.values import (
    BufferRow,
    DerivedRow,
    LayoutRow,
    MemberRow,
    ParameterRow,
    ResultRow,
)
from ..support.frozen import changed
from .fields import Choice, Enumeration, Field, Numbers, Structure
from .materials import Buffer

_ROW = 16
"""Bytes in which a column and an element of three lanes have one that is not read."""


_Named = TypeVar("_Named", Structure, Enumeration)


class Structures:
    """The structures and enumerations of a binding, each of which has a name of its own."""

    def __init__(self) -> None:
        self._found: dict[str, Structure | Enumeration] = {}

    @property
    def found(self) -> tuple[Structure, ...]:
        """All structures, those inside others first."""
        return tuple(each for each in self._found.values() if isinstance(each, Structure))

    @property
    def enumerations(self) -> tuple[Enumeration, ...]:
        """All enumerations."""
        return tuple(each for each in self._found.values() if isinstance(each, Enumeration))

    def structure(self, name: str, size: int, fields: tuple[Field, ...]) -> Structure:
        """The structure of these fields; another one that has the name already is kept."""
        return self._called(name, lambda called: Structure(name=called, size=size, fields=fields))

    def _called(self, name: str, made: Callable[[str], _Named]) -> _Named:
        for number in range(1, len(self._found) + 2):
            called = name if number == 1 else f"{name}{number}"
            new = made(called)
            if self._found.setdefault(called, new) == new:
                return new
        raise AssertionError(name)

    def buffers(self, reflection: Reflection) -> tuple[Buffer, ...]:
        """The storage buffers that a material or a kernel reads, then those that it writes."""
        read = (self._buffer(row, row.count) for row in reflection.buffers)
        return (*read, *(self._buffer(row, "") for row in reflection.results))

    def _buffer(self, row: BufferRow | ResultRow, count: str) -> Buffer:
        type_: Numbers | Structure
        if row.members:
            fields = tuple(self._members(row.members))
            type_ = self.structure(row.layout.stored, row.stride, fields)
        else:
            type_ = numbers(changed(row.layout, stride=row.stride), row.representation)
        return Buffer(name=row.name, type=type_, stride=row.stride, count=count, doc=row.doc)

    def field(
        self, row: ParameterRow | MemberRow, word: str, offset: int, counts: str = ""
    ) -> Field:
        """The field of a parameter or of a member."""
        layout = row.layout
        counter = row.count if isinstance(row, ParameterRow) else None
        return Field(
            name=row.name, word=word, type=self._type(row), offset=offset,
            stride=layout.stride or 0, capacity=layout.count or 0, default=row.default,
            range=row.range, enumeration=self._enumeration(row),
            meaning=row.type, doc=row.doc,
            role=row.role if isinstance(row, ParameterRow) else None,
            counter=(counter or "").replace(".", "_"), counts=counts,
        )  # fmt: skip

    def _type(self, row: ParameterRow | MemberRow) -> Numbers | Structure:
        if not row.members:
            return numbers(row.layout, row.representation)
        name = row.layout.stored.partition("[")[0]
        fields = tuple(self._members(row.members))
        size = row.size if row.layout.count is None else row.layout.stride or 0
        return self.structure(name, size, fields)

    def _members(self, rows: Iterable[MemberRow]) -> Iterable[Field]:
        for each in sorted(rows, key=lambda each: each.offset):
            yield self.field(each, each.name, each.offset)

    def _enumeration(self, row: ParameterRow | MemberRow) -> Enumeration | None:
        if row.choices is None:
            return None
        members = tuple(Choice(name=each.name, doc=each.doc) for each in row.choices)
        name = row.type.partition("[")[0]
        return self._called(name, lambda called: Enumeration(name=called, members=members))


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
