"""Moves affine work from the fragment to the vertex stage, where the picture provably stays the same.

Interpolation with weights that sum to one commutes with affine maps: ``interpolate(e) * a + b`` with
``a`` and ``b`` constant over the draw is ``interpolate(e * a + b)``. The move is made only where it adds
no varying: all uses of one crossing go through one affine value that is no wider.
"""

from __future__ import annotations

from collections.abc import Iterable

from ..ir.leaves import Attribute
from ..ir.node import Graph, Node, reachable
from ..ir.types import Matrix, Scalar, Vector, width
from ..semantics.shader import Notes
from .rewrite import rewrite


def move_to_vertices(graph: Graph, roots: Iterable[Node], notes: Notes) -> list[Node]:
    """The roots with affine values of single crossings computed before the crossing."""
    wanted = list(roots)
    while True:
        moves = _moves(wanted)
        if not moves:
            return wanted

        def rule(
            graph: Graph, node: Node, _operands: tuple[Node, ...], moves: dict[int, Node] = moves
        ) -> Node | None:
            crossing = moves.get(node.id)
            if crossing is None:
                return None
            (inner,) = crossing.operands
            _name_after(notes, node, crossing)
            operands = tuple(inner if o is crossing else o for o in node.operands)
            moved = graph.node(node.op, node.type, operands, node.data)
            return graph.node("interpolate", node.type, (moved,), crossing.data)

        wanted = rewrite(graph, wanted, rule, notes.follow)


_CHANGES = {"mul": "scaled", "add": "shifted", "sub": "shifted", "neg": "negated"}


def _name_after(notes: Notes, node: Node, crossing: Node) -> None:
    """A moved value without a name of its own is called after what crossed before."""
    source = notes.names.get(crossing.id)
    if source is None and isinstance(attribute := crossing.operands[0].data, Attribute):
        source = attribute.name
    if source is not None:
        change = _CHANGES.get(str(node.data), "")
        notes.names.setdefault(node.id, f"{source}_{change}" if change else source)


def _moves(roots: list[Node]) -> dict[int, Node]:
    """Affine nodes that are the only user of a crossing, with that crossing."""
    nodes = reachable(roots)
    users: dict[int, list[Node]] = {}
    constant: dict[int, bool] = {}
    for node in nodes:
        constant[node.id] = node.op in ("constant", "parameter") or (
            bool(node.operands)
            and node.op not in ("interpolate", "apply", "fold")
            and all(constant[operand.id] for operand in node.operands)
        )
        for operand in set(node.operands):
            users.setdefault(operand.id, []).append(node)
    kept = {root.id for root in roots}
    moves = {}
    for crossing in nodes:
        using = users.get(crossing.id, [])
        if crossing.op != "interpolate" or crossing.data != "perspective" or len(using) != 1:
            continue
        (user,) = using
        if crossing.id not in kept and _affine(user, crossing, constant):
            moves[user.id] = crossing
    return moves


def _affine(user: Node, crossing: Node, constant: dict[int, bool]) -> bool:
    """Whether ``user`` is an affine map of ``crossing`` into no more lanes, constant over the draw."""
    if user.op == "swizzle":
        return len(set(user.data)) == len(user.data)  # type: ignore[arg-type, call-overload]
    if user.op not in ("call", "native") or not isinstance(user.type, Scalar | Vector):
        return False
    if width(user.type) > width(crossing.type):
        return False
    others = [operand for operand in user.operands if operand is not crossing]
    if len(others) != len(user.operands) - 1 or not all(constant[o.id] for o in others):
        return False
    if user.data in ("add", "sub", "neg", "mul"):
        return not any(isinstance(other.type, Matrix) and user.data != "mul" for other in others)
    return False
