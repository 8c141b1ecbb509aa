"""Render targets with layers: how many a pass has, and to which of them a strip or a view is drawn.

``elaborate.py`` calls this for the results of a pass. A strip says its layer, by an expansion; each
view has a layer, and ``view_index`` is its number in all stages.
"""

from __future__ import annotations

from collections.abc import Iterator

from ....diagnostics import rules
from ....diagnostics.diagnostic import Label, Rule
from ....diagnostics.source import Span
from ....ir import build
from ....ir.node import Node
from ....ir.shader import Result
from ....ir.stages import GEOMETRY, LAYER
from ....ir.types import INT
from ....syntax import ast
from ...checking.slots import slot
from ...declarations.fitting import fit, typed
from ...inheritance.records import Record
from ...state.context import Context
from ...state.scope import Instance, Scope
from ..assembly import is_declared_abstract
from ..vertices.derived import differs_in_strip
from .captures import captures

MOST_LAYERS = 256
"""All APIs guarantee so many."""
MOST_VIEWS = 4
"""Direct3D takes no more; Vulkan guarantees six."""


def _place(ctx: Context, holder: Instance, declared: Span) -> Span:
    """The place that gives the vertices of a strip different layers."""
    slots = holder.made
    for number, group in enumerate(() if slots is None else slots.groups):
        assert slots is not None
        equation = group.equations.get(LAYER)
        value = slots.values.get((number, LAYER))
        if equation is None or equation.value is None or not isinstance(value, Node):
            continue
        if place := differs_in_strip(ctx, value, equation.value.span):
            return place
    return declared


def layer_count(ctx: Context, drawn: Record) -> int:
    """The number of layers of a pass's targets; 0 where it has none.

    It is also 0 after reporting an error.
    """
    return count_of(ctx, drawn, ast.Layers, MOST_LAYERS, rules.NOT_SO_MANY_LAYERS)


def count_of(
    ctx: Context, drawn: Record, kind: type[ast.Layers | ast.Views], most: int, beyond: Rule
) -> int:
    """The number that a member of a pass says, from 1 to ``most``; 0 if there is no such member.

    It is also 0 after reporting an error: ``beyond`` for other numbers.
    """
    found = next(iter(drawn.every(kind)), None)
    if found is None:
        return 0
    member, owner, _level = found
    span = member.count.span
    number = typed(ctx, member.count, Scope(owner.module), INT, "int")
    count = ctx.constants.integer(number, span)
    if count is None:
        return 0
    if not 1 <= count <= most:
        ctx.report.add(beyond, span, count=count, most=most)
        return 0
    return count


def layer_of(ctx: Context, passing: Instance, count: int) -> Iterator[Result]:
    """Yields the layer of a strip, if there are ``count`` layers and not 0.

    It is the slot ``layer`` of the pass, or that of the material.
    """
    surface, drawn = passing.surface, passing.record
    if surface is None or not count:
        return
    holder = passing if passing.has(LAYER) else surface
    if surface.vertex_stage != GEOMETRY or not holder.has(LAYER):
        if not drawn.baseless and not is_declared_abstract(drawn):
            member, _owner, _level = next(iter(drawn.every(ast.Layers)))
            ctx.report.add(rules.NO_LAYER, member.span, name=drawn.name)
        return
    span = holder.record.definitions[LAYER][0].member.name.span
    value = fit(ctx, slot(ctx, holder, LAYER, span), INT, "int", span)
    layer = ctx.crossings.checked_at_vertex(value, span) if isinstance(value, Node) else value
    if not isinstance(layer, Node):
        return
    if differs_in_strip(ctx, layer, span):
        ctx.report.add(rules.LAYER_WITHIN_STRIP, _place(ctx, holder, span))
        return
    ends = (build.constant(ctx.tree, INT, end) for end in (0, count - 1))
    yield Result(LAYER, GEOMETRY, ctx.tree.node("call", INT, (layer, *ends), "clamp"))


def view_count(ctx: Context, drawn: Record) -> int:
    """The number of views of a pass; 0 where it says nothing of views, or draws nothing.

    It is also 0 after reporting an error.
    """
    if captures(drawn):
        return 0
    layers, views = (next(iter(drawn.every(kind)), None) for kind in (ast.Layers, ast.Views))
    if layers is not None and views is not None:
        labels = [Label(layers[0].span, "the layers are declared here")]
        ctx.report.add(rules.VIEWS_AND_LAYERS, views[0].span, name=drawn.name, labels=labels)
        return 0
    return count_of(ctx, drawn, ast.Views, MOST_VIEWS, rules.NOT_SO_MANY_VIEWS)
