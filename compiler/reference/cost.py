"""Counts how many operations an evaluation takes, before it begins.

Those who draw pictures and run kernels of sources that anybody may have written multiply this by
the number of pixels or elements, and refuse what would not end. A loop counts as often as its
bound says: that is known of every loop.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ..budget import check
from ..ir.node import Node, binders, bodies_of, formals_of, reachable
from ..ir.operations import FOLD, ITERATE

_CALL = 1 << 12
"""What calling an operation of NumPy costs beside its work, in numbers that it computes with."""


class _Cost(NamedTuple):
    """What a node with bodies takes besides its own operation."""

    inside: int
    """How many operations its bodies take, in all turns."""
    outside: tuple[Node, ...]
    """What its bodies use that hangs on none of its variables, and so is computed once."""


def check_operations(roots: Sequence[Node], lanes: int, name: str) -> None:
    """Raise ``BudgetError`` if it takes too long to compute these nodes for so many pixels,
    vertices or elements at once, before anybody is told how far it is."""
    check("operations", operations(roots) * (_CALL + lanes), f"`{name}` takes")


def operations(roots: Sequence[Node]) -> int:
    """How many operations the evaluator computes at most for the values of these nodes."""
    costs: dict[int, _Cost] = {}
    for node in reachable(roots):  # Operands come first, and so do inner loops.
        if bodies_of(node):
            costs[node.id] = _cost_of(node, costs)
    return _walk(roots, costs, None).inside


def _cost_of(node: Node, costs: dict[int, _Cost]) -> _Cost:
    inside = bodies_of(node)
    once = _walk(node.operands[inside.start : inside.stop], costs, node)
    return _Cost(once.inside * _turns(node), once.outside)


def _turns(node: Node) -> int:
    """How often the bodies of a node are evaluated at most."""
    if node.op == "fold":
        return FOLD.data(node).bound
    return ITERATE.data(node).bound if node.op == "iterate" else 1


def _walk(roots: Sequence[Node], costs: dict[int, _Cost], binder: Node | None) -> _Cost:
    """What one evaluation takes of nodes under a binder; without one, of all that is left."""
    pending, seen, outside, count = list(roots), set[int](), [], 0
    while pending:
        node = pending.pop()
        if node.id in seen:
            continue
        seen.add(node.id)
        if binder is not None and not _is_under(node, binder):
            outside.append(node)
            continue
        inside = bodies_of(node)
        count += 1
        if inside:
            count += costs[node.id].inside
            pending += costs[node.id].outside
        pending += node.operands[: inside.start] if inside else node.operands
        pending += node.operands[inside.stop :] if inside else ()
    return _Cost(count, tuple(outside))


def _is_under(node: Node, binder: Node) -> bool:
    """Whether a node in the body of a binder is computed anew in each of its turns, as
    ``Evaluator`` finds its home."""
    if node.free:
        return True
    return not binders(binder) and not node.variables.isdisjoint(formals_of(binder))
