"""Writes a body out where it is used once, or where calling it would cost more than it does."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from ..ir.node import Graph, Node, reachable
from ..ir.rewrite import rewrite
from ..semantics.shader import Notes
from .cost import cost
from .simplify import Simplifier, substitute_through

TRIVIAL = 4
"""Bodies of at most this cost are written out wherever they are used."""


def inline(graph: Graph, roots: Iterable[Node], notes: Notes, simplifier: Simplifier) -> list[Node]:
    """The roots with applies of bodies that are used once replaced by the bodies."""
    wanted = list(roots)
    uses = Counter(node.operands[0].id for node in reachable(wanted) if node.op == "apply")
    if not uses:
        return wanted
    costs: dict[int, int] = {}

    def is_dear(body: Node) -> bool:
        if body.id not in costs:
            costs[body.id] = cost(body)
        return costs[body.id] > TRIVIAL

    def rule(_graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        if uses[node.operands[0].id] > 1 and is_dear(operands[0]):
            return None
        assert isinstance(node.data, tuple)
        replacements = dict(zip(node.data, operands[1:], strict=True))
        body = operands[0]

        def follow(old: Node, new: Node) -> None:
            # A call may be the whole of another function, whose name and doc then hold.
            whole = old is body and node.id in notes.functions
            notes.follow(node if whole else old, new)

        return substitute_through(simplifier, body, replacements, follow)

    return rewrite(graph, wanted, rule, notes.follow, ("apply",))
