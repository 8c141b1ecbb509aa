"""The interface between rules and nodes: rules ask about nodes, and build them."""

from __future__ import annotations

from collections.abc import Hashable, Mapping

from ...ir import build
from ...ir.leaves import Number
from ...ir.node import Formal, Graph, Node, Op
from ...ir.ranges import Ranges
from ...ir.shader import Notes
from ...ir.types import Matrix, Type, scalar_kind, width
from ...reference.operations import constant_lanes


class Builder:
    """Builds nodes for rules. A ``Simplifier`` also simplifies the nodes that it builds."""

    def __init__(self, graph: Graph, ranges: Ranges, notes: Notes) -> None:
        self.graph = graph
        self.ranges = ranges
        self.notes = notes
        self.steady: dict[Node, bool] = {}
        """True for values that are the same for all pixels of a triangle (``differences``)."""

    def make(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """The simplest node with the value of this operation."""
        raise NotImplementedError

    def substituted(self, body: Node, replacements: Mapping[Formal, Node]) -> Node:
        """``body`` with formals replaced; all that changes is built in its simplest form."""
        raise NotImplementedError

    def call(self, name: str, type_: Type, *operands: Node) -> Node:
        """A builtin with Burnish's meaning."""
        return self.make("call", type_, operands, name)

    def constant(self, type_: Type, value: Number) -> Node:
        """A constant with one value in every lane."""
        lane = float(value) if scalar_kind(type_) == "float" else value
        lanes = width(type_)
        return build.constant(self.graph, type_, lane if lanes == 1 else (lane,) * lanes)

    def fitted(self, node: Node, type_: Type) -> Node:
        """An operand as a result of this type: itself, or a scalar in every lane."""
        return node if node.type == type_ else self.make("splat", type_, (node,))


def uniform_lane(node: Node) -> Number | None:
    """The value in every lane of a constant, if they are all the same."""
    if node.op != "constant" or isinstance(node.type, Matrix):
        return None
    values = constant_lanes(node.type, node.data)
    first: Number = values[0]
    return first if values.count(first) == len(values) else None
