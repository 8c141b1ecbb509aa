"""Terms summed over the lights of a rig.

The body of a ``per light`` term is checked once, with the slots of ``light`` as variables, and
applied to each light of the rig. So the part that all lights share is one node, and becomes one
function or one loop body in the output.
"""

from __future__ import annotations

from functools import partial

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir import build
from ...ir.binding import close
from ...ir.node import Formal, Node
from ...ir.types import INT, Scalar, Struct, Vector, scalar_kind
from ...syntax import ast
from ..declarations import contracts
from ..declarations.fitting import fit
from ..declarations.overrides import check_overrides
from ..names.modules import Symbol
from ..state.context import Context, LightBody, Twin
from ..state.scope import (
    FAILURE,
    Application,
    Failure,
    Instance,
    LightVariable,
    RigEntry,
    Scope,
    Value,
)
from .bodies import settle_body
from .functions import fit_result, may_enter, scope_of_body
from .loop_contents import changing
from .loops import folded
from .slots import slot
from .surfaces import slots_given


def per_light(
    ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], span: Span, scope: Scope
) -> Value:
    """The sum of a term over the rig."""
    surface = scope.surface
    if surface is None or not ctx.rig:
        if surface is None:
            ctx.report.add(rules.TERM_WITHOUT_SURFACE, span, name=symbol.name)
        elif not (ctx.report.failed or ctx.report.unread_names):  # Its entries may have been wrong.
            ctx.report.add(rules.EMPTY_RIG, span, name=symbol.name)
        return FAILURE
    if not may_enter(ctx, symbol, span):
        return FAILURE
    body = _light_body(ctx, symbol, arguments, span, surface)
    if isinstance(body, Failure):
        return FAILURE
    active = ctx.progress.active
    active[symbol] = (symbol.name, span)
    try:
        return _summed(ctx, body, span, surface)
    finally:
        active.pop(symbol, None)


def _summed(ctx: Context, body: LightBody, span: Span, surface: Instance) -> Node | Failure:
    """The sum of a body over the lights of the rig."""
    total: Node | None = None
    for entry in ctx.rig:
        instance, formal = light_instance(ctx, entry, surface)
        contribution = _contribution(ctx, body, instance, span)
        if isinstance(contribution, Failure):
            return FAILURE
        if formal is not None:
            count = None if entry.count is None else build.read(ctx.tree, entry.count)
            contribution = folded(
                ctx.tree, "add", entry.bound, contribution, formal, ctx.follow, count
            )
        ctx.places.note(contribution, span)
        total = contribution if total is None else ctx.tree.node(
            "call", total.type, (total, contribution), "add"
        )  # fmt: skip
    assert total is not None
    return total


def _light_body(
    ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], span: Span, surface: Instance
) -> LightBody | Failure:
    """The term's body with ``light``'s slots as variables; once for the same arguments."""
    key: Application = (symbol, tuple(argument.id for argument in arguments), surface)
    if key not in ctx.lights.bodies:
        instance, _ = light_instance(ctx, ctx.rig[0], surface)
        light = LightVariable({}, instance.record, instance)
        scope = scope_of_body(ctx, symbol, arguments, surface, {"light": light})
        finish = partial(_finish_body, ctx, key, arguments, light)
        settle_body(ctx, symbol, span, scope, finish)
    return ctx.lights.bodies[key]


def _finish_body(
    ctx: Context,
    key: Application,
    arguments: tuple[Node, ...],
    light: LightVariable,
    result: Node | Failure,
) -> None:
    symbol, *_ = key
    body = fit_result(ctx, symbol, result, arguments)
    closed = FAILURE if isinstance(body, Failure) else _closed(ctx, symbol, light, body)
    ctx.lights.bodies[key] = closed


def _closed(ctx: Context, symbol: Symbol, light: LightVariable, body: Node) -> LightBody | Failure:
    """A term's body with the variables for the light's slots bound, and named."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    if not isinstance(body.type, Scalar | Vector) or scalar_kind(body.type) == "bool":
        ctx.report.add(
            rules.WRONG_TYPE, function.body.span, expected="a number or a vector", found=body.type
        )
        return FAILURE
    if body.type == INT and isinstance(body.data, int) and body.op == "constant":
        body = build.floating(ctx.tree, float(body.data))
    formals = [node.data for node in light.variables.values() if isinstance(node.data, Formal)]
    for node in changing((body,), set(formals)):
        if node.op == "cross":
            where = ctx.places.within(node, function.body.span)
            ctx.report.add(rules.CROSSING_PER_LIGHT, where)
            return FAILURE
    closed = close(ctx.tree, body, formals, ctx.follow)
    ctx.notes.functions.setdefault(closed.id, symbol.name)
    ctx.notes.terms.setdefault(closed.id, symbol.name)
    ctx.notes.arguments.setdefault(closed.id, tuple(light.variables))
    return LightBody(closed, light.variables)


def _contribution(ctx: Context, body: LightBody, instance: Instance, span: Span) -> Node | Failure:
    """The body applied to one light."""
    if not body.slots:
        return body.body
    given = []
    for name, variable in body.slots.items():
        if not instance.has(name):
            place = instance.record.symbol.declaration.name.span
            ctx.report.add(
                rules.LIGHT_LACKS_SLOT, span, light=instance.record.name, slot=name,
                labels=[Label(place, "this light")],
            )  # fmt: skip
            return FAILURE
        node = slot(ctx, instance, name, span)
        declared = ctx.lights.types[variable.id]
        fitted = fit(ctx, node, declared.type, declared.text, span)
        if isinstance(fitted, Node):
            fitted = contracts.meant(ctx, fitted, declared, span)
        if isinstance(fitted, Failure):
            return FAILURE
        given.append(fitted)
    return build.apply(ctx.tree, body.body, tuple(given))


def light_instance(
    ctx: Context, entry: RigEntry, surface: Instance
) -> tuple[Instance, Formal | None]:
    """One light of the rig as seen from a surface; for an array, its element at a formal index."""
    key = (entry.name, surface)
    if key not in ctx.lights.instances:
        made = ctx.lights.instances[key] = _new_instance(ctx, entry, surface)
        if not ctx.is_twin:
            ctx.twins[made[0]] = partial(_twin, ctx, entry, slots_given(ctx, surface)[0])
    return ctx.lights.instances[key]


def _twin(ctx: Context, entry: RigEntry, surface: Instance) -> Twin:
    """A light in the context apart that its surface has."""
    apart, shaded = ctx.twins[surface]()
    same = (other for other in apart.rig if other.short_name == entry.short_name)
    return apart, light_instance(apart, next(same, entry), shaded)[0]


def _new_instance(
    ctx: Context, entry: RigEntry, surface: Instance
) -> tuple[Instance, Formal | None]:
    if entry.kind != "single":
        (leaf,) = entry.leaves
        return _element(ctx, entry, surface, build.read(ctx.tree, leaf))
    instance = Instance(
        entry.record, entry.short_name, surface,
        leaves={leaf.short_name: build.read(ctx.tree, leaf) for leaf in entry.leaves},
        replaced=dict(entry.replaced),
    )  # fmt: skip
    check_overrides(ctx, instance)
    return instance, None


def _element(
    ctx: Context, entry: RigEntry, surface: Instance, lights: Node
) -> tuple[Instance, Formal]:
    """One of several lights, which are elements of an array or of a storage buffer."""
    formal = Formal("i")
    element = build.index(ctx.tree, lights, ctx.tree.node("formal", INT, (), formal))
    assert isinstance(element.type, Struct)
    instance = Instance(
        entry.record, entry.short_name, surface, replaced=dict(entry.replaced),
        leaves={name: build.member(ctx.tree, element, name) for name, _ in element.type.members},
    )  # fmt: skip
    check_overrides(ctx, instance)
    return instance, formal
