"""What an importer cannot convert, and where it stands."""

from __future__ import annotations

from dataclasses import dataclass


class UnsupportedError(Exception):
    """Something in a document that has no meaning in Burnish, or none at all.

    ``path`` is filled in by whoever knows the element.
    """

    def __init__(self, text: str, path: str = "") -> None:
        super().__init__(text)
        self.text, self.path = text, path


@dataclass(frozen=True)
class Problem:
    """One thing that was not converted as it stands: an element, its place, and a sentence."""

    path: str
    place: str
    text: str
    is_error: bool = True

    def __str__(self) -> str:
        """One line, whatever names and values the document has."""
        return " ".join(f"{self.place}: {self.path}: {self.text}".split())
