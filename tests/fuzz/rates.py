"""Rewrites random programs so that a value is known earlier or later, and means the same."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from random import Random

from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Node as GraphNode
from burnish.compiler.ir.node import reachable
from burnish.compiler.ir.shader import Shader
from burnish.compiler.reference.namespace import Lanes

from ..passes.kit import World
from .tree import Node, changed, expression, walk

LITERALS = ("float", "int", "uint", "bool")
VECTORS = ("vec2", "vec3", "vec4", "ivec2", "ivec3", "uvec2")


@dataclass(frozen=True)
class Rated:
    """A program, and the values that its new parameters have."""

    tree: Node
    fixed: Mapping[str, Lanes] = field(default_factory=dict)


def literal_as_parameter(tree: Node, chance: Random) -> Rated | None:
    """A literal in the material becomes a parameter, which has its value."""
    found = [
        (path, node)
        for path, node in walk(tree)
        if node.role == "literal" and node.type in LITERALS and _in_member(tree, path)
    ]
    if not found:
        return None
    path, node = chance.choice(found)
    reference = expression(node.type, "held", role="variable", name="held")
    declared = Node(f"param held : {node.type}", role="parameter", name="held")
    tree = changed(tree, path, lambda _: reference)
    owner = next(p for p, part in walk(tree) if part.role == "members")
    tree = changed(tree, owner, lambda old: replace(old, parts=(declared, *old.parts)))
    return Rated(tree, {"held": (_value(str(node)),)})


def _in_member(tree: Node, path: tuple[int, ...]) -> bool:
    """True if a path leads through the members of the concrete material."""
    for index in path:
        if tree.role == "members":
            return True
        tree = tree.parts[index]
    return False


def _value(text: str) -> float | int | bool:
    if text in ("true", "false"):
        return text == "true"
    text = text.strip("()").removesuffix("u")
    return float(text) if "." in text or ("e" in text and "x" not in text) else int(text, 0)


def parameter_as_literal(tree: Node, chance: Random, shader: Shader, world: World) -> Rated | None:
    """A parameter of the material becomes a slot with the value that it would have had.

    A point or a direction stays what it is: the value of a graph's parameter has no space any more.
    """
    values = dict(_parameters(shader, world))
    found = [
        (path, node)
        for path, node in walk(tree)
        if node.role == "parameter"
        and node.name in values
        and f"{node.name} : {values[node.name][0]} " in f"{node} "
        and _in_member(tree, path)
    ]
    if not found:
        return None
    path, node = chance.choice(found)
    type_, lanes = values[node.name]
    shown = ", ".join(map(_shown, lanes))
    text = f"{type_}({shown})" if type_ in VECTORS else shown
    slot = Node(f"{node.name} : {type_} = {text}", role="slot", name=node.name)
    return Rated(changed(tree, path, lambda _: slot))


def _parameters(shader: Shader, world: World) -> Iterator[tuple[str, tuple[str, Lanes]]]:
    """The types and the values of all parameters that are numbers or vectors."""
    nodes: list[GraphNode] = [node for node in reachable(shader.roots) if node.op == "parameter"]
    for node in nodes:
        leaf = node.data
        if isinstance(leaf, Parameter) and str(leaf.type) in (*LITERALS, *VECTORS):
            value = world(node)
            assert value is not None
            yield leaf.name, (str(leaf.type), value)


def _shown(lane: float | int | bool) -> str:
    if isinstance(lane, bool):
        return str(lane).lower()
    text = repr(lane)
    return f"({text})" if text.startswith("-") else text
