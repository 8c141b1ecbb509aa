"""Suggestions: the known name that a misspelt one was probably meant to be."""

from __future__ import annotations

from collections.abc import Iterable

from .fixes import Hint, fix_it
from .source import Source, Span

_ALIKE = 0.62
"""How similar two names have to be, as ``difflib`` measures it."""
_SHORT, _ALIKE_IF_SHORT = 4, 0.7
"""Names of up to four letters are similar by chance, as `i` and `pi` or `key` and `eye` are."""


_MOST_COMPARED = 100_000
"""How many names are compared in one text. Nobody reads so many suggestions, and the work would
grow with the number of unknown names times that of known ones."""


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The known name most similar to ``name``, if any is similar enough.

    Names that differ only in upper and lower case come first, then those with the same letters in
    another order.
    """
    from difflib import get_close_matches

    candidates = sorted(set(known) - {name})
    for candidate in candidates:
        if candidate.casefold() == name.casefold():
            return candidate
    for candidate in candidates:
        if sorted(candidate) == sorted(name):
            return candidate
    for candidate in candidates:
        if len(name) <= _SHORT and _continues(name, candidate):
            return candidate
    cutoff = _ALIKE_IF_SHORT if len(name) <= _SHORT else _ALIKE
    folded = {candidate.casefold(): candidate for candidate in reversed(candidates)}
    matches = get_close_matches(name.casefold(), folded, n=1, cutoff=cutoff)
    return folded[matches[0]] if matches else None


def _continues(name: str, other: str) -> bool:
    """Whether one of two names is the other with one more letter at its end: `tt` for `t`."""
    return abs(len(name) - len(other)) == 1 and (name.startswith(other) or other.startswith(name))


def is_searched_out(source: Source) -> bool:
    """Whether so many names were compared that no nearest one is looked for in this text."""
    return source.compared > _MOST_COMPARED


def respelling(name: str, span: Span, known: Iterable[str]) -> Hint:
    """A hint to write the nearest name for ``name``, which stands at ``span``.

    In a text with very many unknown names it is not looked for any more: see ``_MOST_COMPARED``.
    """
    if is_searched_out(span.source):
        return ""
    candidates = set(known)
    span.source.compared += len(candidates)
    found = nearest(name, candidates)
    return "" if found is None else respelt(name, span, found)


def respelt(name: str, span: Span, meant: str) -> Hint:
    """A hint that ``meant`` was probably meant by ``name``, which stands at ``span``."""
    said = f"did you mean `{meant}`?"
    return fix_it(said, (span, meant)) if span.text == name else said


def suggestion(name: str, known: Iterable[str]) -> str:
    """A hint with the nearest name, for names that are not in a text; empty if none is near."""
    found = nearest(name, known)
    return f"did you mean `{found}`?" if found else ""
