"""Tells whether a constant is written where it stands, or is given from elsewhere.

``x / 0`` is a mistake, so the checks of divisors and of indices make it an error. A constant 0 that
comes to ``x / b`` as an argument, or in a slot that another record sets, is none: ``x / b`` has a
value for every ``b``, and whoever wrote it may count on that. Such a constant is worth a warning.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ...diagnostics import rules
from ...diagnostics.diagnostic import Diagnostic, Label, Rule
from ...diagnostics.fixes import Hint
from ...ir.node import Node
from ...syntax import ast
from ..inheritance.records import Definition
from ..state.context import Context
from ..state.scope import Instance, Scope
from . import lookup

_OF_GIVEN = {
    rules.ZERO_DIVISOR: rules.ZERO_DIVISOR_GIVEN,
    rules.OUT_OF_BOUNDS: rules.OUT_OF_BOUNDS_GIVEN,
}
"""The warning in the place of each error, where a value is given from elsewhere."""


def finding(
    ctx: Context,
    rule: Rule,
    e: ast.Expression,
    scope: Scope,
    hint: Hint = "",
    **arguments: Any,
) -> Diagnostic | None:
    """A finding about the constant value of ``e``: a warning, if the value is given from elsewhere.

    Its labels show what other records set. ``Deferred.explain`` names the calls.
    """
    given = list(_given(e, scope))
    if given:
        rule, hint = _OF_GIVEN[rule], ""
    labels = dict.fromkeys(label for label in given if label is not None)
    return ctx.report.finding(rule, e.span, labels=labels, hint=hint, **arguments)


def _given(e: ast.Expression, scope: Scope) -> Iterator[Label | None]:
    """The parts of a value that are given: where, if a slot is; ``None`` for arguments and calls.

    Equations of the same record and of the same ``where`` are looked into.
    """
    pending: list[object] = [e]
    seen: set[str] = set()
    while pending:
        part = pending.pop()
        pending += ast.parts(part)
        match part:
            case ast.Call(callee=ast.Reference(name=name)) if _is_function(name, scope):
                yield None
            case ast.Field(operand=ast.Reference(name=name)):
                yield from _member(name, part.name.text, scope)
            case ast.Reference(name=name) if name not in seen:
                seen.add(name)
                yield from _name(name, scope, pending)


def _is_function(name: str, scope: Scope) -> bool:
    return any(isinstance(s.declaration, ast.Function) for s in scope.module.known(name))


def _member(owner: str, name: str, scope: Scope) -> Iterator[Label | None]:
    """What is given by ``material.name``, ``inherited.name`` and the like."""
    known = scope.locals.get(owner)
    if isinstance(known, Instance):
        yield from _slot(known, name, scope, [])
    elif owner == "inherited" and scope.instance is not None:
        above = scope.instance.record.above(name, scope.level)
        yield None if above is None else _label(above)


def _name(name: str, scope: Scope, pending: list[object]) -> Iterator[Label | None]:
    """What is given by a bare name; an equation of the same declaration is left to look into."""
    if name in scope.locals:
        if isinstance(scope.locals[name], Node):
            yield None
    elif scope.parts is not None and name in scope.parts.declared:
        pending.append(scope.parts.declared[name].value)
    elif (instance := lookup.instance_of(name, scope)) is not None:
        yield from _slot(instance, name, scope, pending)


def _slot(
    instance: Instance, name: str, scope: Scope, pending: list[object]
) -> Iterator[Label | None]:
    """What is given by a slot, unless the record that is being checked defines it itself."""
    replacement = instance.replaced.get(name)
    definitions = instance.record.definitions.get(name)
    if replacement is not None:
        yield None if replacement.definition is None else _label(replacement.definition)
    elif definitions and (instance, definitions[0].level) == (scope.instance, scope.level):
        member = definitions[0].member
        pending.append(member.value if isinstance(member, ast.Slot) else None)
    elif definitions:
        yield _label(definitions[0])


def _label(definition: Definition) -> Label:
    name = definition.member.name
    return Label(name.span, f"`{name.text}` is set here")
