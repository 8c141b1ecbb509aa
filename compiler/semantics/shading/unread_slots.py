"""Warns of slots that a file declares and nothing reads: misspelt ones, and words of other systems.

A name that no base declares is a new slot. That is often wanted, as other equations read it. But a
name that nearly is one of a base, or that means something elsewhere, would be ignored silently.
``slot_checks`` asks for it, with what was read of a material, a pass, a light or a kernel.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping

from ....support.frozen import frozen
from ...diagnostics import rules
from ...diagnostics.fixes import Hint
from ...diagnostics.nearest import nearest_in, respelt
from ...syntax import ast
from ..inheritance.records import Record, is_abstract
from ..names.modules import Module, Symbol
from ..state.context import Context

_GLTF = "only a base that has it makes something of it, such as the library's material of glTF"
_TO_EYE = "what a surface sends to the eye is its slot `color`"
_COVERS = "how much a surface covers is its slot `alpha`"
_NO_DEPTH = "a pass draws with the depth of the surface: no text writes another one"
_NO_CLIP = "a surface is cut at the sides of clip space, or by `discard when` in a pass"
_NO_POINTS = "points have no size of their own: `expand point` makes a square of each"
_IN_CLIP = "where a vertex is drawn is the slot `clip_position`"

ELSEWHERE: Mapping[str, str] = {
    **dict.fromkeys(("albedo", "basecolor", "diffusecolor", "fragcolor", "outcolor", "surfacecolor",
                     "glfragcolor", "svtarget", "finalcolor"), _TO_EYE),
    **dict.fromkeys(("opacity", "transparency", "coverage"), _COVERS),
    **dict.fromkeys(("fragdepth", "glfragdepth", "svdepth", "depth", "pixeldepth"), _NO_DEPTH),
    **dict.fromkeys(("clipdistance", "glclipdistance", "svclipdistance", "culldistance",
                     "svculldistance", "glculldistance"), _NO_CLIP),
    **dict.fromkeys(("pointsize", "glpointsize", "psize"), _NO_POINTS),
    **dict.fromkeys(("glposition", "svposition"), _IN_CLIP),
    **dict.fromkeys(("roughness", "metallic", "metalness", "ao", "occlusion", "emissive",
                     "emission"), _GLTF),
}  # fmt: skip
"""Words of other systems for what a shader writes, in small letters and without underscores, and
what there is here instead."""

_NAMED = re.compile(r"\b(\w+)\b(?!\s*(?::|=(?!=)))")
"""A word that is no left side: `name = …`, `name : type`."""


@frozen
class Own:
    """A slot that a record's own file declares, and that no base of it has."""

    name: ast.Name
    others: frozenset[str]
    """The names that its bases and mixins declare."""


def own_slots(record: Record, also: Iterable[str] = ()) -> Iterator[Own]:
    """The slots of a record that its file adds to the chain; ``also`` are further ``others``.

    What an imported file declares is an offer, and its names are for that file to check.
    """
    others: dict[Symbol, frozenset[str]] = {}
    for definitions in record.definitions.values():
        member, owner = definitions[0].member, definitions[0].owner
        is_new = all(definition.owner is owner for definition in definitions)
        if is_new and isinstance(member, ast.Slot) and owner.module is record.symbol.module:
            if owner not in others:
                others[owner] = frozenset((*_others(record, owner), *also))
            yield Own(member.name, others[owner])


def _others(record: Record, owner: Symbol) -> Iterator[str]:
    """The names that others than one owner declare. One that stays abstract is told by itself."""
    for name, rows in record.definitions.items():
        if not is_abstract(rows[0].member) and any(row.owner is not owner for row in rows):
            yield name


def warn_of_unread(
    ctx: Context,
    record: Record,
    read: Collection[str],
    *,
    also: Collection[str] = (),
    all_read_here: bool = True,
) -> None:
    """Warn of each own slot of a record that is not ``read`` and looks like a mistake.

    ``also`` are names beside those of its bases that it may have meant. If it is ``all_read_here``,
    no other pass can read its slots, so that words of other systems are told, too.
    """
    if record.baseless:
        return
    for own in own_slots(record, also):
        name = own.name.text
        if name in read:
            continue
        hint = _hint(own) or (ELSEWHERE.get(_folded(name), "") if all_read_here else "")
        if hint:
            _warn(ctx, own.name, hint)


def warn_of_all(ctx: Context, record: Record, read: Collection[str]) -> None:
    """Warn of own slots that nothing reads, in a material that sets no colour.

    Of those that do not look like mistakes by themselves, the first one is told.
    """
    if record.baseless:
        return
    idle: list[ast.Name] = []
    named = named_in(record.symbol.module)
    for own in own_slots(record):
        name = own.name.text
        if name in read:
            continue
        if hint := _hint(own) or ELSEWHERE.get(_folded(name), ""):
            _warn(ctx, own.name, hint)
        elif name not in named:  # Else it is the one that reads this that is idle.
            idle.append(own.name)
    for first in idle[:1]:
        ctx.report.add(rules.WITHOUT_COLOR, first.span, name=first.text, material=record.name)


def named_in(module: Module) -> set[str]:
    """The words of a file that stand anywhere but where a member of this name is defined."""
    return set(_NAMED.findall(module.file.source.text))


def _hint(own: Own) -> Hint:
    name, span = own.name.text, own.name.span
    meant = nearest_in(span.source, name, own.others)
    return "" if meant is None else respelt(name, span, meant)


def _folded(name: str) -> str:
    return name.replace("_", "").casefold()


def _warn(ctx: Context, name: ast.Name, hint: Hint) -> None:
    ctx.report.add(rules.UNREAD_SLOT, name.span, name=name.text, hint=hint)
