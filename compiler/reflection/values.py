"""Expressions over parameters as JSON: a list of steps, operands before users.

A list and not a tree, because a tree repeats what is shared (exponentially, in the worst case) and
nests as deeply as the expression does; a host evaluates the list in one loop.
"""

from __future__ import annotations

from typing import Any

from ..ir.host import KEYS, PLAIN
from ..ir.leaves import Parameter, Resource
from ..ir.node import Folding, Node, reachable


def steps(value: Node) -> list[dict[str, Any]]:
    """The steps that compute ``value``, which is the last of them."""
    nodes = reachable([value])
    numbers = {node.id: number for number, node in enumerate(nodes)}
    return [
        {
            "op": node.op,
            "type": str(node.type),
            **_data(node),
            "args": [numbers[operand.id] for operand in node.operands],
        }
        for node in nodes
    ]


def _data(node: Node) -> dict[str, Any]:
    """What a step needs besides its arguments."""
    if node.op in PLAIN:
        return {}
    if isinstance(node.data, Folding):
        return {"operator": node.data.operator, "bound": node.data.bound}
    if node.op not in KEYS:
        raise ValueError(f"a host cannot compute {node.op}")
    if isinstance(node.data, Parameter | Resource):
        return {KEYS[node.op]: node.data.name}
    return {KEYS[node.op]: listed(node.data)}


def listed(value: object) -> Any:
    """Nested tuples as lists."""
    return [listed(element) for element in value] if isinstance(value, tuple) else value
