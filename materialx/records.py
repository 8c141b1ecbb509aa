"""Records of what the package ``MaterialX`` has parsed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .model import Definition, Graph, Link, Node, Port, Structure

TARGET = "genglsl"
"""The generator whose choice of implementations is followed: it is what most renderers execute."""

_HINTS = (
    "doc", "uiname", "uifolder", "uimin", "uimax", "uisoftmin", "uisoftmax", "enum", "enumvalues",
)  # fmt: skip


class Records:
    """Makes records of a document, each definition once."""

    def __init__(self, document: Any, library: Any, comments: Mapping[str, str]) -> None:
        self._document, self._library = document, library
        self._comments = comments
        self._definitions: dict[str, Definition] = {}

    def top(self) -> Graph:
        """The document as a graph: the nodes and graphs at its top."""
        return self._graph(self._document)

    def definition(self, name: str) -> Definition | None:
        """The definition with this name, of the document or of the library."""
        found = self._document.getNodeDef(name) or self._library.getNodeDef(name)
        return None if found is None else self._defined(found)

    def _graph(self, element: Any) -> Graph:
        nodes = {node.getName(): self._node(node) for node in element.getNodes()}
        graphs = {}
        # What a definition means has the inputs that the definition declares.
        owner = element if element is self._document else element.getNodeDef() or element
        if element is self._document:
            graphs = {
                child.getName(): self._graph(child)
                for child in element.getChildren()
                if child.isA(_graph_class())
            }
        return Graph(
            element.getName(),
            element.getNamePath(),
            {port.getName(): self._port(port) for port in owner.getActiveInputs()},
            nodes,
            {port.getName(): self._port(port) for port in element.getOutputs()},
            graphs,
            self._hints(element),
        )

    def _node(self, element: Any) -> Node:
        found = element.getNodeDef(TARGET, True) or element.getNodeDef(TARGET)
        return Node(
            element.getName(),
            element.getCategory(),
            element.getType(),
            element.getNamePath(),
            {port.getName(): self._port(port) for port in element.getActiveInputs()},
            None if found is None else self._defined(found),
            self._hints(element),
            element.getInheritString(),
        )

    def _defined(self, element: Any) -> Definition:
        name = element.getName()
        if name not in self._definitions:
            self._definitions[name] = Definition(
                name,
                element.getNodeString(),
                {port.getName(): self._port(port) for port in element.getActiveInputs()},
                {port.getName(): self._port(port) for port in element.getActiveOutputs()},
                self._document.getNodeDef(name) is None or self._is_of_library(element),
                lambda: self._body(element),
                self._hints(element),
                self._source(element),
            )
        return self._definitions[name]

    def _is_of_library(self, element: Any) -> bool:
        found = self._library.getNodeDef(element.getName())
        return found is not None and bool(found == element)

    def structures(self) -> dict[str, Structure]:
        """The types of the document that have members."""
        return {
            found.getName(): Structure(
                found.getName(),
                {member.getName(): _member(member) for member in found.getMembers()},
            )
            for found in self._document.getTypeDefs()
            if found.getMembers()
        }

    def _source(self, element: Any) -> str:
        if self._is_of_library(element):
            return ""
        found = element.getImplementation(TARGET)
        return "" if found is None else str(found.getAttribute("sourcecode"))

    def _body(self, element: Any) -> Graph | None:
        found = element.getImplementation(TARGET)
        return self._graph(found) if found is not None and found.isA(_graph_class()) else None

    def _port(self, element: Any) -> Port:
        link = None
        node = element.getAttribute("nodename")
        graph = element.getAttribute("nodegraph")
        output = element.getAttribute("output")
        if node or graph or output:
            link = Link(node, graph, output)
        value = None
        if element.hasAttribute("value"):
            # Of files, with the prefix and the tokens of the graph.
            is_file = element.getType() == "filename"
            value = element.getResolvedValueString() if is_file else element.getValueString()
        return Port(
            element.getName(),
            element.getType(),
            value,
            link,
            element.getAttribute("interfacename"),
            element.getAttribute("defaultgeomprop"),
            element.getActiveColorSpace(),
            element.getAttribute("unit"),
            element.getAttribute("unittype"),
            self._hints(element),
        )

    def _hints(self, element: Any) -> Mapping[str, str]:
        found = {name: element.getAttribute(name) for name in _HINTS if element.hasAttribute(name)}
        comment = self._comments.get(element.getNamePath()) if self._comments else None
        if comment is None:
            return found
        doc = found.get("doc", "").strip()
        stop = "" if not doc or doc.endswith((".", "!", "?")) else "."
        return {**found, "doc": f"{doc}{stop} {comment}".strip()}


def _graph_class() -> Any:
    import MaterialX

    return MaterialX.NodeGraph


def _member(element: Any) -> Port:
    value = element.getAttribute("value") if element.hasAttribute("value") else None
    return Port(element.getName(), element.getType(), value)
