"""The known name that was probably meant."""

from __future__ import annotations

from collections.abc import Iterable


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The name most like ``name``, if any is like it at all; a slip in case counts least."""
    from difflib import get_close_matches

    candidates = sorted(set(known) - {name})
    for candidate in candidates:
        if candidate.casefold() == name.casefold():
            return candidate
    matches = get_close_matches(name, candidates, n=1, cutoff=0.6)
    return matches[0] if matches else None


def suggestion(name: str, known: Iterable[str]) -> str:
    """A hint naming the nearest name; empty where none is near."""
    found = nearest(name, known)
    return f"did you mean `{found}`?" if found else ""
