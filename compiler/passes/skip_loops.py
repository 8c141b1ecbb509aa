"""Makes choices of products and mixtures with loops whose weight may be zero for a whole draw.

``w * sum`` is zero where ``w`` is, and ``mix(a, sum, w)`` is ``a``: that is their meaning. Where
``w`` is the same for all pixels, ``if w != 0 then w * sum else 0`` has the same value, and
``schedule`` makes a branch of it, so that a draw with a weight of zero does not run the loop.
``pipeline.py`` calls this before guards are decided. Where the loop is short, or the weight hardly
ever zero, the choice would take more than it saves: ``loop_prices.py`` decides. Values without
loops are left as they are.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from ...support.frozen import cached_property
from ..ir import build
from ..ir.leaves import Number, Parameter
from ..ir.node import Graph, Node, Roots
from ..ir.operations import builtin_of
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.types import BOOL, FLOAT, width
from ..ir.walks import operands_of, visible
from .draw_constants import DrawConstants

if TYPE_CHECKING:
    from .loop_prices import LoopPrices


def skip_loops(
    graph: Graph, roots: Roots, notes: Notes, ranges: Ranges, defaults: Mapping[Parameter, Number]
) -> Roots:
    """The roots with choices in place of products and mixtures with loops, where these pay.

    ``defaults`` are the numbers that parameters have unless a host sets others.
    """
    bodies = dict.fromkeys(node.operands[0] for node in roots.nodes if node.op == "apply")
    weights = _Weights(ranges, defaults)
    chosen = {
        node: weight
        for body in (tuple(roots), *((body,) for body in bodies))
        for node, weight in weights.found(body)
    }

    def rule(graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        if node not in chosen:
            return None
        zero = build.constant(graph, FLOAT, 0.0)
        condition = graph.node("call", BOOL, (chosen[node], zero), "ne")
        value = graph.node(node.op, node.type, operands, node.data)
        lanes = width(node.type)
        # The condition and the inner value get statements of their own, which have places, too.
        for made in (condition, value):
            if node.id in notes.spans:
                notes.spans.setdefault(made.id, notes.spans[node.id])
        nothing = build.constant(graph, node.type, 0.0 if lanes == 1 else (0.0,) * lanes)
        other = operands[0] if builtin_of(node) == "mix" else nothing
        return graph.node("select", node.type, (condition, value, other))

    return rewrite(graph, roots, rule, notes.follow) if chosen else roots


class _Weights:
    """Finds weights that may be zero, and are the same all over a draw."""

    def __init__(self, ranges: Ranges, defaults: Mapping[Parameter, Number]) -> None:
        self._ranges = ranges
        self._defaults = defaults
        self._constant = DrawConstants()

    @cached_property
    def _prices(self) -> LoopPrices:
        """The prices of loops: few shaders have a weight, so that the others do not load this."""
        from .loop_prices import LoopPrices

        return LoopPrices(self._defaults)

    def found(self, roots: tuple[Node, ...]) -> Iterator[tuple[Node, Node]]:
        """Yields the products and mixtures of one body that skip a loop, with their weights."""
        order = visible(roots)
        users: dict[Node, list[Node]] = {}
        for node in order:
            for operand in operands_of(node):
                users.setdefault(operand, []).append(node)
        weights: dict[Node, Node] = {}
        for node in order:
            if node.op == "call" and (weight := self._weight_of(node, weights)) is not None:
                weights[node] = weight
        uses = Counter({node: len(found) for node, found in users.items()})
        for node, weight in weights.items():
            is_mixture = builtin_of(node) == "mix"
            # The product around it has the same weight, and skips more.
            is_part = not is_mixture and any(
                builtin_of(user) == "mul" and user in weights for user in users.get(node, ())
            )
            skipped = node.operands[1:2] if is_mixture else node.operands
            if not is_part and self._prices.pays(weight, skipped, uses):
                yield node, weight

    def _weight_of(self, node: Node, known: dict[Node, Node]) -> Node | None:
        """The weight of a mixture, or the factor of a product that is most likely to be zero."""
        name = builtin_of(node)
        if name == "mix":
            return node.operands[2] if self._is_weight(node.operands[2]) else None
        if name != "mul":
            return None
        weights = [
            operand if self._is_weight(operand) else known[operand]
            for operand in node.operands
            if self._is_weight(operand) or (builtin_of(operand) == "mul" and operand in known)
        ]
        return max(weights, key=self._prices.chance) if weights else None

    def _is_weight(self, node: Node) -> bool:
        """True if a float is not below zero, may be zero, and is the same all over a draw."""
        if node.type != FLOAT or node.op == "constant" or node not in self._constant:
            return False
        fact = self._ranges.of(node)
        return fact.lo == 0 < fact.hi
