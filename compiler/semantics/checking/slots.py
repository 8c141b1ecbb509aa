"""The values of slots: equations, parameters, textures, vertex inputs; and those of ``light``."""

from __future__ import annotations

from functools import partial

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir import build
from ...ir.node import Formal, Node, bare
from ...ir.stages import GROUP
from ...ir.types import BOOL, INT, Opaque, TextureType
from ...syntax import ast
from ..declarations import contracts
from ..declarations.assignments import assigned, type_of
from ..declarations.fitting import fit
from ..declarations.written_types import declared_type
from ..hints import advice
from ..inheritance.records import Definition, Record, is_abstract
from ..state.context import Context, Twin
from ..state.evaluation import Demand, plain, settle
from ..state.origins import OneCorner
from ..state.scope import (
    FAILURE,
    OUTERMOST,
    Corner,
    DerivedVertices,
    Failure,
    Instance,
    LightVariable,
    Scope,
    Value,
)
from ..types.coercion import coerce, is_adaptable
from .abstract_slots import way_to_set
from .cycles import is_cycle
from .replay import replayed
from .unknown_names import unknown


def slot_or_report(ctx: Context, instance: Instance, name: str, span: Span) -> Value:
    """``instance.name`` where it is written with the dot."""
    if not instance.has(name):
        if instance.record.baseless:
            return FAILURE
        unknown(ctx, f"slot of `{instance.record.name}`", name, span, instance.record.definitions)
        return FAILURE
    return slot(ctx, instance, name, span)


def inherited(ctx: Context, instance: Instance, level: int, name: ast.Name) -> Value:
    """``inherited.name``: the definition above the one in which this is written."""
    above = instance.record.above(name.text, level)
    if above is not None:
        return slot(ctx, instance, name.text, name.span, above.level)
    surface = instance.surface
    if surface is not None and name.text in surface.record.definitions:
        return slot(ctx, surface, name.text, name.span, 0)
    if not instance.record.baseless:
        _unknown_inherited(ctx, instance.record, name)
    return FAILURE


def _unknown_inherited(ctx: Context, record: Record, name: ast.Name) -> None:
    """Reports an unknown ``inherited`` name.

    A mixin that no record has knows only those names of the chain behind it that it declares.
    """
    if isinstance(record.symbol.declaration, ast.Mixin) and name.text in record.definitions:
        hint = f"say of which type it has to be: `{name.text} : … = …`"
        kind = "inherited slot"
        ctx.report.add(rules.UNKNOWN_NAME, name.span, kind=kind, name=name.text, hint=hint)
    else:
        unknown(ctx, "inherited slot", name.text, name.span, record.definitions)


def slot(
    ctx: Context, instance: Instance, name: str, span: Span, level: int = OUTERMOST
) -> Node | Failure:
    """The value that ``name`` has in ``instance``, as defined at ``level`` or further up."""
    key = (name, level)
    if key in instance.values:
        return instance.values[key]
    if instance in ctx.is_step and ctx.is_step[instance](key):
        place = instance.record.at(name, level).member.name.span
        labels = [Label(place, "this is a step")]
        ctx.report.add(rules.NOT_A_VALUE, span, hint=advice.OF_A_STEP, labels=labels)
        return FAILURE
    if is_cycle(ctx, (instance, *key), name, span):
        return FAILURE
    replacement = instance.replaced.get(name) if level == OUTERMOST else None
    if replacement is None:
        _settle_own(ctx, instance, name, span, level)
    elif replacement.made:
        _settle_made(ctx, instance, name, span)
    elif replacement.definition is None:
        assert replacement.value is not None
        _keep(ctx, instance, name, level, replacement.value)
    else:
        _settle_given(ctx, instance, name, span, level, replacement.definition, replacement.within)
    return instance.values[key]


def _settle_own(ctx: Context, instance: Instance, name: str, span: Span, level: int) -> None:
    """Computes the record's own definition of a slot."""
    definition = instance.record.at(name, level)
    member = definition.member
    if not isinstance(member, ast.Slot):
        _keep(ctx, instance, name, level, _leaf(ctx, instance, member))
    elif member.value is None:
        _report_abstract(ctx, instance, definition, span)
        _keep(ctx, instance, name, level, FAILURE)
    elif definition.owner.module.is_standard and (
        known := replayed(ctx, instance, name, level, slot)
    ):
        _keep(ctx, instance, name, level, known)
    else:
        _settle_equation(ctx, instance, name, span, level, definition, instance)


def _settle_made(ctx: Context, instance: Instance, name: str, span: Span) -> None:
    """Computes the values of a slot at the vertices that are made of a mesh's.

    Each group of strips of an expansion may say something else.
    """
    assert instance.made is not None
    found = [
        _in_group(ctx, instance, instance.made, number, name, span)
        for number in range(len(instance.made.groups))
    ]
    values = [value for value in found if isinstance(value, Node)]
    chosen = _by_group(ctx, values, span) if len(values) == len(found) else FAILURE
    value = chosen if isinstance(chosen, Failure) else ctx.crossings.to_fragments(chosen)
    _keep(ctx, instance, name, OUTERMOST, value)


def _in_group(
    ctx: Context, instance: Instance, slots: DerivedVertices, number: int, name: str, span: Span
) -> Node | Failure:
    """The value of a slot at the vertices of one group."""
    group = slots.groups[number]
    written = group.equations.get(name)
    if written is None or written.value is None:
        assert isinstance(slots.origin, OneCorner)
        return corner_slot(ctx, corner_like(slots.base_of(instance), slots.origin), name, span)
    if (number, name) not in slots.values:
        key = instance, slots, number, name
        if is_cycle(ctx, key, name, span):
            return FAILURE
        finish = partial(_finish_made, ctx, instance, slots, number, written)
        settle(ctx, Demand(key, name, span, written.value, group.scope, finish))
    return slots.values[number, name]


def _finish_made(
    ctx: Context,
    instance: Instance,
    slots: DerivedVertices,
    number: int,
    equation: ast.Slot,
    value: Value,
) -> None:
    """Keeps a group's equation for a slot, as a value of the slot's type."""
    written, name, scope = equation.value, equation.name.text, slots.groups[number].scope
    assert written is not None
    base = slots.base_of(instance)
    record = _typing(base, name)
    node = plain(ctx, value, written, type_of(ctx, record, name))
    if record.typing(name) is not None:
        node = assigned(ctx, record, name, node, written, scope, OUTERMOST)
    elif isinstance(like := slot(ctx, base, name, equation.name.span), Node):
        node = fit(ctx, node, like.type, str(like.type), written.span)
    if isinstance(node, Node):
        node = ctx.crossings.checked_at_vertex(node, written.span)
    slots.values[number, name] = node


def _by_group(ctx: Context, values: list[Node], span: Span) -> Node:
    """The value of the group that a vertex is emitted in."""
    *others, chosen = values
    emitting = ctx.tree.node("input", GROUP.type, (), GROUP)
    for number, value in reversed(list(enumerate(others))):
        which = emitting, build.constant(ctx.tree, INT, number)
        is_this = ctx.tree.node("call", BOOL, which, "eq")
        chosen = ctx.tree.node("select", chosen.type, (is_this, value, chosen))
        ctx.places.note(chosen, span)
    return chosen


def corner_like(instance: Instance, origin: OneCorner) -> Corner:
    """The corner that an emitted vertex is like where nothing is said of it."""
    return Corner(instance, origin.number, origin.crossing)


def corner_slot(ctx: Context, corner: Corner, name: str, span: Span) -> Node | Failure:
    """``corner[k].name``: the slot as it is at one vertex of the mesh."""
    holder = corner.instance
    if holder.surface is not None and not holder.has(name) and holder.surface.has(name):
        holder = holder.surface
    value = slot_or_report(ctx, holder, name, span)
    if isinstance(value, Node) and not isinstance(value.type, TextureType):
        value = ctx.crossings.checked_at_vertex(value, span)
    if not isinstance(value, Node):
        return FAILURE
    if isinstance(value.type, TextureType):
        return value
    return ctx.crossings.at_corner(value, corner.number, corner.crossing)


def _settle_given(
    ctx: Context,
    instance: Instance,
    name: str,
    span: Span,
    level: int,
    definition: Definition,
    within: Instance | None,
) -> None:
    """Computes the override of a slot by a pass or a rig's entry."""
    if within is not None and is_abstract(definition.member):
        _keep(ctx, instance, name, level, slot(ctx, within, name, span))
    else:
        _settle_equation(ctx, instance, name, span, level, definition, within or instance)


def _settle_equation(
    ctx: Context,
    instance: Instance,
    name: str,
    span: Span,
    level: int,
    definition: Definition,
    within: Instance,
) -> None:
    """Compute a slot by an equation, which is evaluated in the scope of ``within``."""
    assert isinstance(definition.member, ast.Slot) and definition.member.value is not None
    surface = within.surface or within
    locals_ = {"material": surface}
    scope = Scope(definition.owner.module, within, definition.level, surface, locals_)
    key, written = (instance, name, level), definition.member.value
    finish = partial(_finish_equation, ctx, instance, name, level, written, scope)
    settle(ctx, Demand(key, name, span, written, scope, finish))


def _finish_equation(
    ctx: Context,
    instance: Instance,
    name: str,
    level: int,
    written: ast.Expression,
    scope: Scope,
    value: Value,
) -> None:
    """Keep the value of an equation as the type that its slot was declared with."""
    record = _typing(instance, name)
    assert scope.instance is not None
    own = scope.level if record is scope.instance.record else OUTERMOST
    node = plain(ctx, value, written, type_of(ctx, record, name))
    node = like_overridden(ctx, instance, name, own, node)
    _keep(ctx, instance, name, level, assigned(ctx, record, name, node, written, scope, own))


def like_overridden(
    ctx: Context, instance: Instance, name: str, level: int, node: Node | Failure
) -> Node | Failure:
    """Adapts a literal to the type of the definition that it overrides.

    It does so as for a written type. ``level`` is that of the literal.
    """
    record = instance.record
    if isinstance(node, Failure) or not is_adaptable(node) or record.typing(name) is not None:
        return node
    above = record.above(name, level)
    twin = None if above is None else _twin(ctx, instance)
    if above is None or twin is None:
        return node
    overridden = slot(*twin, name, above.member.name.span, above.level)
    if isinstance(overridden, Failure):
        return node
    return coerce(ctx.tree, node, overridden.type) or node


def _twin(ctx: Context, instance: Instance) -> Twin | None:
    """The twin that knows the types of an instance's overrides; ``None`` outside of shaders."""
    if ctx.is_twin:
        return ctx, instance
    make = ctx.twins.get(instance)
    return None if make is None else make()


def _keep(ctx: Context, instance: Instance, name: str, level: int, value: Node | Failure) -> None:
    instance.values[name, level] = value
    if isinstance(value, Node) and value.operands:
        _note(ctx, instance, name, level, value)


def _report_abstract(ctx: Context, instance: Instance, definition: Definition, span: Span) -> None:
    """Report a slot without a value, unless it has not even a type: that has been reported."""
    name, record = definition.member.name, instance.record
    assert definition.member.type is not None
    declared = declared_type(ctx, definition.member.type, definition.owner.module)
    if declared is None:
        return
    outermost = record.definitions[name.text][0] is definition
    ctx.report.add(
        rules.ABSTRACT_SLOT, record.symbol.declaration.name.span if outermost else span,
        name=name.text, record=record.name,
        labels=[Label(name.span, "declared here without a value")],
        hint=way_to_set(instance, definition, declared),
    )  # fmt: skip


def _leaf(ctx: Context, instance: Instance, member: ast.ReadMember) -> Node | Failure:
    """The leaf of a member whose value comes from outside; a failure if it is declared wrongly."""
    read = instance.leaves.get(member.name.text, FAILURE)
    if isinstance(member, ast.Attribute) and isinstance(read, Node):
        return ctx.crossings.attribute(read, instance.origin)
    return read


def _typing(instance: Instance, name: str) -> Record:
    """The record whose written type holds: a pass's slot keeps that of the one it overrides."""
    surface = instance.surface
    given = None if surface is None else surface.replaced.get(name)
    if surface is None or given is None or given.within is not instance:
        return instance.record
    return surface.record


def _note(ctx: Context, instance: Instance, name: str, level: int, node: Node) -> None:
    """Keep the user's name and doc comment for a value."""
    given = instance.replaced.get(name)
    own = instance.record.at(name, level)
    definition = own if level != OUTERMOST or given is None else given.definition
    if definition is not None and isinstance(definition.member, ast.Attribute):
        return
    overridden = given is not None or own is not instance.record.definitions[name][0]
    is_inherited = level != OUTERMOST and overridden and isinstance(own.member, ast.Slot)
    made = instance.made
    is_inherited = is_inherited or (made is not None and made.is_set_behind(instance, name))
    shown = f"{instance.prefix}_{name}" if instance.prefix else name
    crossing = bare(node)
    for named in (node, *crossing.operands) if crossing.op == "cross" else (node,):
        if is_inherited and named.id not in ctx.notes.names:
            ctx.notes.wholes[named.id] = shown
        ctx.notes.names.setdefault(named.id, f"inherited_{shown}" if is_inherited else shown)
        if definition is not None and definition.member.doc:
            ctx.notes.docs.setdefault(named.id, definition.member.doc)


def light_slot(ctx: Context, light: LightVariable, name: ast.Name) -> Value:
    """``light.name`` in a term: a variable of the body that all lights share."""
    if not light.instance.has(name.text):
        definitions = light.record.definitions
        if any(name.text in entry.record.definitions for entry in ctx.rig):
            label = Label(light.record.symbol.declaration.name.span, "this light")
            ctx.report.add(
                rules.LIGHT_LACKS_SLOT, name.span, light=light.record.name, slot=name.text,
                labels=[label],
            )  # fmt: skip
            return FAILURE
        unknown(ctx, f"slot of light `{light.record.name}`", name.text, name.span, definitions)
        return FAILURE
    sample = slot(ctx, light.instance, name.text, name.span)
    if isinstance(sample, Failure):
        return FAILURE
    if isinstance(sample.type, Opaque):
        what = "texture" if isinstance(sample.type, TextureType) else "buffer"
        ctx.report.add(
            rules.WRONG_TYPE, name.span, expected="a value", found=sample.type,
            hint=f"read the {what} in a slot of the light",
        )  # fmt: skip
        return FAILURE
    variable = light.variables.get(name.text)
    if variable is None:
        variable = ctx.tree.node("formal", sample.type, (), Formal(name.text))
        light.variables[name.text] = variable
    return contracts.light_variable(ctx, light, name.text, variable, sample)
