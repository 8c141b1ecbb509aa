"""Estimates what loops cost that run for nothing, and how often they do: ``skip_loops`` asks.

All prices are in ALU operations, as in ``cost.py``. A condition pays if the operations that it is
expected to save, over all draws, are more than those that it takes in each.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from math import prod

from ..ir.leaves import Number, Parameter
from ..ir.node import Node, formals_of, reachable
from ..ir.operations import FOLD, ITERATE, LOOPS
from ..ir.walks import operands_of, visible
from ..reference.evaluate import NotConstantError, evaluate
from ..reference.namespace import Lanes
from ..reference.operations import constant_lanes
from .choices import UNIFORM_BRANCH_COST
from .cost import cost_of

EVEN_CHANCE = 1 / 2
"""The share of draws in which a weight is zero that is zero by default: a layer that is added."""
SMALL_CHANCE = 1 / 64
"""The share for all other weights: few draws have a strength of zero, or a step of no time."""

USUAL_TURNS = 16
"""The turns of a loop whose number the host or the data decide, if it may have so many."""

STORED = 16
"""The price of a condition that the host has to compute: a value in a block, or one more block.

A parameter is compared with zero where it is, which takes nothing but the branch.
"""


class LoopPrices:
    """Prices of loops that a weight may skip, and of the condition that skips them."""

    def __init__(self, defaults: Mapping[Parameter, Number]) -> None:
        self._defaults = defaults
        self._chances: dict[Node, float] = {}
        self._bodies: dict[Node, tuple[bool, int]] = {}
        """For bodies of functions, whether there is a loop in them, and the price."""

    def pays(self, weight: Node, skipped: Iterable[Node], uses: Counter[Node]) -> bool:
        """True if a condition on ``weight`` pays, which skips values unless others need them.

        ``uses`` has the number of users of each node in the body. Without a loop nothing pays: a
        choice of few operations is what ``schedule`` decides about.
        """
        has_loop, price = self._own(skipped, uses)
        condition = UNIFORM_BRANCH_COST + (0 if weight.op == "parameter" else STORED)
        return has_loop and price * self.chance(weight) >= condition

    def chance(self, weight: Node) -> float:
        """The expected share of draws in which a weight is zero."""
        if weight not in self._chances:
            is_zero = self._is_zero_by_default(weight)
            self._chances[weight] = EVEN_CHANCE if is_zero else SMALL_CHANCE
        return self._chances[weight]

    def _is_zero_by_default(self, weight: Node) -> bool:
        try:
            return evaluate(weight, self._default) == (0,)
        except NotConstantError:
            return False

    def _default(self, leaf: Node) -> Lanes | None:
        """The value that a parameter has unless a host sets it, for the reference."""
        value = self._defaults.get(leaf.data) if isinstance(leaf.data, Parameter) else None
        return None if value is None else constant_lanes(leaf.type, value)

    def _own(self, roots: Iterable[Node], uses: Counter[Node]) -> tuple[bool, int]:
        """Tells if only ``roots`` need some loop, with the price of all that only they need."""
        pending, counted = list(roots), Counter[Node]()
        own: list[Node] = []
        while pending:
            node = pending.pop()
            counted[node] += 1
            if counted[node] < uses[node]:
                continue
            own.append(node)
            pending += operands_of(node)
        return self._priced(own)

    def _priced(self, nodes: Iterable[Node]) -> tuple[bool, int]:
        """Tells if some nodes have a loop, with the price of all of them, times their turns."""
        nodes = list(nodes)
        loops = {each: node for node in nodes if node.op in LOOPS for each in formals_of(node)}
        has_loop, price = bool(loops), 0
        for node in nodes:
            once = cost_of(node)
            if node.op == "apply":
                loops_inside, inside = self._body(node.operands[0])
                has_loop, once = has_loop or loops_inside, once + inside
            around = {loops[each] for each in node.variables if each in loops}
            price += once * prod(map(_turns, around))
        return has_loop, price

    def _body(self, body: Node) -> tuple[bool, int]:
        if body not in self._bodies:
            has_loop = any(node.op in LOOPS for node in reachable((body,)))
            self._bodies[body] = has_loop, self._priced(visible((body,)))[1]
        return self._bodies[body]


def _turns(loop: Node) -> int:
    """The turns that are expected of a loop."""
    bound = FOLD.data(loop).bound if loop.op == "fold" else ITERATE.data(loop).bound
    is_known = loop.op == "fold" and loop.operands[0].op == "constant"
    return bound if is_known else min(bound, USUAL_TURNS)
