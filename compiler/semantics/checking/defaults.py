"""The values of arguments that a call leaves out.

A default is an expression in the scope of the declaration: it sees what the body of the function
sees, but of the arguments only those before its own. ``applications`` asks for it where a call
leaves an argument out, and ``trials`` for all defaults of a function, with placeholders. It is
computed once for what it reads.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache, partial

from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir.node import Node
from ...syntax import ast
from ..declarations.contracts import as_declared
from ..declarations.written_types import declared_type, numbers_of
from ..names.modules import Symbol
from ..state.context import Context
from ..state.evaluation import Demand, plain, settle
from ..state.scope import FAILURE, DefaultKey, Failure, Instance, Scope, Value
from ..types.coercion import coerce
from ..types.typenames import Variables
from .functions import is_recursive, used


def completed(
    ctx: Context,
    symbol: Symbol,
    given: Mapping[str, Node],
    variables: Variables,
    surface: Instance | None,
    span: Span,
) -> tuple[Node, ...] | None:
    """All arguments of a call at ``span`` that gives some; ``None`` if the others have no value."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    if function.kind == "term" and surface is None:
        ctx.report.add(rules.TERM_WITHOUT_SURFACE, span, name=symbol.name)
        return None
    values: dict[str, Node] = {}
    for formal in function.arguments:
        value: Node | Failure | None = given.get(formal.name.text)
        if value is None:
            value = default_of(ctx, symbol, formal, values, variables, surface, span)
        if isinstance(value, Failure):
            ctx.entered.add(symbol)  # What is wrong with it has been reported.
            return None
        values[formal.name.text] = value
    return tuple(values.values())


def default_of(
    ctx: Context,
    symbol: Symbol,
    formal: ast.Argument,
    earlier: Mapping[str, Node],
    variables: Variables,
    surface: Instance | None,
    span: Span,
) -> Node | Failure:
    """The value of a default for a call at ``span``, where ``earlier`` arguments have values."""
    function = symbol.declaration
    assert isinstance(function, ast.Function) and formal.default is not None
    named = _named_in(formal.default)
    read = tuple(value.id for name, value in earlier.items() if name in named)
    key: DefaultKey = (formal, read, tuple(variables.items()), surface)
    if key not in ctx.defaults:
        if is_recursive(ctx, symbol, span):
            return FAILURE
        later = {each.name.text: FAILURE for each in function.arguments}
        if function.per is not None:
            later[function.per.text] = FAILURE  # Arguments are the same for all lights.
        locals_: Mapping[str, Value] = {**numbers_of(ctx, variables), **later, **earlier}
        scope = Scope(symbol.module, surface=surface, locals=locals_, variables=variables)
        finish = partial(_finish, ctx, key, symbol, scope, ctx.report.count, span)
        settle(ctx, Demand(symbol, symbol.name, span, formal.default, scope, finish))
    return ctx.defaults[key]


def _finish(
    ctx: Context,
    key: DefaultKey,
    symbol: Symbol,
    scope: Scope,
    before: int,
    span: Span,
    value: Value,
) -> None:
    """Keep a default as a value of the declared type."""
    formal, *_ = key
    assert formal.default is not None
    wanted = declared_type(ctx, formal.type, symbol.module, scope.variables)
    result = plain(ctx, value, formal.default, wanted)
    if isinstance(result, Failure) and ctx.report.count == before:
        _report_later(ctx, formal, scope)
    if wanted is None or isinstance(result, Failure):
        ctx.defaults[key] = FAILURE
        return
    wanted = changed(wanted, text=f"{wanted.text} for `{formal.name.text}`")
    generic = formal.type.name.text in scope.variables
    result = coerce(ctx.tree, result, wanted.type, broadcast=generic) or result
    ctx.defaults[key] = as_declared(ctx, result, wanted, formal.default, scope)
    if scope.variables:
        ctx.report.explain(before, used(symbol, scope, span))


def _report_later(ctx: Context, formal: ast.Argument, scope: Scope) -> None:
    """Report that a default reads its own argument, or one behind it."""
    assert formal.default is not None
    waiting: list[object] = [formal.default]
    while waiting:
        part = waiting.pop()
        if isinstance(part, ast.Reference) and isinstance(scope.locals.get(part.name), Failure):
            ctx.report.add(
                rules.LATER_ARGUMENT, part.span, argument=formal.name.text, name=part.name
            )
            return
        waiting.extend(reversed(ast.parts(part)))


@lru_cache(maxsize=1024)
def _named_in(default: ast.Expression) -> frozenset[str]:
    """The names that stand in a default as values or are called."""
    found: set[str] = set()
    waiting: list[object] = [default]
    while waiting:
        part = waiting.pop()
        waiting.extend(ast.parts(part))
        if isinstance(part, ast.Reference):
            found.add(part.name)
    return frozenset(found)
