"""A rig as lights with places for their parameters."""

from __future__ import annotations

from collections.abc import Container
from typing import Literal

from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...ir.shader import BufferInfo, LightInfo, ParameterInfo, TextureInfo
from ...syntax import ast
from ..checking.turns import LONGEST
from ..declarations.buffers import light_buffer
from ..declarations.parameters import (
    DEFAULT_GROUPS,
    as_array,
    count_parameter,
    leaves_of,
    library_name,
    of_kind,
)
from ..declarations.written_types import count_of
from ..hints.advice import nearest_or_all
from ..inheritance.records import Definition, Record
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import OUTERMOST, Replacement, RigEntry
from .host_names import Entry, light_name
from .unread_slots import word_of_light


def entries_of(ctx: Context, rig: Symbol, taken: Container[str]) -> list[Entry]:
    """The lights of a rig, in order; a wrong one is reported and left out.

    A light stands for a rig that has nothing else. One whose name is ``taken`` by the material or
    the pass is called ``Rig.light`` by a host.
    """
    declaration = rig.declaration
    if not isinstance(declaration, ast.Rig):
        alone = light_entry(ctx, ctx.records.of(rig))
        return [] if alone is None else [alone]
    entries: list[Entry] = []
    seen: dict[str, ast.Name] = {}
    for written in declaration.entries:
        name = written.name
        if name.text in seen:
            first = Label(seen[name.text].span, "first defined here")
            ctx.report.add(rules.DUPLICATE_NAME, name.span, name=name.text, labels=[first])
            continue
        seen[name.text] = name
        record = _light(ctx, rig, written.light)
        shown = light_name(rig, name.text, taken)
        entry = None if record is None else _entry(ctx, rig, written, record, shown)
        if entry is not None:
            entries.append(entry)
    return entries


def _light(ctx: Context, rig: Symbol, name: ast.Name) -> Record | None:
    found = rig.module.find(name.text)
    declaration = found[0].declaration if found else None
    if not isinstance(declaration, ast.Record) or declaration.kind != "light":
        if declaration is not None:
            labels = [Label(declaration.name.span, "declared here")]
            ctx.report.add(rules.UNKNOWN_LIGHT, name.span, name=name.text, labels=labels)
            return None
        lights = [
            visible
            for visible in rig.module.visible()
            if isinstance(d := rig.module.known(visible)[0].declaration, ast.Record)
            and d.kind == "light"
        ]
        if name.text in rig.module.missing:
            return None
        ctx.report.add(
            rules.UNKNOWN_NAME, name.span, kind="light", name=name.text,
            hint=rig.module.hint(name, lights, ("light",)),
        )  # fmt: skip
        return None
    if declaration.abstract:
        ctx.report.add(
            rules.ABSTRACT_USE, name.span, name=name.text,
            labels=[Label(declaration.name.span, "declared abstract here")],
        )  # fmt: skip
        return None
    return ctx.records.of(found[0])


def light_entry(
    ctx: Context, light: Record, number: Literal["one", "exactly"] = "one"
) -> Entry | None:
    """One light of a kind, or some, as a rig would have it: for checking lights without a rig."""
    name = light.symbol.declaration.name
    written = ast.RigEntry(name.span, "", name, name, None, number, ())
    return _entry(ctx, light.symbol, written, light, name.text)


def _entry(
    ctx: Context, rig: Symbol, written: ast.RigEntry, record: Record, name: str
) -> Entry | None:
    given = _overrides(ctx, rig, written, record)
    replaced = {slot: Replacement(definition=definition) for slot, definition in given.items()}
    leaves = leaves_of(ctx, record, name, given)
    place, short, group = written.name.span, written.name.text, DEFAULT_GROUPS["light"]
    light = LightInfo(name, short, record.name, library_name(record.symbol), written.doc)
    if written.number == "one":
        own = tuple(
            changed(info, light=light)
            if isinstance(info, ParameterInfo | TextureInfo | BufferInfo)
            else info
            for info in leaves
        )
        read = tuple(info.leaf for info in own)
        return RigEntry(name, short, place, record, "single", read, replaced=replaced), own
    bound = LONGEST if written.count is None else count_of(ctx, written.count, rig.module)
    if bound is None:
        return None
    parameters = of_kind(ParameterInfo, leaves)
    if not parameters or len(parameters) < len(leaves):
        ctx.report.add(rules.NO_ARRAY_OF, place, light=record.name)
        return None
    if written.number == "any":
        one = as_array(ctx, name, record.name, parameters, 1, group)
        info = light_buffer(name, one, record.name, place, written.doc)
        info = changed(info, light=light)
        entry = RigEntry(
            name, short, place, record, "buffer", (info.leaf,), bound, info.leaf.count, replaced
        )
        return entry, (info,)
    array = as_array(ctx, name, record.name, parameters, bound, group)
    array = changed(array, span=place, light=light)
    count = count_parameter(name, bound, group, array) if written.number == "at_most" else None
    entry = RigEntry(
        name, short, place, record, "array", (array.leaf,), bound,
        None if count is None else count.leaf, replaced,
    )  # fmt: skip
    return entry, (array,) if count is None else (array, count)


def _overrides(
    ctx: Context, rig: Symbol, written: ast.RigEntry, record: Record
) -> dict[str, Definition]:
    """``torch : Beam { inner = 10deg }``: equations checked as the light's own."""
    given: dict[str, Definition] = {}
    for slot in written.overrides:
        if slot.name.text not in record.definitions:
            ctx.report.add(
                rules.UNKNOWN_NAME, slot.name.span,
                kind=f"slot of light `{record.name}`", name=slot.name.text,
                hint=nearest_or_all(slot.name.text, slot.name.span, record.definitions)
                or word_of_light(slot.name.text),
            )  # fmt: skip
            continue
        given[slot.name.text] = Definition(slot, rig, OUTERMOST)
    return given
