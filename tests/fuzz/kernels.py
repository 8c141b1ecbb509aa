"""Random kernels, for the files of random programs."""

from __future__ import annotations

from dataclasses import replace

from .expressions import FUEL, Writer
from .scope import Scope, variable
from .tree import Node, listed

SIZES = ("work_group of 32", "work_group of 2 * 64")


def kernel(writer: Writer, outside: Scope) -> Node:
    """A kernel that computes an element for each of a buffer's."""
    element = writer.chance.choice(("float", "vec2", "int", "uvec4"))
    leaves = (variable("given[index]", element), variable("given.count", "int"))
    scope = replace(outside, leaves=(*outside.leaves, *leaves, variable("index", "int")))
    result = writer.chance.choice(("float", "vec3", "int", "uvec2"))
    value = writer.expression(result, scope, FUEL // 2)
    items = [
        Node(f"buffer given : {element}[]"),
        Node(f"result made : {result}[given.count] = {result}({{}})", (value,)),
    ]
    if writer.maybe(0.5):
        items.append(Node(writer.chance.choice(SIZES), optional=True))
    members = listed("{{\n    {}\n}}", items, "\n    ")
    return Node("kernel Computed {}", (members,), role="kernel", optional=True)
