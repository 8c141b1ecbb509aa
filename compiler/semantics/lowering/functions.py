"""What all functions and terms share: type parameters, results, and that none calls itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir.node import Node
from ...syntax import ast
from ..declarations.written_types import declared_type
from ..names.modules import Symbol
from ..state.scope import FAILURE, Failure
from ..types import overloads
from ..types.generics import Use, bind
from ..types.typenames import Variables, described

if TYPE_CHECKING:
    from ..state.context import Lowering


def entered(low: Lowering, symbol: Symbol, span: Span) -> bool:
    """Whether a body may be lowered; a call of itself is reported, once for each way round."""
    if symbol in low.recursive:
        return False
    low.entered.add(symbol)
    if symbol not in low.active:
        low.active[symbol] = (symbol.name, span)
        return True
    pending = list(low.active)
    start = pending.index(symbol)
    names = [name for name, _ in low.active.values()]
    low.report.add(
        rules.RECURSIVE_FUNCTION, span, name=symbol.name,
        cycle=" → ".join([*names[start:], symbol.name]),
    )  # fmt: skip
    low.recursive.update(step for step in pending[start:] if isinstance(step, Symbol))
    return False


def fit_result(
    low: Lowering, symbol: Symbol, result: Node | Failure, arguments: tuple[Node, ...]
) -> Node | Failure:
    """A body's value as the type that is written behind ``->``."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    if function.result is None:
        return result
    variables = bound(low, function, arguments)
    wanted = declared_type(low, function.result, symbol.module, variables or {})
    if wanted is None:
        return FAILURE
    return low.as_declared(result, wanted, function.body)


def usage(function: ast.Function) -> str:
    """A function as it is declared, up to its arguments: ``f<T: floats>(a: T, b: float)``."""
    parameters = ", ".join(f"{p.name.text}: {p.family.text}" for p in function.type_parameters)
    arguments = ", ".join(f"{a.name.text}: {described(a.type)}" for a in function.arguments)
    return f"{function.name.text}{parameters and f'<{parameters}>'}({arguments})"


def bound(low: Lowering, function: ast.Function, arguments: tuple[Node, ...]) -> Variables | None:
    """What each type parameter stands for, given the arguments."""
    if not function.type_parameters:
        return {}
    uses = [Use(overloads.operand(node), low.meanings.of(node)) for node in arguments]
    return bind(function, uses)
