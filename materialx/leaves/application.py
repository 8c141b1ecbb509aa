"""A node as the rows of leaves see it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..expressions import Call, Expression, called

if TYPE_CHECKING:
    from ..model import Node
    from ..networks import Network, Scope, Texts


@dataclass(frozen=True)
class Application:
    """One output of one node, with what is asked for to write it."""

    network: Network
    node: Node
    output: str
    scope: Scope

    @property
    def texts(self) -> Texts:
        return self.network.texts

    @property
    def type(self) -> str:
        """The type of the output."""
        return self.node.output_type(self.output)

    def input(self, name: str) -> Expression:
        """The value of an input, or its default."""
        return self.network.input(self.node, name, self.scope)

    def inputs(self, *names: str) -> tuple[Expression, ...]:
        return tuple(map(self.input, names))

    def input_type(self, name: str) -> str:
        """The type of an input, as the definition has it."""
        assert self.node.definition is not None
        return self.node.definition.inputs[name].type

    def has(self, name: str) -> bool:
        """True if the node sets an input: by a value, a node or an input of its graph."""
        return name in self.node.inputs

    def static(self, name: str) -> str:
        """The text of an input that no shader computes."""
        return self.network.static(self.node, name, self.scope)

    def texture(self, name: str) -> Expression | None:
        """The texture of an input of the type ``filename``; nothing if no file is named."""
        return self.network.texture(self.node, name, self.scope)

    def library(self, name: str) -> str:
        """A name of ``std.mtlx``, which is imported."""
        return self.texts.library(name)


Row = Callable[[Application], Expression]
"""How nodes of a category are written."""


def builtin(name: str, *inputs: str) -> Row:
    """A function that every file of Burnish has."""
    return lambda node: called(name, *node.inputs(*inputs))


def function(name: str, *inputs: str) -> Row:
    """A function of ``std.mtlx``."""
    return lambda node: Call(node.library(name), node.inputs(*inputs))


SUFFIXES = {
    "float": "",
    "vector2": "_vec2",
    "vector3": "_vec3",
    "color3": "_vec3",
    "vector4": "_vec4",
    "color4": "_vec4",
}
"""What the names of functions end in whose results differ by the number of lanes alone."""
