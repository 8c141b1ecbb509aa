"""A material under a pass and under lights, before anything of it has been lowered."""

from __future__ import annotations

from typing import TypeVar

from ...frozen import changed, frozen
from ..diagnostics import rules
from ..diagnostics.diagnostic import Label, Report
from ..ir.leaves import Parameter, Resource
from ..syntax import ast
from .instances import instance_of
from .lower import Lowering
from .modules import Module, Symbol
from .parameters import Leaves, leaves_of
from .records import Record, Records
from .rigs import Entry, entries_of
from .scope import Instance, Replacement
from .standins import stand_in
from .typenames import TypeResolver


@frozen
class Parts:
    """What is multiplied."""

    material: Symbol
    rig: Symbol
    """A rig; or a light, for checking what is meant for lights that no rig has."""
    pass_: Symbol
    module: Module
    """The file being compiled."""


@frozen(eq=False)
class Setting:
    """Instances of the parts, and the leaves that they read."""

    low: Lowering
    entries: list[Entry]
    leaves: tuple[Leaves, Leaves]
    """Of the pass and of the material."""
    surface: Instance
    passing: Instance


def set_up(parts: Parts, report: Report, records: Records) -> Setting:
    """The parts put together; what they lack because they are abstract has stand-ins."""
    low = Lowering(report, records, TypeResolver(report))
    entries = entries_of(low, parts.rig)
    low.rig = tuple(entry for entry, _, _ in entries)
    material, drawn = records.of(parts.material), records.of(parts.pass_)
    material_leaves, pass_leaves = leaves_of(low, material), leaves_of(low, drawn)
    pass_leaves = _apart(pass_leaves, material_leaves, drawn)
    _check_attributes(low, pass_leaves, material_leaves, material)
    surface = instance_of(low, material, material_leaves)
    passing = instance_of(low, drawn, pass_leaves)
    passing.surface = surface
    low.passing = passing
    surface.replaced.update(_overrides(material, drawn, passing))
    for instance in (surface, passing):
        if is_declared_abstract(instance.record):
            stand_in(low, instance)
    return Setting(low, entries, (pass_leaves, material_leaves), surface, passing)


def is_declared_abstract(record: Record) -> bool:
    """Whether a record is there for its heirs only."""
    declaration = record.symbol.declaration
    return isinstance(declaration, ast.Record) and declaration.abstract


def _apart(leaves: Leaves, others: Leaves, drawn: Record) -> Leaves:
    """A pass's parameters and textures under names that its material does not use."""
    taken = {info.parameter.name for info in others.parameters}
    taken |= {info.resource.name for info in others.resources}
    parameters = tuple(
        changed(info, parameter=_prefixed(info.parameter, drawn))
        if info.parameter.name in taken
        else info
        for info in leaves.parameters
    )
    resources = tuple(
        changed(info, resource=_prefixed(info.resource, drawn))
        if info.resource.name in taken
        else info
        for info in leaves.resources
    )
    return changed(leaves, parameters=parameters, resources=resources)


Leaf = TypeVar("Leaf", Parameter, Resource)


def _prefixed(leaf: Leaf, drawn: Record) -> Leaf:
    return changed(leaf, name=f"{drawn.name}.{leaf.name}")


def _check_attributes(low: Lowering, leaves: Leaves, others: Leaves, material: Record) -> None:
    """A vertex input that a pass and its material declare is one."""
    known = {info.attribute.name: info for info in others.attributes}
    for info in leaves.attributes:
        other = known.get(info.attribute.name)
        if other is not None and other.attribute != info.attribute:
            low.report.add(
                rules.OVERRIDE_CHANGES_TYPE, info.span,
                name=info.attribute.name, base=material.name,
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
