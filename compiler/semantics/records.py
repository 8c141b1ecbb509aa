"""Inheritance: a material, light or pass as the list of what each of its names is defined to be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ...frozen import frozen
from ..diagnostics import rules
from ..diagnostics.diagnostic import Label, Report
from ..syntax import ast
from .modules import Module, Symbol

_WORDS: Mapping[type, str] = {
    ast.Param: "param",
    ast.Map: "map",
    ast.Attribute: "attribute",
    ast.Slot: "an equation",
    ast.Target: "target",
    ast.Discard: "discard",
}
_MISPLACED: Mapping[str, frozenset[str]] = {
    "material": frozenset({"target", "discard"}),
    "light": frozenset({"target", "discard", "attribute"}),
    "pass": frozenset(),
}
"""What a kind of record cannot have: targets and what is not drawn are a pass's to say."""

NamedMember = ast.Param | ast.Map | ast.Attribute | ast.Slot


@frozen
class Definition:
    """What a name is defined to be at one level of an inheritance chain."""

    member: NamedMember
    owner: Symbol
    level: int
    """0 for the most derived record."""


@dataclass(slots=True, eq=False)
class Record:
    """A record with its ancestors."""

    symbol: Symbol
    chain: tuple[Symbol, ...]
    """Most derived first."""
    definitions: dict[str, tuple[Definition, ...]] = field(default_factory=dict)
    """Of each name, most derived first; names in order of first declaration, ancestors first."""
    targets: tuple[tuple[ast.Target, Symbol, int], ...] = ()
    """Of a pass: its targets, each with its record and level."""
    discards: tuple[tuple[ast.Discard, Symbol, int], ...] = ()
    baseless: bool = False
    """Whether a base is wrong, so that no name can be said to be missing."""

    @property
    def name(self) -> str:
        """The declared name."""
        return self.symbol.name

    @property
    def root(self) -> Symbol:
        """The ancestor without a base."""
        return self.chain[-1]

    def declaration(self, name: str) -> Definition:
        """Where ``name`` was first declared (the furthest ancestor)."""
        return self.definitions[name][-1]

    def typed(self, name: str) -> ast.TypeName | None:
        """The type that the nearest declaring level wrote for ``name``."""
        for definition in self.definitions[name]:
            if definition.member.type is not None:
                return definition.member.type
        return None


class Records:
    """Flattens records; each once. Reports what is wrong with an inheritance chain."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._known: dict[Symbol, Record] = {}
        self._astray: set[Symbol] = set()
        """Records whose base is wrong, which has been reported."""

    def of(self, symbol: Symbol) -> Record:
        """The record that a ``material``, ``light`` or ``pass`` declares."""
        if symbol not in self._known:
            self._known[symbol] = self._flatten(symbol)
        return self._known[symbol]

    def _flatten(self, symbol: Symbol) -> Record:
        chain = self._chain(symbol)
        record = Record(symbol, chain, baseless=not self._astray.isdisjoint(chain))
        targets: dict[str, tuple[ast.Target, Symbol, int]] = {}
        for level in reversed(range(len(chain))):
            owner = chain[level]
            declaration = owner.declaration
            assert isinstance(declaration, ast.Record)
            seen: dict[str, ast.Name] = {}
            self._check_blend(declaration)
            for member in declaration.members:
                if not self._in_place(declaration, member):
                    continue
                if isinstance(member, ast.Discard):
                    record.discards += ((member, owner, level),)
                elif self._first(member.name, seen):
                    if isinstance(member, ast.Target):
                        targets[member.name.text] = (member, owner, level)
                    else:
                        self._define(record, Definition(member, owner, level))
        record.targets = tuple(targets.values())
        return record

    def _in_place(self, declaration: ast.Record, member: ast.Member) -> bool:
        """Whether a kind of member belongs into a kind of record."""
        word = _WORDS[type(member)]
        if word not in _MISPLACED[declaration.kind]:
            return True
        self._report.add(
            rules.MISPLACED_MEMBER, member.span, member=word, record=f"a {declaration.kind}"
        )
        return False

    def _check_blend(self, declaration: ast.Record) -> None:
        if declaration.blend is not None and declaration.kind != "pass":
            self._report.add(
                rules.MISPLACED_MEMBER, declaration.blend.span,
                member="blend", record=f"a {declaration.kind}",
            )  # fmt: skip

    def _first(self, name: ast.Name, seen: dict[str, ast.Name]) -> bool:
        if name.text in seen:
            self._report.add(
                rules.DUPLICATE_NAME, name.span, name=name.text,
                labels=[Label(seen[name.text].span, "first defined here")],
            )  # fmt: skip
            return False
        seen[name.text] = name
        return True

    def _define(self, record: Record, definition: Definition) -> None:
        name = definition.member.name.text
        inherited = record.definitions.get(name, ())
        record.definitions[name] = (definition, *inherited)

    def _chain(self, symbol: Symbol) -> tuple[Symbol, ...]:
        chain = [symbol]
        while (base := self._base(chain[-1])) is not None:
            if base in chain:
                declaration = chain[-1].declaration
                self._report_cycle([*chain[chain.index(base) :], base])
                assert isinstance(declaration, ast.Record)
                root = self._implied_base(chain[-1], declaration)
                return tuple(chain) if root is None else (*chain, root)
            chain.append(base)
        return tuple(chain)

    def _report_cycle(self, steps: list[Symbol]) -> None:
        """Each cycle once, from wherever it was entered."""
        if self._astray.isdisjoint(steps):
            *_, last, base = steps
            cycle = " : ".join(step.name for step in steps)
            place = last.declaration.name.span
            self._report.add(rules.CYCLIC_INHERITANCE, place, name=base.name, cycle=cycle)
        self._astray.update(steps)

    def _base(self, symbol: Symbol) -> Symbol | None:
        declaration = symbol.declaration
        assert isinstance(declaration, ast.Record)
        if declaration.base is None:
            return self._implied_base(symbol, declaration)
        base = self._written_base(symbol, declaration.kind, declaration.base)
        if base is None:
            self._astray.add(symbol)
            return self._implied_base(symbol, declaration)
        return base

    def _written_base(self, symbol: Symbol, kind: str, name: ast.Name) -> Symbol | None:
        found = symbol.module.find(name.text)
        if not found:
            if name.text not in symbol.module.missing:
                hint = symbol.module.hint(name.text, symbol.module.visible())
                self._report.add(
                    rules.UNKNOWN_NAME, name.span, kind=kind, name=name.text, hint=hint
                )
            return None
        base = found[0].declaration
        if isinstance(base, ast.Record) and base.kind == kind:
            return found[0]
        labels = [Label(base.name.span, "declared here")]
        self._report.add(rules.WRONG_BASE, name.span, kind=kind, name=name.text, labels=labels)
        return None

    def _implied_base(self, symbol: Symbol, declaration: ast.Record) -> Symbol | None:
        """Every material (light, …) extends the prelude's only abstract one of its kind."""
        root = sole(symbol.module.prelude or symbol.module, declaration.kind, abstract=True)
        return None if root is symbol else root


def records_of(module: Module, kind: str, *, abstract: bool) -> list[Symbol]:
    """The records of one kind that a module declares, in order."""
    return [
        symbols[0]
        for symbols in module.declared.values()
        if isinstance(declared := symbols[0].declaration, ast.Record)
        and declared.kind == kind
        and declared.abstract == abstract
    ]


def sole(module: Module, kind: str, *, abstract: bool) -> Symbol | None:
    """The only such record of a module, if there is exactly one."""
    found = records_of(module, kind, abstract=abstract)
    return found[0] if len(found) == 1 else None
