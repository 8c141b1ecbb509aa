"""Warns of slots that a file declares and nothing reads: misspelt ones, and words of other systems.

A name that no base declares is a new slot. That is often wanted, as other equations read it. But a
name that nearly is one of a base, or that means something elsewhere, would be ignored silently.
``slot_checks`` asks for it, with what was read of a material, a pass, a light or a kernel.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable, Iterator, Mapping

from ....support.frozen import cached_property, frozen
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
    **dict.fromkeys(("fragdepth", "glfragdepth", "svdepth", "pixeldepth"), _NO_DEPTH),
    **dict.fromkeys(("clipdistance", "glclipdistance", "svclipdistance", "culldistance",
                     "svculldistance", "glculldistance"), _NO_CLIP),
    **dict.fromkeys(("pointsize", "glpointsize", "psize"), _NO_POINTS),
    **dict.fromkeys(("glposition", "svposition"), _IN_CLIP),
    **dict.fromkeys(("roughness", "metallic", "metalness", "ao", "occlusion", "emissive",
                     "emission"), _GLTF),
}  # fmt: skip
"""Words of other systems for what a shader writes, in small letters and without underscores, and
what there is here instead."""


_ALIKE = 0.75
"""The least similarity of an unread slot and one of a base that it may have meant."""


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
    """The names that others than one owner declare, without those of the mesh.

    One that is abstract, and stays so, is told by itself.
    """
    for name, rows in record.definitions.items():
        member = rows[0].member
        is_theirs = any(row.owner is not owner for row in rows)
        if is_theirs and not (is_abstract(member) or isinstance(member, ast.Attribute)):
            yield name


def warn_of_unread(
    ctx: Context,
    record: Record,
    *read: Collection[str],
    beside: Container[str] = (),
    also: Collection[str] = (),
    all_read_here: bool = True,
) -> None:
    """Warn of each own slot of a record that is in none of ``read`` and looks like a mistake.

    Nor may it be in ``beside``, which is asked last, as it may have to look through a file.
    ``also`` are names beside those of its bases that it may have meant. If it is ``all_read_here``,
    no other pass can read its slots, so that words of other systems are told, too.
    """
    if record.baseless:
        return
    for own in own_slots(record, also):
        if any(own.name.text in each for each in read):
            continue  # Most are read, and names are compared slowly.
        hint = _hint(own, elsewhere=all_read_here)
        if hint and own.name.text not in beside:
            _warn(ctx, own.name, hint)


def warn_of_all(ctx: Context, record: Record, read: Collection[str]) -> None:
    """Warn of own slots that nothing reads, in a material that sets no colour.

    Of those that do not look like mistakes by themselves, the first one is told.
    """
    if record.baseless:
        return
    idle: list[ast.Name] = []
    named = NamedIn(record.symbol.module)
    for own in own_slots(record):
        if own.name.text in read:
            continue
        if hint := _hint(own):
            _warn(ctx, own.name, hint)
        elif own.name.text not in named:  # Else it is the one that reads this that is idle.
            idle.append(own.name)
    for first in idle[:1]:
        ctx.report.add(rules.WITHOUT_COLOR, first.span, name=first.text, material=record.name)


class NamedIn:
    """The names that some expression of a file reads, found when somebody asks for the first."""

    def __init__(self, module: Module) -> None:
        self._module = module

    def __contains__(self, name: object) -> bool:
        return name in self._names

    @cached_property
    def _names(self) -> frozenset[str]:
        return frozenset(_names_in(self._module.file.declarations))


def _names_in(root: object) -> Iterator[str]:
    """The names in all expressions of a syntax tree: `name`, and `light.name`."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        match node:
            case ast.Reference(name=name) | ast.Field(name=ast.Name(text=name)):
                yield name
        if isinstance(node, tuple):
            waiting += node
        elif hasattr(node, "span"):
            fields: tuple[str, ...] = vars(type(node))["__match_args__"]
            waiting += [getattr(node, field) for field in fields]


def _hint(own: Own, *, elsewhere: bool = True) -> Hint:
    """What the slot may have meant: a word of other systems, or a name that is nearly the same."""
    name, span = own.name.text, own.name.span
    advice = _advice(own) if elsewhere else ""
    if advice and advice is not _GLTF:
        return advice
    meant = nearest_in(span.source, name, own.others)
    return advice if meant is None or not _is_alike(name, meant) else respelt(name, span, meant)


def _is_alike(name: str, meant: str) -> bool:
    """True if a name is nearly another one: that of a slot is right by itself, though unread."""
    from difflib import SequenceMatcher

    one, other = _folded(name), _folded(meant)
    return sorted(one) == sorted(other) or SequenceMatcher(None, one, other).ratio() >= _ALIKE


def _advice(own: Own) -> str:
    """What is said of a word of other systems, unless a base has one that is nearly the same."""
    folded = _folded(own.name.text)
    return "" if folded in map(_folded, own.others) else ELSEWHERE.get(folded, "")


def _folded(name: str) -> str:
    return name.replace("_", "").casefold()


def _warn(ctx: Context, name: ast.Name, hint: Hint) -> None:
    ctx.report.add(rules.UNREAD_SLOT, name.span, name=name.text, hint=hint)
