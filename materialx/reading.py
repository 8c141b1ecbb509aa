"""Reads documents of MaterialX, by the package of that name.

A document may come from anybody. So its text is looked through before the package gets it: its
size, how deep its elements nest, and that it declares no entities; and files that it includes are
read only from its own folder.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from pathlib import Path
from typing import Any

from ..targets.runner.files import regular
from .library import library
from .materials import Renderable
from .model import Document, Graph, Link, Port
from .outline import DocumentError, Outline
from .records import Records
from .values import CLOSURES

LARGEST = 32 << 20
"""The most bytes of a document and of all files that it includes."""


def read(path: Path) -> tuple[Document, list[Renderable]]:
    """A document and what of it is drawn. Raises ``DocumentError``, ``FileError`` for what is no
    file, and ``OSError`` if it cannot be read."""
    import MaterialX

    texts = _Texts(path)
    document = MaterialX.createDocument()
    options = MaterialX.XmlReadOptions()
    options.readXIncludeFunction = None
    for text in texts.texts:
        part = document if text is texts.texts[0] else MaterialX.createDocument()
        try:
            MaterialX.readFromXmlString(part, text, MaterialX.FileSearchPath(), options)
        except (MaterialX.Exception, MaterialX.ExceptionParseError) as error:
            raise DocumentError(f"{path.name}:1: error: {_sentence(str(error))}") from None
        if part is not document:
            document.importLibrary(part)
    document.setDataLibrary(library())
    records = Records(document, library(), texts.comments)
    try:
        top = records.top()
    except (LookupError, MaterialX.ExceptionFoundCycle) as error:
        raise DocumentError(f"{path.name}:1: error: {_sentence(str(error))}") from None
    version = document.getVersionString()
    found = Document(
        path.name, version, top, texts.lines, records.structures(), texts.repeated,
        texts.comments.get("", ""),
    )  # fmt: skip
    return found, list(_with_looks(top, document))


class _Texts:
    """The texts of a file and of all that it includes from its folder."""

    def __init__(self, path: Path) -> None:
        self.texts: list[str] = []
        self.lines: dict[str, tuple[str, int]] = {}
        self.repeated: dict[str, tuple[str, int]] = {}
        self.comments: dict[str, str] = {}
        self._root = path.parent.resolve()
        self._seen: set[Path] = set()
        self._left = LARGEST
        self._read(path, path.name)

    def _read(self, path: Path, name: str) -> None:
        if path.resolve() in self._seen:
            return
        self._seen.add(path.resolve())
        with regular(path, str(path)) as file:
            text = file.read(self._left + 1)
        if len(text) > self._left:
            raise DocumentError(
                f"{name}:1: error: documents of more than {LARGEST >> 20} MiB are not read"
            )
        self._left -= len(text)
        outline = Outline(name, text.decode("utf-8", "replace"))
        self.lines = outline.places | self.lines
        self.repeated |= outline.repeated
        self.comments = outline.comments | self.comments
        try:
            self.texts.append(text.decode("utf-8"))
        except UnicodeDecodeError:
            raise DocumentError(f"{name}:1: error: this text is not UTF-8") from None
        for href in outline.included:
            try:
                other = (path.parent / href).resolve()
                is_inside = other.is_relative_to(self._root) and "://" not in href
                is_there = is_inside and other.is_file()
            except (OSError, ValueError):  # Too long, or with characters that no path has.
                is_inside, is_there = True, False
            if not is_inside:
                raise DocumentError(
                    f"{name}:1: error: '{href}' is included from outside of the document's folder"
                )
            if not is_there:
                said = href if len(href) < 100 else f"{href[:100]}…"
                raise DocumentError(
                    f"{name}:1: error: there is no file '{said}', which is included"
                )
            self._read(other, str(other.relative_to(self._root)))


def _sentence(text: str) -> str:
    first = text[:1] if text[1:2].isupper() else text[:1].lower()
    return first + text[1:].rstrip(". ")


def _with_looks(top: Graph, document: Any) -> Iterator[Renderable]:
    """What is drawn; the words about a material say what the document's looks assign it to."""
    places: dict[str, dict[str, list[str]]] = {}
    for look in document.getLooks():
        for each in look.getActiveMaterialAssigns():
            looks = places.setdefault(each.getMaterial(), {})
            collection = each.getCollectionString()
            named = f"the collection `{collection}`" if collection else f"`{each.getGeom()}`"
            looks.setdefault(look.getName(), []).append(named)
    for found in _renderables(top):
        looks = places.get(found.name, {})
        words = [f"In the look `{name}` of {' and '.join(each)}." for name, each in looks.items()]
        yield found._replace(doc=" ".join(filter(None, [found.doc, *words])))


def _renderables(top: Graph) -> Iterator[Renderable]:
    """What MaterialX's own viewers draw: materials; without any, outputs of the document and of its
    graphs. A surface that none of these reads is drawn, too, and not the graphs that it reads."""
    materials = [node for node in top.nodes.values() if node.type == "material"]
    ports = [port for node in top.nodes.values() for port in node.inputs.values()]
    used = {port.link.node for port in (*ports, *top.outputs.values()) if port.link}
    surfaces = [
        node for node in top.nodes.values()
        if node.type == "surfaceshader" and node.name not in used
    ]  # fmt: skip
    for node in materials or surfaces:
        port = Port("out", node.type, link=Link(node.name))
        yield Renderable(node.path, node.name, port, top, node.hints.get("doc", ""))
    if not materials:
        read = [port for node in surfaces for port in node.inputs.values()]
        yield from _outputs(
            top, {(port.link.graph, port.link.output) for port in read if port.link}
        )


def _outputs(top: Graph, read: Set[tuple[str, str]]) -> Iterator[Renderable]:
    """The outputs of the document and of its graphs, but for those that are ``read``, by the names
    of their graphs and their own."""
    for port in top.outputs.values():
        if port.type not in CLOSURES:
            yield Renderable(port.name, port.name, port, top)
    for graph in top.graphs.values():
        only = len(graph.outputs) == 1
        for port in graph.outputs.values():
            is_read = (graph.name, port.name) in read or (only and (graph.name, "") in read)
            if is_read or port.type in CLOSURES:
                continue
            name = graph.name if only else f"{graph.name}_{port.name}"
            link = Link("", graph.name, port.name)
            yield Renderable(
                f"{graph.path}/{port.name}",
                name,
                Port("out", port.type, link=link),
                top,
                graph.hints.get("doc", ""),
            )
