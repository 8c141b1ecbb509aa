"""Functions and terms applied to arguments: which of several, what it takes, and what it gives."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ....frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir.node import Node
from ...syntax import ast
from ...trampoline import Reply, Step
from ..declarations import contracts
from ..declarations.written_types import declared_type, numbers_of
from ..hints.wording import counted
from ..names.modules import Symbol
from ..state.scope import FAILURE, Application, Failure, Instance, Scope, Value
from ..types.coercion import coerce
from ..types.generics import shown, unfounded, untold
from . import lights, lookup
from .call_marks import marked
from .functions import bound, entered, fit_result, usage
from .operands import listed

if TYPE_CHECKING:
    from ..state.context import Lowering


def apply_best(
    low: Lowering,
    overloaded: list[Symbol],
    arguments: tuple[Node, ...],
    e: ast.Call,
    scope: Scope,
) -> Reply[Value]:
    """The value of a call of whichever of these functions takes the arguments best."""
    symbol = overloaded[0] if len(overloaded) == 1 else best(low, overloaded, arguments)
    if symbol is not None:
        return _apply(low, symbol, arguments, e, scope)
    low.report.add(
        rules.NO_OVERLOAD, e.span, name=overloaded[0].name, arguments=listed(arguments),
        labels=[Label(s.declaration.name.span, "a candidate") for s in overloaded],
    )  # fmt: skip
    return FAILURE


def best(low: Lowering, overloaded: list[Symbol], arguments: tuple[Node, ...]) -> Symbol | None:
    """The overload that takes the arguments most nearly as they are.

    What need not adapt comes before what must, concrete types before type parameters, and then the
    order of the file decides.
    """
    ranked: list[tuple[bool, bool, int]] = []
    for number, symbol in enumerate(overloaded):
        adapts = accepts(low, symbol, arguments)
        function = symbol.declaration
        assert isinstance(function, ast.Function)
        if adapts is not None:
            ranked.append((adapts, bool(function.type_parameters), number))
    return overloaded[min(ranked)[2]] if ranked else None


def accepts(low: Lowering, symbol: Symbol, arguments: tuple[Node, ...]) -> bool | None:
    """Whether an overload takes these arguments only if one adapts; ``None`` if not at all.

    Reports nothing.
    """
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    if len(function.arguments) != len(arguments):
        return None
    variables = bound(low, function, arguments)
    if variables is None:
        return None
    adapts = False
    for formal, argument in zip(function.arguments, arguments, strict=True):
        wanted = declared_type(low, formal.type, symbol.module, variables)
        generic = formal.type.name.text in variables
        fits = (
            None if wanted is None else contracts.adapts(low, argument, wanted, broadcast=generic)
        )
        if fits is None:
            return None
        adapts = adapts or fits
    return adapts


def _apply(
    low: Lowering, symbol: Symbol, arguments: tuple[Node, ...], e: ast.Call, scope: Scope
) -> Reply[Value]:
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    fitted = _fit_arguments(low, symbol, arguments, e, scope)
    if fitted is None:
        return FAILURE
    if function.per is not None:
        return lights.per_light(low, symbol, fitted, e.span, scope)
    surface = scope.surface if function.kind == "term" else None
    if function.kind == "term" and surface is None:
        low.report.add(rules.TERM_WITHOUT_SURFACE, e.span, name=symbol.name)
        return FAILURE
    return apply_body(low, symbol, fitted, e.span, surface)


def _fit_arguments(
    low: Lowering, symbol: Symbol, arguments: tuple[Node, ...], e: ast.Call, scope: Scope
) -> tuple[Node, ...] | None:
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    if len(arguments) != len(function.arguments):
        low.report.add(
            rules.WRONG_COUNT, e.span, name=symbol.name,
            expected=counted(len(function.arguments), "argument"), found=len(arguments),
            labels=[Label(function.name.span, "declared here")], hint=f"it is `{usage(function)}`",
        )  # fmt: skip
        return None
    variables = bound(low, function, arguments)
    if variables is None and (untold(function) or unfounded(function)):  # Which is reported.
        return None
    if variables is None:
        low.report.add(
            rules.NO_OVERLOAD, e.span, name=symbol.name, arguments=listed(arguments),
            labels=[Label(function.name.span, "declared here")], hint=f"it is `{usage(function)}`",
        )  # fmt: skip
        return None
    fitted = []
    for formal, argument, written in zip(function.arguments, arguments, e.arguments, strict=True):
        wanted = declared_type(low, formal.type, symbol.module, variables)
        if wanted is None:
            return None
        wanted = changed(wanted, text=f"{wanted.text} for `{formal.name.text}`")
        generic = formal.type.name.text in variables
        broadcast = coerce(low.graph, argument, wanted.type, broadcast=generic)
        node = low.as_declared(broadcast or argument, wanted, written, scope)
        if isinstance(node, Failure):
            return None
        fitted.append(node)
    return tuple(fitted)


def apply_body(
    low: Lowering,
    symbol: Symbol,
    arguments: tuple[Node, ...],
    span: Span,
    surface: Instance | None = None,
    use: str = "called here",
) -> Reply[Node | Failure]:
    """A function's value for fitted arguments; the same call is lowered once.

    ``use`` is what messages about a generic body say of ``span``.
    """
    key = (symbol, tuple(argument.id for argument in arguments), surface)
    if key in low.applied:
        return low.applied[key]
    if not entered(low, symbol, span):
        return FAILURE
    return _new_application(low, key, arguments, span, use)


def _new_application(
    low: Lowering, key: Application, arguments: tuple[Node, ...], span: Span, use: str
) -> Step[Node | Failure]:
    symbol, _, surface = key
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    locals_ = {
        formal.name.text: argument
        for formal, argument in zip(function.arguments, arguments, strict=True)
    }
    variables = bound(low, function, arguments) or {}
    values = {**numbers_of(low, variables), **locals_}
    scope = Scope(symbol.module, surface=surface, locals=values, variables=variables)
    before = low.report.count
    result: Node | Failure = yield lookup.body(low, function, scope)
    result = fit_result(low, symbol, result, arguments)
    if variables:
        label = Label(span, f"in `{shown(symbol.name, variables)}`, {use}")
        low.report.explain(before, label)
    low.active.pop(symbol)
    if isinstance(result, Node) and result.operands:
        low.notes.roles.setdefault(result.id, symbol.name)
        if surface is None:
            result = marked(low, symbol, arguments, result)
            low.notes.roles.setdefault(result.id, symbol.name)
    low.applied[key] = result
    return result


def library_call(
    low: Lowering, symbol: Symbol, arguments: tuple[Node, ...], span: Span
) -> Step[Node | Failure]:
    """A library function's value for arguments that it is known to take."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    variables = bound(low, function, arguments)
    assert variables is not None
    fitted = []
    for formal, argument in zip(function.arguments, arguments, strict=True):
        declared = declared_type(low, formal.type, symbol.module, variables)
        assert declared is not None
        fitted.append(low.meanings.ascribed(argument, declared.meaning))
    result: Node | Failure = yield apply_body(low, symbol, tuple(fitted), span)
    return result
