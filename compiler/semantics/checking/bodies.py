"""Bodies of functions, and the equations behind their ``where``."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ....support.frozen import changed
from ...diagnostics.source import Span
from ...ir.node import Node
from ...syntax import ast
from ..declarations.contracts import as_declared
from ..declarations.written_types import declared_type
from ..names.modules import Symbol
from ..state.context import Context
from ..state.evaluation import Demand, plain, settle
from ..state.scope import FAILURE, Failure, FunctionParts, Scope, Value
from .cycles import is_cycle


def settle_body(
    ctx: Context,
    symbol: Symbol,
    span: Span,
    scope: Scope,
    finish: Callable[[Node | Failure], None],
) -> None:
    """Evaluate a function's body, where ``scope`` has the arguments.

    Parts that it does not read are evaluated too, so that their mistakes are found; but not those
    of the library, which may belong to a side of a choice that is never taken (``choices``).
    """
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    first = len(ctx.tree)
    parts = FunctionParts({part.name.text: part for part in function.parts}, scope)
    if function.parts:
        scope = parts.scope = changed(scope, parts=parts)

    def keep(value: Value) -> None:
        if not symbol.module.is_standard:
            for part in function.parts:
                part_value(ctx, parts, part.name.text, part.name.span)
        wanted = None
        if function.result is not None:
            wanted = declared_type(ctx, function.result, symbol.module, scope.variables)
        result = plain(ctx, value, function.body, wanted)
        if isinstance(result, Node):
            values = [part for part in parts.values.values() if isinstance(part, Node)]
            ctx.deferred.unread(result, values, first)
        finish(result)

    settle(ctx, Demand(symbol, symbol.name, span, function.body, scope, keep))


def part_value(ctx: Context, parts: FunctionParts, name: str, span: Span) -> Node | Failure:
    """The value of an equation behind ``where``."""
    key = (parts, name)
    if name not in parts.values:
        if is_cycle(ctx, key, name, span):
            return FAILURE
        written, finish = parts.declared[name], partial(_finish_part, ctx, parts, name)
        assert written.value is not None
        settle(ctx, Demand(key, name, span, written.value, parts.scope, finish))
    return parts.values[name]


def _finish_part(ctx: Context, parts: FunctionParts, name: str, value: Value) -> None:
    written, scope = parts.declared[name], parts.scope
    assert written.value is not None
    wanted = None
    if written.type is not None:
        wanted = declared_type(ctx, written.type, scope.module, scope.variables)
    result = plain(ctx, value, written.value, wanted)
    if written.type is not None:
        result = (
            FAILURE if wanted is None else as_declared(ctx, result, wanted, written.value, scope)
        )
    parts.values[name] = result
    if isinstance(result, Node) and (result.operands or result.op == "formal"):
        # An argument may be a variable here that stands for what calls compute (``signatures``).
        ctx.notes.names.setdefault(result.id, name)
        if written.doc:
            ctx.notes.docs.setdefault(result.id, written.doc)
