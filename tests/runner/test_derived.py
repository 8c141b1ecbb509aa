"""Derived values: the steps of a reflection against the graph that they were made from."""

from __future__ import annotations

import json
import math
import struct
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import burnish
from burnish import Instance
from burnish.compiler.documents.writing import to_json
from burnish.compiler.ir import build
from burnish.compiler.ir.build import constant, index, member, swizzle
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Folding, Graph, Node
from burnish.compiler.ir.operations import PARAMETER
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    VEC2,
    VEC3,
    Array,
    Struct,
    Type,
    square,
)
from burnish.compiler.passes.pipeline import Options, Staged, stage
from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.evaluate import evaluate as meaning
from burnish.compiler.reference.held_values import stored
from burnish.compiler.reflection import reflect
from burnish.compiler.reflection.values import steps
from burnish.targets.runner.instances.derived import Inputs, compute
from burnish.targets.runner.instances.shapes import Elements, Member, Members, Numbers, Shape

from ..layout.memory import read
from ..passes.kit import World, derived_value, shaders

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.burnish"))
RIGS = {"rigs": "Noon"}
"""The rigs of the examples that have several."""


# --- examples ------------------------------------------------------------------------------------


def host(type_: Type, value: Any) -> Any:
    """A value of the evaluator as a host writes it."""
    match type_:
        case Struct(members=members):
            return {n: host(t, v) for (n, t), v in zip(members, value, strict=True)}
        case Array(element=element):
            return [host(element, part) for part in value]
        case _:
            return value[0] if len(value) == 1 else value


def rounded(value: Any) -> Any:
    """Floats as float32, by NumPy."""
    if isinstance(value, tuple):
        return tuple(map(rounded, value))
    return float(np.float32(value)) if isinstance(value, float) else value


def flat(value: Any) -> list[float]:
    """All numbers in a value."""
    return [lane for part in value for lane in flat(part)] if isinstance(value, tuple) else [value]


def parameter_nodes(shader: Shader) -> list[Node]:
    parameters = [info.leaf for info in shader.parameters]
    return [shader.graph.node("parameter", p.type, (), p) for p in parameters]


@pytest.mark.parametrize("hoist", [True, False], ids=["hoisted", "plain"])
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_blocks_of_examples_hold_what_the_graphs_say(path: Path, hoist: bool) -> None:
    for shader in shaders(path, RIGS.get(path.stem)):
        leaves = parameter_nodes(shader)
        staged = stage(shader, Options(hoist))
        derived = {value.parameter: value.expression for value in staged.derived}
        reflection = reflect(shader, staged.program, {}, derived)
        for seed in range(4):
            check(json.loads(json.dumps(to_json(reflection))), leaves, staged, seed)


def check(reflection: dict[str, Any], leaves: list[Node], staged: Staged, seed: int) -> None:
    """Sets random values, and reads the bytes back by the compiler's own types and graphs."""
    world, instance, inputs = World(seed, traps=seed % 2 == 1), Instance(reflection), {}
    counters = {row["count"] for row in reflection["buffers"]}
    for node in leaves:
        parameter = PARAMETER.data(node)
        if parameter.name in counters:  # A buffer that is not set has no elements.
            inputs[parameter.name] = (0,)
            continue
        value = world(node)
        assert value is not None
        inputs[parameter.name] = rounded(value)
        instance.set(parameter.name, host(parameter.type, value))

    def given(node: Node) -> Any:
        return inputs[node.data.name] if isinstance(node.data, Parameter) else None

    # A list of lights sets their number, so that comes last.
    for node in leaves:
        name = PARAMETER.data(node).name
        if name.endswith(".count") and name not in counters:
            instance.set(name, inputs[name][0])
    assert instance.values() == inputs
    data, evaluator = instance.blocks(), Evaluator(given)
    derived = {value.parameter: value for value in staged.derived}
    for block in staged.program.blocks:
        for part in block.members:
            if part.parameter is None:
                continue
            if part.parameter in derived:
                with np.errstate(over="ignore"):
                    value = rounded(derived_value(derived[part.parameter], evaluator))
            else:
                value = inputs[part.parameter.name]
            expected = stored(part.parameter.type, value)
            found = read(data[block.name], part.offset, part.type)
            assert np.array_equal(flat(found), flat(expected), equal_nan=True), part.name


def test_examples_have_derived_values() -> None:
    found = {
        value.parameter.name
        for path in EXAMPLES
        for shader in shaders(path, RIGS.get(path.stem))
        for value in stage(shader, Options(True)).derived
    }
    assert len(found) > 5
    assert {"normal_matrix", "torch_falloff_cos"} <= found


def test_what_overflows_float32_is_infinite() -> None:
    source = "material M { param a : float = 100  color = vec3(uv.x * exp(a)) }"
    blocks = burnish.compile(source, ("wgsl",))["M"].instance().blocks()
    assert struct.unpack_from("<f", blocks["MaterialDerived"]) == (math.inf,)


# --- every operation -----------------------------------------------------------------------------

LAYER = Struct("Layer", (("tint", VEC3), ("weights", Array(FLOAT, 3)), ("on", BOOL)))
SHAPES: dict[str, Shape] = {
    "a": Numbers("float", "float", 1),
    "n": Numbers("int", "int", 1),
    "v": Numbers("vec2", "float", 2),
    "m": Numbers("mat2", "float", 2, 2),
    "layers": Elements(
        "Layer[2]",
        Members(
            "Layer",
            (
                Member("tint", 0, Numbers("vec3", "float", 3)),
                Member("weights", 16, Elements("float[3]", Numbers("float", "float", 1), 3, 4)),
                Member("on", 32, Numbers("bool", "bool", 1)),
            ),
        ),
        2,
        48,
    ),
}
TYPES: dict[str, Type] = {
    "a": FLOAT, "n": INT, "v": VEC2, "m": square(2), "layers": Array(LAYER, 2),
}  # fmt: skip
VALUES: dict[str, Any] = {
    "a": (0.75,),
    "n": (3,),
    "v": (2.0, -5.0),
    "m": ((1.0, 2.0), (3.0, 4.0)),
    "layers": (
        ((1.0, 2.0, 3.0), ((4.0,), (5.0,), (6.0,)), (True,)),
        ((7.0, 8.0, 9.0), ((10.0,), (11.0,), (12.0,)), (False,)),
    ),
}
"""The values of the parameters, in the evaluator's form."""


class Kit:
    """Builds graphs over the parameters above."""

    def __init__(self) -> None:
        self.graph = Graph()
        self.a, self.n, self.v, self.m, self.layers = (
            self.graph.node("parameter", type_, (), Parameter(name, type_, "material"))
            for name, type_ in TYPES.items()
        )

    def call(self, name: str, type_: Type, *operands: Node) -> Node:
        return self.graph.node("call", type_, operands, name)

    def bound(self, binder: int, type_: Type = INT) -> Node:
        return self.graph.node("bound", type_, (), binder)

    def number(self, value: float) -> Node:
        return constant(self.graph, FLOAT, value)

    def fold(
        self, operator: Literal["add", "mul"], limit: int, count: Node, start: Node, body: Node
    ) -> Node:
        return self.graph.node("fold", start.type, (count, start, body), Folding(operator, limit))

    def apply(self, body: Node, *arguments: Node) -> Node:
        return build.apply(self.graph, body, arguments)


def run(root: Node) -> Any:
    """The computed value, which has to be the evaluator's."""

    def leaves(node: Node) -> Any:
        return VALUES[node.data.name] if isinstance(node.data, Parameter) else None

    rows = steps(root)
    value = compute(rows, Inputs(SHAPES, VALUES))
    assert value == meaning(root, leaves)
    return value


def test_values_are_taken_apart_and_joined() -> None:
    kit = Kit()
    one = constant(kit.graph, INT, 1)
    layer = index(kit.graph, kit.layers, one)
    assert run(member(kit.graph, layer, "tint")) == (7.0, 8.0, 9.0)
    assert run(index(kit.graph, member(kit.graph, layer, "weights"), one)) == (11.0,)
    assert run(member(kit.graph, layer, "on")) == (False,)
    assert run(index(kit.graph, kit.m, one)) == (3.0, 4.0)
    assert run(index(kit.graph, kit.v, one)) == (-5.0,)
    assert run(swizzle(kit.graph, kit.v, (1, 0, 1))) == (-5.0, 2.0, -5.0)
    assert run(kit.graph.node("vector", VEC3, (kit.v, kit.a))) == (2.0, -5.0, 0.75)
    assert run(kit.graph.node("splat", VEC3, (kit.a,))) == (0.75,) * 3
    assert run(kit.graph.node("matrix", square(2), (kit.v, kit.v))) == ((2.0, -5.0),) * 2
    pair = kit.graph.node("array", Array(VEC2, 2), (kit.v, constant(kit.graph, VEC2, (1.0, 2.0))))
    assert run(pair) == ((2.0, -5.0), (1.0, 2.0))
    assert run(index(kit.graph, pair, one)) == (1.0, 2.0)
    assert run(constant(kit.graph, VEC2, (1.0, 2.0))) == (1.0, 2.0)


def test_both_sides_of_a_selection_are_computed_and_neither_traps() -> None:
    kit = Kit()
    zero = kit.number(0.0)
    quotient = kit.call("div", FLOAT, kit.a, zero)
    chosen = kit.graph.node("select", FLOAT, (kit.call("eq", BOOL, zero, zero), kit.a, quotient))
    assert run(chosen) == (0.75,)
    assert run(quotient) == (0.0,)


def test_integers_stay_integers() -> None:
    kit = Kit()
    two = constant(kit.graph, INT, 2)
    assert run(kit.call("div", INT, kit.n, two)) == (1,)
    large = constant(kit.graph, INT, 2**31 - 1)
    assert run(kit.call("add", INT, large, two)) == (-(2**31) + 1,)
    assert run(kit.call("mul", square(2), kit.m, kit.a)) == ((0.75, 1.5), (2.25, 3.0))


def test_sums_count_up_to_their_bound() -> None:
    kit = Kit()
    zero, one = constant(kit.graph, INT, 0), constant(kit.graph, INT, 1)
    assert run(kit.fold("add", 8, kit.n, zero, kit.bound(0))) == (3,)
    assert run(kit.fold("add", 2, kit.n, zero, kit.bound(0))) == (1,)
    assert run(kit.fold("mul", 8, zero, one, kit.bound(0))) == (1,)


def test_sums_in_sums_see_the_outer_variable() -> None:
    kit = Kit()
    zero = constant(kit.graph, INT, 0)
    product = kit.call("mul", INT, kit.bound(0), kit.bound(1))
    inner = kit.fold("add", 8, kit.n, zero, kit.call("add", INT, product, kit.n))
    outer = kit.fold("add", 8, kit.n, zero, kit.call("add", INT, inner, kit.bound(0)))
    assert run(outer) == (sum(sum(i * j + 3 for j in range(3)) + i for i in range(3)),)


def test_a_body_takes_its_arguments_in_order() -> None:
    kit = Kit()
    body = kit.call("sub", FLOAT, kit.bound(0, FLOAT), kit.bound(1, FLOAT))
    assert run(kit.apply(body, kit.a, kit.number(0.5))) == (0.25,)
    twice = kit.call("mul", FLOAT, kit.apply(body, kit.bound(0, FLOAT), kit.a), kit.number(2.0))
    assert run(kit.apply(twice, kit.number(1.0))) == (0.5,)


def test_a_shared_body_has_a_value_for_each_argument() -> None:
    kit = Kit()
    body = kit.call("sin", FLOAT, kit.bound(0, FLOAT))
    both = (kit.apply(body, kit.a), kit.apply(body, kit.number(2.0)))
    assert len(set(run(kit.graph.node("vector", VEC2, both)))) == 2


def test_depth_is_no_limit() -> None:
    kit = Kit()
    value, body = kit.a, kit.bound(0, FLOAT)
    for _ in range(3000):
        value = kit.call("add", FLOAT, value, kit.number(1.0))
        body = kit.apply(kit.call("add", FLOAT, kit.bound(0, FLOAT), kit.number(1.0)), body)
    assert run(value) == (3000.75,)
    nested = kit.number(0.0)
    for _ in range(3000):
        nested = kit.apply(kit.call("add", FLOAT, nested, kit.number(1.0)), kit.a)
    assert run(nested) == (3000.0,)
    assert run(kit.apply(body, kit.a)) == (3000.75,)


def test_shared_steps_are_computed_once() -> None:
    kit = Kit()
    value = kit.number(1.0)
    for _ in range(100):
        value = kit.call("add", FLOAT, value, value)
    assert run(value) == (2.0**100,)
