"""Writes what the primitives of random materials and passes turn into."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from .expressions import FUEL, Writer
from .scope import Scope, variable
from .tree import Node, listed

CORNERS = {"point": 1, "line": 2, "triangle": 3, "line_adjacency": 4, "triangle_adjacency": 6}
SPREAD = variable("spread", "float")
"""The slot that only an expansion or a tessellation sets."""

TRIANGLES = (("strip", 3), ("strip", 4), ("strip", 5), ("list", 6))
LINES = (("line", 2), ("line", 3), ("line", 5))
"""The strips or lists that groups emit, each with its number of vertices.

All groups of an expansion emit triangles, or all emit lines.
"""


def expansion(writer: Writer, scope: Scope, *, layers: int = 0) -> Iterator[Node]:
    """A slot of the expansion's own, and the expansion; in a pass, its targets may have layers."""
    yield Node("spread : float = 0.25", role="slot", name="spread")
    if layers:
        yield Node(f"layers of {layers}", role="layers")
        yield Node("layer : int = 1", role="slot")
    yield expand(writer, scope, writer.chance.choice([*CORNERS]), layers)


def expand(writer: Writer, scope: Scope, primitive: str, layers: int = 0) -> Node:
    """The expansion of these primitives."""
    shapes = LINES if writer.maybe(0.2) else TRIANGLES
    groups = [
        _strips(writer, scope, primitive, layers, *writer.chance.choice(shapes))
        for _ in range(writer.chance.choice((1, 1, 2)))
    ]
    return listed(f"expand {primitive} {{{{ {{}} }}}}", groups, " ", "expansion")


def _strips(
    writer: Writer, scope: Scope, primitive: str, layers: int, shape: str, count: int
) -> Node:
    """One group of strips, of a list, or of lines."""
    corners = CORNERS[primitive]
    head = f"{shape} of {count} as i"
    known = [*_of_corner(writer, corners), variable("float(i)", "float"), variable("i", "int")]
    parts: list[Node] = []
    if writer.maybe(0.4):
        head += f" for s in 0..{writer.chance.choice(('2', '3', 'int(corner[0].uv.x) up to 2'))}"
        known.append(variable("s", "int"))
    if writer.maybe(0.3):
        seen = replace(scope, leaves=tuple(known[:2]), can=frozenset[str](), maps=())
        parts.append(writer.expression("bool", seen, FUEL // 4))
        head += " where {}"
    if corners > 1 and (count > corners or writer.maybe(0.3)):
        last = corners - 1
        head += f" like corner[{writer.chance.choice(('0', str(last), f'i mod {corners}'))}]"
    plain = [leaf for leaf in scope.leaves if not leaf.needs]
    inside = replace(scope, leaves=(*plain, *known), can=frozenset[str](), maps=())
    equations = []
    for name, type_, form in (
        ("position", "vec3", "inherited.position + 0.3 * sin(vec3({}) + float(i))"),
        ("uv", "vec2", "{}"),
        ("spread", "float", "saturate({})"),
    ):
        if writer.maybe(0.6):
            value = writer.expression(type_, inside, FUEL // 4)
            equations.append(Node(f"{name} = {form}", (value,), role="emitted", optional=True))
    if layers and writer.maybe(0.8):
        # Some do not exist: the nearest one is meant.
        numbers = ["int(primitive_index mod 4u) - 1", "2", *["s"] * (" for s " in head)]
        equations.append(Node(f"layer = {writer.chance.choice(numbers)}", role="emitted"))
    body = listed("{}", equations, "  ", "equations")
    return Node(f"{head} {{{{ {{}} }}}}", (*parts, body), role="strips")


def _of_corner(writer: Writer, corners: int) -> Iterator[Node]:
    """Values of slots at some corner."""
    for form, type_ in (
        ("vec3(corner[{}].position)", "vec3"),
        ("corner[{}].uv.x", "float"),
        ("corner[{}].uv", "vec2"),
    ):
        yield variable(form.format(writer.chance.randrange(corners)), type_)
