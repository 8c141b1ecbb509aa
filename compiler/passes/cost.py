"""Rough prices, for choosing between a branch and a select, a function and its body."""

from __future__ import annotations

from ...stdlib.builtins import BUILTINS
from ..ir.node import Node, reachable
from ..ir.types import Scalar, Vector, width

LOOP = 32
"""A loop is worth skipping, however little it does in a turn."""

LOAD = 4
"""Reading one more element of an array of uniforms, at an index that the shader computes."""


def cost_of(node: Node) -> int:
    """ALU operations of one node, not counting its operands."""
    if node.op in ("call", "native"):
        lanes = width(node.type) if isinstance(node.type, Scalar | Vector) else 4
        return BUILTINS[str(node.data)].cost * lanes
    if node.op in ("fold", "iterate"):
        return LOOP
    return 1 if node.op in ("select", "apply") else 0


def cost(root: Node) -> int:
    """ALU operations of everything that ``root`` needs."""
    return sum(map(cost_of, reachable((root,))))
