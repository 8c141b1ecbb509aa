"""What all functions and terms share: type parameters, results, and that none calls itself."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ..diagnostics import rules
from ..diagnostics.source import Span
from ..ir.node import Node
from ..ir.types import Matrix, Texture, Type
from ..syntax import ast
from . import overloads
from .declared import declared_type
from .modules import Symbol
from .scope import FAILURE, Failure

if TYPE_CHECKING:
    from .lower import Lowering


def entered(low: Lowering, symbol: Symbol, span: Span) -> bool:
    """Whether a body may be lowered; a call of itself is reported, once for each way round."""
    if symbol in low.recursive:
        return False
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
    variables = bind_type_parameters(function, arguments)
    wanted = declared_type(low, function.result, symbol.module, variables)
    if wanted is None:
        return FAILURE
    return low.fit(result, wanted.type, wanted.text, function.body.span)


_WHOLE_FAMILIES: Mapping[str, type[Matrix | Texture]] = {"matrices": Matrix, "textures": Texture}
"""Families of types without lanes that could adapt."""


def bind_type_parameters(
    function: ast.Function, arguments: tuple[Node, ...]
) -> dict[str, Type] | None:
    """What each type parameter stands for, given the arguments: the widest type passed for it."""
    variables: dict[str, Type] = {}
    for parameter in function.type_parameters:
        used = [
            argument
            for formal, argument in zip(function.arguments, arguments, strict=True)
            if formal.type.name.text == parameter.name.text
        ]
        if not used:
            return None
        whole = _WHOLE_FAMILIES.get(parameter.family.text)
        if whole is not None:
            type_ = used[0].type
            if not isinstance(type_, whole):
                return None
        else:
            family = overloads.WRITTEN_FAMILIES.get(parameter.family.text)
            bound = None if family is None else overloads.common_type(
                family, [overloads.operand(node) for node in used]
            )  # fmt: skip
            if bound is None:
                return None
            type_ = bound
        variables[parameter.name.text] = type_
    return variables
