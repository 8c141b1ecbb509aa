"""The names by which a host sets things, of which each stands for one."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from itertools import product

from ....support.frozen import frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.source import Span
from ...ir.leaves import behind
from ...ir.shader import (
    AttributeInfo,
    BufferInfo,
    ExternInfo,
    LeafInfo,
    ParameterInfo,
    TextureInfo,
)
from ...syntax import ast
from ..declarations.parameters import Leaves, of_kind
from ..names.modules import Module, Symbol
from ..state.scope import RigEntry

Entry = tuple[RigEntry, Leaves]
"""A light of a rig with its leaves."""


@frozen
class HostName:
    """A thing that a host sets by name."""

    root: str
    """The first word of its name: what owns it, or its own name."""
    name: str
    what: str
    """The kind of thing that the root stands for, as messages say it."""
    span: Span
    """The span of its declaration."""


def names_taken(leaves: Iterable[Leaves], module: Module) -> frozenset[str]:
    """The names of parameters, textures, buffers and the file's blocks, which no light can have."""
    words = {named.root for named in _of_leaves(leaves)}
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
    return behind(rig.name, name) if name in taken else name


def check_host_names(
    report: Report,
    rig: Symbol,
    module: Module,
    leaves: Sequence[Leaves],
    entries: Iterable[Entry],
    externs: Iterable[ExternInfo],
) -> None:
    """Reports things that a host would set by a name that something else has.

    Names of things in a light or a block begin with its name, as members of a structure do with the
    parameter's, so first words have to differ. Among things of one kind they do.
    """
    lights = _of_lights(rig, entries, names_taken(leaves, module))
    known: dict[str, HostName] = {}
    for named in (*_of_leaves(leaves), *lights, *_of_blocks(externs)):
        other = known.setdefault(named.root, named)
        if other.what != named.what:
            report.add(
                rules.HOST_NAME_TAKEN, named.span, what=named.what, other=other.what,
                name=named.name, labels=[Label(other.span, "declared here")],
            )  # fmt: skip


_WORDS: Mapping[type[LeafInfo], str] = {
    ParameterInfo: "a parameter",
    TextureInfo: "a texture",
    BufferInfo: "a buffer",
}
"""The kinds of leaves that a host sets by name, as messages call them."""


def _of_leaves(leaves: Iterable[Leaves]) -> Iterator[HostName]:
    """A pass's own leaf begins with the pass's name where the material has the other."""
    for group, (kind, word) in product(leaves, _WORDS.items()):
        for info in of_kind(kind, group):
            leaf = info.leaf
            what = "a pass" if leaf.owner else word
            yield HostName(leaf.owner or leaf.name, leaf.name, what, info.span)


def _of_lights(rig: Symbol, entries: Iterable[Entry], taken: Container[str]) -> Iterator[HostName]:
    """The lights, by the names that they have in this shader.

    ``entries`` may have been made for another material, beside which they have other names.
    """
    for entry, leaves in entries:
        short = entry.short_name
        if any(not isinstance(info, AttributeInfo) for info in leaves):
            root = rig.name if short in taken else short
            yield HostName(root, light_name(rig, short, taken), "a light", entry.span)


def _of_blocks(externs: Iterable[ExternInfo]) -> Iterator[HostName]:
    for block in externs:
        if block.members:
            yield HostName(block.place.name, block.place.name, "a block", block.span)
