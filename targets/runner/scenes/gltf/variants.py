"""Chooses the materials of a file in one of its variants (``KHR_materials_variants``)."""

from __future__ import annotations

from pathlib import Path

from ..notes import Notes
from ..records import SceneError, short
from .schema import File, Primitive, VariantMapping

_TOLD = 20
"""The most variants of a file that a message lists."""


class ChosenVariant:
    """A variant of a file, or none."""

    def __init__(self, file: File, path: Path, name: str | None, notes: Notes) -> None:
        """Raises ``SceneError`` if the file has no variant of this name. Without a name, primitives
        keep their materials, and a note tells of the file's variants."""
        names = [each.name for each in file.extensions.variants.variants]
        self._count = len(names)
        if name is None:
            self._number = None
            if names:
                notes.add(f"it has {_listed(names)}", ": `--variant NAME` shows one")
        elif name in names:
            self._number = names.index(name)
        else:
            said = f"it has {_listed(names)}" if names else "it has none"
            raise SceneError(f"{path} has no variant {short(name)!r}: {said}")

    def material_of(self, primitive: Primitive, what: str) -> int | None:
        """The number of a primitive's material. Raises ``SceneError``; ``what`` names the
        primitive in it."""
        found = [each for each in primitive.extensions.variants.mappings if self._shows(each, what)]
        return found[0].material if found else primitive.material

    def _shows(self, mapping: VariantMapping, what: str) -> bool:
        for number in mapping.variants:
            if number >= self._count:
                raise SceneError(f"{what}: there is no variant {number}")
        return self._number in mapping.variants


def _listed(names: list[str]) -> str:
    shown = ", ".join(repr(short(name)) for name in names[:_TOLD])
    return f"the variants {shown}{', …' if len(names) > _TOLD else ''}"
