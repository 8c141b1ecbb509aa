"""Overload resolution: which of several functions of one name a call means.

``applications`` asks this for each call, and so do conversions and expansions for functions of the
library. Nothing is reported here. The order of declarations has no meaning: of functions that take
the arguments equally well none is preferred.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...ir.node import Node
from ...syntax import ast
from ..declarations import contracts
from ..declarations.contracts import Change
from ..declarations.written_types import declared_type
from ..names.modules import Symbol
from ..state.context import Context, Kinds, Overloads
from .functions import bound

Rank = tuple[list[Change], int, int, int]
"""The rank of a candidate; the least is the best.

It consists of the changes of its arguments, the worst first; the number of arguments that the call
leaves out; the number of arguments of any type, such as ``T``; and the number of type parameters.
"""

Names = Sequence[ast.Name | None]


def best(
    ctx: Context, overloaded: Sequence[Symbol], arguments: tuple[Node, ...], names: Names = ()
) -> list[Symbol]:
    """The functions that take the arguments best; none if none takes them."""
    if names:
        return _least(ctx, _by_names(overloaded, names), arguments)
    overloads = _overloads(ctx, overloaded)
    kinds = tuple((argument.type, ctx.meanings.of(argument)) for argument in arguments)
    exact = overloads.exact.get(kinds)
    if exact is not None and _changes(ctx, exact, _arguments(exact), arguments) is not None:
        return [exact]
    count = len(arguments)
    found = overloads.of_count.get(count, ())
    return _least(ctx, [(symbol, _arguments(symbol)[:count]) for symbol in found], arguments)


def _least(
    ctx: Context,
    candidates: Iterable[tuple[Symbol, Sequence[ast.Argument]]],
    arguments: tuple[Node, ...],
) -> list[Symbol]:
    """The functions that change the arguments least; each comes with what these are for."""
    found: list[Symbol] = []
    least: Rank | None = None
    for symbol, formals in candidates:
        changes = _changes(ctx, symbol, formals, arguments)
        if changes is None:
            continue
        left_out = len(_arguments(symbol)) - len(arguments)
        rank = sorted(changes, reverse=True), left_out, *_generality(_function(symbol))
        if least is None or rank < least:
            found, least = [symbol], rank
        elif rank == least:
            found.append(symbol)
    return found


def _by_names(
    overloaded: Sequence[Symbol], names: Names
) -> Iterator[tuple[Symbol, Sequence[ast.Argument]]]:
    """The functions that have arguments of these names, and defaults for all others."""
    from .arguments import takers

    for symbol in overloaded:
        formals = _arguments(symbol)
        numbers = takers([formal.name.text for formal in formals], names, len(names))
        if numbers is None:
            continue
        left_out = (f for number, f in enumerate(formals) if number not in numbers)
        if all(formal.default is not None for formal in left_out):
            yield symbol, [formals[number] for number in numbers]


def _generality(function: ast.Function) -> tuple[int, int]:
    parameters = {parameter.name.text for parameter in function.type_parameters}
    types = (argument.type for argument in function.arguments)
    any_type = sum(type_.name.text in parameters and type_.count is None for type_ in types)
    return any_type, len(parameters)


def _overloads(ctx: Context, overloaded: Sequence[Symbol]) -> Overloads:
    """The index of the functions that one file has under one name; each is made once."""
    known = ctx.overloads.get(overloaded[0])
    if known is None:
        known = ctx.overloads[overloaded[0]] = Overloads({}, {})
        for symbol in overloaded:
            function = _function(symbol)
            for count in range(_least_count(function), len(function.arguments) + 1):
                known.of_count.setdefault(count, []).append(symbol)
            kinds = None if function.type_parameters else _declared(ctx, symbol)
            if kinds is not None:
                known.exact[kinds] = None if kinds in known.exact else symbol
    return known


def _least_count(function: ast.Function) -> int:
    """The least number of arguments by position: the last ones may have defaults."""
    count = len(function.arguments)
    while count and function.arguments[count - 1].default is not None:
        count -= 1
    return count


def _declared(ctx: Context, symbol: Symbol) -> Kinds | None:
    """The declared kinds of a function's arguments; ``None`` if one has no proper type."""
    kinds = []
    for formal in _arguments(symbol):
        declared = declared_type(ctx, formal.type, symbol.module)
        if declared is None:
            return None
        kinds.append((declared.type, declared.meaning))
    return tuple(kinds)


def _changes(
    ctx: Context, symbol: Symbol, formals: Sequence[ast.Argument], arguments: tuple[Node, ...]
) -> list[Change] | None:
    """The change of each argument for a function to take it; ``None`` if it cannot.

    ``formals`` are what the arguments are for.
    """
    variables = bound(ctx, _function(symbol), arguments, formals)
    if variables is None:
        return None
    changes = []
    for formal, argument in zip(formals, arguments, strict=True):
        wanted = declared_type(ctx, formal.type, symbol.module, variables)
        generic = formal.type.name.text in variables
        change = (
            None if wanted is None else contracts.change(ctx, argument, wanted, broadcast=generic)
        )
        if change is None:
            return None
        changes.append(change)
    return changes


def _arguments(symbol: Symbol) -> tuple[ast.Argument, ...]:
    return _function(symbol).arguments


def _function(symbol: Symbol) -> ast.Function:
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    return function
