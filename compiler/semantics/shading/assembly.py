"""A material under a pass and under lights, before anything of it has been checked."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial

from ....support.frozen import changed, frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...ir.leaves import Buffer, behind
from ...ir.shader import AttributeInfo, BufferInfo, LeafInfo
from ...syntax import ast
from ..checking.expressions import RULES
from ..declarations.overrides import check_replacements
from ..declarations.parameters import Leaves, leaves_of, of_kind
from ..inheritance.flattening import Records
from ..inheritance.records import Record
from ..names.modules import Module, Symbol
from ..state.context import Context, Twin
from ..state.scope import Instance, Replacement
from .host_names import Entry, names_taken
from .instances import instance_of
from .kept_bodies import KEPT_BODIES
from .kept_transcripts import KEPT_TRANSCRIPTS
from .placeholders import stand_in
from .rigs import entries_of
from .vertices.expansion import expanded, expands
from .vertices.tessellation import tessellated


@frozen
class Parts:
    """The parts of a shader that are put together."""

    material: Symbol
    rig: Symbol
    """A rig; or a light, for checking declarations that are meant for lights that no rig has."""
    pass_: Symbol
    module: Module
    """The file being compiled."""


@frozen(eq=False)
class Setting:
    """Instances of the parts, and the leaves that they read."""

    ctx: Context
    parts: Parts
    entries: list[Entry]
    leaves: tuple[Leaves, Leaves]
    """The leaves of the pass and of the material."""
    surface: Instance
    passing: Instance

    @property
    def all_leaves(self) -> Leaves:
        """The leaves of the pass, of the material, and of the lights."""
        of_lights = [leaves for _, leaves in self.entries]
        return tuple(info for leaves in (*self.leaves, *of_lights) for info in leaves)


def set_up(parts: Parts, report: Report, records: Records) -> Setting:
    """The parts put together; slots that they lack because they are abstract get placeholders."""
    ctx = Context(report, records, RULES)
    ctx.transcripts.kept = KEPT_TRANSCRIPTS.of
    ctx.bodies.kept = KEPT_BODIES.of
    leaves = _leaves(ctx, parts)
    entries = entries_of(ctx, parts.rig, names_taken(leaves, parts.module))
    ctx.rig = tuple(entry for entry, _ in entries)
    return _put_together(ctx, parts, leaves, entries, None)


def set_up_beside(setting: Setting, parts: Parts) -> Setting:
    """Other parts under the same lights, which share all that has been checked already."""
    if parts == setting.parts:
        return setting
    same = parts.material == setting.parts.material and not setting.surface.replaced
    is_known = same and setting.surface.made is None
    leaves, known = _leaves(setting.ctx, parts), setting.surface if is_known else None
    return _put_together(setting.ctx, parts, leaves, setting.entries, known)


def _leaves(ctx: Context, parts: Parts) -> tuple[Leaves, Leaves]:
    """The leaves that the pass and the material read from outside, under names of their own."""
    material, drawn = ctx.records.of(parts.material), ctx.records.of(parts.pass_)
    material_leaves, pass_leaves = leaves_of(ctx, material), leaves_of(ctx, drawn)
    _check_attributes(ctx, pass_leaves, material_leaves, material)
    return _apart(pass_leaves, material_leaves, drawn), material_leaves


def _put_together(
    ctx: Context,
    parts: Parts,
    leaves: tuple[Leaves, Leaves],
    entries: list[Entry],
    known: Instance | None,
) -> Setting:
    """``known`` is an instance of the material as it is under a pass that overrides nothing."""
    material, drawn = ctx.records.of(parts.material), ctx.records.of(parts.pass_)
    pass_leaves, material_leaves = leaves
    passing = instance_of(ctx, drawn, pass_leaves)
    overrides = _overrides(material, drawn, passing)
    reused = known is not None and not overrides and not expands(passing)
    surface = known if known is not None and reused else instance_of(ctx, material, material_leaves)
    surface.replaced.update(overrides)
    check_replacements(ctx, passing, surface)
    passing.surface = surface
    ctx.passing = passing
    twin = cache(partial(_twin, ctx, parts))
    for instance in (passing,) if reused else (surface, passing):
        if is_declared_abstract(instance.record):
            stand_in(ctx, instance)
    if not reused:
        surface = with_made_vertices(ctx, surface, passing)
        ctx.twins[surface] = lambda: (twin().ctx, twin().surface)
        for number, part in enumerate(_parts(surface)):
            ctx.twins[part] = partial(_part_in, twin, number)
    passing.surface = surface
    ctx.twins[passing] = lambda: (twin().ctx, twin().passing)
    return Setting(ctx, parts, entries, leaves, surface, passing)


def with_made_vertices(ctx: Context, surface: Instance, passing: Instance | None) -> Instance:
    """The surface with the vertices of a tessellation, and then of an expansion.

    The expansion is of the tessellation's vertices, or of the mesh's own. There is no pass where a
    mixin is checked alone.
    """
    return expanded(ctx, tessellated(ctx, surface, passing), passing)


def at_mesh(instance: Instance) -> Instance:
    """A surface or a pass as it is at the mesh's own vertices."""
    while instance.made is not None:
        instance = instance.made.base_of(instance)
    return instance


def _parts(surface: Instance) -> tuple[Instance, ...]:
    return () if surface.made is None else surface.made.parts


def _part_in(twin: Callable[[], Setting], number: int) -> Twin:
    """The twin that knows the types of overrides in a part of a surface with other vertices."""
    setting = twin()
    return setting.ctx, _parts(setting.surface)[number]


def _twin(ctx: Context, parts: Parts) -> Setting:
    """A setting of these parts in a context apart, which reports nothing."""
    setting = set_up(parts, ctx.report.apart(), ctx.records)
    setting.ctx.is_twin = True
    return setting


def is_declared_abstract(record: Record) -> bool:
    """True if a record is there only for others to be derived from it."""
    declaration = record.symbol.declaration
    return isinstance(declaration, ast.Record) and declaration.abstract


def _apart(leaves: Leaves, others: Leaves, drawn: Record) -> Leaves:
    """A pass's parameters, textures and buffers under names that its material does not use."""
    taken = {info.leaf.name for info in others if not isinstance(info, AttributeInfo)}
    return tuple(_owned(info, drawn) if info.leaf.name in taken else info for info in leaves)


def _owned(info: LeafInfo, drawn: Record) -> LeafInfo:
    """A pass's leaf with the pass as its owner; a vertex input is one with the material's."""
    if isinstance(info, AttributeInfo):
        return info
    leaf = changed(info.leaf, name=behind(drawn.name, info.leaf.name), owner=drawn.name)
    if isinstance(info, BufferInfo) and isinstance(leaf, Buffer):
        return changed(info, leaf=leaf, count=changed(info.count, leaf=leaf.count))
    return changed(info, leaf=leaf)


def _check_attributes(ctx: Context, leaves: Leaves, others: Leaves, material: Record) -> None:
    """A vertex input that a pass and its material declare is one."""
    known = {info.leaf.name: info for info in of_kind(AttributeInfo, others)}
    for info in of_kind(AttributeInfo, leaves):
        other = known.get(info.leaf.name)
        if other is not None and other.leaf != info.leaf:
            ctx.report.add(
                rules.OVERRIDE_CHANGES_TYPE, info.span,
                name=info.leaf.name, base=material.name,
                expected=other.declared_type, found=info.declared_type,
                labels=[Label(other.span, "declared here")],
            )  # fmt: skip


def _overrides(material: Record, drawn: Record, passing: Instance) -> dict[str, Replacement]:
    """A pass's slots that the material's abstract root declares override the material's."""
    root = material.root
    given = {}
    for name, definitions in drawn.definitions.items():
        shared = name in material.definitions and material.declaration(name).owner is root
        if shared and isinstance(definitions[0].member, ast.Slot):
            given[name] = Replacement(definition=definitions[0], within=passing)
    return given
