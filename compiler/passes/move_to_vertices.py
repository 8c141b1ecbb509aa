"""Moves affine work from the fragment stage to the vertex stage if the picture stays the same.

Interpolation uses weights whose sum is one, and therefore commutes with affine maps: if ``a`` and
``b`` are the same all over the draw, ``cross(e) * a + b`` equals ``cross(e * a + b)``. The pass
moves work only if this adds no varying, that is, if all uses of a crossing go through one affine
value that is not wider.
"""

from __future__ import annotations

from ..ir import build
from ..ir.leaves import Attribute
from ..ir.node import Graph, Node, Roots
from ..ir.operations import BUILTIN_OPS, CROSS, SWIZZLE, builtin_of
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.types import Scalar, Vector, width
from .draw_constants import DrawConstants

AFFINE = {"mul": "scaled", "add": "shifted", "sub": "shifted", "neg": "negated"}
"""Builtins that are affine in one operand, and the word for their result."""


def move_to_vertices(graph: Graph, roots: Roots, notes: Notes) -> Roots:
    """The roots with affine values of single crossings computed before the crossing."""
    if not any(_is_affine(node) and _crosses(node) for node in roots.nodes):
        return roots
    return rewrite(
        graph, roots, _Moving(roots, notes).rule, notes.follow, BUILTIN_OPS | {"swizzle"}
    )


class _Moving:
    def __init__(self, roots: Roots, notes: Notes) -> None:
        self._notes = notes
        self._users: dict[int, int] = {root.id: 1 for root in roots}
        self._constant = DrawConstants()
        for node in roots.nodes:
            for operand in set(node.operands):
                self._users[operand.id] = self._users.get(operand.id, 0) + 1

    def rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        """Compute ``node`` before the crossing that it is an affine map of."""
        position = self._moved_operand(node, operands)
        if position is None:
            return None
        crossing = operands[position]
        self._name_after(node, crossing)
        inner = tuple(crossing.operands[0] if o is crossing else o for o in operands)
        moved = graph.node(node.op, node.type, inner, node.data)
        return build.cross(graph, moved, CROSS.data(crossing))

    def _moved_operand(self, node: Node, operands: tuple[Node, ...]) -> int | None:
        """The place of the only varying operand, if ``node`` is affine in it; else ``None``."""
        if not any(operand.op == "cross" for operand in operands) or not _is_affine(node):
            return None
        varying = [i for i, old in enumerate(node.operands) if old not in self._constant]
        if len(varying) != 1:
            return None
        (position,) = varying
        crossing, old = operands[position], node.operands[position]
        if crossing.op != "cross" or CROSS.data(crossing).mode != "perspective":
            return None
        # A value used twice crosses anyway, and a wider result would need another varying.
        fits = width(node.type) <= width(crossing.type)
        return position if fits and self._users[old.id] == 1 else None

    def _name_after(self, node: Node, crossing: Node) -> None:
        """Calls a moved value without a name of its own after the value that crossed before."""
        names = self._notes.names
        source = names.get(crossing.id)
        if source is None and isinstance(attribute := crossing.operands[0].data, Attribute):
            source = attribute.name
        if source is not None:
            change = AFFINE.get(builtin_of(node) or "", "")
            unchanged = not change or source.endswith(change)
            names.setdefault(node.id, source if unchanged else f"{source}_{change}")


def _crosses(node: Node) -> bool:
    """True if an operation has a varying as an operand."""
    return any(operand.op == "cross" for operand in node.operands)


def _is_affine(node: Node) -> bool:
    """True if an operation is affine in any operand while the others are constant."""
    if not isinstance(node.type, Scalar | Vector):
        return False
    if node.op == "swizzle":
        lanes = SWIZZLE.data(node)
        return len(set(lanes)) == len(lanes)
    return builtin_of(node) in AFFINE
