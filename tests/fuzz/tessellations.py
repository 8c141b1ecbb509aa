"""Writes into what the patches of random materials are divided."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from .expansions import expand
from .expressions import FUEL, Writer
from .scope import Scope, variable
from .tree import Node, listed

PATCHES = {"triangle": ("vec3", 3), "quad": ("vec2", 4), "isoline": ("vec2", 2)}
"""The type of a vertex's place in a patch, and how many ends that has."""


def tessellation(writer: Writer, scope: Scope) -> Iterator[Node]:
    """A slot of the tessellation's own, and the tessellation."""
    yield Node("spread : float = 0.25", role="slot", name="spread")
    yield _tessellate(writer, scope, writer.chance.choice([*PATCHES]))


def divided_and_expanded(writer: Writer, scope: Scope) -> Iterator[Node]:
    """A tessellation with its slot, and an expansion of the parts of its patches."""
    patch = writer.chance.choice([*PATCHES])
    yield Node("spread : float = 0.25", role="slot", name="spread")
    yield _tessellate(writer, scope, patch)
    yield expand(writer, scope, "line" if patch == "isoline" else "triangle")


def _tessellate(writer: Writer, scope: Scope, patch: str) -> Node:
    """A tessellation of levels that a host can compute."""
    place, ends = PATCHES[patch]
    head = f"tessellate {patch}"
    if writer.maybe(0.3):
        turned = writer.chance.randrange(ends)
        order = [str((turned + k) % ends) for k in range(ends)]
        head += f" of {ends} ends [{', '.join(order)}]"
    if writer.maybe(0.5):
        head += f" spacing {writer.chance.choice(('equal', 'fractional_even', 'fractional_odd'))}"
    head += f" by {writer.chance.choice(('2', '1.5', '3', '1 + 2 * 0.75'))}"
    if patch == "isoline":
        head += f" lines {writer.chance.choice(('1', '2', '2.5'))}" if writer.maybe(0.5) else ""
    elif writer.maybe(0.3):
        head += f" inside {writer.chance.choice(('1', '2', '3.25'))}"
    lanes = "xyz"[: 3 if place == "vec3" else 2]
    known = [
        variable("at", place),
        variable(f"at.{writer.chance.choice(lanes)}", "float"),
        variable("float(patch_index)", "float"),
        variable(f"corner[{writer.chance.randrange(ends)}].uv", "vec2"),
        variable(f"vec3(corner[{writer.chance.randrange(ends)}].position)", "vec3"),
    ]
    plain = [leaf for leaf in scope.leaves if not leaf.needs]
    inside = replace(scope, leaves=(*plain, *known), can=frozenset[str](), maps=())
    equations = []
    for name, type_, form in (
        ("position", "vec3", "inherited.position + 0.2 * sin(vec3({}))"),
        ("uv", "vec2", "{}"),
        ("spread", "float", "saturate({})"),
    ):
        if writer.maybe(0.6):
            value = writer.expression(type_, inside, FUEL // 4)
            equations.append(Node(f"{name} = {form}", (value,), role="divided", optional=True))
    return listed(f"{head} as at {{{{ {{}} }}}}", equations, "  ", "tessellation")
