"""Collects notes about the parts of a scene that are left out; a file can cause a million."""

from __future__ import annotations

_TOLD = 5
"""The most notes of a kind that are listed; for the others, their number is given."""


class Notes:
    """Notes of one file, by their text."""

    def __init__(self) -> None:
        self._places: dict[str, dict[str, None]] = {}

    def add(self, where: str, what: str) -> None:
        """Note that something is left out at a place.

        ``what`` continues the sentence that ``where`` begins. A place that is noted again is listed
        once.
        """
        self._places.setdefault(what, {})[where] = None

    def told(self) -> tuple[str, ...]:
        """All notes as sentences; those of a kind follow each other."""
        found = []
        for what, places in self._places.items():
            found += [f"{where}{what}" for where in [*places][:_TOLD]]
            if (more := len(places) - _TOLD) > 0:
                found.append(f"and {more:,} more like this")
        return tuple(found)
