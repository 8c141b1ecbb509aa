"""Estimates the cost of an evaluation in operations, before it begins.

Those who draw pictures and run kernels of sources that anybody may have written multiply this by
the number of pixels or elements, and refuse work that would not end. A loop counts as often as its
bound says: that is known of every loop. An operation with vectors or matrices counts as often as
they have numbers, and one that takes longer as often as simpler ones fit into its time: two units
for one pixel are about a nanosecond, which is one of the operations that are limited.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ..budget import check
from ..ir.node import Node, binders, bodies_of, formals_of, reachable
from ..ir.operations import FOLD, ITERATE
from ..ir.types import TextureType, numbers

CALL = 1 << 12
"""The cost of calling an operation of NumPy beside its work, in numbers that it computes with."""
_STEP = 2
"""The cost of an operation beside the numbers that it reads and makes."""
_READ = 100
"""The cost of a texture read: it blends several texels, and has to find each."""
_SLOW = {"inverse": 6, "determinant": 3}
"""The factor for functions of matrices that look at each number more than once."""
_PARTS = ("swizzle", "member")
"""Operations that only pick something of a value, however large it is."""


class _Cost(NamedTuple):
    """The cost of a node with bodies, besides its own operation."""

    inside: int
    """The cost of its bodies, in all iterations."""
    outside: tuple[Node, ...]
    """The nodes in its bodies that depend on none of its variables, and so are computed once."""


def check_operations(roots: Sequence[Node], lanes: int, name: str) -> None:
    """Checks that it does not take too long to compute these nodes for so many lanes at once.

    Raises ``BudgetError`` before anybody is told how far the work is.
    """
    check("operations", operations(roots) * (CALL + lanes) // 2, f"`{name}` takes")


def operations(roots: Sequence[Node], usual_turns: int | None = None) -> int:
    """The largest cost of evaluating these nodes, for one pixel.

    With ``usual_turns`` it is an estimate: loops whose number of turns is not known before they run
    have at most that many.
    """
    costs: dict[int, _Cost] = {}
    for node in reachable(roots):  # Operands come first, and so do inner loops.
        if bodies_of(node):
            costs[node.id] = _cost_of(node, costs, usual_turns)
    return _walk(roots, costs, None).inside


def _cost_of(node: Node, costs: dict[int, _Cost], usual_turns: int | None) -> _Cost:
    inside = bodies_of(node)
    once = _walk(node.operands[inside.start : inside.stop], costs, node)
    turns = _turns(node)
    if usual_turns is not None and not _has_known_turns(node):
        turns = min(turns, usual_turns)
    return _Cost((once.inside + _STEP + numbers(node.type)) * turns, once.outside)


def _weight(node: Node) -> int:
    """The cost of a node by itself, without its bodies."""
    if not node.operands:
        return 1
    if any(isinstance(operand.type, TextureType) for operand in node.operands):
        return _READ
    read = () if node.op in _PARTS or bodies_of(node) else node.operands
    moved = numbers(node.type) + sum(numbers(operand.type) for operand in read)
    slower = _SLOW.get(str(node.data), 1) if node.op == "call" else 1
    return _STEP + moved * slower


def _turns(node: Node) -> int:
    """The largest number of evaluations of a node's bodies."""
    if node.op == "fold":
        return FOLD.data(node).bound
    return ITERATE.data(node).bound if node.op == "iterate" else 1


def _has_known_turns(node: Node) -> bool:
    """True for a fold whose count is a constant; other loops may have fewer turns than allowed."""
    return node.op == "fold" and node.operands[0].op == "constant"


def _walk(roots: Sequence[Node], costs: dict[int, _Cost], binder: Node | None) -> _Cost:
    """The cost of one evaluation of nodes under a binder; without one, of all that is left."""
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
        count += _weight(node)
        if inside:
            count += costs[node.id].inside
            pending += costs[node.id].outside
        pending += node.operands[: inside.start] if inside else node.operands
        pending += node.operands[inside.stop :] if inside else ()
    return _Cost(count, tuple(outside))


def _is_under(node: Node, binder: Node) -> bool:
    """True if a node in the body of a binder is computed anew in each of its iterations.

    ``Evaluator`` finds its home in the same way.
    """
    if node.free:
        return True
    return not binders(binder) and not node.variables.isdisjoint(formals_of(binder))
