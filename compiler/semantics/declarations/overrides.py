"""Overrides keep the type of what they override, and what a mixin needs has the type it says."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ..inheritance.records import Definition
from ..lowering.lookup import OUTERMOST
from ..state.scope import FAILURE, Instance
from ..types.meaning_rules import fits
from .written_types import declared_type

if TYPE_CHECKING:
    from ..state.context import Lowering


def check_overrides(low: Lowering, instance: Instance) -> None:
    """An heir may write a slot's type again but not change it; what does has no value."""
    for name, definitions in instance.record.definitions.items():
        if len(definitions) > 1 and not _keeps_type(low, definitions):
            instance.values[name, OUTERMOST] = FAILURE
    for required in instance.record.requirements:
        name = required.member.name.text
        had = instance.record.definitions[name]
        if not _keeps_type(low, (required, *had)):
            instance.values[name, OUTERMOST] = FAILURE


def _keeps_type(low: Lowering, definitions: tuple[Definition, ...]) -> bool:
    typed = [d for d in definitions if d.member.type is not None]
    for heir, base in pairwise(typed):
        types = []
        for definition in (heir, base):
            assert definition.member.type is not None
            types.append(declared_type(low, definition.member.type, definition.owner.module))
        own, inherited = types
        if own is None or inherited is None:
            continue
        if own.type == inherited.type and fits(own.meaning, inherited.meaning):
            continue
        low.report.add(
            rules.OVERRIDE_CHANGES_TYPE, heir.member.name.span,
            name=heir.member.name.text, base=base.owner.name,
            expected=inherited.text, found=own.text,
            labels=[Label(base.member.name.span, "declared here")],
        )  # fmt: skip
        return False
    return True
