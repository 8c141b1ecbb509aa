"""The claims of an import: each of its materials is what a renderable of the document is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Protocol

from .checking import Claim
from .images import Images, NamedImage


class Written(Protocol):
    """A material that an import has written."""

    @property
    def name(self) -> str:
        """The name of the material."""

    @property
    def path(self) -> str:
        """The renderable of the document, by MaterialX's name of it."""

    @property
    def files(self) -> Mapping[str, tuple[str, ...]]:
        """The files of the textures by their names, as the document says them: one, or one for each
        layer."""

    @property
    def is_displaced(self) -> bool:
        """True if points are moved."""


def claims_of(
    document: Path,
    source: Path,
    materials: Iterable[Written],
    image_folders: tuple[Path, ...] = (),
) -> Iterator[Claim]:
    """The claims of all materials of an import.

    ``source`` is the file with the materials, and ``image_folders`` are further folders in which
    the document's images may lie.
    """
    images = Images(document, image_folders)
    for material in materials:
        values = {name: NamedImage(images, files) for name, files in material.files.items()}
        yield Claim(
            document, material.path, source, material.name, values,
            image_folders=image_folders, is_displaced=material.is_displaced,
        )  # fmt: skip
