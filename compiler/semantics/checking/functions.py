"""The common part of functions and terms: type parameters, results, and no recursion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ....support.frozen import EMPTY
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir.node import Node
from ...syntax import ast
from ...syntax.quoting import spanned
from ..declarations.contracts import as_declared
from ..declarations.written_types import declared_type, numbers_of
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import FAILURE, Failure, Instance, Scope, Value
from ..types import overloads
from ..types.generics import Use, bind, shown
from ..types.typenames import Variables, described


def may_enter(ctx: Context, symbol: Symbol, span: Span) -> bool:
    """True if a body may be evaluated; a recursive call is reported, once for each cycle."""
    if symbol in ctx.progress.recursive:
        return False
    ctx.entered.add(symbol)
    return not is_recursive(ctx, symbol, span)


def is_recursive(ctx: Context, symbol: Symbol, span: Span) -> bool:
    """True if a function is called by itself here; reported once for each cycle."""
    if symbol in ctx.progress.recursive:
        return True
    if symbol not in ctx.progress.active:
        return False
    pending = list(ctx.progress.active)
    start = pending.index(symbol)
    names = [name for name, _ in list(ctx.progress.active.values())[start:] if name]
    ctx.report.add(
        rules.RECURSIVE_FUNCTION, span, name=symbol.name,
        cycle=" → ".join([*names, symbol.name]),
    )  # fmt: skip
    ctx.progress.recursive.update(step for step in pending[start:] if isinstance(step, Symbol))
    return True


def scope_of_body(
    ctx: Context,
    symbol: Symbol,
    arguments: tuple[Node, ...],
    surface: Instance | None,
    locals_: Mapping[str, Value] = EMPTY,
) -> Scope:
    """The scope of the body of a function, for these arguments and further names."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    variables = bound(ctx, function, arguments) or {}
    names = (formal.name.text for formal in function.arguments)
    given = dict(zip(names, arguments, strict=True))
    values = {**numbers_of(ctx, variables), **locals_, **given}
    return Scope(symbol.module, surface=surface, locals=values, variables=variables)


def fit_result(
    ctx: Context, symbol: Symbol, result: Node | Failure, arguments: tuple[Node, ...]
) -> Node | Failure:
    """A body's value as the type that is written behind ``->``."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    if function.result is None:
        return result
    variables = bound(ctx, function, arguments)
    wanted = declared_type(ctx, function.result, symbol.module, variables or {})
    if wanted is None:
        return FAILURE
    return as_declared(ctx, result, wanted, function.body)


def usage(function: ast.Function) -> str:
    """A function as it is declared, up to its arguments: ``f<T: floats>(a: T, b: float)``."""
    parameters = ", ".join(f"{p.name.text}: {p.family.text}" for p in function.type_parameters)
    arguments = ", ".join(map(_formal, function.arguments))
    return f"{function.name.text}{parameters and f'<{parameters}>'}({arguments})"


def _formal(argument: ast.Argument) -> str:
    """An argument as it is declared, with its default."""
    default = "" if argument.default is None else f" = {spanned(argument.default.span)}"
    return f"{argument.name.text}: {described(argument.type)}{default}"


def used(symbol: Symbol, scope: Scope, span: Span, use: str = "called here") -> Label:
    """A label for a message about a function's body: the place where it is used."""
    return Label(span, f"in `{shown(symbol.name, scope.variables)}`, {use}")


def bound(
    ctx: Context,
    function: ast.Function,
    arguments: tuple[Node, ...],
    formals: Sequence[ast.Argument] | None = None,
) -> Variables | None:
    """The value of each type parameter, given the arguments; ``None`` if there is none.

    ``formals`` are what the arguments are for, if they are not for all in order.
    """
    if not function.type_parameters:
        return {}
    uses = [Use(overloads.operand(node), ctx.meanings.of(node)) for node in arguments]
    return bind(function, function.arguments if formals is None else formals, uses)
