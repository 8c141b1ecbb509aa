"""The results of kernels for each of their work groups, and checks where there are no groups.

``kernels/kernel.py`` makes the results here that have one element for each work group. It and
``elaborate.py`` report by ``check_no_groups`` where values are joined that no work group has.
"""

from __future__ import annotations

from collections.abc import Iterable

from .....support.frozen import changed
from ....diagnostics import rules
from ....diagnostics.source import Span
from ....ir import build
from ....ir.kernel import WorkGroup, invocations
from ....ir.node import reachable
from ....ir.operations import joins_group
from ....ir.shader import BufferInfo, Result, Store
from ....ir.stages import COMPUTE, LENGTH
from ....ir.types import INT
from ....syntax import ast
from ...declarations.textures import unknown_word
from ...state.context import Context
from .images import is_image

PER_GROUP = "group"
"""The word behind ``per`` for results that have one element for each work group."""


def is_per_group(ctx: Context, member: ast.Result) -> bool:
    """True if a result has one element for each work group; errors in that are reported."""
    if member.per is None:
        return False
    if member.per.text != PER_GROUP:
        unknown_word(ctx, "rate", member.per, (PER_GROUP,))
    elif is_image(member):
        ctx.report.add(rules.IMAGE_PER_GROUP, member.type.span, name=member.name.text)
    elif not member.type.unsized:
        ctx.report.add(rules.COUNT_PER_GROUP, member.type.span, name=member.name.text)
    return True


def of_each_group(
    ctx: Context, info: BufferInfo, stores: Iterable[Result], group: WorkGroup
) -> Iterable[Result]:
    """The parts of an element, which the first invocation of a group writes.

    The number of elements comes with them: as many as groups.
    """
    size = invocations(group)
    for result in stores:
        assert result.store is not None
        yield changed(result, store=changed(result.store, of_group=size))
    assert ctx.extent is not None
    graph, most = ctx.tree, build.constant(ctx.tree, INT, size)
    rest = build.constant(graph, INT, size - 1)
    filled = graph.node("call", INT, (ctx.extent, rest), "add")
    count = graph.node("call", INT, (filled, most), "div")
    yield Result(LENGTH, COMPUTE, count, store=Store(info.leaf, of_group=size))


def check_no_groups(ctx: Context, results: Iterable[Result], what: str, around: Span) -> None:
    """Reports operations that join the values of a work group where there is none."""
    if not ctx.progress.joins_groups:
        return
    for node in reachable(tuple(result.value for result in results)):
        if joins_group(node):
            span = ctx.places.within(node, around)
            ctx.report.add(rules.NO_WORK_GROUP, span, what=what, name=node.data)
