"""Ways in which many rows are written, and the names of functions by the lanes of their results.

A row that is one call or one operation of Burnish is ``Written``: it says the word and the inputs
that its operands are, so that it is read in both directions. Importers call it, and
``materialx.export`` finds by the word which node an expression becomes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from ..expressions import Expression, called
from ..networks import Application, Row


@dataclass(frozen=True)
class Written:
    """A row for nodes that are one call, or one operation, of Burnish."""

    word: str
    """The builtin or the operator."""
    inputs: tuple[str, ...]
    """The inputs of the node, in the order of the operands."""
    row: Row | None = None
    """Writes the node where a plain call of the builtin would not read well."""
    also: Mapping[str, tuple[str, ...]] = field(default_factory=lambda: MappingProxyType({}))
    """Further builtins that are this node with other inputs left at their defaults."""

    def __call__(self, node: Application) -> Expression:
        if self.row is not None:
            return self.row(node)
        return called(self.word, *node.inputs(*self.inputs))


def builtin(name: str, *inputs: str) -> Row:
    """A function that every file of Burnish has."""
    return Written(name, inputs)


SUFFIXES = {
    "float": "",
    "vector2": "_vec2",
    "vector3": "_vec3",
    "color3": "_vec3",
    "vector4": "_vec4",
    "color4": "_vec4",
}
"""What the names of functions end in whose results differ by the number of lanes alone."""
