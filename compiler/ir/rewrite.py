"""Rebuilds a graph from the bottom up, each node once, without recursion; most passes call this."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable

from .binding import Moved
from .node import Graph, Node, reachable

Rule = Callable[[Graph, Node, tuple[Node, ...]], Node | None]
"""``(graph, node, new_operands) -> replacement``; ``None`` keeps the operation as it is."""


def rewrite(
    graph: Graph,
    roots: Iterable[Node],
    rule: Rule,
    moved: Moved | None = None,
    ops: Container[str] | None = None,
    nodes: Iterable[Node] | None = None,
) -> list[Node]:
    """The roots, rebuilt with ``rule`` applied to every node they need, operands before users.

    A rule that has something to say of some operations only names them: ``ops``. ``nodes`` are all
    that the roots need (``reachable``), where a pass has looked at them already.

    Bodies of folds and applies are ordinary operands here. A replacement therefore stands under
    the same binders as what it replaces and may use the same ``bound`` variables, no others.
    """
    wanted = list(roots)
    new: dict[Node, Node] = {}
    """What became of the nodes that changed."""
    changed = new.keys()
    for node in reachable(wanted) if nodes is None else nodes:
        operands = node.operands
        if not changed.isdisjoint(operands):
            operands = tuple(map(new.get, operands, operands))
        replacement = rule(graph, node, operands) if ops is None or node.op in ops else None
        if replacement is None:
            if operands is node.operands:
                continue
            replacement = graph.node(node.op, node.type, operands, node.data)
        if replacement is not node:
            new[node] = replacement
            if moved is not None:
                moved(node, replacement)
    return [new.get(root, root) for root in wanted]
