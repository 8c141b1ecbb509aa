"""Checks of slots that a shader has and does not read, so that every mistake is found at once."""

from __future__ import annotations

from ....stdlib import COMPANIONS
from ...diagnostics import rules
from ...diagnostics.nearest import nearest_in, respelt
from ...syntax import ast
from ..checking.lights import light_instance
from ..checking.slots import slot
from ..checking.step_needs import is_brought
from ..inheritance.records import Definition, is_abstract
from ..state.context import Context
from ..state.scope import Instance


def check_slots(ctx: Context, surface: Instance, passing: Instance) -> None:
    """Check every slot of a material and its pass; warn of those that look misspelt."""
    read = {name for name, _ in surface.values}
    for instance in (surface, passing):
        made = instance
        while made.made is not None:
            read |= {name for part in made.made.parts for name, _ in part.values}
            base = made.made.base_of(made)
            check_overridden(ctx, base, made)
            made = base
        check_instance(ctx, instance)
    _check_companions(ctx, surface)
    known, root = surface.record.definitions, surface.record.root
    inherited = [name for name, definitions in known.items() if definitions[-1].owner is root]
    for name, definitions in known.items():
        if name not in read:
            _check_spelling(ctx, surface, name, definitions, inherited)


def check_overridden(ctx: Context, base: Instance, surface: Instance) -> None:
    """Checks the values of slots without an expansion or a tessellation that sets them."""
    for name, replacement in surface.replaced.items():
        definition = base.record.definitions[name][0]
        if replacement.made and not is_abstract(definition.member):
            slot(ctx, base, name, definition.member.name.span)


def check_rig(ctx: Context, surface: Instance) -> None:
    """Checks the slots that a rig sets of its lights, whether a term asks for them or not."""
    for entry in ctx.rig:
        instance, _ = light_instance(ctx, entry, surface)
        for name, replacement in entry.replaced.items():
            if replacement.definition is not None and not is_brought(instance.record, name):
                slot(ctx, instance, name, replacement.definition.member.name.span)


def check_instance(ctx: Context, instance: Instance) -> None:
    """Check every slot of an instance; frames check the steps that lights bring them."""
    for name, definitions in instance.record.definitions.items():
        is_slot = isinstance(definitions[0].member, ast.Slot)
        if is_slot and not is_brought(instance.record, name):
            slot(ctx, instance, name, definitions[0].member.name.span)


def _check_companions(ctx: Context, surface: Instance) -> None:
    """Warn of records that override one slot of the library and not another that goes with it.

    It matters only if somebody has given that other slot a value.
    """
    for name, (companion, hint) in COMPANIONS.items():
        own, others = (surface.record.definitions.get(each, ()) for each in (name, companion))
        together = {definition.owner for definition in others}
        if len(others) < 2:
            continue
        for definition in own:
            if definition.owner not in together:
                ctx.report.add(
                    rules.LEFT_BEHIND, definition.member.name.span, record=definition.owner.name,
                    name=name, companion=companion, hint=hint,
                )  # fmt: skip


def _check_spelling(
    ctx: Context,
    surface: Instance,
    name: str,
    definitions: tuple[Definition, ...],
    inherited: list[str],
) -> None:
    """Warn of an own slot that nothing reads and that is nearly called like an ``inherited`` one.

    What an imported file declares is an offer, and its names are for that file to check.
    """
    root = surface.record.root
    member, owner = definitions[0].member, definitions[0].owner
    if not isinstance(member, ast.Slot) or definitions[-1].owner is root:
        return
    if owner.module is not surface.record.symbol.module:
        return
    meant = nearest_in(member.name.span.source, name, inherited)
    if meant is not None and not surface.record.baseless:
        hint = respelt(name, member.name.span, meant)
        ctx.report.add(rules.MISSPELT_SLOT, member.name.span, name=name, hint=hint)
