"""Estimates the cost of calls, and of their bodies in their place: ``inline`` decides by it.

A call with constant arguments may leave little of a body. So the price of such a call is found by
putting these arguments in, and counting what is left.
"""

from __future__ import annotations

from collections.abc import Container

from ..ir.node import Formals, Node, formals_of
from ..ir.operations import VARYING
from .cost import cost, cost_of
from .draw_constants import DrawConstants
from .simplify import Simplifier
from .walks import operands_of, visible

TRIVIAL = 4
"""Bodies of at most this cost are written out wherever they are used."""

WORTHWHILE = 0.5
"""A call that computes no more than this share of its body for its own arguments is written out."""

DEAR = 1024
"""The limit of a body's price: more expensive bodies are alike.

The cost of a body around such a call is mainly that of the call.
"""


class CallPrices:
    """Costs of bodies, and of the rest of a body for the arguments of a call."""

    def __init__(self, simplifier: Simplifier) -> None:
        self._simplifier = simplifier
        self._constant = DrawConstants()
        self._trivial: dict[Node, bool] = {}
        self._costs: dict[Node, int] = {}
        """The costs of bodies, with all that they need."""
        self._outside: dict[Node, frozenset[int]] = {}
        """The nodes of each body that depend on nothing inside it, and come before the call."""
        self._left: dict[tuple[int, tuple[Node | None, ...]], int] = {}
        """The cost of what is left, by the body and the arguments that are put in."""

    def is_worth_calling(self, call: Node) -> bool:
        """True if a call is better than its body written out."""
        body, *arguments = call.operands
        if self._is_trivial(body):
            return False
        fixed = tuple(a if a in self._constant else None for a in arguments)
        if not any(fixed):
            return True
        formals = formals_of(call)
        whole = self._price(body, formals, (None,) * len(fixed))
        return self._price(body, formals, fixed) > max(TRIVIAL, WORTHWHILE * whole)

    def _price(self, body: Node, formals: Formals, fixed: tuple[Node | None, ...]) -> int:
        """The cost of a call's values for every pixel, if these arguments are put in."""
        if (body.id, fixed) not in self._left:
            pairs = zip(formals, fixed, strict=True)
            known = {formal: value for formal, value in pairs if value is not None}
            left = self._simplifier.substituted(body, known)
            self._left[body.id, fixed] = self._varying_cost(left, self._outside_of(body))
        return self._left[body.id, fixed]

    def _outside_of(self, body: Node) -> frozenset[int]:
        if body not in self._outside:
            nodes = visible((body,))
            self._outside[body] = frozenset(node.id for node in nodes if not node.variables)
        return self._outside[body]

    def _is_trivial(self, body: Node) -> bool:
        if body not in self._trivial:
            self._trivial[body] = cost(body, TRIVIAL) <= TRIVIAL
        return self._trivial[body]

    def _cost(self, body: Node) -> int:
        if body not in self._costs:
            self._costs[body] = cost(body, DEAR)
        return self._costs[body]

    def _varying_cost(self, root: Node, outside: Container[int]) -> int:
        """The cost of nodes that may differ from pixel to pixel, if not computed ``outside``."""
        varying: set[Node] = set()
        price = 0
        for node in visible((root,)):
            if node.op in VARYING or not varying.isdisjoint(operands_of(node)):
                varying.add(node)
                if node.id not in outside:
                    called = node.op == "apply"
                    price += self._cost(node.operands[0]) if called else cost_of(node)
        return price
