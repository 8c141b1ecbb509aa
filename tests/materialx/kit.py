"""Where the tests' own documents are, and the names of all that they render."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).parent
DOCUMENTS = FOLDER / "documents"
BY_HAND = FOLDER / "by_hand"


def documents() -> list[Path]:
    """All documents, in the order of their names."""
    return sorted(DOCUMENTS.glob("*.mtlx"))


def document(name: str) -> Path:
    """The document with this name."""
    return DOCUMENTS / f"{name}.mtlx"
