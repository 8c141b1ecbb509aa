"""The few conversions that happen by themselves.

A constant adapts: ``2`` may stand for ``2.0``, and one number for a vector of equal lanes. Nothing
else converts without being asked to.
"""

from __future__ import annotations

from ..ir.build import constant, splat
from ..ir.node import Graph, Node
from ..ir.types import Scalar, Type, Vector, scalar_kind, width


def coerce(graph: Graph, node: Node, wanted: Type, *, broadcast: bool = False) -> Node | None:
    """``node`` as a value of type ``wanted``, or ``None`` where it cannot be.

    ``broadcast`` lets any scalar, not only a constant, stand for a vector of equal lanes.
    """
    if node.type == wanted:
        return node
    kind = scalar_kind(wanted)
    if node.op == "select" and scalar_kind(node.type) != kind:
        return _sides(graph, node, wanted, broadcast=broadcast)
    if not isinstance(node.type, Scalar) or not isinstance(wanted, Scalar | Vector):
        return None
    lane = _as_kind(graph, node, kind)
    if lane is None or not (is_constant(node) or broadcast or isinstance(wanted, Scalar)):
        return None
    return splat(graph, lane, width(wanted))


def _sides(graph: Graph, node: Node, wanted: Type, *, broadcast: bool) -> Node | None:
    """``if c then 1 else 0`` as a float: a choice between constants adapts as they do."""
    condition, *sides = node.operands
    then, otherwise = (coerce(graph, side, wanted, broadcast=broadcast) for side in sides)
    if then is None or otherwise is None:
        return None
    return graph.node("select", wanted, (condition, then, otherwise))


def is_constant(node: Node) -> bool:
    """Whether a value is written in the program: a literal, or one with a sign."""
    while node.op == "call" and node.data == "neg":
        node = node.operands[0]
    return node.op == "constant"


def _as_kind(graph: Graph, node: Node, kind: str | None) -> Node | None:
    if scalar_kind(node.type) == kind:
        return node
    if scalar_kind(node.type) != "int" or not is_constant(node):
        return None
    negative = False
    while node.op == "call":
        node, negative = node.operands[0], not negative
    assert isinstance(node.data, int)
    value = -node.data if negative else node.data
    if kind == "float":
        return constant(graph, Scalar("float"), float(value))
    if kind == "uint" and value >= 0:
        return constant(graph, Scalar("uint"), value)
    return None
