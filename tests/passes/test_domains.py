"""The domains over which each value varies."""

from __future__ import annotations

import pytest

from burnish.compiler.ir import build
from burnish.compiler.ir.domains import Domains, MixedDomainsError
from burnish.compiler.ir.leaves import Attribute, Parameter, Texture
from burnish.compiler.ir.node import Formal, Graph, Node
from burnish.compiler.ir.stages import FLAT, FRAGMENTS, INSTANCES, RASTERISED, VERTICES, inputs_of
from burnish.compiler.ir.types import FLOAT, INT, VEC2, VEC4, TextureType

GRAPH = Graph()


def parameter() -> Node:
    return GRAPH.node("parameter", FLOAT, (), Parameter("p", FLOAT, "material"))


def attribute(step: str = VERTICES) -> Node:
    return GRAPH.node("attribute", FLOAT, (), Attribute(f"a_{step}", FLOAT, step=step))


def supplied(name: str) -> Node:
    row = inputs_of(RASTERISED)[name]
    return GRAPH.node("input", row.type, (), row)


def added(*operands: Node) -> Node:
    return GRAPH.node("call", FLOAT, operands, "add")


def read(coordinate: Node) -> Node:
    texture = GRAPH.node("texture", TextureType(), (), Texture("t", TextureType(), "material"))
    operands = (texture, build.vector(GRAPH, (coordinate, coordinate)))
    assert operands[1].type == VEC2
    return build.swizzle(GRAPH, GRAPH.node("call", VEC4, operands, "sample"), (0,))


CASES: dict[str, tuple[Node, str | None]] = {
    "a number": (build.floating(GRAPH, 1.0), None),
    "a parameter": (parameter(), None),
    "a texel at one place": (read(parameter()), None),
    "a variable": (GRAPH.node("formal", INT, (), Formal("i")), None),
    "a vertex input": (attribute(), VERTICES),
    "an input of each instance": (attribute(INSTANCES), INSTANCES),
    "the number of the instance": (supplied("instance_index"), INSTANCES),
    "the number of the vertex": (supplied("vertex_index"), VERTICES),
    "a pixel's place": (supplied("frag_coord"), FRAGMENTS),
    "of the draw and the vertex": (added(parameter(), attribute()), VERTICES),
    "of the instance and the vertex": (added(attribute(INSTANCES), attribute()), VERTICES),
    "what has crossed": (build.cross(GRAPH, attribute(INSTANCES), FLAT), FRAGMENTS),
    "a constant that has crossed": (build.cross(GRAPH, parameter(), FLAT), FRAGMENTS),
    "a texel at a vertex": (read(attribute()), VERTICES),
}


@pytest.mark.parametrize(("value", "expected"), CASES.values(), ids=CASES)
def test_domain(value: Node, expected: str | None) -> None:
    assert Domains().of(value) == expected


@pytest.mark.parametrize("step", [VERTICES, INSTANCES])
def test_what_has_not_crossed_is_not_in_the_next_stage(step: str) -> None:
    mixed = added(attribute(step), build.cross(GRAPH, attribute(), FLAT))
    domains = Domains()
    with pytest.raises(MixedDomainsError) as caught:
        domains.of(added(mixed, parameter()))
    assert caught.value.node is mixed
