"""Flattens inheritance: for each name of a material, light or pass, its definitions in order.

A record's ancestors form one chain, most derived first. ``material A : B + C + D`` is the chain
``A, D, C, B, …``: mixins stand between the derived record and its base, the last one written
nearest to the derived record. ``inherited.x`` is what the rest of the chain says.
"""

from __future__ import annotations

from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.source import Span
from ...syntax import ast
from ..names.kept_of_library import KeptOfLibrary
from ..names.modules import Module, Symbol
from ..work import Work
from .inherited import inherited_names
from .records import Definition, Record, Statement, is_abstract

MOST_BASES = 64
"""The largest number of records that one may extend, bases of bases included.

Each record of a chain is flattened by itself, so the work would grow with the square of its length.
"""


_LIBRARY: KeptOfLibrary[Record] = KeptOfLibrary(256)
"""Records of the library about which nothing was reported. Nobody changes a record later."""


class Records:
    """Flattens records; each once. Reports errors in an inheritance chain."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self.work = Work()
        """The work of all elaborations that share these records."""
        self._known: dict[Symbol, Record] = {}
        self._chains: dict[Symbol, tuple[Symbol, ...]] = {}
        self._astray: set[Symbol] = set()
        """Records whose base is wrong, which has been reported."""
        self._clashes: set[tuple[Symbol, Symbol, str]] = set()
        """Mixins that both declare a name, which has been reported."""
        self._twice: set[Span] = set()
        """The spans of mixins that are included already, which has been reported."""
        self._has_long_chain = False
        """True if a record has too many bases, which is reported for the first one only."""

    def of(self, symbol: Symbol) -> Record:
        """The record that a ``material``, ``light`` or ``pass`` declares."""
        if symbol not in self._known:
            is_own = not symbol.module.is_standard
            self._known[symbol] = self._flatten(symbol) if is_own else self._of_library(symbol)
        return self._known[symbol]

    def _of_library(self, symbol: Symbol) -> Record:
        """A record of the library, which is the same in all compiles."""
        known = _LIBRARY.find(symbol, symbol)
        if known is None:
            before = self._report.count
            known = self._flatten(symbol)
            if self._report.count == before and not known.baseless:
                _LIBRARY.keep(symbol, symbol, known)
        return known

    def chain(self, symbol: Symbol) -> tuple[Symbol, ...]:
        """A record with its mixins, its base with the mixins of that, and so on, to the root."""
        if symbol not in self._chains:
            self._chains[symbol] = self._chain(symbol)
        return self._chains[symbol]

    def alone(self, mixin: Symbol) -> Record:
        """A mixin in front of the root, which every record of its kind extends.

        Names that the mixin needs beyond that, or builds on, are declared there without a value.
        """
        declaration = mixin.declaration
        assert isinstance(declaration, ast.Mixin)
        root = root_of(mixin.module, declaration.kind)
        record = self._flattened(mixin, (mixin,) if root is None else (mixin, root))
        for name, (own, *behind) in record.definitions.items():
            if isinstance(own.member, ast.Slot) and own.member.type is not None and not behind:
                assumed = changed(own.member, value=None)
                record.definitions[name] = (own, Definition(assumed, mixin, len(record.chain)))
        return record

    def of_chain(self, chain: tuple[Symbol, ...]) -> Record:
        """The record that the last records of another one's chain are by themselves."""
        return self._flattened(chain[0], chain)

    def _flatten(self, symbol: Symbol) -> Record:
        return self._flattened(symbol, self.chain(symbol))

    def _flattened(self, symbol: Symbol, chain: tuple[Symbol, ...]) -> Record:
        record = Record(symbol, chain, baseless=not self._astray.isdisjoint(chain))
        statements: dict[object, Statement] = {}
        for level in reversed(range(len(chain))):
            owner = chain[level]
            declaration = owner.declaration
            assert isinstance(declaration, ast.Record | ast.Mixin)
            seen: dict[object, tuple[ast.Name, ast.Member]] = {}
            if isinstance(declaration, ast.Record):
                self._check_header(declaration)
            for member in declaration.members:
                if not self._in_place(declaration, member):
                    continue
                name, named = ast.only_one(member), ast.is_named(member)
                if name is not None and not self._first(name, named, member, seen):
                    continue
                if ast.is_read(member):
                    self._define(record, Definition(member, owner, level))
                else:
                    replaced = member if name is None else (type(member), name.text)
                    statements[replaced] = Statement(member, owner, level)
        record.statements = tuple(statements.values())
        return record

    def _in_place(self, declaration: ast.Record | ast.Mixin, member: ast.Member) -> bool:
        """True if a kind of member belongs into a kind of record; reported if not."""
        kind = ast.kind_of(member)
        if declaration.kind in kind.records:
            return True
        from .placing import in_place

        self._report_misplaced(
            kind, kind.word, declaration, member.span, in_place(declaration.kind, member)
        )
        if ast.is_named(member):
            self._report.unread((member.name.text,))
        return False

    def _report_misplaced(
        self,
        kind: ast.MemberKind,
        word: str,
        declaration: ast.Record | ast.Mixin,
        span: Span,
        hint: Hint = "",
    ) -> None:
        self._report.add(
            rules.MISPLACED_MEMBER, span, member=word, record=f"a {declaration.kind}",
            hint=hint or f"`{word}` belongs in {kind.places}",
        )  # fmt: skip

    def _check_header(self, declaration: ast.Record) -> None:
        target = ast.MEMBERS["target"]
        if declaration.blend is not None and declaration.kind not in target.records:
            self._report_misplaced(target, "blend", declaration, declaration.blend.span)
        if declaration.by is not None and declaration.kind != "material":
            hint = "`by` belongs in the header of a material: `material Leaf by Cutout { … }`"
            self._report_misplaced(target, "by", declaration, declaration.by.span, hint)

    def _first(
        self,
        name: ast.Name,
        named: bool,
        member: ast.Member,
        seen: dict[object, tuple[ast.Name, ast.Member]],
    ) -> bool:
        """True if a record has declared nothing of this name yet, or no member of this kind."""
        first, before = seen.setdefault((named, name.text), (name, member))
        if first is not name:
            self._report.add(
                rules.DUPLICATE_NAME, name.span, name=name.text,
                labels=[Label(first.span, "first defined here")], hint=_apart(before, member),
            )  # fmt: skip
            self._report.unread((name.text,))
        return first is name

    def _define(self, record: Record, definition: Definition) -> None:
        name = definition.member.name.text
        inherited = record.definitions.get(name, ())
        if isinstance(definition.owner.declaration, ast.Mixin) and inherited:
            if is_abstract(definition.member):
                record.requirements.append(definition)
                return
            if self._clashes_with(record, definition, inherited[-1]):
                return
        record.definitions[name] = (definition, *inherited)

    def _clashes_with(self, record: Record, later: Definition, first: Definition) -> bool:
        """Two mixins that know nothing of each other must not mean different things by a name."""
        if not isinstance(first.owner.declaration, ast.Mixin) or is_abstract(first.member):
            return False
        if _belong_together(later.member, first):
            return False
        name = later.member.name.text
        if (first.owner, later.owner, name) in self._clashes:
            return True
        self._clashes.add((first.owner, later.owner, name))
        self._report.add(
            rules.MIXINS_CLASH, later.member.name.span,
            name=name, first=first.owner.name, later=later.owner.name, record=record.name,
            labels=[Label(first.member.name.span, f"declared by `{first.owner.name}` here")],
            hint=f"rename one of them, or build on the other as `inherited.{name}`",
        )  # fmt: skip
        return True

    def _chain(self, symbol: Symbol) -> tuple[Symbol, ...]:
        used: dict[Symbol, ast.Name] = {}
        records, chain = [symbol], [symbol, *self._mixins(symbol, used)]
        while (base := self._base(records[-1])) is not None:
            if base in records or len(records) > MOST_BASES:
                if base in records:
                    self._report_cycle([*records[records.index(base) :], base])
                else:
                    self._report_long_chain(symbol)
                declaration = records[-1].declaration
                assert isinstance(declaration, ast.Record)
                root = self._implied_base(records[-1], declaration)
                return tuple(chain) if root is None else (*chain, root)
            records.append(base)
            chain += [base, *self._mixins(base, used)]
        return tuple(chain)

    def _mixins(self, symbol: Symbol, used: dict[Symbol, ast.Name]) -> list[Symbol]:
        """The mixins in a record's header, the last one first.

        ``used`` are those of the records derived from it, to which they are added, each with where
        it is written.
        """
        declaration = symbol.declaration
        assert isinstance(declaration, ast.Record)
        found: list[Symbol] = []
        for name in declaration.mixins:
            mixin = self._mixin(symbol, declaration.kind, name)
            if mixin is None:
                self._astray.add(symbol)
            elif mixin in used:
                self._report_twice(used[mixin], name)
            else:
                used[mixin] = name
                found.append(mixin)
        return found[::-1]

    def _report_twice(self, one: ast.Name, other: ast.Name) -> None:
        """Reports a double mixin once for each place, however many derived records share it."""
        first, again = one, other
        if one.span.source is other.span.source:
            first, again = sorted((one, other), key=lambda name: name.span.start)
        if again.span not in self._twice:
            self._twice.add(again.span)
            self._report.add(
                rules.MIXIN_TWICE, again.span, name=again.text,
                labels=[Label(first.span, "already included here")],
            )  # fmt: skip

    def _mixin(self, symbol: Symbol, kind: str, name: ast.Name) -> Symbol | None:
        found = symbol.module.find(name.text)
        if not found:
            self._report_unknown(symbol, "mixin", name)
            return None
        declaration = found[0].declaration
        if isinstance(declaration, ast.Mixin) and declaration.kind == kind:
            return found[0]
        if not self._follows_mixin(symbol):
            record = isinstance(declaration, ast.Record) and declaration.kind == kind
            self._report.add(
                rules.NOT_A_MIXIN, name.span, name=name.text, kind=kind,
                labels=[Label(declaration.name.span, "declared here")],
                hint=f"there is one base: declare this one as `mixin {name.text} {{ … }}`"
                if record else "",
            )  # fmt: skip
        return None

    def _follows_mixin(self, symbol: Symbol) -> bool:
        """True if a mixin stands where the base should, which is reported there."""
        declaration = symbol.declaration
        assert isinstance(declaration, ast.Record)
        base = symbol.module.find(declaration.base.text) if declaration.base is not None else ()
        return bool(base) and isinstance(base[0].declaration, ast.Mixin)

    def _report_long_chain(self, symbol: Symbol) -> None:
        self._astray.add(symbol)
        if not self._has_long_chain:
            self._has_long_chain = True
            self._report.add(
                rules.TOO_MANY_BASES, symbol.declaration.name.span, name=symbol.name,
                most=MOST_BASES,
            )  # fmt: skip

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
            self._report_unknown(symbol, kind, name)
            return None
        base = found[0].declaration
        if isinstance(base, ast.Mixin):
            self._report_mixin_as_base(symbol, kind, name, base)
            return None
        if isinstance(base, ast.Record) and base.kind == kind:
            return found[0]
        labels = [Label(base.name.span, "declared here")]
        self._report.add(rules.WRONG_BASE, name.span, kind=kind, name=name.text, labels=labels)
        return None

    def _report_unknown(self, symbol: Symbol, kind: str, name: ast.Name) -> None:
        if name.text not in symbol.module.missing:
            hint = symbol.module.hint(name, symbol.module.visible(), (kind,))
            self._report.add(rules.UNKNOWN_NAME, name.span, kind=kind, name=name.text, hint=hint)

    def _report_mixin_as_base(
        self, symbol: Symbol, kind: str, name: ast.Name, mixin: ast.Mixin
    ) -> None:
        declaration, root = symbol.declaration, root_of(symbol.module, kind)
        assert isinstance(declaration, ast.Record)
        records = (
            other.text
            for other in declaration.mixins
            if any(isinstance(s.declaration, ast.Record) for s in symbol.module.find(other.text))
        )
        base = next(records, "Base" if root is None else root.name)
        bases = f"{base} + {name.text}"
        self._report.add(
            rules.MIXIN_AS_BASE, name.span, name=name.text, kind=kind,
            labels=[Label(mixin.name.span, "declared here")],
            hint=fix_it(f"begin with a {kind}: `: {bases}`", (name.span, bases)),
        )  # fmt: skip

    def _implied_base(self, symbol: Symbol, declaration: ast.Record) -> Symbol | None:
        """Every material (light, …) extends the prelude's only abstract one of its kind."""
        root = root_of(symbol.module, declaration.kind)
        return None if root is symbol else root


def _belong_together(later: ast.ReadMember, first: Definition) -> bool:
    """True if a mixin's definition means to continue, or to share, another one's declaration."""
    if isinstance(later, ast.Slot) and later.value is not None:
        return later.name.text in inherited_names(later.value)
    # Vertex inputs are the mesh's: both mean the same.
    return isinstance(later, ast.Attribute) and isinstance(first.member, ast.Attribute)


def root_of(module: Module, kind: str) -> Symbol | None:
    """The prelude's only abstract record of a kind, which all others extend."""
    return sole(module.prelude or module, kind, abstract=True)


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


def _apart(first: ast.Member, second: ast.Member) -> str:
    """The hint for two members of one name that are of different kinds."""
    words = {ast.kind_of(first).word, ast.kind_of(second).word}
    if words == {"", "output"}:
        return (
            "an output has a name of its own, beside those of equations: call one of them otherwise"
        )
    return ""
