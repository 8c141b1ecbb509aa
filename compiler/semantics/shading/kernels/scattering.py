"""Scattered values of a kernel: its invocations join them with elements of their choice.

``kernels/kernel.py`` calls ``scattered`` for each ``scatter`` of a kernel.
"""

from __future__ import annotations

from collections.abc import Iterator

from .....support.frozen import changed
from ....diagnostics import rules
from ....ir import build
from ....ir.node import Node
from ....ir.shader import BufferInfo, Result, Store
from ....ir.stages import COMPUTE, CONDITION, LENGTH, PLACE, SCATTER
from ....ir.types import BOOL, INT, UINT, Type
from ....syntax import ast
from ...declarations.fitting import typed
from ...declarations.written_types import declared_type
from ...state.context import Context
from ...state.scope import Failure, Scope
from .extents import declared_extent, exists_in_kernels, written_buffer


def scattered(
    ctx: Context, member: ast.Scatter, scope: Scope
) -> tuple[BufferInfo, list[Result]] | None:
    """The buffer and the results of one ``scatter``, or ``None`` after reporting why not."""
    name = member.name.text
    length = declared_extent(ctx, name, member.type, scope)
    element = declared_type(ctx, changed(member.type, count=None), scope.module)
    if element is None:
        return None
    if element.type not in (INT, UINT):
        ctx.report.add(rules.NOT_SCATTERED, member.type.span, name=name, type=element.text)
        return None
    value = _part(ctx, member.value, scope, element.type)
    place = _part(ctx, member.place, scope, INT)
    condition: Node | None = build.constant(ctx.tree, BOOL, True)
    if member.condition is not None:
        condition = _part(ctx, member.condition, scope, BOOL)
    if length is None or value is None or place is None or condition is None:
        return None
    if not _may_exist(ctx, member, place, length):
        return None
    info = written_buffer(member.name, member.doc, element)
    store = Store(info.leaf, operator=member.operator)
    return info, list(_results(ctx, store, value, place, condition, length))


def _part(ctx: Context, written: ast.Expression, scope: Scope, type_: Type) -> Node | None:
    node = typed(ctx, written, scope, type_, str(type_))
    if isinstance(node, Failure) or not exists_in_kernels(ctx, node, written.span):
        return None
    return node


def _may_exist(ctx: Context, member: ast.Scatter, place: Node, length: Node) -> bool:
    """True if the chosen element may exist; reported if it never does."""
    index, count = ctx.constants.known_integer(place), ctx.constants.known_integer(length)
    if index is None or (index >= 0 and (count is None or index < count)):
        return True
    ctx.report.add(rules.NO_SUCH_ELEMENT, member.place.span, index=index, name=member.name.text)
    return False


def _results(
    ctx: Context, store: Store, value: Node, place: Node, condition: Node, length: Node
) -> Iterator[Result]:
    """The results of a ``scatter``; nothing is joined where there is no such element."""
    tree, zero = ctx.tree, build.constant(ctx.tree, INT, 0)
    after_first = tree.node("call", BOOL, (place, zero), "ge")
    before_end = tree.node("call", BOOL, (place, length), "lt")
    exists = tree.node("call", BOOL, (after_first, before_end), "and")
    holds = tree.node("call", BOOL, (condition, exists), "and")
    ctx.notes.names.setdefault(place.id, f"{store.buffer.name}_place")
    for kind, node in ((SCATTER, value), (PLACE, place), (CONDITION, holds), (LENGTH, length)):
        yield Result(kind, COMPUTE, node, store=store)
