"""The names by which a host sets things, of which each stands for one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.source import Span
from ...ir.shader import ExternInfo
from ..declarations.parameters import Leaves
from .rigs import Entry

Named = tuple[str, str, Span]
"""A name, what its first word stands for, and where that is declared."""


def check_host_names(
    report: Report,
    leaves: Iterable[Leaves],
    entries: Iterable[Entry],
    externs: Iterable[ExternInfo],
) -> None:
    """Report what a host would set by a name that something else has.

    What is in a light or a block begins with its name, as members of a structure do with the
    parameter's, so first words have to differ. Among things of one kind they do.
    """
    known: dict[str, tuple[str, Span]] = {}
    for name, what, span in (*_of_leaves(leaves), *_of_lights(entries), *_of_blocks(externs)):
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


def _apart(name: str, what: str, span: Span) -> Named:
    """A pass's own begins with its name where the material has the other."""
    return name, "a pass" if "." in name else what, span


def _of_lights(entries: Iterable[Entry]) -> Iterator[Named]:
    for entry, infos, resources in entries:
        if infos or resources:
            yield entry.name, "a light", entry.span


def _of_blocks(externs: Iterable[ExternInfo]) -> Iterator[Named]:
    for block in externs:
        if block.members:
            yield block.place.name, "a block", block.span
