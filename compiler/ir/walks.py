"""Lists the nodes that a stage or a function computes itself, in order.

Nodes behind a crossing belong to an earlier stage, and those in a function's body to the function.
"""

from __future__ import annotations

from collections.abc import Iterable

from .node import AGE, Node

_PARTLY = frozenset({"apply", "cross"})
"""Operations of which a body does not compute the first operand itself."""


def operands_of(node: Node) -> tuple[Node, ...]:
    """The operands that a body computes itself.

    A called function's body is none, nor is the operand of a crossing, which an earlier stage has
    computed; but the number of the corner of a crossing is one.
    """
    return node.operands[1:] if node.op in _PARTLY else node.operands


def visible(roots: Iterable[Node], *, into_bodies: bool = False) -> list[Node]:
    """All nodes that a stage computes for ``roots``, operands before users.

    The bodies of functions that are called belong to it ``into_bodies``.
    """
    seen = set(roots)
    found = list(seen)
    for node in found:  # The list grows on the way.
        is_whole = node.op not in _PARTLY or (into_bodies and node.op == "apply")
        for operand in node.operands if is_whole else operands_of(node):
            if operand not in seen:
                seen.add(operand)
                found.append(operand)
    found.sort(key=AGE)
    return found


def in_order_of_use(roots: Iterable[Node], *, of_all: bool = False) -> list[Node]:
    """The nodes that roots need, each as late as its first use allows, as a person writes them.

    The order follows from the roots alone. Those that a body does not compute itself are among them
    only if the order is to be ``of_all``.
    """
    order: dict[int, Node] = {}
    pending: list[tuple[Node, bool]] = [(root, False) for root in reversed(list(roots))]
    while pending:
        node, ready = pending.pop()
        if ready:
            order.setdefault(node.id, node)
        elif node.id not in order:
            operands = node.operands if of_all else operands_of(node)
            if not operands:
                order[node.id] = node
                continue
            pending.append((node, True))
            pending += [(operand, False) for operand in reversed(operands)]
    return list(order.values())


def called_functions(nodes: Iterable[Node]) -> list[Node]:
    """One call of each function among the nodes of a stage, callees before callers."""
    first: dict[Node, Node] = {}
    for node in nodes:
        if node.op == "apply":
            first.setdefault(node.operands[0], node)
    return list(first.values())
