"""Calls of functions that differ in their results alone: the type that is wanted decides.

A call of functions with the same arguments has a value for each of their results. Wherever a type
is written (a slot, a parameter, an argument, a result, ``as``), or is known from the other side of
a choice, the value of that type is taken. Nothing else is looked at, so a reader finds the type
next to the call; elsewhere the call is reported with the ways to write one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.fixes import either
from ...ir.node import Node
from ...syntax import ast
from ...syntax.quoting import shortened
from ..declarations.written_types import declared_type
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import Scope, Undecided, Value
from ..types.coercion import is_adaptable
from ..types.typenames import Declared
from .operands import listed

if TYPE_CHECKING:
    from collections.abc import Callable

    Apply = Callable[[Context, Symbol, tuple[Node, ...], ast.Call, Scope], Value]


def by_result(
    ctx: Context,
    found: Sequence[Symbol],
    arguments: tuple[Node, ...],
    e: ast.Call,
    scope: Scope,
    apply: Apply,
) -> Undecided | None:
    """The value of a call of one of these functions; ``None`` if their results are no reason."""
    results = []
    for symbol in found:
        function = symbol.declaration
        assert isinstance(function, ast.Function)
        if function.result is None or function.type_parameters:
            return None
        declared = declared_type(ctx, function.result, symbol.module)
        if declared is None or declared in results:
            return None
        results.append(declared)

    def value(number: int) -> Value:
        return apply(ctx, found[number], arguments, e, scope)

    report = partial(_report, ctx, found, results, arguments, e)
    return Undecided(tuple(results), value, report)


def _report(
    ctx: Context,
    found: Sequence[Symbol],
    results: Sequence[Declared],
    arguments: tuple[Node, ...],
    e: ast.Call,
) -> None:
    """Report a call of which nothing says which result is wanted."""
    names = [result.text for result in results]
    written = [f"({e.span.text} as {name})" for name in names]
    shown = " or ".join(f"`{shortened(each)}`" for each in written)
    ctx.report.add(
        rules.UNDECIDED_CALL, e.span, name=found[0].name,
        arguments=listed(ctx, arguments, e.names), results=_listed(names),
        labels=[
            Label(symbol.declaration.name.span, f"gives `{name}`")
            for symbol, name in zip(found, names, strict=True)
        ],
        hint=either(f"say which one: {shown}", e.span, *written),
    )  # fmt: skip


def _listed(names: Sequence[str]) -> str:
    *others, last = names
    return f"{', '.join(others)} or {last}"


def decided_arguments(
    ctx: Context, e: ast.Call, values: Sequence[Value], scope: Scope
) -> list[Value]:
    """The arguments of a call, of which some have the type that the called functions take."""
    callee = e.callee
    called: Sequence[Symbol] = ()
    if isinstance(callee, ast.Reference) and callee.name not in scope.locals:
        called = scope.module.find(callee.name)
    return [
        value.decided(*_types_at(ctx, e, place, called)) if isinstance(value, Undecided) else value
        for place, value in enumerate(values)
    ]


def _types_at(
    ctx: Context, e: ast.Call, place: int, called: Sequence[Symbol]
) -> Iterator[Declared]:
    """The types that functions, or structures, have for an argument of a call."""
    from .arguments import takers

    for symbol in called:
        declaration = symbol.declaration
        own: set[str] = set()
        if isinstance(declaration, ast.Function):
            formals = [(each.name.text, each.type) for each in declaration.arguments]
            own = {parameter.name.text for parameter in declaration.type_parameters}
        elif isinstance(declaration, ast.StructDeclaration):
            formals = [(each.name.text, each.type) for each in declaration.members]
        else:
            continue
        numbers = takers([name for name, _ in formals], e.names, len(e.arguments))
        if numbers is None or formals[numbers[place]][1].name.text in own:
            continue
        declared = declared_type(ctx, formals[numbers[place]][1], symbol.module)
        if declared is not None:
            yield declared


def of_choice(then: Value, otherwise: Value, chosen: Callable[[Value, Value], Value]) -> Value:
    """A choice of which a side is undecided: the other one says which type it has, or nobody.

    ``chosen`` gives the choice between sides that are decided.
    """
    sides = (then, otherwise)
    for side, other in (sides, sides[::-1]):
        if isinstance(side, Undecided) and isinstance(other, Node) and not is_adaptable(other):
            taken = side.decided(Declared(other.type, str(other.type)))
            return chosen(*((taken, other) if side is then else (other, taken)))
    first = then if isinstance(then, Undecided) else otherwise
    if not isinstance(first, Undecided):
        return chosen(then, otherwise)

    def value(number: int) -> Value:
        wanted = first.results[number]
        taken = [s.decided(wanted) if isinstance(s, Undecided) else s for s in sides]
        return chosen(taken[0], taken[1])

    return Undecided(first.results, value, first.report)
