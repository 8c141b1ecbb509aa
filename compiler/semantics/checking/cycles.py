"""Values that are defined by themselves."""

from __future__ import annotations

from collections.abc import Hashable

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ..state.context import Context
from ..state.scope import Instance


def is_cycle(ctx: Context, key: Hashable, name: str, span: Span) -> bool:
    """True if the value with this key is being computed already; reports the cycle."""
    active, cyclic = ctx.progress.active, ctx.progress.cyclic
    if key not in active:
        return False
    if key in cyclic:
        return True
    cyclic.add(key)
    start = list(active).index(key)
    steps = [step for step in list(active.values())[start:] if step[0]]
    labels = [Label(place, f"`{step}` is needed here") for step, place in steps[1:]]
    hint = ""
    if isinstance(key, tuple) and isinstance(key[0], Instance) and _is_overridden(key[0], name):
        hint = f"what it is otherwise is `inherited.{name}`"
    ctx.report.add(
        rules.CYCLIC_DEFINITION, span, name=name,
        cycle=" → ".join([*(step for step, _ in steps), name]), labels=labels[:8], hint=hint,
    )  # fmt: skip
    return True


def _is_overridden(instance: Instance, name: str) -> bool:
    """True if there is another definition behind that of a slot.

    It is that of a base or, if a pass, the entry of a rig, an expansion or a tessellation has
    overridden the slot, that of the record itself.
    """
    replacement = instance.replaced.get(name)
    if replacement is not None and (replacement.made or replacement.definition is not None):
        return True
    return len(instance.record.definitions.get(name, ())) > 1
