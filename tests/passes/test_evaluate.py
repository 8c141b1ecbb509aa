"""The evaluator of whole graphs: binders open or closed, aggregates, and arrays of many values."""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Attribute, Parameter
from burnish.compiler.ir.node import Folding, Formal, Graph, Node
from burnish.compiler.ir.stages import SMOOTH
from burnish.compiler.ir.types import FLOAT, INT, VEC2, Array, Struct, Type
from burnish.compiler.passes.pipeline import Options
from burnish.compiler.reference.evaluate import Evaluator, LeafValues, NotConstantError, evaluate
from burnish.compiler.reference.namespace import Lanes

from .hardware import flat
from .kit import Smooth, World, history, shader

LAMP = Struct("Lamp", (("on", FLOAT), ("place", VEC2)))


def leaf(graph: Graph, name: str, type_: Type = FLOAT) -> Node:
    return graph.node("parameter", type_, (), Parameter(name, type_, "material"))


def named(**values: Lanes) -> LeafValues:
    """Leaves by name."""
    return lambda node: values.get(node.data.name) if hasattr(node.data, "name") else None


def squares(graph: Graph, count: Node) -> Node:
    """The sum of ``i * i``, closed."""
    index = graph.node("bound", INT, (), 0)
    body = graph.node("call", INT, (index, index), "mul")
    operands = (count, build.constant(graph, INT, 0), body)
    return graph.node("fold", INT, operands, Folding("add", 10))


def test_a_fold_takes_as_many_turns_as_it_is_told() -> None:
    graph = Graph()
    total = squares(graph, leaf(graph, "n", INT))
    assert evaluate(total, named(n=(4,))) == (14,)
    assert evaluate(total, named(n=(99,))) == (285,)
    assert evaluate(total, named(n=(-1,))) == (0,)


def test_counts_may_differ_in_an_array() -> None:
    graph = Graph()
    total = squares(graph, leaf(graph, "n", INT))
    (found,) = evaluate(total, named(n=(np.array([0, 1, 4, 99]),)), np)
    assert found.tolist() == [0, 0, 14, 285]


def test_variables_of_outer_binders_are_seen() -> None:
    graph = Graph()
    inner, outer = (graph.node("bound", INT, (), level) for level in (0, 1))
    product = graph.node("call", INT, (inner, outer), "mul")
    three, zero = build.constant(graph, INT, 3), build.constant(graph, INT, 0)
    nested = graph.node("fold", INT, (three, zero, product), Folding("add", 3))
    both = graph.node("fold", INT, (three, zero, nested), Folding("add", 3))
    assert evaluate(both) == (9,)


def test_values_are_forgotten_after_their_last_use() -> None:
    """A chain of sums needs two at a time; a body's operand from outside is needed every turn."""
    graph = Graph()
    first = total = graph.node("call", FLOAT, (leaf(graph, "x"),) * 2, "mul")
    for i in range(100):
        total = graph.node("call", FLOAT, (total, build.floating(graph, float(i))), "add")
    again = graph.node("call", FLOAT, (first, total), "mul")
    turn = graph.node("call", FLOAT, (first, graph.node("bound", INT, (), 0)), "add")
    operands = (build.constant(graph, INT, 3), build.floating(graph, 0.0), turn)
    fold = graph.node("fold", FLOAT, operands, Folding("add", 3))
    alive: weakref.WeakSet[Value] = weakref.WeakSet()
    most = 0

    def look(_node: Node, _operands: list[Lanes], value: Lanes) -> Lanes:
        nonlocal most
        alive.update(lane for lane in value if isinstance(lane, Value))
        most = max(most, len(alive))
        return value

    x = np.array([1.0, 2.0]).view(Value)
    evaluator = Evaluator(named(x=(x,)), np, look)
    found = [lanes[0].tolist() for lanes in evaluator.values((again, fold))]
    assert found == [[4951.0, 4 * 4954.0], [6.0, 15.0]]
    assert most <= 8


class Value(np.ndarray[Any, Any]):
    """An array to which there may be weak references, and which is equal only to itself."""

    __hash__ = object.__hash__  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        return self is other


def test_an_opened_body_is_evaluated_for_each_call() -> None:
    graph = Graph()
    formal = Formal("x")
    body = graph.node("call", FLOAT, (graph.node("formal", FLOAT, (), formal),) * 2, "mul")
    calls = [build.apply(graph, body, (build.floating(graph, x),), (formal,)) for x in (2.0, 3.0)]
    assert evaluate(graph.node("call", FLOAT, tuple(calls), "add")) == (13.0,)


def test_elements_and_members_are_found_at_one_place_or_many() -> None:
    graph = Graph()
    lamps = leaf(graph, "lamps", Array(LAMP, 3))
    place = build.member(graph, build.index(graph, lamps, leaf(graph, "i", INT)), "place")
    value = tuple(((1.0,), (float(n), 10.0 * n)) for n in range(3))
    assert evaluate(place, named(lamps=value, i=(2,))) == (2.0, 20.0)
    many = evaluate(place, named(lamps=value, i=(np.array([2, 0]),)), np)
    assert [lane.tolist() for lane in many] == [[2.0, 0.0], [20.0, 0.0]]


def test_a_crossing_has_the_value_it_is_given_or_that_of_the_vertex() -> None:
    graph = Graph()
    at_vertex = graph.node("attribute", FLOAT, (), Attribute("a", FLOAT))
    crossing = build.cross(graph, at_vertex, SMOOTH)
    assert evaluate(crossing, named(a=(1.0,))) == (1.0,)
    assert evaluate(crossing, lambda node: (5.0,) if node is crossing else None) == (5.0,)


def test_a_leaf_without_a_value_is_named() -> None:
    graph = Graph()
    with pytest.raises(NotConstantError) as caught:
        evaluate(build.splat(graph, leaf(graph, "x"), 3))
    assert caught.value.node.op == "parameter"


LIT = """
import std.lights
import std.terms
material M {
    map m : texture2d
    color = lambert(m(uv).rgb) + phong(vec3(1), 8.0) * (sum i in 0..3 : sin(uv.x * float(i)))
}
rig R { lamps : Point[<= 4]; torch : Spot }
"""


class Many:
    """The values of several worlds, side by side in arrays."""

    def __init__(self, worlds: list[World]) -> None:
        self._worlds = worlds

    def __call__(self, node: Node) -> Lanes | None:
        if node.op == "texture":
            return (Smooth(node.type, np),)
        values = [world(node) for world in self._worlds]
        together: Lanes | None = None if values[0] is None else stacked(values)
        return together


class One(Many):
    """Evaluates one world, with the textures of many."""

    def __call__(self, node: Node) -> Lanes | None:
        return super().__call__(node) if node.op == "texture" else self._worlds[0](node)


def stacked(values: Sequence[Any]) -> Any:
    """Values of one type as one value of arrays."""
    if isinstance(values[0], tuple):
        return tuple(stacked(parts) for parts in zip(*values, strict=True))
    return np.array(values)


def test_arrays_have_the_values_that_numbers_have() -> None:
    worlds = [World(seed) for seed in range(6)]
    past = history(shader(LIT), Options(hoist=False))
    for name in ("semantics", "guard", "lower_reads"):
        together = Evaluator(Many(worlds), np)
        for root in past.roots[name]:
            columns = [np.broadcast_to(lane, (6,)) for lane in arrays(together.value(root))]
            for i, world in enumerate(worlds):
                alone = list(flat(Evaluator(One([world])).value(root)))
                assert [column[i] for column in columns] == pytest.approx(alone, rel=1e-9)


def arrays(value: Any) -> list[Any]:
    """All lanes of a value of arrays."""
    if not isinstance(value, tuple):
        return [value]
    return [lane for part in value for lane in arrays(part)]
