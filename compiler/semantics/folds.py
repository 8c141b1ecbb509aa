"""Bounded folds as nodes."""

from __future__ import annotations

from typing import Literal

from ..ir import build
from ..ir.binding import Moved, close
from ..ir.node import Folding, Formal, Graph, Node
from ..ir.types import INT, Scalar, Vector, width


def fold(
    graph: Graph,
    operator: Literal["add", "mul"],
    bound: int,
    body: Node,
    formal: Formal,
    moved: Moved,
    count: Node | None = None,
) -> Node:
    """The sum or product of ``body`` over ``0 <= formal < count``; ``bound`` is the most turns."""
    type_ = body.type
    assert isinstance(type_, Scalar | Vector)
    neutral: float | int = 0 if operator == "add" else 1
    neutral = float(neutral) if type_.kind == "float" else neutral
    start = build.splat(graph, build.constant(graph, Scalar(type_.kind), neutral), width(type_))
    turns = count or build.constant(graph, INT, bound)
    closed = close(graph, body, (formal,), moved)
    return graph.node("fold", type_, (turns, start, closed), Folding(operator, bound))
