"""Rebuilds a graph from the bottom up, each node once, without recursion; most passes call this."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable

from .binding import Moved
from .node import Graph, Node, Roots

Rule = Callable[[Graph, Node, tuple[Node, ...]], Node | None]
"""``(graph, node, new_operands) -> replacement``; ``None`` keeps the operation as it is."""


def rewrite(
    graph: Graph,
    roots: Iterable[Node],
    rule: Rule,
    moved: Moved | None = None,
    ops: Container[str] | None = None,
    nodes: Iterable[Node] | None = None,
    new: dict[Node, Node] | None = None,
) -> Roots:
    """The roots, rebuilt with ``rule`` applied to every node they need, operands before users.

    A rule for some operations only names them: ``ops``. Where a caller knows that all other nodes
    stay as they are, it names ``nodes``, operands before users. If nothing changes, these are the
    roots that were given.

    ``new`` holds the new forms of nodes, if a caller remembers them from one call to the next, and
    gets those of this call.

    Bodies of folds and applies are ordinary operands here. A replacement therefore stands under the
    same binders as the node that it replaces and may use the same ``bound`` variables, no others.
    """
    wanted = roots if isinstance(roots, Roots) else Roots(roots)
    if ops is not None and nodes is None and not any(op in ops for op in wanted.ops):
        return wanted
    new = {} if new is None else new
    changed = new.keys()
    for node in wanted.nodes if nodes is None else nodes:
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
    return wanted if changed.isdisjoint(wanted) else Roots(map(new.get, wanted, wanted))
