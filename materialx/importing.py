"""Imports a document: the files of Burnish that it becomes, and what could not be converted."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from .definitions import Functions
from .library import library
from .materials import Material, Materials, Renderable
from .model import Definition, Document
from .models import Models
from .names import slot_name
from .problems import Problem, Unsupported
from .reading import read
from .records import Records
from .texts import File


class Imported(NamedTuple):
    """What a document becomes: texts by their paths in a folder, the materials, and what is missing."""

    files: dict[str, str]
    materials: Sequence[Material]
    problems: Sequence[Problem]


def imported(path: Path) -> Imported:
    """Convert a document. Raises ``DocumentError`` and ``OSError`` if it cannot be read."""
    document, renderables = read(path)
    return converted(document, renderables, slot_name(path.stem))


def converted(document: Document, renderables: Iterable[Renderable], name: str) -> Imported:
    """Convert what of a document is drawn, to a file with this name and to those that it imports."""
    own = File(name, heading=f"//! Imported from `{document.name}`, a document of MaterialX {document.version}.")
    functions = Functions(own, _Known())
    models = Models(functions, own)
    writer = Materials(own, functions, models)
    materials, problems = [], []
    for renderable in renderables:
        try:
            materials.append(writer.written(renderable))
        except Unsupported as error:
            place = error.path or renderable.path
            problems.append(Problem(place, document.place(place), error.text))
    files = {f"{file.path}.burnish": file.text() for file in (own, *functions.files.values())}
    return Imported(files, materials, problems)


class _Known:
    """The definitions of MaterialX's own library by their categories."""

    def __init__(self) -> None:
        self._records = Records(library(), library())

    def __call__(self, category: str) -> list[Definition]:
        names = [found.getName() for found in library().getMatchingNodeDefs(category)]
        return [found for name in names if (found := self._records.definition(name)) is not None]
