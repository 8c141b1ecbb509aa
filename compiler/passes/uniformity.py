"""Finds the nodes that all pixels of a quad have to execute together.

``schedule`` and ``path_conditions`` ask for them. A derivative, and a texture read that computes
its own level of detail, compare neighbouring pixels. So a loop that contains one, or a call of a
function that does, cannot stand in a branch that only some of the pixels take.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...stdlib.builtins import BUILTINS
from ..ir.node import Node
from ..ir.operations import LOOPS

_COMPARING = frozenset(name for name, row in BUILTINS.items() if row.uniform_control_flow)


def compares(node: Node) -> bool:
    """True if an operation compares neighbouring pixels."""
    return node.head in _COMPARING


def needing_uniform_flow(nodes: Iterable[Node]) -> frozenset[int]:
    """The ids of operations, loops and calls among ``nodes`` that all pixels have to reach.

    ``nodes`` are all that some roots need, operands before users.

    What a loop's turns have in common is computed before it, and so does not count.
    """
    nodes = list(nodes)
    if _COMPARING.isdisjoint([node.head for node in nodes]):
        return frozenset()
    found: set[int] = set()
    inside: set[Node] = set()
    turning: set[Node] = set()
    """Nodes that contain a comparison of pixels, and among these the nodes that differ."""
    for node in nodes:
        own = node.head in _COMPARING
        if own or not inside.isdisjoint(node.operands):
            inside.add(node)
        if (own and node.variables) or not turning.isdisjoint(node.operands):
            turning.add(node)
        calls = node.op == "apply" and node.operands[0] in inside
        if own or calls or (node.op in LOOPS and node in turning):
            found.add(node.id)
    return frozenset(found)
