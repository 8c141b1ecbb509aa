"""Suggestions: the known name that a misspelt one was probably meant to be."""

from __future__ import annotations

from collections.abc import Iterable

from .fixes import Hint, fix_it
from .source import Source, Span

_ALIKE = 0.62
"""The least similarity of two names, as ``difflib`` measures it."""
_SHORT, _ALIKE_IF_SHORT = 4, 0.7
"""Names of up to four letters are similar by chance, as `i` and `pi` or `key` and `eye` are."""
_LONGEST = 60
"""Names with more letters are like no other: comparing takes the product of two lengths."""
_MOST_COMPARED = 10**7
"""The largest number of pairs of letters that are compared in all texts of a compile.

Nobody reads so many suggestions, and the work would grow with the number of unknown names times
that of known ones.
"""


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The known name most similar to ``name``, if any is similar enough.

    Names that differ only in upper and lower case come first, then those with the same letters in
    another order.
    """
    from difflib import get_close_matches

    if len(name) > _LONGEST:
        return None
    candidates = sorted({each for each in known if len(each) <= _LONGEST} - {name})
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


def similarity(one: str, other: str) -> float:
    """The similarity of two names, from 0 to 1, whatever their letters' case."""
    from difflib import SequenceMatcher

    return SequenceMatcher(None, one.casefold(), other.casefold()).ratio()


def _continues(name: str, other: str) -> bool:
    """True if one of two names is the other with one more letter at its end: `tt` for `t`."""
    return abs(len(name) - len(other)) == 1 and (name.startswith(other) or other.startswith(name))


def is_searched_out(source: Source) -> bool:
    """True if so much was compared that no nearest names are looked for in this text any more."""
    return source.compared.letters > _MOST_COMPARED


def nearest_in(source: Source, name: str, known: Iterable[str]) -> str | None:
    """The nearest name for a name of which a text may have very many.

    ``None`` when too much was compared: see ``_MOST_COMPARED``.
    """
    if is_searched_out(source):
        return None
    candidates = set(known)
    source.compared.letters += len(name) * sum(map(len, candidates))
    return nearest(name, candidates)


def respelling(name: str, span: Span, known: Iterable[str]) -> Hint:
    """A hint to write the nearest name for ``name``, which stands at ``span``.

    In a text with very many unknown names it is not looked for any more.
    """
    found = nearest_in(span.source, name, known)
    return "" if found is None else respelt(name, span, found)


def respelt(name: str, span: Span, meant: str) -> Hint:
    """A hint that ``meant`` was probably meant by ``name``, which stands at ``span``."""
    said = f"did you mean `{meant}`?"
    return fix_it(said, (span, meant)) if span.text == name else said


def suggestion(name: str, known: Iterable[str]) -> str:
    """A hint with the nearest name, for names that are not in a text; empty if none is near."""
    found = nearest(name, known)
    return f"did you mean `{found}`?" if found else ""
