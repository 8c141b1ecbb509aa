"""The files that nodes read: where they are named, and how their textures are read."""

from __future__ import annotations

from typing import Protocol

from .constants import OF_OTHERS
from .expressions import Expression
from .model import Node, Port
from .places import Sampling, Scope, Texts
from .problems import UnsupportedError

_SRGB = ("srgb_texture", *OF_OTHERS["from_srgb_texture"])


class Nodes(Protocol):
    """What is asked of the network that has the nodes."""

    @property
    def texts(self) -> Texts:
        """The place that its expressions are written to."""

    def entered(self, node: Node, scope: Scope) -> Scope:
        """The scope of the graph that a node stands for."""

    def static(self, node: Node, name: str, scope: Scope) -> str:
        """The text of an input that no shader computes."""


class FileInputs:
    """The inputs of the type ``filename`` in a network."""

    def __init__(self, network: Nodes) -> None:
        self._network = network
        self._open: set[tuple[Scope, str]] = set()

    def texture(self, node: Node, name: str, scope: Scope) -> Expression | None:
        """The texture that a node's input of the type ``filename``
        names; nothing if it names none."""
        port, place = self._file(node, name, scope)
        if port.interface:
            assert place.bound is not None
            return place.bound[port.interface]
        is_encoded, tiles = self.is_encoded(node, name, scope), self.tiles(node, name, scope)
        sampling = Sampling(*self._sampling(node, name, scope), is_encoded, tiles)
        return self._network.texts.texture(port, sampling, node)

    def is_encoded(self, node: Node, name: str, scope: Scope) -> bool:
        """True for a file of colours in sRGB, which are decoded before filtering: this node gives
        colours, or one around it that is written out."""
        if not gives_color(node):
            port = node.inputs.get(name)
            if port is None or not port.interface or scope.node is None or scope.outer is None:
                return False
            return self.is_encoded(scope.node, port.interface, scope.outer)
        return name in node.inputs and is_srgb(self._file(node, name, scope)[0].color_space)

    def borders(self, node: Node, name: str, scope: Scope) -> tuple[bool, bool]:
        """The axes, u and v, at which the images that read a file end in their default colour.

        In a function there are none: what has borders is written out where it is used.
        """
        if self._file(node, name, scope)[0].interface:
            return False, False
        u, v, _ = self._sampling(node, name, scope)
        return u == "constant", v == "constant"

    def tiles(self, node: Node, name: str, scope: Scope) -> tuple[int, ...]:
        """The squares of a chart for which a set of files has files. Only images read sets."""
        port, _ = self._file(node, name, scope)
        if port.interface or not port.value or not self._is_of_images(node):
            return ()
        return self._network.texts.tiles(port.value)

    def _is_of_images(self, node: Node) -> bool:
        """True if all leaves of a node that read files are images."""
        graph = node.definition.graph if node.definition is not None else None
        if graph is None:
            return node.category == "image"
        return all(
            map(self._is_of_images, (each for each in graph.nodes.values() if files_of(each)))
        )

    def can_be_called(self, node: Node, scope: Scope) -> bool:
        """True if all files that a node reads are named, and none of them ends in a border or is
        one of a set."""
        return all(
            self.texture(node, name, scope) is not None
            and not any(self.borders(node, name, scope))
            and not self.tiles(node, name, scope)
            for name in files_of(node)
        )

    def _file(self, node: Node, name: str, scope: Scope) -> tuple[Port, Scope]:
        """The input where a file is named, and its scope; in a function, the one that an argument
        gives."""
        assert node.definition is not None
        port = node.inputs.get(name) or node.definition.inputs[name]
        while port.interface and scope.bound is None:
            if scope.node is not None and scope.outer is not None:
                outer = scope.node
                assert outer.definition is not None
                port = outer.inputs.get(port.interface) or outer.definition.inputs[port.interface]
                scope = scope.outer
            elif port.interface in scope.graph.inputs:
                port = scope.graph.inputs[port.interface]
            else:
                raise UnsupportedError(
                    f"the graph {scope.graph.path} has no input '{port.interface}'"
                )
        if port.link is not None and port.link.node:
            other = scope.graph.nodes.get(port.link.node)
            key = (scope, port.link.node)
            if key in self._open:
                raise UnsupportedError("this node depends on itself", node.path)
            for word in ("value", "in"):
                if other is not None and word in other.inputs:
                    self._open.add(key)
                    try:
                        return self._file(other, word, scope)
                    finally:
                        self._open.discard(key)
        return port, scope

    def space(self, node: Node, name: str, scope: Scope) -> str:
        """The colour space of a file that this node decodes, and no node around it."""
        port = node.inputs.get(name)
        if port is None:
            return ""
        if port.interface and scope.bound is not None:
            return ""
        if port.interface and scope.node is not None and scope.outer is not None:
            if gives_color(scope.node):
                return ""
            return self.space(scope.node, port.interface, scope.outer)
        return self._file(node, name, scope)[0].color_space

    def _sampling(self, node: Node, name: str, scope: Scope) -> tuple[str, str, str]:
        """How the images that read a file continue it to both sides, and how they filter."""
        if node.category == "image" or node.definition is None or node.definition.graph is None:
            words = ("uaddressmode", "vaddressmode", "filtertype")
            u, v, kind = (self._network.static(node, word, scope) for word in words)
            return u or "periodic", v or "periodic", kind or "linear"
        inner = self._network.entered(node, scope)
        for other in inner.graph.nodes.values():
            for port in other.inputs.values():
                if port.type == "filename" and port.interface == name:
                    return self._sampling(other, port.name, inner)
        return "periodic", "periodic", "linear"


def files_of(node: Node) -> list[str]:
    """The inputs of a node that name files."""
    inputs = node.definition.inputs if node.definition is not None else {}
    return [name for name, port in inputs.items() if port.type == "filename"]


def gives_color(node: Node) -> bool:
    """True for a node whose first output is a colour: only that of files is decoded."""
    outputs = node.definition.outputs if node.definition is not None else {}
    first = next(iter(outputs.values()), None)
    return (first.type if first is not None and len(outputs) > 1 else node.type).startswith("color")


def is_srgb(space: str) -> bool:
    """True for the colour space that graphics cards decode by themselves."""
    return space.lower() in _SRGB
