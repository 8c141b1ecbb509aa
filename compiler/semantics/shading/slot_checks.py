"""Checks of slots that a shader has and does not read, so that every mistake is found at once."""

from __future__ import annotations

from collections.abc import Collection

from ....stdlib import COMPANIONS
from ...diagnostics import rules
from ...syntax import ast
from ..checking.lights import light_instance
from ..checking.slots import slot
from ..checking.step_needs import is_brought
from ..inheritance.records import Record, is_abstract
from ..names.modules import Module
from ..state.context import Context
from ..state.scope import Instance
from .assembly import is_declared_abstract
from .unread_slots import NamedIn, warn_of_all, warn_of_unread


def check_slots(ctx: Context, surface: Instance, passing: Instance) -> None:
    """Check every slot of a material and its pass; warn of those that look misspelt."""
    read = {name for name, _ in surface.values}
    read_of_pass = {name for name, _ in passing.values}
    for instance in (surface, passing):
        made = instance
        while made.made is not None:
            read |= {name for part in made.made.parts for name, _ in part.values}
            base = made.made.base_of(made)
            check_overridden(ctx, base, made)
            made = base
        check_instance(ctx, instance)
    _check_companions(ctx, surface)
    # A parameter is read by slots that nothing reads, too.
    read |= surface.leaves.keys() & {name for name, _ in surface.values}
    _check_unread(ctx, surface, passing, read)
    _check_unseen(ctx, passing.record, surface.record, read | read_of_pass)


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


def _check_unread(ctx: Context, surface: Instance, passing: Instance, read: set[str]) -> None:
    """Warn of unread slots of a material and of its pass that look like mistakes."""
    record, drawn = surface.record, passing.record
    is_alone = drawn.symbol.module.is_standard and not _draws(record.symbol.module)
    if is_declared_abstract(record):
        # Its slots are an offer to the materials that extend it.
        named = NamedIn(record.symbol.module)
        warn_of_unread(ctx, record, read, beside=named, all_read_here=False)
    elif is_alone and not _sets_color(record):
        warn_of_all(ctx, record, read)
    else:
        warn_of_unread(ctx, record, read, all_read_here=is_alone)
    if not drawn.symbol.module.is_standard:
        # A pass may have its own form of any slot of the material, and the material reads it.
        shared = record.definitions.keys()
        named = NamedIn(drawn.symbol.module)
        warn_of_unread(ctx, drawn, read, shared, beside=named, also=shared)


def _check_unseen(ctx: Context, drawn: Record, record: Record, read: Collection[str]) -> None:
    """Warn of a slot that a pass without targets sets in vain: its target was forgotten.

    One that the material has, such as its colour, tells more than one that only leads there.
    """
    # What was unreadable, or is a base that does not exist, may have had a target.
    is_whole = not (is_declared_abstract(drawn) or drawn.baseless or ctx.report.unread_names)
    if not is_whole or any(True for kind in (ast.Target, ast.Capture) for _ in drawn.every(kind)):
        return
    nearest = (definitions[0] for definitions in drawn.definitions.values())
    idle = [
        each.member.name
        for each in nearest
        if isinstance(each.member, ast.Slot)
        and each.member.value is not None
        and not each.owner.module.is_standard
        and each.member.name.text not in read
    ]
    for first in sorted(idle, key=lambda name: name.text not in record.definitions)[:1]:
        ctx.report.add(rules.UNSEEN, first.span, name=first.text, pass_=drawn.name)


def _draws(module: Module) -> bool:
    """True if a file has passes or frames, which may read more of its materials."""
    return any(
        isinstance(symbol.declaration, ast.Record) and symbol.declaration.kind in ("pass", "frame")
        for symbols in module.declared.values()
        for symbol in symbols
    )


def _sets_color(record: Record) -> bool:
    """True if a material, or what it is made of, has another colour than the library's surface."""
    return record.definitions["color"][0].owner is not record.root
