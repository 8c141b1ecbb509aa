"""Marks the values of calls, so that ``outlining`` can let calls of one function share its body."""

from __future__ import annotations

from typing import TypeAlias

from ....frozen import frozen
from ...ir import build
from ...ir.meaning import Meaning
from ...ir.node import Node, bare
from ...ir.types import Array, Matrix, Scalar, Struct, Texture, Type, Vector
from ..names.modules import Symbol
from ..state.context import Context

Given: TypeAlias = "Node | tuple[Type, Meaning | None]"
"""What a body knows of an argument: its value, or what kind of value it is."""


@frozen
class Callee:
    """What was called: calls of one callee may share a body."""

    symbol: Symbol
    given: tuple[Given, ...]


def marked(ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], value: Node) -> Node:
    """``value`` as what a function gives for ``arguments``: a node ``called``."""
    if not isinstance(value.type, Scalar | Vector | Matrix) or not value.operands:
        return value
    given: list[Given] = []
    parts: list[Node] = []
    for argument in arguments:
        if not _is_kept(argument):
            given.append((argument.type, ctx.meanings.of(argument)))
            whole = bare(argument) if isinstance(argument.type, Struct) else argument
            parts += build.flattened(ctx.graph, whole)
        elif argument.variables:
            return value
        else:
            given.append(argument)
    if not parts:
        return value
    callee = Callee(symbol, tuple(given))
    return ctx.graph.node("called", value.type, (value, *parts), callee)


def _is_kept(argument: Node) -> bool:
    """Whether each value of an argument has a body of its own.

    Textures are no arguments everywhere, arrays would be copied, and what a block holds can be read
    by every function.
    """
    if isinstance(argument.type, Texture | Array):
        return True
    return isinstance(argument.type, Struct) and bare(argument).op == "parameter"
