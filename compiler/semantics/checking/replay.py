"""Gives slots of the library their values by the steps that were written down when one was checked.

``slots`` asks for each equation of the library. A transcript holds if checking could only do the
same again: the equation, its type, and all that it reads, directly or not, are the library's, and
nothing that the user has written stands between. Then nothing is reported either, as only
equations about which nothing was reported have a transcript.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ....support.frozen import EMPTY
from ...diagnostics.source import Span
from ...ir.node import Node
from ...syntax import ast
from ..declarations.transform_paths import transforms
from ..declarations.written_types import struct_of
from ..inheritance.records import Definition
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import OUTERMOST, Failure, Instance, Scope
from ..state.transcripts import Reading, Replay, Transcript, Ways, level_in
from ..types.typenames import Declared

Slot = Callable[[Context, Instance, str, Span, int], Node | Failure]


def replayed(ctx: Context, instance: Instance, name: str, level: int, slot: Slot) -> Node | None:
    """The value of a slot by its transcript; ``None`` if there is none that holds.

    ``slot`` gives the values of the slots that it reads.
    """
    found = _fitting(ctx, instance, name, level)
    if found is None:
        return None
    tree = ctx.tree
    read = partial(_read, ctx, instance, found.definition.member.name.span, slot)
    replay = Replay(tree, ctx.places, ctx.notes.tables, ctx.meanings.keep, read)
    # A rule that runs once more finds its own nodes again, and not these (``evaluation``).
    again, tree.again = tree.again, EMPTY
    try:
        for step in found.steps:
            step.take(replay)
    finally:
        tree.again = again
    _remember(ctx, instance, found, replay.values)
    return replay.values[found.value]


def _read(ctx: Context, instance: Instance, span: Span, slot: Slot, reading: Reading) -> Node:
    """The value of a slot that a step reads."""
    holder = instance.surface if reading.of_surface else instance
    assert holder is not None
    value = slot(ctx, holder, reading.name, span, _level(ctx, holder, reading))
    assert isinstance(value, Node), "a transcript holds only if all that it reads is right"
    return value


def _level(ctx: Context, holder: Instance, reading: Reading) -> int:
    """The level at which a slot is read here: a light asks for that of the whole surface."""
    _, first = ctx.transcripts.of(holder)
    return reading.level if reading.of_surface else level_in(reading.level, first)


def _remember(ctx: Context, instance: Instance, found: Transcript, values: list[Node]) -> None:
    """Keep what checking would have kept for later checks."""
    ctx.records.work.nodes += found.unmade
    for symbol, arguments, of_surface, value in found.calls:
        surface = (instance.surface or instance) if of_surface else None
        key = symbol, tuple([values[argument].id for argument in arguments]), surface
        ctx.applied.setdefault(key, values[value])
    for value, inner in found.at_vertex:
        ctx.crossings.vertex.setdefault(values[value].id, values[inner])


# --- which transcripts hold ----------------------------------------------------------------------


def _fitting(ctx: Context, instance: Instance, name: str, level: int) -> Transcript | None:
    """The transcript of a slot if it holds; it recurses over what the library reads."""
    known, key = ctx.transcripts.fitting, (instance, name, level, ctx.passing)
    if key not in known:
        known[key] = None  # This holds on the way round a circle.
        known[key] = _found(ctx, instance, name, level)
    return known[key]


def _found(ctx: Context, instance: Instance, name: str, level: int) -> Transcript | None:
    kept, first = ctx.transcripts.of(instance)
    if not kept or instance.made is not None or instance in ctx.is_step:
        return None
    definition = instance.record.at(name, level)
    found = kept.get((name, definition.level - first))
    holds = (
        found is not None
        and _is_same(definition, found.definition)
        and _is_same(instance.record.typing(name), found.typing)
        and all(_is_read_alike(ctx, instance, reading) for reading in found.readings)
        and not any(_is_declared(instance, name) for name in found.inputs)
        and (found.ways is None or ways_of(ctx, instance) == found.ways)
        and all(_has_structure(ctx, instance, *each) for each in found.structures)
    )
    return found if holds else None


def _is_same(definition: Definition | None, other: Definition | None) -> bool:
    """True if two records have one text here."""
    if definition is None or other is None:
        return definition is other
    return definition.member is other.member


def _has_structure(
    ctx: Context, instance: Instance, symbol: Symbol, declared: Declared | None
) -> bool:
    """True if a structure of the library has the same type here: no other one takes its name."""
    is_free = symbol.name not in instance.record.symbol.module.declared
    return (is_free or instance.record.symbol.module is symbol.module) and (
        struct_of(ctx, symbol) == declared
    )


def _is_declared(instance: Instance, name: str) -> bool:
    """True if a name is a slot here, which comes before the pipeline's own values."""
    return instance.has(name) or (instance.surface is not None and instance.surface.has(name))


def _is_read_alike(ctx: Context, instance: Instance, reading: Reading) -> bool:
    """True if a step reads here what it read when it was written down."""
    name, holder = reading.name, instance
    if reading.of_surface:
        if instance.surface is None or instance.has(name):
            return False
        holder = instance.surface
    if holder.made is not None or name not in holder.record.definitions:
        return False
    level = _level(ctx, holder, reading)
    if level == OUTERMOST and name in holder.replaced:
        return False
    definition = holder.record.at(name, level)
    if not _is_same(definition, reading.definition):
        return False
    if isinstance(holder.values.get((name, level)), Failure):
        return False
    if isinstance(definition.member, ast.Slot):
        return _fitting(ctx, holder, name, level) is not None
    return name in holder.leaves


def ways_of(ctx: Context, instance: Instance) -> Ways:
    """The transforms that an equation of an instance could take."""
    surface = instance.surface or instance
    scope = Scope(instance.record.symbol.module, instance, surface=surface)
    around = [instance, surface, ctx.passing]
    return tuple(
        (around.index(way.instance), way.name, way.meaning) for way in transforms(ctx, scope)
    )
