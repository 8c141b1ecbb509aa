"""Path conditions: facts that the conditions of branches imply for values computed behind them.

In ``if x > 0 then 1 / x else 0`` the divisor is positive wherever the quotient is used. ``guard``
and ``simplify`` may rely on this if *all* uses of a node are behind the condition. The node then
has to be computed there, so the select has to become a branch (``KnownOnPath.selects``).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from itertools import islice

from ...stdlib.builtins.facts import Fact
from ...support.frozen import frozen
from ..ir import rulebook
from ..ir.node import Node, Roots
from ..ir.ranges import Ranges
from ..ir.refinements import Refinement, refinements
from ..ir.types import Scalar
from .uniformity import needing_uniform_flow

WIDEST = 24
"""Values between an operand and a condition's; beyond that, nothing is worked out anew."""


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
        """Iterates over this region and those around it, from the inside out."""
        path: Path | None = self
        while path is not None:
            yield path
            path = path.parent


@frozen
class PathRefinement:
    """The fact that a condition around a region implies for a value, and the condition's select."""

    select: Node
    refinement: Refinement


@frozen
class KnownOnPath:
    """The range of a value on a path, and the conditions from which it follows."""

    fact: Fact
    conditions: tuple[PathRefinement, ...]

    @property
    def selects(self) -> Iterator[Node]:
        """The selects that have to become branches, if this is made use of."""
        return (one.select for one in self.conditions)


class PathConditions:
    """The innermost region that encloses all uses of each node."""

    def __init__(self, roots: Roots, ranges: Ranges) -> None:
        self._ranges = ranges
        self._of: dict[int, Path | None] = {}
        self._refined_at: dict[Path, dict[int, list[PathRefinement]]] = {}
        if "select" in roots.ops:
            self._find(roots, needing_uniform_flow(roots.nodes))

    def known(self, user: Node, operand: Node) -> KnownOnPath:
        """The range of ``operand`` where ``user`` is computed.

        A condition may bound the operand itself, or values from which it is computed.
        """
        refined = self._refined(self._of.get(user.id))
        cone = _cone(operand, refined.keys()) if refined else []
        facts: dict[int, Fact] = {}
        used: list[PathRefinement] = []
        for node in cone:
            fact = self._ranges.of(node)
            if any(need.id in facts for need in node.operands):
                needs = self._ranges.needs(node)
                inner = [facts.get(need.id, self._ranges.of(need)) for need in needs]
                fact = fact.meet(self._ranges.derived(node, inner))
            for one in refined.get(node.id, ()):
                fact = fact.meet(one.refinement.fact)
                used.append(one)
            facts[node.id] = fact
        return KnownOnPath(facts.get(operand.id, self._ranges.of(operand)), tuple(used))

    def _refined(self, path: Path | None) -> dict[int, list[PathRefinement]]:
        """The refinements by the conditions around a region, by the id of the bounded value."""
        if path is None or rulebook.AROUND in self._ranges.without:
            return {}
        if path not in self._refined_at:
            refined: dict[int, list[PathRefinement]] = {}
            for step in islice(path.outward(), FARTHEST):
                condition = step.select.operands[0]
                for one in refinements(
                    self._ranges.of, condition, step.holds, self._ranges.without
                ):
                    refined.setdefault(one.about.id, []).append(PathRefinement(step.select, one))
            self._refined_at[path] = refined
        return self._refined_at[path]

    def _find(self, roots: Roots, together: frozenset[int]) -> None:
        """Finds the paths of all nodes; nodes that all pixels reach precede all branches."""
        for root in roots:
            self._of[root.id] = None
        for node in reversed(roots.nodes):
            here = self._of.get(node.id)
            if node.op == "select" and isinstance(node.operands[0].type, Scalar):
                depth = 0 if here is None else here.depth + 1
                inner = [Path(here, node, holds, depth) for holds in (True, False)]
                sides = (here, here) if depth >= DEEPEST else inner
                for operand, path in zip(node.operands, (here, *sides), strict=True):
                    self._use(operand, path)
                continue
            if node.op == "cross" or node.id in together:
                here = None
            for operand in node.operands:
                self._use(operand, here)

    def _use(self, operand: Node, path: Path | None) -> None:
        """Notes one more region in which a value is used."""
        known = self._of.setdefault(operand.id, path)
        if known is not path:
            self._of[operand.id] = _common(known, path)


def _cone(operand: Node, about: Collection[int]) -> list[Node]:
    """The values between ``operand`` and those that some condition bounds, operands first."""
    near: dict[int, Node] = {operand.id: operand}
    front = [operand]
    while front and len(near) < WIDEST:
        front = [o for node in front for o in node.operands if o.id not in near]
        near |= {node.id: node for node in front}
    chosen: dict[int, Node] = {}
    for id_ in sorted(near):
        node = near[id_]
        if id_ in about or any(o.id in chosen for o in node.operands):
            chosen[id_] = node
    return list(chosen.values())


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
