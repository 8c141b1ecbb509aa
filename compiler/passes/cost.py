"""Rough costs of nodes, in ALU operations.

``schedule`` compares them to choose between a branch and a select, ``inline`` to choose between a
function and its body, ``hoist`` and the rules for loops to see whether their work pays.
"""

from __future__ import annotations

from functools import lru_cache

from ...stdlib.builtins import BUILTINS
from ..ir.node import Node
from ..ir.operations import BUILTIN_OPS, CALL, OPERATIONS
from ..ir.types import Scalar, Type, Vector, width

LOAD = 4
"""Reading one more row of a block: of a value that the host computes, or of an array's element."""


def cost_of(node: Node) -> int:
    """ALU operations of one node, not counting its operands."""
    if node.op in BUILTIN_OPS:
        return _cost_of_builtin(CALL.data(node), node.type)
    return OPERATIONS[node.op].cost


@lru_cache(maxsize=1024)
def _cost_of_builtin(builtin: str, type_: Type) -> int:
    return BUILTINS[builtin].cost * (width(type_) if isinstance(type_, Scalar | Vector) else 4)


def cost(root: Node, limit: int) -> int:
    """ALU operations of everything that ``root`` needs; above ``limit``, only that it is more.

    Bodies contain the bodies of the functions that they call, so that counting to the end would
    take the square of the program's size.
    """
    total = 0
    seen = {root}
    pending = [root]
    for node in pending:  # The list grows on the way.
        total += cost_of(node)
        if total > limit:
            return limit + 1
        for operand in node.operands:
            if operand not in seen:
                seen.add(operand)
                pending.append(operand)
    return total
