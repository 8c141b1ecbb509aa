"""The common part of surfaces whose vertices are made of those of a mesh.

``vertices/expansion.py`` and ``vertices/tessellation.py`` make them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from .....support.frozen import changed
from ....diagnostics import rules
from ....diagnostics.diagnostic import Label
from ....diagnostics.source import Span
from ....ir.node import Node, reachable
from ....ir.operations import INPUT
from ....ir.stages import STRIP_VERTEX
from ....syntax import ast
from ...checking.unknown_names import unknown
from ...state.context import Context
from ...state.scope import Instance, Replacement


def slots_set(ctx: Context, below: Instance, equations: Sequence[ast.Slot]) -> Iterator[str]:
    """Yields the slots that equations set in ``below``, a surface or a pass.

    Equations for slots that do not exist there are reported.
    """
    surface = below.surface or below
    seen: dict[str, Span] = {}
    for equation in equations:
        name, span = equation.name.text, equation.name.span
        if name in seen:
            label = Label(seen[name], "first defined here")
            ctx.report.add(rules.DUPLICATE_NAME, span, name=name, labels=[label])
        elif not below.has(name) and not surface.has(name):
            known = {**surface.record.definitions, **below.record.definitions}
            unknown(ctx, f"slot of `{below.record.name}`", name, span, known, "slot")
        else:
            yield name
        seen.setdefault(name, span)


def by_vertices(names: Iterable[str]) -> dict[str, Replacement]:
    """Slots that have a value of their own at each vertex that is made."""
    return {name: Replacement(made=True) for name in names}


def apart(surface: Instance, passing: Instance | None) -> tuple[Instance, Instance | None]:
    """The surface with a pass of its own, so that the pass's overrides read this surface."""
    base = changed(surface, replaced=dict(surface.replaced))
    return base, pass_of(base, passing)


def pass_of(surface: Instance, passing: Instance | None) -> Instance | None:
    """A copy of a pass that reads this surface, which from now on reads the copy in turn."""
    if passing is None:
        return None
    own = changed(
        passing, surface=surface, replaced=dict(passing.replaced), values=dict(passing.values)
    )
    for name, given in surface.replaced.items():
        if given.within is passing:
            surface.replaced[name] = changed(given, within=own)
    return own


def differs_in_strip(ctx: Context, value: Node, written: Span) -> Span | None:
    """The place where a written value depends on the number of a strip's vertex, if it does."""
    for node in reachable([value]):
        if node.op == "input" and INPUT.data(node) == STRIP_VERTEX:
            return ctx.places.within(node, written)
    return None
