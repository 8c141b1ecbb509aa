"""The shapes of arguments: what checks of a function's body may see in them, for its signature."""

from __future__ import annotations

from ...ir.node import Node, bare
from ...ir.types import Scalar, Vector
from ..state.context import Context, Shape, Unfixed
from ..types.coercion import is_constant, is_negated_literal

LARGEST_CONSTANT = 8
"""The largest number of operations of a constant expression that is part of a signature."""


def shape_of(ctx: Context, part: Node) -> Shape:
    """What checks of a repeated body may see in a value, besides its type and meaning.

    Constant expressions are computed, choices between literals adapt where they are used, and all
    lanes of a splat are equal.
    """
    node = bare(part)
    if ctx.constants.is_known(node):
        return _written(node)
    if is_constant(node):
        return Unfixed.ADAPTS
    return Unfixed.SPLAT if node.op == "splat" else None


def literal_shape(part: Node) -> Shape:
    """A literal as it is written; ``None`` for any other value."""
    node = bare(part)
    return _written(node) if node.op == "constant" or is_negated_literal(node) else None


def _written(root: Node) -> Shape:
    """A constant expression as a text: literals that compare equal, as ``1`` and ``true``, differ.

    That of a large one would be as large, so it is said to adapt.
    """
    written: list[str] = []
    pending = [root]
    while pending:
        node = bare(pending.pop())
        if len(written) == LARGEST_CONSTANT:
            return Unfixed.ADAPTS
        written.append(f"{node.op} {node.type} {node.data!r}")
        pending += node.operands
    return "; ".join(written)


def computed_shape(ctx: Context, part: Node, shape: Shape) -> Shape:
    """The value of a large constant expression in the place of its text, if nothing is wrong there.

    Checks see no more of such a constant: it is no literal, and not put together of columns.
    """
    node = bare(part)
    is_plain = isinstance(node.type, Scalar | Vector) and not is_constant(node)
    if shape is not Unfixed.ADAPTS or not is_plain or ctx.deferred.concerns(node):
        return shape
    return f"{node.op} of {node.type} {ctx.constants.known(node)!r}"


def is_fixed(shape: Shape) -> bool:
    """True if a body is checked with the very value of an argument of this shape."""
    return isinstance(shape, str)


def varying_part(part: Node, shape: Shape) -> Node:
    """The part of a value for which bodies have a variable, or the value if it is constant."""
    return bare(part).operands[0] if shape is Unfixed.SPLAT else part


def is_unit(ctx: Context, part: Node) -> bool:
    """True if a value is a vector of length one."""
    return isinstance(part.type, Vector) and ctx.ranges.of(part).unit
