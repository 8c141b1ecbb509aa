"""Functions and terms applied to arguments: overload resolution, coercion, and results."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING

from ....support.frozen import changed, frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.fixes import fix_it
from ...diagnostics.source import Span
from ...ir.node import Formals, Node
from ...syntax import ast
from ...syntax.quoting import spanned
from ..declarations.contracts import as_declared, change
from ..declarations.written_types import declared_type
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import FAILURE, Application, Failure, Instance, Scope, Value
from ..types.coercion import coerce
from ..types.generics import of_unknown_family, uninferable
from ..types.typenames import Declared
from . import lights
from .bodies import settle_body
from .call_marks import Callee, marked
from .candidates import best
from .functions import bound, fit_result, may_enter, scope_of_body, usage, used
from .operands import listed
from .signatures import SharedCall, applied, failed, shared_call, stand_ins

if TYPE_CHECKING:
    from .arguments import Head


def apply_best(
    ctx: Context,
    overloaded: list[Symbol],
    arguments: tuple[Node, ...],
    e: ast.Call,
    scope: Scope,
) -> Value:
    """The value of a call of whichever of these functions takes the arguments best."""
    found = overloaded if len(overloaded) == 1 else best(ctx, overloaded, arguments, e.names)
    if len(found) == 1:
        return apply(ctx, found[0], arguments, e, scope)
    if len(found) > 1:
        from .wanted import by_result

        undecided = by_result(ctx, found, arguments, e, scope, apply)
        if undecided is not None:
            return undecided
    labels = [Label(s.declaration.name.span, "a candidate") for s in found or overloaded]
    if not found and (name := _unknown_to_all(overloaded, e)) is not None:
        from .arguments import unknown_argument

        heads = [_head_of(s) for s in overloaded]
        known = chain.from_iterable(head.parameters for head in heads)
        usages = [head.usage for head in heads]
        unknown_argument(ctx, name, overloaded[0].name, known, usages, labels)
        return FAILURE
    ctx.report.add(
        rules.AMBIGUOUS_CALL if found else rules.NO_OVERLOAD, e.span,
        name=overloaded[0].name, arguments=listed(ctx, arguments, e.names), labels=labels,
    )  # fmt: skip
    return FAILURE


def _unknown_to_all(overloaded: Sequence[Symbol], e: ast.Call) -> ast.Name | None:
    """The first name of an argument that none of several functions has."""
    heads = [_head_of(symbol) for symbol in overloaded] if e.names else []
    for name in e.names:
        if name is not None and all(name.text not in head.parameters for head in heads):
            return name
    return None


def apply(
    ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], e: ast.Call, scope: Scope
) -> Value:
    """The value of a call of this function."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    fitted = _fit_arguments(ctx, symbol, arguments, e, scope)
    if fitted is None:
        return FAILURE
    if function.per is not None:
        return lights.per_light(ctx, symbol, fitted, e.span, scope)
    surface = scope.surface if function.kind == "term" else None
    if function.kind == "term" and surface is None:
        ctx.report.add(rules.TERM_WITHOUT_SURFACE, e.span, name=symbol.name)
        return FAILURE
    return apply_body(ctx, symbol, fitted, e.span, surface)


def _fit_arguments(
    ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], e: ast.Call, scope: Scope
) -> tuple[Node, ...] | None:
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    written: Sequence[ast.Argument] | None = function.arguments
    if e.names or len(arguments) != len(function.arguments):
        written = _taken(ctx, symbol, e)
    if written is None:
        return None
    variables = bound(ctx, function, arguments, written)
    if variables is None and (uninferable(function) or of_unknown_family(function)):
        return None  # The declaration's mistake has been reported.
    if variables is None:
        ctx.report.add(
            rules.NO_OVERLOAD, e.span, name=symbol.name, arguments=listed(ctx, arguments, e.names),
            labels=[Label(function.name.span, "declared here")], hint=f"it is `{usage(function)}`",
        )  # fmt: skip
        return None
    formals: list[_Formal] = []
    for formal in written:
        wanted = declared_type(ctx, formal.type, symbol.module, variables)
        if wanted is None:
            return None
        wanted = changed(wanted, text=f"{wanted.text} for `{formal.name.text}`")
        formals.append(_Formal(wanted, formal.type.name.text in variables))
    fitted = []
    for index, (formal_, argument) in enumerate(zip(formals, arguments, strict=True)):
        found = ctx.report.count
        node = _fit_argument(ctx, formal_, argument, e.arguments[index], scope)
        if isinstance(node, Failure):
            if not e.names:
                _tell_of_order(ctx, function, formals, arguments, e, index, found)
            return None
        fitted.append(node)
    if written is function.arguments:
        return tuple(fitted)
    from .defaults import completed

    given = {formal.name.text: node for formal, node in zip(written, fitted, strict=True)}
    surface = scope.surface if function.kind == "term" else None
    return completed(ctx, symbol, given, variables, surface, e.span)


def _taken(ctx: Context, symbol: Symbol, e: ast.Call) -> list[ast.Argument] | None:
    """The declared argument for each one of a call; ``None`` if they do not fit together."""
    from .arguments import placed

    function = symbol.declaration
    assert isinstance(function, ast.Function)
    numbers = placed(ctx, e, _head_of(symbol))
    return None if numbers is None else [function.arguments[number] for number in numbers]


def _head_of(symbol: Symbol) -> Head:
    """A function as it is called."""
    from .arguments import Head

    function = symbol.declaration
    assert isinstance(function, ast.Function)
    names = tuple([argument.name.text for argument in function.arguments])
    optional = (a.name.text for a in function.arguments if a.default is not None)
    label = Label(function.name.span, "declared here")
    return Head(symbol.name, names, frozenset(optional), usage(function), (label,))


@frozen
class _Formal:
    """An argument as a function declares it."""

    declared: Declared
    generic: bool
    """True if its type is a type parameter, so that one number may stand for a vector."""


def _fit_argument(
    ctx: Context, formal: _Formal, argument: Node, written: ast.Expression, scope: Scope
) -> Node | Failure:
    broadcast = coerce(ctx.tree, argument, formal.declared.type, broadcast=formal.generic)
    return as_declared(ctx, broadcast or argument, formal.declared, written, scope)


def _tell_of_order(
    ctx: Context,
    function: ast.Function,
    formals: Sequence[_Formal],
    arguments: Sequence[Node],
    e: ast.Call,
    wrong: int,
    found: int,
) -> None:
    """Tell of two arguments that fit if they change places, in place of what is ``wrong`` with one.

    ``found`` is the number of findings before that was reported.
    """

    def takes(place: int, index: int) -> bool:
        formal = formals[place]
        return change(ctx, arguments[index], formal.declared, broadcast=formal.generic) is not None

    others = (i for i in range(len(formals)) if i != wrong and takes(wrong, i) and takes(i, wrong))
    other = next(others, None)
    if other is None or ctx.report.count == found:
        return
    ctx.report.forget(found)
    one, two = (e.arguments[index].span for index in (wrong, other))
    swapped = {wrong: spanned(two), other: spanned(one)}
    listed_so = ", ".join(swapped.get(i, spanned(a.span)) for i, a in enumerate(e.arguments))
    ctx.report.add(
        rules.WRONG_TYPE, one, expected=formals[wrong].declared.text, found=arguments[wrong].type,
        caption=f"this is `{arguments[wrong].type}`",
        labels=[Label(function.name.span, "declared here")],
        hint=fix_it(
            f"did you mean `{function.name.text}({listed_so})`? It is `{usage(function)}`",
            (one, two.text), (two, one.text),
        ),
    )  # fmt: skip


def apply_body(
    ctx: Context,
    symbol: Symbol,
    arguments: tuple[Node, ...],
    span: Span,
    surface: Instance | None = None,
    use: str = "called here",
) -> Node | Failure:
    """A function's value for fitted arguments; the same call is checked once.

    ``use`` is the text of messages about ``span``, if an error in the body may be due to the types
    or the constants that it was called with.
    """
    key: Application = (symbol, tuple(argument.id for argument in arguments), surface)
    if key not in ctx.applied:
        if not may_enter(ctx, symbol, span):
            return FAILURE
        call = shared_call(ctx, symbol, arguments, surface)
        value = None if call is None else applied(ctx, call, span)
        if value is not None:
            repeated = call is not None and call.signature.repeated
            ctx.applied[key] = _marked(ctx, key, arguments, value) if repeated else value
            return ctx.applied[key]
        scope = scope_of_body(ctx, symbol, arguments, surface)
        in_use = used(symbol, scope, span, use)
        before = ctx.report.count, len(ctx.deferred)
        finish = partial(_finish, ctx, key, call, arguments, scope, before, in_use)
        settle_body(ctx, symbol, span, scope, finish)
    return ctx.applied[key]


def _finish(
    ctx: Context,
    key: Application,
    call: SharedCall | None,
    arguments: tuple[Node, ...],
    scope: Scope,
    before: tuple[int, int],
    in_use: Label,
    result: Node | Failure,
) -> None:
    """Keep the value of a body that was checked for this call alone."""
    symbol, *_ = key
    result = fit_result(ctx, symbol, result, arguments)
    if call is not None and isinstance(result, Failure):
        failed(ctx, call.signature, before[0])
    if scope.variables:
        ctx.report.explain(before[0], in_use)
    if scope.variables or any(map(ctx.constants.is_known, arguments)):
        ctx.deferred.explain(before[1], in_use)
    ctx.applied[key] = _marked(ctx, key, arguments, result)


def _marked(
    ctx: Context, key: Application, arguments: tuple[Node, ...], value: Node | Failure
) -> Node | Failure:
    """A body's value as that of a call, which ``outlining`` may have share a body with others."""
    symbol, _, surface = key
    if symbol.module.is_standard:
        ctx.deferred.left_out(arguments)
    elif isinstance(value, Node):
        ctx.deferred.unread(value, arguments)
    if isinstance(value, Node) and value.operands:
        ctx.notes.roles.setdefault(value.id, symbol.name)
        if surface is None:
            value = marked(ctx, symbol, arguments, value)
            ctx.notes.roles.setdefault(value.id, symbol.name)
    return value


def checked_body(
    ctx: Context, callee: Callee, fixed: Sequence[Node | None]
) -> tuple[Node, Formals] | None:
    """The result of a function for variables in place of its arguments, but for ``fixed`` ones.

    ``lowering`` asks for this, for calls that could apply one body. There is none if the body is
    wrong for variables, about which nothing is reported: the calls have been checked.
    """
    function, found = callee.symbol.declaration, ctx.report.count
    assert isinstance(function, ast.Function)
    names = [argument.name.text for argument in function.arguments]
    deferred = len(ctx.deferred)
    stand_in = stand_ins(ctx, names, callee.given, fixed)
    value = apply_body(ctx, callee.symbol, stand_in.values, function.name.span)
    failed = ctx.report.count > found
    ctx.report.forget(found)
    ctx.deferred.forget(deferred)
    if failed or isinstance(value, Failure) or not stand_in.formals:
        return None
    return value.operands[0] if value.op == "called" else value, stand_in.formals


def library_call(
    ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], span: Span
) -> Node | Failure:
    """A library function's value for arguments that it is known to take."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    variables = bound(ctx, function, arguments)
    assert variables is not None
    fitted = []
    for formal, argument in zip(function.arguments, arguments, strict=True):
        declared = declared_type(ctx, formal.type, symbol.module, variables)
        assert declared is not None
        fitted.append(ctx.meanings.ascribed(argument, declared.meaning))
    return apply_body(ctx, symbol, tuple(fitted), span)
