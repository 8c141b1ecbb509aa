"""Surfaces of which ``with`` replaces slots: the same values make the same surface."""

from __future__ import annotations

from collections.abc import Mapping

from ...ir.node import Node
from ..state.context import Context
from ..state.scope import Failure, Instance, Replacement


def shaded(ctx: Context, surface: Instance, given: Mapping[str, Node | Failure]) -> Instance:
    """The surface with other values in some slots."""
    base, slots = slots_given(ctx, surface)
    slots = dict(sorted({**slots, **given}.items()))
    key = (base, tuple(slots.items()))
    if key not in ctx.shaded:
        replaced = {name: Replacement(value=value) for name, value in slots.items()}
        ctx.shaded[key] = base.with_replaced(replaced)
        ctx.shaded_from[ctx.shaded[key]] = base, slots
    return ctx.shaded[key]


def slots_given(ctx: Context, surface: Instance) -> tuple[Instance, Mapping[str, Node | Failure]]:
    """The surface without the slots that ``with`` replaces, and these with their values."""
    return ctx.shaded_from.get(surface, (surface, {}))
