"""Estimates the cost of calls, and of their bodies in their place: ``inline`` decides by it.

A call with constant arguments may leave little of a body. So the price of such a call is found by
putting the constants in, and counting what is left. Of an argument that is the same all over the
draw only that is looked at: calls that differ in nothing else have one price.
"""

from __future__ import annotations

from collections.abc import Container

from ..ir.node import Formal, Formals, Node, formals_of
from ..ir.operations import VARYING
from ..ir.walks import operands_of, visible
from .cost import cost, cost_of
from .draw_constants import DrawConstants
from .simplify import Simplifier

TRIVIAL = 4
"""Bodies of at most this cost are written out wherever they are used."""

WORTHWHILE = 0.5
"""A call that computes no more than this share of its body for its own arguments is written out."""

DEAR = 1024
"""The limit of a body's price: more expensive bodies are alike.

The cost of a body around such a call is mainly that of the call.
"""


_Priced = tuple[Node, tuple[Node, ...], int]
"""A node, the operands that its body computes itself, and its own cost."""


class CallPrices:
    """Costs of bodies, and of the rest of a body for the arguments of a call."""

    def __init__(self, simplifier: Simplifier) -> None:
        self._simplifier = simplifier
        self._constant = DrawConstants()
        self._trivial: dict[Node, bool] = {}
        self._costs: dict[Node, int] = {}
        """The costs of bodies, with all that they need."""
        self._nodes: dict[Node, list[_Priced]] = {}
        """The nodes of each body, operands before users."""
        self._outside: dict[Node, frozenset[Node]] = {}
        """The nodes of each body that depend on nothing inside it, and come before the call."""
        self._left: dict[tuple[Node, tuple[Node | bool, ...]], int] = {}
        """The cost of what is left, by the body and what is known of each argument.

        That is a constant itself, or whether the argument is the same all over the draw.
        """

    def is_worth_calling(self, call: Node) -> bool:
        """True if a call is better than its body written out."""
        body, *arguments = call.operands
        if self._is_trivial(body):
            return False
        known = tuple([a if a.op == "constant" else a in self._constant for a in arguments])
        if not any(known):
            return True
        formals = formals_of(call)
        whole = self._price(body, formals, (False,) * len(known))
        return self._price(body, formals, known) > max(TRIVIAL, WORTHWHILE * whole)

    def _price(self, body: Node, formals: Formals, known: tuple[Node | bool, ...]) -> int:
        """The cost of a call's values for every pixel, if this is known of its arguments."""
        if (body, known) not in self._left:
            given = dict(zip(formals, known, strict=True))
            constants = {f: value for f, value in given.items() if isinstance(value, Node)}
            fixed = {formal for formal, value in given.items() if value is True}
            left = self._simplifier.substituted(body, constants)
            self._left[body, known] = self._varying_cost(left, fixed, self._outside_of(body))
        return self._left[body, known]

    def _outside_of(self, body: Node) -> frozenset[Node]:
        if body not in self._outside:
            outside = [node for node, _, _ in self._priced(body) if not node.variables]
            self._outside[body] = frozenset(outside)
        return self._outside[body]

    def _priced(self, body: Node) -> list[_Priced]:
        if body not in self._nodes:
            self._nodes[body] = [
                (
                    node,
                    operands_of(node),
                    self._cost(node.operands[0]) if node.op == "apply" else cost_of(node),
                )
                for node in visible((body,))
            ]
        return self._nodes[body]

    def _is_trivial(self, body: Node) -> bool:
        if body not in self._trivial:
            self._trivial[body] = cost(body, TRIVIAL) <= TRIVIAL
        return self._trivial[body]

    def _cost(self, body: Node) -> int:
        if body not in self._costs:
            self._costs[body] = cost(body, DEAR)
        return self._costs[body]

    def _varying_cost(self, root: Node, fixed: Container[Formal], outside: Container[Node]) -> int:
        """The cost of nodes that may differ from pixel to pixel, if not computed ``outside``.

        The ``fixed`` variables stand for values that are the same all over the draw.
        """
        varying: set[Node] = set()
        price = 0
        for node, operands, own in self._priced(root):
            is_varying = node.op in VARYING and not (node.op == "formal" and node.data in fixed)
            if is_varying or not varying.isdisjoint(operands):
                varying.add(node)
                if node not in outside:
                    price += own
        return price
