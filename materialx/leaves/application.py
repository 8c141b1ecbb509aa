"""Ways in which many rows are written, and the names of functions by the lanes of their results."""

from __future__ import annotations

from ..expressions import Call, called
from ..networks import Row


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
