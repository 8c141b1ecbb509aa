"""The names by which a host sets things, of which each stands for one."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.source import Span
from ...ir.shader import ExternInfo
from ...syntax import ast
from ..declarations.parameters import Leaves
from ..names.modules import Module, Symbol
from ..state.scope import RigEntry

Entry = tuple[RigEntry, Leaves]
"""A light of a rig with its parameters, textures and buffers."""

Named = tuple[str, str, Span]
"""A name, the thing that its first word stands for, and the place of its declaration."""


def names_taken(leaves: Iterable[Leaves], module: Module) -> frozenset[str]:
    """The names of parameters, textures, buffers and the file's blocks, which no light can have."""
    words = {name.partition(".")[0] for name, _, _ in _of_leaves(leaves)}
    blocks = {
        symbols[0].name
        for symbols in module.declared.values()
        if isinstance(symbols[0].declaration, ast.ExternBlock)
    }
    return frozenset(words | blocks)


def light_name(rig: Symbol, name: str, taken: Container[str]) -> str:
    """The host's name of a light: ``sun``, or ``Rig.sun`` where that name is taken.

    Who writes a material need not know the lights under which it is drawn.
    """
    return f"{rig.name}.{name}" if name in taken else name


def check_host_names(
    report: Report,
    rig: Symbol,
    module: Module,
    leaves: Iterable[Leaves],
    entries: Iterable[Entry],
    externs: Iterable[ExternInfo],
) -> None:
    """Reports things that a host would set by a name that something else has.

    Names of things in a light or a block begin with its name, as members of a structure do with the
    parameter's, so first words have to differ. Among things of one kind they do.
    """
    leaves = tuple(leaves)
    lights = _of_lights(rig, entries, names_taken(leaves, module))
    known: dict[str, tuple[str, Span]] = {}
    for name, what, span in (*_of_leaves(leaves), *lights, *_of_blocks(externs)):
        other, place = known.setdefault(name.partition(".")[0], (what, span))
        if other != what:
            report.add(
                rules.HOST_NAME_TAKEN, span, what=what, other=other, name=name,
                labels=[Label(place, "declared here")],
            )  # fmt: skip


def _of_leaves(leaves: Iterable[Leaves]) -> Iterator[Named]:
    for group in leaves:
        for info in group.parameters:
            yield _apart(info.parameter.name, "a parameter", info.span)
        for texture in group.resources:
            yield _apart(texture.resource.name, "a texture", texture.span)
        for buffer in group.buffers:
            yield _apart(buffer.buffer.name, "a buffer", buffer.span)


def _apart(name: str, what: str, span: Span) -> Named:
    """A pass's own begins with its name where the material has the other."""
    return name, "a pass" if "." in name else what, span


def _of_lights(rig: Symbol, entries: Iterable[Entry], taken: Container[str]) -> Iterator[Named]:
    """The lights, by the names that they have in this shader.

    ``entries`` may have been made for another material, beside which they have other names.
    """
    for entry, leaves in entries:
        if leaves.parameters or leaves.resources or leaves.buffers:
            yield light_name(rig, entry.short_name, taken), "a light", entry.span


def _of_blocks(externs: Iterable[ExternInfo]) -> Iterator[Named]:
    for block in externs:
        if block.members:
            yield block.place.name, "a block", block.span
