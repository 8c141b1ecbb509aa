"""Checks that overrides keep the overridden type, and mixins' requirements their declared one."""

from __future__ import annotations

from itertools import pairwise

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...ir.types import Array, Type
from ..inheritance.records import Definition
from ..state.context import Context
from ..state.scope import FAILURE, OUTERMOST, Instance
from ..types.meaning_rules import fits
from .written_types import declared_type


def check_overrides(ctx: Context, instance: Instance) -> None:
    """Checks that a derived record may write a slot's type again but does not change it.

    A definition that does has no value.
    """
    for name, definitions in instance.record.definitions.items():
        if len(definitions) > 1 and not _keeps_type(ctx, definitions):
            instance.values[name, OUTERMOST] = FAILURE
    for required in instance.record.requirements:
        name = required.member.name.text
        had = instance.record.definitions[name]
        if not _keeps_type(ctx, (required, *had)):
            instance.values[name, OUTERMOST] = FAILURE


def check_replacements(ctx: Context, passing: Instance, surface: Instance) -> None:
    """A pass may not change the type of a material's slot that it overrides either."""
    for name in surface.replaced:
        own, material = passing.record.typing(name), surface.record.typing(name)
        if own is not None and material is not None and not _keeps_type(ctx, (own, material)):
            passing.values[name, OUTERMOST] = FAILURE
            surface.values[name, OUTERMOST] = FAILURE


def _keeps_type(ctx: Context, definitions: tuple[Definition, ...]) -> bool:
    typed = [d for d in definitions if d.member.type is not None]
    for derived, base in pairwise(typed):
        types = []
        for definition in (derived, base):
            assert definition.member.type is not None
            types.append(declared_type(ctx, definition.member.type, definition.owner.module))
        own, inherited = types
        if own is None or inherited is None:
            continue
        if _may_stand_for(own.type, inherited.type) and fits(own.meaning, inherited.meaning):
            continue
        ctx.report.add(
            rules.OVERRIDE_CHANGES_TYPE, derived.member.name.span,
            name=derived.member.name.text, base=base.owner.name,
            expected=inherited.text, found=own.text,
            labels=[Label(base.member.name.span, "declared here")],
        )  # fmt: skip
        return False
    return True


def _may_stand_for(own: Type, inherited: Type) -> bool:
    """True for the type itself, and for an array of the same elements that has another length.

    Whoever uses a mixin with an array knows how long it has to be. Any index is in bounds.
    """
    if isinstance(own, Array) and isinstance(inherited, Array):
        return own.element == inherited.element
    return own == inherited
