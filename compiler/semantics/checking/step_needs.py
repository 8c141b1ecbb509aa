"""Finds the slots of a frame that are steps, and which of them each one needs.

``frames`` asks before it evaluates anything, so that every step is checked behind those that it
needs, however long a chain they form.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ....support.frozen import EMPTY, fresh, frozen, record
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.source import Span
from ...syntax import ast
from ..inheritance.records import Definition, Record
from ..names.modules import Module, Symbol
from ..state.scope import OUTERMOST

PREVIOUS = "previous"
"""The name of ``previous(x)``: the content of an image at the end of the last frame."""

SCREEN = "screen"
"""The argument of a pass that draws one triangle over everything."""

VIEWPORT, SCISSOR, BLEND_CONSTANT = OF_STEPS = "viewport", "scissor", "blend_constant"
"""The settings of a step as a whole, and of no pass.

Any pass may be drawn into a part of something.
"""

STEPS = ("pass", "kernel")
"""Kinds of records that a frame applies."""

Key = tuple[str, int]
"""A slot as it is defined at a level of the chain, or further up."""


def applied(e: ast.Expression, module: Module) -> Symbol | None:
    """The pass or kernel that a call applies, if it is one."""
    if not isinstance(e, ast.Call) or not isinstance(e.callee, ast.Reference):
        return None
    found = module.find(e.callee.name)
    declaration = found[0].declaration if found else None
    is_step = isinstance(declaration, ast.Record) and declaration.kind in STEPS
    return found[0] if is_step else None


def is_drawn(e: ast.Expression, record: Record) -> bool:
    """True if an expression says what a pass of a frame draws, which has no value."""
    if not isinstance(e, ast.Reference) or not is_frame(record) or e.name in record.definitions:
        return False
    models = (member.name.text for member, _, _ in record.every(ast.Models))
    return e.name == SCREEN or e.name in models


def is_frame(record: Record) -> bool:
    """True if the steps of a record are those of a frame."""
    declaration = record.symbol.declaration
    return isinstance(declaration, ast.Record) and declaration.kind == "frame"


def is_previous(e: object) -> bool:
    """True if an expression is ``previous(…)``."""
    callee = e.callee if isinstance(e, ast.Call) else None
    return isinstance(callee, ast.Reference) and callee.name == PREVIOUS


def is_brought(record: Record, name: str) -> bool:
    """True if a slot is a step that a light brings to frames, of which nobody else knows."""
    declaration = record.symbol.declaration
    assert isinstance(declaration, ast.Record | ast.Mixin)
    return declaration.kind == "light" and Dependencies(record, Report()).is_step((name, OUTERMOST))


@frozen
class Need:
    """A slot that an expression needs."""

    key: Key
    span: Span
    before: bool
    """True if it has to be there before; otherwise it is the result of the last frame."""


@record
class Dependencies:
    """The steps of a frame, found in its text."""

    record: Record
    report: Report
    overrides: Mapping[str, Definition] = EMPTY
    """Definitions from outside: for a light, those of its rig."""
    known: dict[Key, bool] = fresh(factory=dict)
    """Slots that have been asked for, and whether they are steps."""

    def definition(self, key: Key) -> Definition | None:
        """The frame's definition of a slot at a level or further up."""
        name, level = key
        if level == OUTERMOST and name in self.overrides:
            return self.overrides[name]
        found = (d for d in self.record.definitions.get(name, ()) if d.level >= level)
        return next(found, None)

    def is_step(self, key: Key) -> bool:
        """True if a slot is a step, or a result of one, and no number."""
        pending = [key]
        while pending:
            top = pending[-1]
            if top in self.known:
                pending.pop()
                continue
            leads = self._leads(top)
            if isinstance(leads, bool):
                self.known[top] = leads
            elif leads in self.known or leads in pending:
                self.known[top] = self.known.get(leads, False)
            else:
                pending.append(leads)
        return self.known[key]

    def _leads(self, key: Key) -> bool | Key:
        """True or false for a slot that is a step or not; or another slot that decides it."""
        definition = self.definition(key)
        member = None if definition is None else definition.member
        if definition is None or not isinstance(member, ast.Slot) or member.value is None:
            return False
        return self._kind(member.value, definition)

    def _kind(self, e: ast.Expression, definition: Definition) -> bool | Key:
        while True:
            if applied(e, definition.owner.module) is not None or is_previous(e):
                return True
            match e:
                case ast.With(operand=operand):
                    e = operand
                case ast.Field(operand=ast.Reference(name="inherited"), name=name):
                    return name.text, definition.level + 1
                case ast.Field(operand=operand):
                    e = operand
                case ast.FoldOver():
                    return True
                case ast.Fold(operator="each"):
                    return True
                case ast.Iterate(body=body) | ast.Conditional(then=body):
                    e = body
                case ast.Reference(name=name):
                    return name, OUTERMOST
                case _:
                    return False

    def needs(self, written: ast.Expression, level: int) -> Iterator[Need]:
        """The slots that an expression names which are steps; ``level`` is where it is written."""
        waiting: list[tuple[object, bool, frozenset[str]]] = [(written, True, frozenset())]
        while waiting:
            part, before, bound = waiting.pop()
            key = _named(part, level, bound)
            if key is not None:
                assert isinstance(part, ast.Reference | ast.Field)
                if self.is_step(key):
                    yield Need(key, part.span, before)
            else:
                bound |= _binds(part)
                if isinstance(part, ast.Call) and is_previous(part):
                    last, *initial = part.arguments or ((),)
                    waiting += [(last, False, bound), (tuple(initial), before, bound)]
                    continue
                if isinstance(part, ast.FoldOver):
                    # `rig`, `cube` and `mips(n)` are words there, whatever else is called so.
                    waiting.append((part.body, before, bound))
                    continue
                waiting += [(each, before, bound) for each in ast.parts(part)]

    def ordered(self, roots: Sequence[Need]) -> list[Key]:
        """The steps that some needs lead to, each behind those it needs itself; reports cycles."""
        done: dict[Key, None] = {}
        path: dict[Key, Span] = {}
        waiting: list[tuple[Need, bool]] = [(root, False) for root in reversed(roots)]
        later: list[Need] = []
        while waiting or later:
            if not waiting:
                waiting.append((later.pop(0), False))
            need, is_left = waiting.pop()
            if is_left:
                del path[need.key]
                done[need.key] = None
                continue
            if need.key in done:
                continue
            if need.key in path:
                self._report_cycle(need, path)
                continue
            path[need.key] = need.span
            waiting.append((need, True))
            inner = list(self._of(need.key))
            later += [each for each in inner if not each.before]
            waiting += [(each, False) for each in reversed(inner) if each.before]
        return list(done)

    def _of(self, key: Key) -> Iterator[Need]:
        definition = self.definition(key)
        assert definition is not None
        member = definition.member
        if isinstance(member, ast.Slot) and member.value is not None:
            yield from self.needs(member.value, definition.level)

    def _report_cycle(self, need: Need, path: dict[Key, Span]) -> None:
        names = [name for name, _ in path]
        start = list(path).index(need.key)
        spans = list(path.values())[start + 1 :]
        labels = [
            Label(span, f"`{name}` is needed here")
            for name, span in zip(names[start + 1 :], spans, strict=True)
        ]
        self.report.add(
            rules.FRAME_CYCLE, need.span, name=need.key[0],
            cycle=" → ".join([*names[start:], need.key[0]]), labels=labels[:8],
        )  # fmt: skip


def _named(part: object, level: int, bound: frozenset[str]) -> Key | None:
    """The slot that a part of an expression names; ``bound`` are the names that loops give."""
    if isinstance(part, ast.Reference) and part.name not in bound:
        return part.name, OUTERMOST
    if isinstance(part, ast.Field) and _is_inherited(part.operand):
        return part.name.text, level + 1
    return None


def _binds(part: object) -> frozenset[str]:
    match part:
        case ast.Iterate(state=ast.Name(text=name)) | ast.FoldOver(variable=ast.Name(text=name)):
            return frozenset((name,))
        case ast.Fold(turns=ast.Turns(variable=ast.Name(text=name))):
            return frozenset((name,))
    return frozenset()


def _is_inherited(e: ast.Expression) -> bool:
    return isinstance(e, ast.Reference) and e.name == "inherited"
