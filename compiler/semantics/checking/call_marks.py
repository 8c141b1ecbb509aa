"""Marks the values of calls, so that ``outlining`` can let calls of one function share its body."""

from __future__ import annotations

from ....support.frozen import frozen
from ...ir import build
from ...ir.node import Node, bare
from ...ir.types import Array, Matrix, Opaque, Scalar, Struct, Vector
from ..names.modules import Symbol
from ..state.context import Context, Given


@frozen
class Callee:
    """A called function with its arguments' kinds: calls of one callee may share a body."""

    symbol: Symbol
    given: tuple[Given, ...]


def marked(ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], value: Node) -> Node:
    """Wraps a call's result in a ``called`` node that records callee and arguments."""
    if not isinstance(value.type, Scalar | Vector | Matrix) or not value.operands:
        return value
    kinds = kinds_of(ctx, arguments)
    if kinds is None:
        # With arguments of its own, the body around this call may have one that can be marked.
        ctx.progress.unproven += any(argument.variables for argument in arguments)
        return value
    given, parts = kinds
    return ctx.tree.node("called", value.type, (value, *parts), Callee(symbol, given))


def kinds_of(
    ctx: Context, arguments: tuple[Node, ...]
) -> tuple[tuple[Given, ...], tuple[Node, ...]] | None:
    """The kind of each argument, and the numbers, vectors and matrices that they consist of.

    ``None`` if there are none of these, or if an argument is no variable but depends on one.
    """
    given: list[Given] = []
    parts: list[Node] = []
    for argument in arguments:
        if not _is_kept(argument):
            given.append((argument.type, ctx.meanings.of(argument)))
            whole = bare(argument) if isinstance(argument.type, Struct) else argument
            parts += build.flattened(ctx.tree, whole)
        elif argument.variables:
            return None
        else:
            given.append(argument)
    return (tuple(given), tuple(parts)) if parts else None


def _is_kept(argument: Node) -> bool:
    """True if the function must be specialised for each value of an argument.

    Textures and buffers are no arguments everywhere, arrays would be copied, and a value in a block
    can be read by every function.
    """
    if isinstance(argument.type, Opaque | Array):
        return True
    return isinstance(argument.type, Struct) and bare(argument).op == "parameter"
