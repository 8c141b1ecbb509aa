"""Random kernels, for the files of random programs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from burnish.stdlib.builtins import BUILTINS

from .expressions import FUEL, Writer
from .scope import GROUPS, UNIFORM, Scope, variable
from .tree import Node, listed

OPERATORS = ("add", "min", "max", "and", "or")
JOINING = tuple(name for name, row in BUILTINS.items() if row.of_group)
"""The builtins by which the invocations of a work group know of each other."""
SIZES = ("work_group of 32", "work_group of 2 * 64")

FORMATS = {"r8": "float", "rg8": "vec2", "rgba8": "vec4", "r32f": "float", "rgba32f": "vec4"}
"""Formats of images, with what a texel is given. Numbers of 16 bits would often be too large."""


def kernel(writer: Writer, outside: Scope) -> Node:
    """A kernel that computes the elements of a buffer, or the texels of images."""
    return _over_images(writer, outside) if writer.maybe(0.4) else _over_buffers(writer, outside)


def _over_images(writer: Writer, outside: Scope) -> Node:
    """A kernel that computes a texel for each texel of a texture, or for some more or fewer."""
    size = writer.chance.choice(("given.size()", "given.size() + ivec2(3, -2)", "ivec2(19, 13)"))
    leaves = (
        variable("texel", "ivec2"),
        variable("given.load(texel)", "vec4"),
        variable("given.load(texel.yx - 1)", "vec4"),
        variable("vec2(texel)", "vec2"),
    )
    scope = replace(outside, leaves=(*outside.leaves, *leaves))
    items = [Node("map given : texture2d")]
    for number in range(writer.chance.randint(1, 3)):
        format_ = writer.chance.choice(tuple(FORMATS))
        type_ = FORMATS[format_]
        value = writer.expression(type_, scope, FUEL // 2)
        text = f"result made{number} : image2d<{format_}>[{size}] = {type_}({{}})"
        items.append(Node(text, (value,), optional=number > 0))
    if writer.maybe(0.3):
        items.append(Node("work_group of 16 by 4", optional=True))
    members = listed("{{\n    {}\n}}", items, "\n    ")
    return Node("kernel Imaged {}", (members,), role="kernel", optional=True)


def _over_buffers(writer: Writer, outside: Scope) -> Node:
    """A kernel that computes an element for each of a buffer's."""
    element = writer.chance.choice(("float", "vec2", "int", "uvec4"))
    leaves = (variable("given[index]", element), variable("given.count", "int"))
    can = frozenset({UNIFORM, GROUPS})
    scope = replace(
        outside, leaves=(*outside.leaves, *leaves, variable("index", "int")), can=outside.can | can
    )
    result = writer.chance.choice(("float", "vec3", "int", "uvec2"))
    value = writer.expression(result, scope, FUEL // 2)
    items = [
        Node(f"buffer given : {element}[]"),
        Node(f"result made : {result}[given.count] = {result}({{}})", (value,)),
    ]
    if writer.maybe(0.9):
        value = writer.expression("float", scope, FUEL // 2)
        name = writer.chance.choice(JOINING)
        value = Node(
            f"{name}({{}})", (value,), role=name, type=value.type, needs=frozenset({GROUPS})
        )
        items.append(Node("result joined : float[] per group = {}", (value,), optional=True))
    if writer.maybe(0.5):
        items += scatters(writer, scope)
    if writer.maybe(0.5):
        items.append(Node("runs over given.count", optional=True))
    if writer.maybe(0.5):
        items.append(Node(writer.chance.choice(SIZES), optional=True))
    members = listed("{{\n    {}\n}}", items, "\n    ")
    return Node("kernel Computed {}", (members,), role="kernel", optional=True)


def scatters(writer: Writer, scope: Scope) -> Iterator[Node]:
    """The scattered results of a kernel; some of the elements that it writes to do not exist."""
    kind = writer.chance.choice(("int", "uint"))
    value, place = (writer.expression(type_, scope, FUEL // 3) for type_ in (kind, "int"))
    operator = writer.chance.choice(OPERATORS)
    form = f"scatter found : {kind}[20] {operator} {kind}({{}}) at ({{}}) mod 24 - 2"
    if writer.maybe(0.5):
        condition = writer.expression("bool", scope, FUEL // 3)
        yield Node(form + " where ({})", (value, place, condition), optional=True)
    else:
        yield Node(form, (value, place), optional=True)
