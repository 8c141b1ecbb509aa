"""What conditions tell about values on the paths that they guard.

In ``if x > 0 then 1 / x else 0`` the divisor is known to be positive wherever the quotient is used.
That holds for a node only if *all* of its uses lie behind the condition, and helps only if the node
is computed there: so the select has to become a branch, which ``Path.selects`` are marked for.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from ...frozen import frozen
from ...stdlib.builtins.facts import SMALLEST_NORMAL, UNKNOWN, Fact
from ..ir.node import Node, reachable
from ..ir.ranges import Ranges
from ..ir.types import Scalar
from .arithmetic import OPPOSITES
from .uniformity import needing_uniform_flow

FARTHEST = 16
"""Conditions looked at on the way out; farther ones rarely say anything more."""


DEEPEST = 32
"""Branches inside of branches, beyond which both sides are computed: front ends have limits too."""


@frozen(eq=False)
class Path:
    """The region behind one side of a select."""

    parent: Path | None
    select: Node
    holds: bool
    depth: int

    def outward(self) -> Iterator[Path]:
        """This region and those around it."""
        path: Path | None = self
        while path is not None:
            yield path
            path = path.parent


class Paths:
    """The innermost region that encloses all uses of each node."""

    def __init__(self, roots: Iterable[Node], ranges: Ranges) -> None:
        self._ranges = ranges
        self._of: dict[int, Path | None] = {}
        wanted = list(roots)
        nodes = reachable(wanted)
        if any(node.op == "select" for node in nodes):
            self._find(wanted, nodes, needing_uniform_flow(wanted))

    def known(self, user: Node, operand: Node) -> tuple[Fact, tuple[Node, ...]]:
        """What holds of ``operand`` where ``user`` is computed, and the selects that say so."""
        path = self._of.get(user.id)
        fact = UNKNOWN
        selects: list[Node] = []
        for step in path.outward() if path is not None else ():
            if len(selects) == FARTHEST:
                break
            learnt = self._learnt(step.select.operands[0], step.holds, operand)
            if learnt is not UNKNOWN:
                fact = fact.meet(learnt)
                selects.append(step.select)
        return fact, tuple(selects)

    def _find(self, roots: list[Node], nodes: list[Node], together: frozenset[int]) -> None:
        """Paths of all nodes; what needs all pixels, and its operands, come before all branches."""
        for root in roots:
            self._of[root.id] = None
        for node in reversed(nodes):
            here = self._of.get(node.id)
            sides: list[Path | None] = [here] * len(node.operands)
            if node.op == "select" and isinstance(node.operands[0].type, Scalar):
                depth = 0 if here is None else here.depth + 1
                if depth < DEEPEST:
                    sides[1:] = [Path(here, node, holds, depth) for holds in (True, False)]
            elif node.op == "interpolate" or node.id in together:
                sides = [None] * len(node.operands)
            for operand, path in zip(node.operands, sides, strict=True):
                known = operand.id in self._of
                self._of[operand.id] = _common(self._of[operand.id], path) if known else path

    def _learnt(self, condition: Node, holds: bool, about: Node) -> Fact:
        """What ``condition`` being ``holds`` says about a value."""
        fact = UNKNOWN
        pending = [(condition, holds)]
        while pending:
            node, truth = pending.pop()
            if node.op not in ("call", "native"):
                continue
            name = str(node.data)
            if name == "not":
                pending.append((node.operands[0], not truth))
            elif (name, truth) in (("and", True), ("or", False)):
                pending.extend((operand, truth) for operand in node.operands)
            elif name in OPPOSITES and about in node.operands:
                fact = fact.meet(self._compared(name if truth else OPPOSITES[name], node, about))
        return fact

    def _compared(self, name: str, node: Node, about: Node) -> Fact:
        left, right = node.operands
        if about is right:
            name, left, right = _MIRRORED[name], right, left
        bound = self._ranges.of(right)
        match name:
            case "gt":
                return Fact(bound.lo, math.inf, nonzero=bound.lo >= 0)
            case "lt":
                return Fact(-math.inf, bound.hi, nonzero=bound.hi <= 0)
            case "ge":
                return Fact(bound.lo, math.inf, nonzero=bound.lo >= SMALLEST_NORMAL)
            case "le":
                return Fact(-math.inf, bound.hi, nonzero=bound.hi <= -SMALLEST_NORMAL)
            case "eq":
                return bound
            case _:
                return Fact(nonzero=True) if (bound.lo, bound.hi) == (0.0, 0.0) else UNKNOWN


_MIRRORED = {"lt": "gt", "gt": "lt", "le": "ge", "ge": "le", "eq": "eq", "ne": "ne"}


def _common(left: Path | None, right: Path | None) -> Path | None:
    """The innermost region around both."""
    while left is not right:
        if left is None or right is None:
            return None
        if left.depth >= right.depth:
            left = left.parent
        else:
            right = right.parent
    return left
