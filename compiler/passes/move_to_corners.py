"""Moves work on one corner of a primitive to the stage before, which does it once for each vertex.

A geometry or evaluation stage reads values of the stage before at corner ``k`` of a primitive or a
patch. ``f`` of such a value is the same as the value of ``f`` at the corner, for any ``f`` and
exactly; but the vertex is computed once, and read by several primitives and at several vertices of
each. The pass moves work only if no more numbers cross for it. It comes after ``move_to_vertices``,
whose values it often takes further, and after ``hoist``.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from ...support.frozen import fresh, frozen, record
from ..ir import build
from ..ir.node import Graph, Node, Roots
from ..ir.operations import BUILTIN_OPS, CROSS, SWIZZLE
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.stages import Crossing
from ..ir.types import Scalar, Vector, scalar_kind, width
from .draw_constants import DrawConstants
from .naming import Naming

MOVED = BUILTIN_OPS | {"swizzle"}
"""The operations that can be done in either stage."""


def move_to_corners(graph: Graph, roots: Roots, notes: Notes) -> Roots:
    """The roots with such values computed before they cross."""
    if not any(_is_corner(node) for node in roots.nodes):
        return roots
    moved = _Corners(roots).moved()
    naming = Naming(notes)
    naming.learn(reversed(roots.nodes))

    def rule(graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        if node.id not in moved:
            return None
        crossing = next(operand for operand in operands if operand.op == "cross")
        inner = (operand.operands[0] if operand.op == "cross" else operand for operand in operands)
        value = graph.node(node.op, node.type, tuple(inner), node.data)
        result = build.at_corner(graph, value, crossing.operands[1], CROSS.data(crossing))
        notes.names.setdefault(result.id, naming.name(node))
        return result

    return rewrite(graph, roots, rule, notes.follow, MOVED) if moved else roots


@frozen
class _Place:
    """A corner, and how values get from it."""

    crossing: Crossing
    number: int
    """The ``id`` of the node that says which corner."""


@record
class _Family:
    """Values of the stage before that are read together, and the values to cross in their place.

    A value that two later stages read crosses into the first of them for both, so all values that
    either of them computes of it belong to one family.
    """

    sources: dict[int, int] = fresh(factory=dict)
    """The lanes of the values that cross now, by their nodes' ids."""
    results: dict[int, int] = fresh(factory=dict)
    """The lanes of the values that would cross instead, by their value numbers."""
    work: list[int] = fresh(factory=list)
    """The ids of the nodes that would move."""
    within: _Family | None = None
    """The family that this one has become a part of."""

    @property
    def whole(self) -> _Family:
        """The family that has all that this one was joined with."""
        whole = self
        while whole.within is not None:
            whole = whole.within
        if whole is not self:
            self.within = whole
        return whole

    def join(self, other: _Family) -> _Family:
        """The family with the sources and the work of both; the results are not known yet."""
        small, large = sorted((self.whole, other.whole), key=lambda family: len(family.work))
        if small is not large:
            large.sources.update(small.sources)
            large.work += small.work
            small.within = large
        return large

    @property
    def pays(self) -> bool:
        """True if moving the work does not make more numbers cross between the stages."""
        return sum(self.results.values()) <= sum(self.sources.values())


class _Corners:
    """Finds work that is worth moving."""

    def __init__(self, roots: Roots) -> None:
        self._roots = roots
        self._constant = DrawConstants()
        self._places: dict[int, _Place] = {}
        self._computed: dict[int, int] = {}
        """The results of nodes at corners, as value numbers: equal for equal work elsewhere."""
        self._numbers: dict[object, int] = {}
        self._families: dict[int, _Family] = {}
        """The families of nodes at corners, and of the values that cross."""

    def moved(self) -> frozenset[int]:
        """The ids of the nodes that are to be computed in the stage before."""
        for node in self._roots.nodes:
            self._look_at(node)
        for node in self._ends():
            self._families[node.id].whole.results[self._computed[node.id]] = _lanes(node)
        families = {id(family.whole): family.whole for family in self._families.values()}
        paying = [family for family in families.values() if family.pays]
        return frozenset(node for family in paying for node in family.work)

    def _look_at(self, node: Node) -> None:
        """Find the corner that a value is of, if it is of one only; operands come before users."""
        if _is_corner(node):
            value, number = node.operands
            self._places[node.id] = _Place(CROSS.data(node), number.id)
            self._computed[node.id] = self._number(value.id)
            family = self._families.setdefault(value.id, _Family())
            family.whole.sources[value.id] = _lanes(value)
            self._families[node.id] = family
        elif _is_movable(node):
            varying = [operand for operand in node.operands if operand not in self._constant]
            places = {self._places.get(operand.id) for operand in varying}
            place = places.pop() if len(places) == 1 else None
            if place is None:
                return
            self._places[node.id] = place
            parts = [self._value(operand) for operand in node.operands]
            self._computed[node.id] = self._number((node.op, node.type, node.data, *parts))
            family = reduce(_Family.join, (self._families[operand.id] for operand in varying))
            family.whole.work.append(node.id)
            self._families[node.id] = family

    def _value(self, node: Node) -> int:
        return self._computed[node.id] if node.id in self._computed else self._number(node.id)

    def _number(self, what: object) -> int:
        """A number for each different thing, as comparing the values of a long chain takes long."""
        return self._numbers.setdefault(what, len(self._numbers))

    def _ends(self) -> Iterable[Node]:
        """The values of corners that something else reads."""
        read = {root.id for root in self._roots}
        for node in self._roots.nodes:
            if node.id not in self._places or _is_corner(node):
                read.update(operand.id for operand in node.operands)
        return [n for n in self._roots.nodes if n.id in read and n.id in self._places]


def _lanes(node: Node) -> int:
    """The number of floats that cross for a value; only scalars and vectors do."""
    return width(node.type) if isinstance(node.type, Scalar | Vector) else 0


def _is_movable(node: Node) -> bool:
    """True if either stage can do an operation; a swizzle must not repeat lanes."""
    if node.op not in MOVED or scalar_kind(node.type) != "float":
        return False
    return node.op != "swizzle" or len(set(SWIZZLE.data(node))) == len(SWIZZLE.data(node))


def _is_corner(node: Node) -> bool:
    """True if a node is a value at one corner of a primitive."""
    return node.op == "cross" and CROSS.data(node).mode == "corner"
