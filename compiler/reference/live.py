"""Liveness: how many numbers an evaluation needs at once for each pixel, vertex or invocation.

Most programs need a few dozens. But a choice between two arrays needs all their elements for each
pixel, so few pixels are evaluated at once then.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ..ir.node import Node, reachable
from ..ir.types import numbers

MOST = 1 << 21
"""The limit of the numbers that an evaluation needs at once, of all pixels together."""

_VARYING = frozenset(("input", "cross", "bound", "formal"))
"""Operations that differ from pixel to pixel, besides vertex inputs.

Some of them may do so from iteration to iteration.
"""


def at_once(roots: Sequence[Node], usual: int) -> int:
    """The number of pixels, vertices or invocations to evaluate at once.

    It is smaller than ``usual`` if each has very many numbers.
    """
    return max(min(usual, MOST // max(most_live(roots), 1)), 1)


def most_live(roots: Sequence[Node]) -> int:
    """The largest number of live numbers of one pixel.

    Values are forgotten after their last use, as ``Evaluator.values`` does; those that are computed
    in iterations of a loop, when the iteration ends.
    """
    nodes = reachable(roots)
    uses = Counter(root.id for root in roots)
    for node in nodes:
        uses.update(operand.id for operand in node.operands)
    sizes = _sizes(nodes)
    inside = sum(sizes[node.id] for node in nodes if _is_in_turn(node))
    live = most = 0
    for node in nodes:
        if _is_in_turn(node):
            continue
        live += sizes[node.id]
        most = max(most, live)
        for operand in node.operands:
            uses[operand.id] -= 1
            if not uses[operand.id] and not _is_in_turn(operand):
                live -= sizes[operand.id]
    return most + inside


def _is_in_turn(node: Node) -> bool:
    """True if a node is computed anew in each iteration of a loop, or each call of a function."""
    return bool(node.free or node.variables)


def _sizes(nodes: Sequence[Node]) -> dict[int, int]:
    """The number of numbers of each node for one pixel; 0 if it is the same for all pixels."""
    sizes: dict[int, int] = {}
    for node in nodes:
        varies = (
            node.op in _VARYING
            or node.op == "attribute"
            or any(sizes[operand.id] for operand in node.operands)
        )
        sizes[node.id] = max(numbers(node.type), 1) if varies else 0
    return sizes
