"""Says how many turns the loops of a value take at least, before anybody computes it.

Values that have to be known when compiling have a limit of operations. Where loops alone exceed it,
semantics says so at once, and nobody waits until the limit is reached.
"""

from __future__ import annotations

from ..ir.node import Node, bare, bodies_of, reachable
from ..ir.operations import CONSTANT, FOLD, OUTSIDE


def least_turns(root: Node) -> int:
    """The turns that loops certainly take until a closed value is known.

    Of several loops beside each other, only the longest counts, and none that is computed once
    for all turns of a loop around it. The result is 0 if something in the value comes from outside,
    as then nobody can say what is computed.
    """
    least: dict[int, int] = {}
    for node in reachable((root,)):  # Operands come first, and so do inner loops.
        if node.op in OUTSIDE:
            return 0
        certain = [each for each in _certain(node) if each.free or not node.free]
        turns = max((least[each.id] for each in certain), default=0)
        if node.op == "fold":
            body = node.operands[2]
            turns = max(turns, _count(node) * (1 + (least[body.id] if body.free else 0)))
        least[node.id] = turns
    return least[root.id]


def _certain(node: Node) -> tuple[Node, ...]:
    """The operands that are computed in any case: not the sides of a choice, or bodies of loops."""
    if node.op == "select":
        return node.operands[:1]
    if node.op == "apply":
        return node.operands
    inside = bodies_of(node)
    return tuple(each for number, each in enumerate(node.operands) if number not in inside)


def _count(fold: Node) -> int:
    """The turns of a fold; 0 where its count is computed."""
    written = bare(fold.operands[0])
    count = CONSTANT.data(written) if written.op == "constant" else 0
    return min(count, FOLD.data(fold).bound) if isinstance(count, int) else 0
