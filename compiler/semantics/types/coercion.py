"""The few conversions that happen by themselves.

A constant adapts: ``2`` may stand for ``2.0``, and one number for a vector of equal lanes. Nothing
else converts without being asked to.
"""

from __future__ import annotations

from ...ir.build import constant, splat
from ...ir.node import Graph, Node, bare
from ...ir.operations import ASCRIBE
from ...ir.types import Array, Scalar, Type, Vector, scalar_kind, width


def coerce(graph: Graph, node: Node, wanted: Type, *, broadcast: bool = False) -> Node | None:
    """``node`` as a value of type ``wanted``, or ``None`` where it cannot be.

    ``broadcast`` lets any scalar, not only a constant, stand for a vector of equal lanes.
    """
    if node.type == wanted:
        return node
    if is_settled(node) and not broadcast:
        return None
    node = bare(node)
    kind = scalar_kind(wanted)
    if isinstance(wanted, Array):
        return _elements(graph, node, wanted)
    if node.op == "select" and scalar_kind(node.type) != kind:
        return _choice(graph, node, wanted, broadcast=broadcast)
    if not isinstance(node.type, Scalar) or not isinstance(wanted, Scalar | Vector):
        return None
    lane = _as_kind(graph, node, kind)
    if lane is None or not (is_constant(node) or broadcast or isinstance(wanted, Scalar)):
        return None
    return splat(graph, lane, width(wanted))


def _elements(graph: Graph, node: Node, wanted: Array) -> Node | None:
    """``[1, 2]`` as two floats: an array of constants adapts as they do."""
    if node.op != "array" or len(node.operands) != wanted.count:
        return None
    fitted = [coerce(graph, element, wanted.element) for element in node.operands]
    elements = tuple(element for element in fitted if element is not None)
    return graph.node("array", wanted, elements) if len(elements) == wanted.count else None


def _choice(graph: Graph, root: Node, wanted: Type, *, broadcast: bool) -> Node | None:
    """``if c then 1 else 0`` as a float: a choice between constants adapts as they do."""
    fitted: dict[int, Node] = {}
    for node in _choices(root):
        condition, *sides = node.operands
        for side in sides:
            if side.id not in fitted:
                adapted = coerce(graph, side, wanted, broadcast=broadcast)
                if adapted is None:
                    return None
                fitted[side.id] = adapted
        then, otherwise = (fitted[side.id] for side in sides)
        fitted[node.id] = graph.node("select", wanted, (condition, then, otherwise))
    return fitted[root.id]


def _choices(root: Node) -> list[Node]:
    """A choice and those that it chooses between, the innermost first."""
    found = {root.id: root}
    pending = [root]
    while pending:
        for side in pending.pop().operands[1:]:
            if side.op == "select" and side.id not in found:
                found[side.id] = side
                pending.append(side)
    return [found[number] for number in sorted(found)]


def settled(graph: Graph, node: Node) -> Node:
    """A constant that has been given to a slot whose type is written: it adapts no more.

    So a parameter may override the slot, which would not adapt either.
    """
    adapts = isinstance(node.type, Scalar | Array) and is_adaptable(node)
    return graph.node("as", node.type, (node,), None) if adapts else node


def is_settled(node: Node) -> bool:
    """True for a value that has the type that is written, whatever it was made of."""
    return (node.op == "as" and node.data is None) or _is_member(node)


def _is_member(node: Node) -> bool:
    """True for a member of an enumeration, which is no number to adapt."""
    while node.op == "called":
        node = node.operands[0]
    meaning = ASCRIBE.data(node) if node.op == "as" else None
    return meaning is not None and meaning.kind == "enum"


def is_constant(node: Node) -> bool:
    """True if a value is written in the program: a literal, one with a sign, or a choice."""
    if is_settled(node):
        return False
    node = bare(node)
    if node.op == "select":
        sides = (side for choice in _choices(node) for side in choice.operands[1:])
        return all(side.op == "select" or _is_literal(side) for side in sides)
    return _is_literal(node)


def is_adaptable(node: Node) -> bool:
    """True if a value adapts to a type that is required: a constant, or an array of constants."""
    if is_settled(node):
        return False
    node = bare(node)
    if node.op == "array":
        return all(is_constant(element) for element in node.operands)
    return is_constant(node)


def _is_literal(node: Node) -> bool:
    known = bare(node).op == "constant" or is_negated_literal(node)
    return known and not _is_member(node)


def is_negated_literal(node: Node) -> bool:
    """True if a value is a literal with a sign; a second sign gives the literal itself.

    So no value has two of them, and nothing has to look through a long row.
    """
    node = bare(node)
    return node.op == "call" and node.data == "neg" and bare(node.operands[0]).op == "constant"


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
