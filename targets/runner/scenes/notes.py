"""Gathers what is left out of a scene, for people: a file can have a million reasons for a note."""

from __future__ import annotations

_TOLD = 5
"""How many notes of a kind are told; of the others, their number."""


class Notes:
    """Notes of one file, by what they say."""

    def __init__(self) -> None:
        self._places: dict[str, dict[str, None]] = {}

    def add(self, where: str, what: str) -> None:
        """Note what is left out somewhere: ``what`` goes on where ``where`` ends. A place that is
        noted again is told once."""
        self._places.setdefault(what, {})[where] = None

    def told(self) -> tuple[str, ...]:
        """All notes as sentences, those of a kind one behind the other."""
        found = []
        for what, places in self._places.items():
            found += [f"{where}{what}" for where in [*places][:_TOLD]]
            if (more := len(places) - _TOLD) > 0:
                found.append(f"and {more:,} more like this")
        return tuple(found)
