"""Materials that inherit from others of their document: only what differs is written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from .model import Graph, Node, Port
from .texts import Equation


class Written(NamedTuple):
    """A material that was written: its name, the surface model that it extends, and its members."""

    name: str
    base: str
    members: Sequence[Equation]


class Heirs:
    """Finds the materials that others can extend."""

    def __init__(self) -> None:
        self._written: dict[str, Written] = {}

    def add(self, port: Port, graph: Graph, written: Written) -> None:
        """Note a material by its nodes: its own one, and its surface's."""
        for node in _nodes(port, graph):
            self._written.setdefault(node.name, written)

    def ancestor(self, port: Port, graph: Graph, whole: Written) -> Written | None:
        """The material that another one can extend, since a node of that inherits from one of this;
        nothing if this has members which the other does not have, or declares otherwise."""
        own = {row.name: row for row in whole.members}
        for node in _nodes(port, graph):
            found = self._written.get(node.inherit)
            if found is None or found.base != whole.base:
                continue
            if any(row.name not in own for row in found.members):
                continue
            changed = [row for row in found.members if row != own[row.name]]
            if not any(row.prefix or own[row.name].prefix for row in changed):
                return found
        return None


def _nodes(port: Port, graph: Graph) -> Iterator[Node]:
    """The node of what is drawn, and the surface that it shows."""
    node = graph.nodes.get(port.link.node) if port.link is not None else None
    if node is not None:
        yield node
        surface = node.inputs.get("surfaceshader")
        if surface is not None:
            yield from _nodes(surface, graph)
