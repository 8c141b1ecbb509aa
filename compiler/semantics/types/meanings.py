"""The meaning of each node: derived from its operands when asked for, and kept.

Meanings begin at ascriptions (nodes ``as``), which semantics makes where something was declared:
parameters, attributes, typed slots, arguments, colours, angles. ``erased`` takes them out again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from ....stdlib.builtins import BUILTINS
from ...ir.binding import Moved
from ...ir.leaves import Attribute, Buffer, Parameter, Texture
from ...ir.meaning import ARROWS, COLORS, GEOMETRY, RGB, Meaning
from ...ir.node import Folding, Graph, Node, Roots
from ...ir.operations import CROSS
from ...ir.rewrite import rewrite
from ...ir.types import Array, Matrix, RuntimeArray, Struct
from .meaning_rules import (
    RULES,
    Found,
    chosen,
    gathered,
    is_enum,
    of_members,
    side,
    weakened,
)


class Meanings:
    """The meanings of one graph's nodes."""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self._known: dict[Node, Meaning | None] = {}

    def of(self, node: Node) -> Meaning | None:
        """The meaning of ``node``; ``None`` for a bare number."""
        if node.op not in _RULES:
            return None
        known = self._known
        if node in known:
            return known[node]
        pending = [node]
        while pending:
            top = pending[-1]
            rule = _RULES.get(top.op)
            if rule is None or top in known:
                known.setdefault(top, None)
                pending.pop()
                continue
            for operand in top.operands:
                if operand not in known:
                    pending.append(operand)
            if pending[-1] is top:
                pending.pop()
                found = rule(top, [known[operand] for operand in top.operands])
                known[top] = found if isinstance(found, Meaning) else None
        return known[node]

    def keep(self, node: Node, meaning: Meaning | None) -> None:
        """Remembers a meaning that was worked out for ``node`` already."""
        self._known[node] = meaning

    def ascribed(self, node: Node, meaning: Meaning | None) -> Node:
        """The value of ``node`` with a meaning given to it; ``None`` makes it a bare number."""
        if self.of(node) == meaning:
            return node
        return self._graph.node("as", node.type, (node,), meaning)


MARKS = ("as", "called")
"""Operations that semantics notes in the graph, and no pass ever sees."""


def erased(graph: Graph, roots: Iterable[Node], moved: Moved | None = None) -> Roots:
    """The roots without ascriptions: numbers, as all that follows sees them."""
    return rewrite(graph, roots, lambda _graph, _node, operands: operands[0], moved, MARKS)


def combined(node: Node, meanings: Iterable[Meaning | None]) -> Found:
    """The meaning of a builtin's call, or why it has none."""
    sides = tuple(side(o, m) for o, m in zip(node.operands, meanings, strict=True))
    if any(is_enum(each.meaning) for each in sides):
        return of_members(str(node.data), sides)
    return RULES[BUILTINS[str(node.data)].meaning](sides, node.type)


Operands = list[Meaning | None]


def _call(node: Node, operands: Operands) -> Found:
    return combined(node, operands) if any(operands) or _makes(node) else None


def _makes(node: Node) -> bool:
    return BUILTINS[str(node.data)].meaning == "angle"


def _ascription(node: Node, _operands: Operands) -> Found:
    return node.data if isinstance(node.data, Meaning) else None


_LEAVES = (Parameter, Buffer, Attribute, Texture)


def _leaf(node: Node, _operands: Operands) -> Found:
    return node.data.meaning if isinstance(node.data, _LEAVES) else None


def _select(node: Node, operands: Operands) -> Found:
    return chosen((side(node.operands[1], operands[1]), side(node.operands[2], operands[2])))


def _struct(node: Node, operands: Operands) -> Found:
    assert isinstance(node.type, Struct)
    names = (name for name, _type in node.type.members)
    members = tuple(zip(names, operands, strict=True))
    return Meaning("struct", members=members) if any(operands) else None


def _array(node: Node, operands: Operands) -> Found:
    return gathered([side(o, m) for o, m in zip(node.operands, operands, strict=True)])


def _swizzle(node: Node, operands: Operands) -> Found:
    is_color = operands[0] is not None and operands[0].kind in COLORS
    return RGB if is_color and node.data == (0, 1, 2) else None


def _index(node: Node, operands: Operands) -> Found:
    whole, of = operands[0], node.operands[0].type
    if isinstance(of, Array | RuntimeArray):
        return whole
    if isinstance(of, Matrix) and whole is not None and whole.kind == "basis":
        return Meaning("vector", whole.spaces[1:])
    return None


def _member(node: Node, operands: Operands) -> Found:
    return None if operands[0] is None else operands[0].member(str(node.data))


def _cross(node: Node, operands: Operands) -> Found:
    return weakened(operands[0]) if CROSS.data(node).mode == "perspective" else operands[0]


def _fold(node: Node, operands: Operands) -> Found:
    """A sum of points is a step on the way to their mean, and nothing by itself."""
    term = operands[2]
    if not isinstance(node.data, Folding) or term is None:
        return None
    if node.data.operator != "add":
        return term if term.kind in COLORS else None
    if term.kind in GEOMETRY - ARROWS:
        return None
    return weakened(term)


def _value(_node: Node, operands: Operands) -> Found:
    return operands[0]


_RULES: Mapping[str, Callable[[Node, Operands], Found]] = {
    "parameter": _leaf,
    "buffer": _leaf,
    "attribute": _leaf,
    "texture": _leaf,
    "as": _ascription,
    "call": _call,
    "native": _call,
    "struct": _struct,
    "array": _array,
    "select": _select,
    "swizzle": _swizzle,
    "index": _index,
    "member": _member,
    "cross": _cross,
    "fold": _fold,
    "apply": _value,
    "called": _value,
}
