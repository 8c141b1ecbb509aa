"""Random kernels, for the files of random programs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from .expressions import FUEL, Writer
from .scope import Scope, variable
from .tree import Node, listed

OPERATORS = ("add", "min", "max", "and", "or")
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
        items += scatters(writer, scope)
    if writer.maybe(0.5):
        items.append(Node(writer.chance.choice(SIZES), optional=True))
    members = listed("{{\n    {}\n}}", items, "\n    ")
    return Node("kernel Computed {}", (members,), role="kernel", optional=True)


def scatters(writer: Writer, scope: Scope) -> Iterator[Node]:
    """What a kernel scatters, to elements that may not exist, and that it runs as it would."""
    kind = writer.chance.choice(("int", "uint"))
    value, place = (writer.expression(type_, scope, FUEL // 3) for type_ in (kind, "int"))
    operator = writer.chance.choice(OPERATORS)
    form = f"scatter found : {kind}[20] {operator} {kind}({{}}) at ({{}}) mod 24 - 2"
    if writer.maybe(0.5):
        condition = writer.expression("bool", scope, FUEL // 3)
        yield Node(form + " where ({})", (value, place, condition), optional=True)
    else:
        yield Node(form, (value, place), optional=True)
    if writer.maybe(0.3):
        yield Node("runs over given.count", optional=True)
