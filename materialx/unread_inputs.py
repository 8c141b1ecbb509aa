"""Finds what a document states and nothing reads: inputs that the definitions of their nodes do not
have, as misspelt ones, or have with another type, and nodes to inherit from that are not there.

MaterialX passes over them in silence. The document is converted all the same, and they are told.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..compiler.diagnostics.nearest import nearest
from .model import Document, Graph, Node, Port
from .problems import Problem


def unread_inputs(document: Document) -> Iterator[Problem]:
    """A note for each such input or node, with its line."""
    for graph in (document.top, *document.top.graphs.values()):
        for node in graph.nodes.values():
            for path, text in _unread(node, graph):
                yield Problem(path, document.place(path), text, is_error=False)


def _unread(node: Node, graph: Graph) -> Iterator[tuple[str, str]]:
    if node.inherit and node.inherit not in graph.nodes:
        yield node.path, f"there is no node '{node.inherit}' to inherit from"
    if node.definition is None:
        return
    for port in node.inputs.values():
        declared = node.definition.inputs.get(port.name)
        path = f"{node.path}/{port.name}"
        if declared is None:
            yield path, _no_input(node, port)
        elif declared.type != port.type:
            text = f"this input of {node.category} is of the type {declared.type}"
            yield path, f"{text}, and not {port.type}"


def _no_input(node: Node, port: Port) -> str:
    assert node.definition is not None
    meant = nearest(port.name, node.definition.inputs)
    way_out = f": did you mean '{meant}'?" if meant else ""
    return f"{node.category} has no such input, and it is left out{way_out}"
