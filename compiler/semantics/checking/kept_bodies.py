"""Bodies of library functions that were checked in another elaboration, for calls in this one.

``shading/kept_bodies.py`` keeps them. ``signatures`` takes one where it meets a signature for the
first time, and repeats or applies it as if it had been checked here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ....support.frozen import EMPTY
from ...ir import build
from ...ir.node import Node
from ...ir.operations import ASCRIBE, CONSTANT
from ..declarations.written_types import struct_of
from ..state.context import Context, KeptBody, NotedNode, SharedBody, Signature


def taken(
    ctx: Context, signature: Signature, parts: tuple[Node, ...]
) -> SharedBody | KeptBody | None:
    """The body for a signature if one is kept; ``parts`` are those of a call's arguments."""
    kept = ctx.bodies.kept(signature, parts)
    if kept is None or any(struct_of(ctx, symbol) != found for symbol, found in kept.structures):
        return None
    _make(ctx, kept.constants, ctx.bodies.copies)
    ctx.bodies.applicable.update(ctx.bodies.copies[node] for node in kept.applicable)
    ctx.records.work.nodes += kept.made
    return kept if signature.repeated else SharedBody(ctx.bodies.copies[kept.value], kept.formals)


def repeated_kept(ctx: Context, kept: KeptBody, parts: tuple[Node, ...]) -> Node:
    """A body with the arguments of a call in the place of those that it was checked with."""
    made: dict[Node, Node] = {}
    for part, stand_in in zip(parts, kept.parts, strict=True):
        made[stand_in.node] = part
        if part.operands:
            _note(ctx, part, stand_in.noted)
    _make(ctx, kept.own, made, ctx.bodies.copies)
    return made.get(kept.value) or ctx.bodies.copies[kept.value]


def _make(
    ctx: Context,
    nodes: Iterable[NotedNode],
    made: dict[Node, Node],
    constants: Mapping[Node, Node] = EMPTY,
) -> None:
    """Make nodes of another elaboration here, as far as they are not ``made``, with their notes."""
    for each in nodes:
        node = each.node
        if node not in made:
            operands = tuple([made.get(o) or constants[o] for o in node.operands])
            made[node] = new = of_operands(ctx, node, operands)
            _note(ctx, new, each.noted)


def _note(ctx: Context, node: Node, noted: Iterable[tuple[int, Any]]) -> None:
    tables = ctx.notes.tables
    for number, note in noted:
        tables[number].setdefault(node.id, note)


def of_operands(ctx: Context, node: Node, operands: tuple[Node, ...]) -> Node:
    """A node with other operands, as checking it with them would have made it."""
    if node.op == "as":
        return ctx.meanings.ascribed(operands[0], ASCRIBE.data(node))
    if node.op == "index" and operands[0].op == "matrix" and operands[1].op == "constant":
        position = CONSTANT.data(operands[1])
        assert isinstance(position, int)
        return build.part(ctx.tree, operands[0], position)
    return ctx.tree.node(node.op, node.type, operands, node.data)
