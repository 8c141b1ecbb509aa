"""Finds the values that can be one number only, by their ranges: they are constants.

``simplify.py`` asks for each node that no rule makes simpler. So a parameter in ``0..0`` leaves as
much of a shader as the constant 0 in its place does, and so does a product with it: nothing is left
of the other factor, of the textures that it reads and of the loops in it.
"""

from __future__ import annotations

from ..ir import build
from ..ir.leaves import Parameter
from ..ir.node import Graph, Node
from ..ir.ranges import Ranges
from ..ir.types import Scalar, ScalarKind, Vector, scalar_kind, width

ONE_VALUE = "one value"
"""The name of this rule in ``Options.without``."""

_LANES: dict[ScalarKind, type[float] | type[int] | type[bool]] = {
    "float": float, "int": int, "uint": int, "bool": bool
}  # fmt: skip
"""The classes of constants' lanes."""


def as_constant(graph: Graph, ranges: Ranges, node: Node) -> Node | None:
    """The constant that a value has to be; ``None`` if it may have several values.

    Only numbers and vectors are looked at. A range is the same for all lanes of a vector. What
    depends on the states of loops is left alone: their ranges are best if they are first asked for
    from outside of the loops, once all that is around these is simplified.
    """
    kind = scalar_kind(node.type)
    if node.op == "constant" or kind is None or not isinstance(node.type, Scalar | Vector):
        return None
    if isinstance(node.data, Parameter) and node.data.value is not None:
        return build.constant(graph, node.type, node.data.value)
    if ranges.is_in_turn(node) or ONE_VALUE in ranges.without:
        return None
    fact = ranges.of(node)
    if fact.lo != fact.hi:
        return None
    lane = _LANES[kind](fact.lo + 0.0)  # no zero has a sign
    lanes = width(node.type)
    return build.constant(graph, node.type, lane if lanes == 1 else (lane,) * lanes)
