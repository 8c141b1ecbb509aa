"""Reads of a storage buffer: its elements, and their number."""

from __future__ import annotations

from ...ir import build
from ...ir.node import Formal, Node, bare
from ...ir.stages import SystemInput
from ...ir.types import INT
from ..declarations.buffers import leaf_of
from ..state.context import Context


def count(ctx: Context, buffer: Node) -> Node:
    """``b.count``; of a buffer that only a use can tell, some number."""
    leaf = leaf_of(buffer)
    if leaf is None:
        some = ctx.tree.node("formal", INT, (), Formal("count"))
        ctx.placeholders.add(some)
        return some
    return ctx.tree.node("parameter", INT, (), leaf.count)


def element(ctx: Context, buffer: Node, position: Node) -> Node:
    """``b[i]``: the nearest element, where ``i`` is before the first or behind the last.

    A buffer without elements reads as if it had one of zeros, which the runtime binds then.
    """
    if not _is_within(ctx, buffer, position):
        position = _clamped(ctx, buffer, position)
    part = build.index(ctx.tree, buffer, position)
    ctx.deferred.unread(part, (position,))
    return part


def _is_within(ctx: Context, buffer: Node, position: Node) -> bool:
    """True if a position is the index of a loop, or of a kernel, over this buffer's elements."""
    index, leaf = bare(position).data, leaf_of(buffer)
    end = ctx.ends.get(index) if isinstance(index, Formal) else None
    if isinstance(index, SystemInput):
        end = ctx.extent
    return leaf is not None and end is not None and bare(end).data == leaf.count


def _clamped(ctx: Context, buffer: Node, position: Node) -> Node:
    """The nearest position of an element; the first, if there is none."""
    graph = ctx.tree
    zero, one = (build.constant(graph, INT, number) for number in (0, 1))
    last = graph.node("call", INT, (count(ctx, buffer), one), "sub")
    last = graph.node("call", INT, (last, zero), "max")
    if (leaf := leaf_of(buffer)) is not None:
        ctx.notes.names.setdefault(last.id, f"{leaf.name.replace('.', '_')}_last")
    positive = graph.node("call", INT, (position, zero), "max")
    return graph.node("call", INT, (positive, last), "min")
