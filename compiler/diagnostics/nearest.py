"""The known name that was probably meant."""

from __future__ import annotations

from collections.abc import Iterable

from .fixes import Hint, fix_it
from .source import Source, Span

_ALIKE = 0.62
"""How much of two names has to agree."""
_SHORT, _ALIKE_IF_SHORT = 4, 0.7
"""Names of so few letters agree in most of them by chance: `i` and `pi`, `key` and `eye`."""


_MOST_COMPARED = 100_000
"""How many names are compared in one text. Nobody reads so many suggestions, and the work would
grow with the number of unknown names times that of known ones."""


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The name most like ``name``, if any is like it; a slip in case or order counts least."""
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
    """Whether one of two names is the other with a letter more: `tt` for `t`."""
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
    """A hint naming the nearest name; empty where none is near."""
    found = nearest(name, known)
    return f"did you mean `{found}`?" if found else ""
