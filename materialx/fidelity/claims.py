"""The claims of an import: each of its materials is what a renderable of the document is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Protocol

from .checking import Claim
from .images import Images


class Written(Protocol):
    """A material that an import has written."""

    @property
    def name(self) -> str:
        """The name of the material."""

    @property
    def path(self) -> str:
        """The renderable of the document, by MaterialX's name of it."""

    @property
    def files(self) -> Mapping[str, str]:
        """The files of the textures by their names, as the document says them."""


def claims_of(
    document: Path, source: Path, materials: Iterable[Written], root: Path | None = None
) -> Iterator[Claim]:
    """The claims of all materials of an import.

    ``source`` is the file with the materials, and ``root`` the folder in which the document's
    images lie. Raises ``FidelityError`` for images outside of it.
    """
    images = Images(document, root)
    for material in materials:
        found = {name: images.path(file) for name, file in material.files.items()}
        values = {name: str(path) for name, path in found.items() if path is not None}
        yield Claim(document, material.path, source, material.name, values, root=root)
