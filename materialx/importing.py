"""Imports a document: the files of Burnish that it becomes, and what could not be converted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from ..compiler.opening import MOST_PROGRAMS
from ..support.depth import with_depth
from ..support.garbage import seldom_collected
from .archives import unpacked
from .definitions import Functions
from .known import known
from .lights import lights_of, rig_of
from .materials import Material, Materials, Renderable
from .model import Document
from .models import Models
from .names import slot_name
from .outline import DocumentError
from .pictures import Picture, Pictures, is_set
from .problems import Problem, UnsupportedError
from .reading import read
from .structures import Structures
from .texts import File, one_line, wrapped


class Imported(NamedTuple):
    """What a document becomes: texts and pictures by their paths in a folder, its materials, and
    what is missing."""

    files: Mapping[str, bytes]
    main: str
    """The path of the file that has the materials."""
    materials: Sequence[Material]
    problems: Sequence[Problem]


@seldom_collected
def imported(path: Path, name: str = "", image_folders: Sequence[Path] = ()) -> Imported:
    """Convert a document to files of Burnish.

    The main one is called ``name``, or else like the document.

    Pictures are taken from the document's folder, from the archive that it lies in, and from
    ``image_folders``, and from nowhere else. Raises ``DocumentError``, ``FileError`` for what is
    neither a file nor an archive, and ``OSError`` if the document cannot be read.
    """
    with unpacked(path, tuple(image_folders)) as source:
        document, renderables = read(source.document)
        pictures = Pictures((source.document.parent, *source.image_folders))
        title = name or slot_name(source.document.stem)
        return with_depth(lambda: converted(document, renderables, title, pictures))


def converted(
    document: Document, renderables: Sequence[Renderable], name: str, pictures: Pictures
) -> Imported:
    """Convert what of a document is drawn, to a file with this name and to those that it imports.
    Raises ``DocumentError`` for more materials than a file may have."""
    if len(renderables) > MOST_PROGRAMS:
        raise DocumentError(
            f"{document.name}:1: error: {len(renderables)} materials or outputs are drawn, and a "
            f"file of Burnish has at most {MOST_PROGRAMS}: divide the document"
        )
    own = File(name)
    structures = Structures(own, document.structures)
    functions = Functions(own, known, structures, pictures.tiles)
    writer = Materials(own, functions, Models(functions, own))
    materials: list[Material] = []
    problems = list(_repeated(document))
    for renderable in renderables:
        try:
            materials.append(writer.written(renderable))
        except UnsupportedError as error:
            place = error.path or renderable.path
            problems.append(Problem(place, document.place(place), error.text))
        except RecursionError:
            text = "its nodes depend on each other over more steps than are followed"
            problems.append(Problem(renderable.path, document.place(renderable.path), text))
    for left_out in rig_of(lights_of(document.top), document.top, own, functions):
        place = document.place(left_out.path)
        problems.append(Problem(left_out.path, place, left_out.text, is_error=False))
    copied: dict[str, list[Picture]] = {}
    for material in materials:
        problems += _notes(document, material, pictures, copied)
    set_by = {
        title: ",".join(picture.path for picture in layers)
        for title, layers in copied.items()
        if layers
    }
    own.heading = _heading(document, name, materials, set_by)
    texts = {
        f"{file.path}.burnish": file.text().encode() for file in (own, *functions.files.values())
    }
    contents = {picture.path: picture.content for layers in copied.values() for picture in layers}
    return Imported(texts | contents, f"{name}.burnish", materials, problems)


def _notes(
    document: Document, material: Material, pictures: Pictures, copied: dict[str, list[Picture]]
) -> Iterator[Problem]:
    """What a person should know about a material and its pictures, which are added to ``copied`` by
    their maps."""
    texts = [f"its `{word}` is left out" for word in material.left_out]
    for title, files in material.files.items():
        found = [pictures.found(file) for file in files]
        copied[title] = [each for each in found if each is not None]
        for file, picture in zip(files, found, strict=True):
            texts.append(_about(file, picture, is_too_large=file in pictures.too_large))
    place = document.place(material.path)
    for text in filter(None, texts):
        yield Problem(material.path, place, text, is_error=False)


def _repeated(document: Document) -> Iterator[Problem]:
    for path, (file, line) in document.repeated.items():
        text = "an element before it has this name already, and this one is left out"
        yield Problem(path, f"{file}:{line}", text)


def _about(file: str, picture: Picture | None, *, is_too_large: bool) -> str:
    """What a person should know about a picture; nothing if it is one that was found."""
    if is_too_large:
        return (
            f"the picture `{file}` is too large to be copied: "
            "its texture is white until a host binds it"
        )
    if picture is None:
        return (
            f"the picture `{file}` is not in the document's folder: "
            "its texture is white until a host binds it"
        )
    if is_set(file):
        return (
            f"of the files `{file}` for the squares of a chart, the first is drawn on all of them"
        )
    return ""


def _heading(
    document: Document, name: str, materials: Sequence[Material], pictures: Mapping[str, str]
) -> str:
    """The comment about the file, with the command that draws its first material."""
    lines = [
        f"//! Imported from `{one_line(document.name)}`, "
        f"a document of MaterialX {one_line(document.version)}."
    ]
    if document.comment:
        lines += ["//!", *(f"//! {line}" for line in wrapped(one_line(document.comment), 110))]
    if materials:
        first = materials[0]
        words = [f"burnish render {name}.burnish -o {name}.png"]
        if len(materials) > 1:
            words.append(f"--material {first.name}")
        words += [f"--set {title}={pictures[title]}" for title in first.files if title in pictures]
        lines += ["//!", *(f"//!     {line}" for line in _continued(words))]
    return "\n".join(lines)


def _continued(words: Sequence[str]) -> list[str]:
    """A command in lines, each but the last with a backslash at its end."""
    lines = [words[0]]
    for word in words[1:]:
        if len(lines[-1]) + len(word) > 100:
            lines[-1] += " \\"
            lines.append(f"    {word}")
        else:
            lines[-1] += f" {word}"
    return lines
