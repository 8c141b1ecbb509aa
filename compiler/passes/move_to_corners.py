"""Moves work on one corner of a primitive to the stage before, which does it once for each vertex.

A geometry or evaluation stage reads what the stage before has at corner ``k`` of a primitive or a
patch. ``f`` of that is what ``f`` of the value is at the corner, for any ``f`` and exactly; but the
vertex is computed once, and read by several primitives and at several vertices of each. The pass
moves work only if no more numbers cross for it. It comes after ``move_to_vertices``, whose values
it often takes further, and after ``hoist``.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ...frozen import fresh, frozen, record
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
    """Values of the stage before that are read together, and what would cross if work moved."""

    sources: dict[int, int] = fresh(factory=dict)
    """The lanes of the values that cross now, by their nodes' ids."""
    results: dict[object, int] = fresh(factory=dict)
    """The lanes of what would cross instead, by what is computed."""
    work: list[int] = fresh(factory=list)
    """The ids of what would move."""

    def join(self, other: _Family) -> None:
        """Take what another family has; the results are not known yet."""
        self.sources.update(other.sources)
        self.work += other.work

    @property
    def pays(self) -> bool:
        """Whether no more numbers cross if its work moves."""
        return sum(self.results.values()) <= sum(self.sources.values())


class _Corners:
    """Finds out what is worth moving."""

    def __init__(self, roots: Roots) -> None:
        self._roots = roots
        self._constant = DrawConstants()
        self._places: dict[int, _Place] = {}
        self._computed: dict[int, object] = {}
        """What nodes at corners compute: equal for equal values of different corners."""
        self._families: dict[int, _Family] = {}

    def moved(self) -> frozenset[int]:
        """The ids of the nodes that are to be computed in the stage before."""
        for node in self._roots.nodes:
            self._look_at(node)
        for node in self._ends():
            self._families[node.id].results[self._computed[node.id]] = _lanes(node)
        families = {id(family): family for family in self._families.values()}
        paying = [family for family in families.values() if family.pays]
        return frozenset(node for family in paying for node in family.work)

    def _look_at(self, node: Node) -> None:
        """Find the corner that a value is of, if it is of one only; operands come before users."""
        if _is_corner(node):
            value, number = node.operands
            self._places[node.id] = _Place(CROSS.data(node), number.id)
            self._computed[node.id] = value.id
            self._families[node.id] = self._family([value.id])
            self._families[node.id].sources[value.id] = _lanes(value)
            self._families[value.id] = self._families[node.id]
        elif self._may_move(node):
            varying = self._varying(node)
            self._places[node.id] = self._places[varying[0].id]
            parts = (self._computed.get(operand.id, -operand.id) for operand in node.operands)
            self._computed[node.id] = (node.op, node.type, node.data, *parts)
            self._families[node.id] = self._family([operand.id for operand in varying])
            self._families[node.id].work.append(node.id)

    def _may_move(self, node: Node) -> bool:
        if node.op not in MOVED or scalar_kind(node.type) != "float":
            return False
        if node.op == "swizzle" and len(set(SWIZZLE.data(node))) < len(SWIZZLE.data(node)):
            return False
        varying = self._varying(node)
        places = [self._places.get(operand.id) for operand in varying]
        return bool(places) and places[0] is not None and len(set(places)) == 1

    def _varying(self, node: Node) -> list[Node]:
        return [operand for operand in node.operands if operand not in self._constant]

    def _family(self, ids: Sequence[int]) -> _Family:
        """The one family of some nodes, which so far may have had several."""
        known = [self._families[each] for each in ids if each in self._families]
        if not known:
            return _Family()
        first = known[0]
        for other in known[1:]:
            if other is not first:
                first.join(other)
                for each in [key for key, value in self._families.items() if value is other]:
                    self._families[each] = first
        return first

    def _ends(self) -> Iterable[Node]:
        """The values of corners that something else reads."""
        read = {root.id for root in self._roots}
        for node in self._roots.nodes:
            if node.id not in self._places or _is_corner(node):
                read.update(operand.id for operand in node.operands)
        return [n for n in self._roots.nodes if n.id in read and n.id in self._places]


def _lanes(node: Node) -> int:
    """How many numbers cross for a value; only scalars and vectors do."""
    return width(node.type) if isinstance(node.type, Scalar | Vector) else 0


def _is_corner(node: Node) -> bool:
    """Whether a node is what one corner of a primitive has."""
    return node.op == "cross" and CROSS.data(node).mode == "corner"
