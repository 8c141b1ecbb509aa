"""The claims of an import: each of its materials is what a renderable of the document is."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..importing import Imported
from .checking import Claim
from .images import Images


def claims_of(
    document: Path, imported: Imported, folder: Path, root: Path | None = None
) -> Iterator[Claim]:
    """The claims of all materials of an import whose files lie in a folder.

    ``root`` is the folder in which the document's images lie. Raises ``FidelityError`` for images
    outside of it.
    """
    images = Images(document, root)
    source = folder / next(iter(imported.files))
    for material in imported.materials:
        found = {name: images.path(file) for name, file in material.files.items()}
        values = {name: str(path) for name, path in found.items() if path is not None}
        yield Claim(document, material.path, source, material.name, values, root=root)
