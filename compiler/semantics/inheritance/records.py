"""A material, light or pass with its ancestors, as ``flattening`` makes it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeVar

from ....support.frozen import fresh, frozen, record
from ...syntax import ast
from ..names.modules import Symbol

M = TypeVar("M", bound=ast.Member)


@frozen
class Definition:
    """A definition of a name at one level of an inheritance chain."""

    member: ast.ReadMember
    owner: Symbol
    level: int
    """0 for the most derived record."""


@frozen
class Statement:
    """A member that expressions cannot read, such as a target, with where it stands."""

    member: ast.Member
    owner: Symbol
    level: int


@record
class Record:
    """A record with its ancestors."""

    symbol: Symbol
    chain: tuple[Symbol, ...]
    """Most derived first."""
    definitions: dict[str, tuple[Definition, ...]] = fresh(factory=dict)
    """The definitions of each name, most derived first.

    Names are in order of first declaration, ancestors first.
    """
    requirements: list[Definition] = fresh(factory=list)
    """The slots that mixins require of the chain behind them: with a type and no value."""
    statements: tuple[Statement, ...] = ()
    """The members of the chain that count and have no definition, as nothing reads them."""
    baseless: bool = False
    """True if a base is wrong, so that no name can be said to be missing."""

    @property
    def name(self) -> str:
        """The declared name."""
        return self.symbol.name

    @property
    def root(self) -> Symbol:
        """The ancestor without a base."""
        return self.chain[-1]

    def every(self, node: type[M]) -> Iterator[tuple[M, Symbol, int]]:
        """The statements of one kind, ancestors first: the member, its owner and the level."""
        for statement in self.statements:
            member = statement.member
            if isinstance(member, node):
                yield member, statement.owner, statement.level

    def declaration(self, name: str) -> Definition:
        """The first declaration of ``name`` (that of the furthest ancestor)."""
        return self.definitions[name][-1]

    def at(self, name: str, level: int) -> Definition:
        """The definition of ``name`` at ``level`` or further up."""
        definitions = self.definitions[name]
        nearest = definitions[0]
        return (
            nearest if nearest.level >= level else next(d for d in definitions if d.level >= level)
        )

    def above(self, name: str, level: int) -> Definition | None:
        """The nearest definition of ``name`` further up the chain than ``level``, if any."""
        return next((d for d in self.definitions.get(name, ()) if d.level > level), None)

    def typing(self, name: str) -> Definition | None:
        """The definition with the type that holds for ``name``, if any says one.

        The nearest of those that write a type, else a mixin that needs it.
        """
        for definition in self.definitions[name]:
            if definition.member.type is not None:
                return definition
        needed = (d for d in self.requirements if d.member.name.text == name)
        return next((d for d in needed if d.member.type is not None), None)


def is_abstract(member: ast.ReadMember) -> bool:
    """True if a member is a slot with a type and no value."""
    return isinstance(member, ast.Slot) and member.value is None
