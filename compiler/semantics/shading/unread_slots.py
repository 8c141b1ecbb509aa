"""Warns of slots that a file declares and nothing reads: misspelt ones, and words of other systems.

A name that no base declares is a new slot, or a new parameter. That is often wanted, as other
equations read it. But a name that nearly is one of a base, or that means something elsewhere, would
be ignored silently. ``slot_checks``, ``trials`` and those who check kernels and frames ask for it,
with what was read of a record.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Container, Iterable, Iterator
from string import digits

from ....support.frozen import frozen
from ...diagnostics import rules
from ...diagnostics.fixes import Hint
from ...diagnostics.nearest import nearest_in, respelt, similarity
from ...syntax import ast
from ..inheritance.records import Record, is_abstract
from ..names.modules import Module
from ..state.context import Context

_ALIKE = 0.75
"""The least similarity of an unread slot and one of a base that it may have meant."""


CLOSED = ("kernel", "frame")
"""The kinds of records whose slots nothing outside of them reads, whatever they are called."""


@frozen
class Own:
    """A slot, parameter, texture or buffer that a record's own file declares, and no base of it."""

    name: ast.Name
    others: frozenset[str]
    """The names that its bases and mixins declare."""
    kind: str
    """The kind of the record, or of what a mixin is for."""
    is_offered: bool
    """True if a base or a mixin declares it, from which others may be derived that read it."""


def own_members(record: Record, also: Iterable[str] = ()) -> Iterator[Own]:
    """What a record's file adds to the chain; ``also`` are further ``others``.

    What an imported file declares is an offer, and its names are for that file to check. A slot of
    an abstract material that states its type is declared on purpose: one that was meant to replace
    that of a base needs no type.
    """
    kind = _kind(record)
    is_abstract_offer = kind == "material" and _is_offer(record)
    others: dict[int, frozenset[str]] = {}
    for definitions in record.definitions.values():
        first = definitions[0]
        member, owner, level = first.member, first.owner, first.level
        is_new = all(definition.owner is owner for definition in definitions)
        if is_abstract_offer and isinstance(member, ast.Slot) and member.type is not None:
            continue
        if is_new and isinstance(member, _READ) and owner.module is record.symbol.module:
            if level not in others:
                others[level] = frozenset((*_others(record, level), *also))
            yield Own(member.name, others[level], kind, owner is not record.symbol)


_READ = ast.Slot | ast.Param | ast.Texture | ast.Buffer


def _is_offer(record: Record) -> bool:
    """True if a record is there for others, which may read what it adds."""
    declaration = record.symbol.declaration
    return not isinstance(declaration, ast.Record) or declaration.abstract


def _kind(record: Record) -> str:
    """The kind of a record, and of what a mixin is for."""
    declaration = record.symbol.declaration
    return declaration.kind if isinstance(declaration, ast.Record | ast.Mixin) else ""


def _others(record: Record, level: int) -> Iterator[str]:
    """The names that the ancestors behind one level declare.

    One that is abstract, and stays so, is told by itself.
    """
    for name, rows in record.definitions.items():
        member = rows[0].member
        is_theirs = rows[-1].level > level
        if is_theirs and not is_abstract(member):
            yield name


def warn_of_unread(
    ctx: Context,
    record: Record,
    *read: Collection[str],
    beside: Container[str] = (),
    also: Collection[str] = (),
    all_read_here: bool = True,
) -> None:
    """Warn of what a record adds if it is in none of ``read`` and looks like a mistake.

    Nor may it be in ``beside``, which is asked last, as it may have to look through a file.
    ``also`` are names beside those of its bases that it may have meant. If it is ``all_read_here``,
    no other pass can read its slots, so that words of other systems are told, too.
    """
    if record.baseless:
        return
    is_closed = _kind(record) in CLOSED and not _is_offer(record)
    named = NamedIn(record.symbol.module)
    for own in own_members(record, also):
        if any(own.name.text in each for each in read):
            continue  # Most are read, and names are compared slowly.
        hint = _hint(own, elsewhere=all_read_here)
        is_idle = own.name.text not in (named if own.is_offered else beside)
        if (hint or (is_closed and not own.is_offered)) and is_idle:
            _warn(ctx, own.name, hint)


def warn_of_all(ctx: Context, record: Record, read: Collection[str]) -> None:
    """Warn of what a material adds and nothing reads, if it sets no colour.

    Of those that do not look like mistakes by themselves, the first one is told.
    """
    if record.baseless:
        return
    idle: list[ast.Name] = []
    named = NamedIn(record.symbol.module)
    for own in own_members(record):
        if own.name.text in read or (own.is_offered and own.name.text in named):
            continue
        if hint := _hint(own):
            _warn(ctx, own.name, hint)
        elif not own.is_offered and own.name.text not in named:  # Else what reads it is idle.
            idle.append(own.name)
    for first in idle[:1]:
        ctx.report.add(rules.WITHOUT_COLOR, first.span, name=first.text, material=record.name)


class NamedIn:
    """The names that some expression of a file reads; asking for one may look through the file."""

    def __init__(self, module: Module) -> None:
        self._module = module

    def __contains__(self, name: object) -> bool:
        return name in self._module.read


def _hint(own: Own, *, elsewhere: bool = True) -> Hint:
    """What the slot may have meant: a word of other systems, or a name that is nearly the same."""
    name, span = own.name.text, own.name.span
    from ....stdlib.builtins.foreign_words import OF_GLTF

    advice = _advice(own) if elsewhere else ""
    if advice and advice is not OF_GLTF:
        return advice
    meant = nearest_in(span.source, name, own.others)
    return advice if meant is None or not _is_alike(name, meant) else respelt(name, span, meant)


def _is_alike(name: str, meant: str) -> bool:
    """True if a name is nearly another one: that of a slot is right by itself, though unread.

    A number behind a name is no mistake: ``uv1`` stands beside ``uv``. Nor is a word before or
    behind it, as in ``old_position``, which a pass of another file may read.
    """
    one, other = _folded(name), _folded(meant)
    if one.rstrip(digits) == other.rstrip(digits):
        return one == other
    words, fewer = _words(name), _words(meant)
    if len(words) > len(fewer) and fewer in (words[: len(fewer)], words[-len(fewer) :]):
        return False
    return sorted(one) == sorted(other) or similarity(one, other) >= _ALIKE


def _advice(own: Own) -> str:
    """What is said of a word of other systems, unless a base has one that is nearly the same."""
    from ....stdlib.builtins.foreign_words import SLOTS

    folded = _folded(own.name.text)
    words = SLOTS.get(own.kind, {})
    return "" if folded in map(_folded, own.others) else words.get(folded, "")


def _words(name: str) -> list[str]:
    """The words of a name, which an underscore divides or a capital letter begins."""
    return [word.casefold() for word in re.findall(r"[A-Z]*[^A-Z_]+|[A-Z]+", name)]


def _folded(name: str) -> str:
    return name.replace("_", "").casefold()


def word_of_light(name: str) -> str:
    """What is said of a word of other systems for what a light sends; empty if it is none."""
    from ....stdlib.builtins.foreign_words import OF_LIGHTS

    return OF_LIGHTS.get(_folded(name), "")


def _warn(ctx: Context, name: ast.Name, hint: Hint) -> None:
    ctx.report.add(rules.UNREAD_SLOT, name.span, name=name.text, hint=hint)
