"""Tells which operations choose, and which of these choices are worth a branch.

A choice is a ``?:``, a ``&&`` or a ``||``. ``schedule`` asks here for each of them whether it shall
become an ``if``, so that values that only one side needs are computed only where that side is
chosen.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ...stdlib.builtins import BUILTINS
from ...support.frozen import cached_property
from ..ir.node import Node
from ..ir.operations import BRANCH
from ..ir.types import BOOL, Matrix
from ..ir.walks import operands_of
from .cost import cost, cost_of
from .draw_constants import DrawConstants

BRANCH_COST = 32
"""A choice whose sides cost less than this is cheaper than a branch."""
UNIFORM_BRANCH_COST = 16
"""The cost of a branch where the whole draw takes one side, so that no pixel waits for others.

A texture read is worth skipping then.
"""

_SHORT_CIRCUITING = frozenset(name for name, row in BUILTINS.items() if row.short_circuits)


def chooses(node: Node) -> bool:
    """True if a node is a choice: a ``?:``, ``&&`` or ``||`` where it is printed in place."""
    return node.op == "select" or short_circuits(node)


def short_circuits(node: Node) -> bool:
    """True if a node is a ``&&`` or ``||``."""
    return node.op == "native" and node.data in _SHORT_CIRCUITING and node.type == BOOL


def has_to_branch(node: Node) -> bool:
    """One side is safe only behind the condition, or no language has a ``?:`` for the type."""
    return node.op == "select" and (node.data == BRANCH or isinstance(node.type, Matrix))


class Choices:
    """The choices of one body: a stage's entry point or a function."""

    def __init__(self, order: Sequence[Node], together: frozenset[int]) -> None:
        """``together`` are the nodes that all pixels have to reach (``uniformity.py``)."""
        self._order = order
        self._together = together
        self._constant = DrawConstants()
        self._bodies: dict[Node, int] = {}

    def is_uniform(self, choice: Node) -> bool:
        """True if all pixels of a draw choose the same side."""
        return choice.operands[0] in self._constant

    def is_worth_branching(self, choice: Node, *, uniform: bool) -> bool:
        """True if a side costs more than a branch, in ``uniform`` control flow or not.

        Only in uniform control flow can a branch contain operations that all pixels have to reach.
        """
        limit = UNIFORM_BRANCH_COST if uniform else BRANCH_COST
        kept = frozenset[int]() if uniform else self._together
        return any(self._costs_at_least(side, limit, kept) for side in choice.operands[1:])

    @cached_property
    def _uses(self) -> Counter[Node]:
        return Counter(operand for node in self._order for operand in operands_of(node))

    def _costs_at_least(self, side: Node, limit: int, kept: frozenset[int]) -> bool:
        """True if the operations that only one side of a choice needs cost ``limit`` or more.

        A value is needed there only if each of its uses is: they are counted off on the way down.
        The nodes in ``kept`` are computed before the branch.
        """
        total, pending = 0, [side]
        counted: dict[Node, int] = {}
        while pending and total < limit:
            node = pending.pop()
            counted[node] = found = counted.get(node, 0) + 1
            if found < self._uses[node] or node.id in kept:
                continue
            total += cost_of(node)
            if node.op == "apply":
                total += self._body(node.operands[0])
            pending.extend(operands_of(node))
        return total >= limit

    def _body(self, body: Node) -> int:
        if body not in self._bodies:
            self._bodies[body] = cost(body, BRANCH_COST)
        return self._bodies[body]
