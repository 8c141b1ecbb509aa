"""Simplification by example: a value and its simplest form."""

from __future__ import annotations

from typing import Literal

import pytest

from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Folding, Formal, Graph, Node
from burnish.compiler.ir.ranges import Ranges
from burnish.compiler.ir.rewrite import rewrite
from burnish.compiler.ir.shader import Notes
from burnish.compiler.ir.types import BOOL, FLOAT, INT, VEC2, VEC3, Type, Vector
from burnish.compiler.passes.simplify import Simplifier
from burnish.stdlib.builtins.facts import LARGEST_FLOAT, UNIT, UNKNOWN, Fact

BVEC2 = Vector("bool", 2)


class Kit:
    """Short spellings for one graph."""

    def __init__(self) -> None:
        self.graph = Graph()

    def leaf(self, name: str, type_: Type = FLOAT, fact: Fact = UNKNOWN) -> Node:
        return self.graph.node(
            "parameter", type_, (), Parameter(name, type_, "material", fact=fact)
        )

    def call(self, name: str, *operands: Node, type_: Type | None = None) -> Node:
        return self.graph.node("call", type_ or operands[0].type, operands, name)

    def number(self, value: float) -> Node:
        return build.floating(self.graph, value)

    def simplified(self, root: Node) -> Node:
        simplifier = Simplifier(self.graph, Ranges([root]), Notes())
        (simple,) = rewrite(self.graph, [root], simplifier.rule)
        return simple


@pytest.fixture
def kit() -> Kit:
    return Kit()


@pytest.mark.parametrize(
    ("name", "neutral"), [("add", 0.0), ("sub", 0.0), ("mul", 1.0), ("div", 1.0)]
)
def test_neutral_operands_disappear(kit: Kit, name: str, neutral: float) -> None:
    x = kit.leaf("x")
    assert kit.simplified(kit.call(name, x, kit.number(neutral))) is x


@pytest.mark.parametrize(
    ("name", "neutral"),
    [("bit_and", -1), ("bit_or", 0), ("bit_xor", 0), ("shift_left", 0), ("shift_right", 64)],
)
def test_bits_that_change_nothing_disappear(kit: Kit, name: str, neutral: int) -> None:
    n = kit.leaf("n", INT)
    assert kit.simplified(kit.call(name, n, build.constant(kit.graph, INT, neutral))) is n


def test_bits_that_decide_everything_are_constants(kit: Kit) -> None:
    n = kit.leaf("n", INT)
    none, all_set = (build.constant(kit.graph, INT, bits) for bits in (0, -1))
    assert kit.simplified(kit.call("bit_and", n, none)) is none
    assert kit.simplified(kit.call("bit_or", n, all_set)) is all_set
    assert kit.simplified(kit.call("bit_xor", n, n)) is none
    assert kit.simplified(kit.call("bit_and", n, n)) is n
    assert kit.simplified(kit.call("bit_xor", n, all_set)) is kit.call("bit_not", n)
    assert kit.simplified(kit.call("bit_not", kit.call("bit_not", n))) is n


def test_lanes_that_all_hold_decide_a_choice(kit: Kit) -> None:
    v, w = kit.leaf("v", VEC2), kit.leaf("w", VEC2)
    all_hold = build.constant(kit.graph, BVEC2, (True, True))
    mixed = build.constant(kit.graph, BVEC2, (True, False))
    assert kit.simplified(kit.call("choose", all_hold, v, w, type_=VEC2)) is v
    assert kit.simplified(kit.call("choose", mixed, v, v, type_=VEC2)) is v
    assert kit.simplified(kit.call("and", mixed, all_hold)) is mixed
    flags = kit.leaf("flags", BVEC2)
    assert kit.simplified(kit.call("and", flags, mixed)).op == "call"
    assert kit.simplified(kit.call("or", flags, all_hold)) is all_hold


def test_zero_times_anything_is_zero(kit: Kit) -> None:
    v = kit.leaf("v", VEC3)
    product = kit.call("mul", v, kit.number(0.0))
    assert kit.simplified(product) is build.constant(kit.graph, VEC3, (0.0,) * 3)


def test_constants_are_folded_with_burnish_meaning(kit: Kit) -> None:
    assert kit.simplified(kit.call("div", kit.number(1.0), kit.number(0.0))) is kit.number(0.0)
    assert kit.simplified(kit.call("pow", kit.number(0.0), kit.number(0.0))) is kit.number(1.0)


def test_what_float32_cannot_hold_becomes_the_largest_number_that_it_does(kit: Kit) -> None:
    large = kit.call("mul", kit.number(1e30), kit.number(1e30))
    assert kit.simplified(large) is kit.number(LARGEST_FLOAT)
    assert kit.simplified(kit.call("neg", large)) is kit.number(-LARGEST_FLOAT)
    assert kit.simplified(kit.call("mul", large, kit.number(0.0))) is kit.number(0.0)


def test_differences_and_double_negations_vanish(kit: Kit) -> None:
    x = kit.leaf("x")
    assert kit.simplified(kit.call("sub", x, x)) is kit.number(0.0)
    assert kit.simplified(kit.call("neg", kit.call("neg", x))) is x


def test_saturating_what_is_saturated_costs_nothing(kit: Kit) -> None:
    once = kit.call("saturate", kit.leaf("x"))
    assert kit.simplified(kit.call("saturate", once)) is once
    clamped = kit.call("clamp", once, kit.number(-1.0), kit.number(2.0))
    assert kit.simplified(clamped) is once


def test_normalising_a_direction_costs_nothing(kit: Kit) -> None:
    direction = kit.leaf("d", VEC3, UNIT)
    assert kit.simplified(kit.call("normalize", direction)) is direction


def test_ranges_decide_comparisons(kit: Kit) -> None:
    power = kit.leaf("power", FLOAT, Fact(1.0, 512.0))
    below = kit.call("lt", power, kit.number(0.5), type_=BOOL)
    x, y = kit.leaf("x"), kit.leaf("y")
    assert kit.simplified(kit.graph.node("select", FLOAT, (below, x, y))) is y


def test_truths_compared_with_constants_are_truths(kit: Kit) -> None:
    x, zero = kit.leaf("x"), kit.number(0.0)
    below = kit.call("lt", x, zero, type_=BOOL)
    for truth in (False, True):
        constant = build.constant(kit.graph, BOOL, truth)
        same = kit.simplified(kit.call("eq", below, constant))
        other = kit.simplified(kit.call("ne", constant, below))
        pair = [below, kit.call("ge", x, zero, type_=BOOL)]
        assert [same, other] == (pair if truth else pair[::-1])


def test_lanes_are_found_where_they_came_from(kit: Kit) -> None:
    x, v = kit.leaf("x"), kit.leaf("v", VEC2)
    joined = build.vector(kit.graph, (x, v))
    assert kit.simplified(build.swizzle(kit.graph, joined, (0,))) is x
    assert kit.simplified(build.swizzle(kit.graph, joined, (1, 2))) is v
    taken = [build.swizzle(kit.graph, v, (lane,)) for lane in (1, 0)]
    assert kit.simplified(build.vector(kit.graph, tuple(taken))) is build.swizzle(
        kit.graph, v, (1, 0)
    )


def test_equal_lanes_are_computed_once(kit: Kit) -> None:
    x, y = kit.leaf("x"), kit.leaf("y")
    both = [build.splat(kit.graph, lane, 3) for lane in (x, y)]
    assert kit.simplified(kit.call("mul", *both)) is build.splat(
        kit.graph, kit.call("mul", x, y), 3
    )


def fold(kit: Kit, bound: int, body: Node, index: Formal) -> Node:
    count = build.constant(kit.graph, INT, bound)
    folding = Folding("add", bound, (index,))
    return kit.graph.node("fold", FLOAT, (count, kit.number(0.0), body), folding)


def test_short_folds_are_written_out(kit: Kit) -> None:
    index = Formal("i")
    i = kit.graph.node("formal", INT, (), index)
    body = kit.call("mul", kit.call("to_float", i, type_=FLOAT), kit.leaf("x"))
    assert kit.simplified(fold(kit, 2, body, index)) is kit.leaf("x")
    assert kit.simplified(fold(kit, 9, body, index)).op == "fold"


def test_folds_of_constants_are_computed(kit: Kit) -> None:
    index = Formal("i")
    body = kit.call("to_float", kit.graph.node("formal", INT, (), index), type_=FLOAT)
    assert kit.simplified(fold(kit, 9, body, index)) is kit.number(36.0)
    assert kit.simplified(fold(kit, 4096, body, index)).op == "fold", "that takes too long"


def test_folds_of_nothing_are_their_start(kit: Kit) -> None:
    index = Formal("i")
    assert kit.simplified(fold(kit, 9, kit.number(0.0), index)) is kit.number(0.0)
    assert kit.simplified(fold(kit, 0, kit.leaf("x"), index)) is kit.number(0.0)


@pytest.mark.parametrize("operator", ["add", "mul", "min", "max"])
def test_folds_of_unequal_lanes_do_something(
    kit: Kit, operator: Literal["add", "mul", "min", "max"]
) -> None:
    count, start = build.constant(kit.graph, INT, 9), kit.leaf("start", VEC3)
    body = build.constant(kit.graph, VEC3, (2.0, 1.0, 0.25))
    operands = count, start, body
    folding = Folding(operator, 9, (Formal("i"),))
    assert kit.simplified(kit.graph.node("fold", VEC3, operands, folding)) is not start


@pytest.mark.parametrize("order", [1, -1])
def test_a_scalar_lane_stands_for_all_lanes_of_a_vector(kit: Kit, order: Literal[1, -1]) -> None:
    v, constant = kit.leaf("v", VEC3), build.constant(kit.graph, VEC3, (1.0, 2.0, 3.0))
    lane = build.swizzle(kit.graph, v, (2,))
    for vector in (v, constant):
        product = kit.graph.node("call", VEC3, (vector, lane)[::order], "mul")
        picked = build.swizzle(kit.graph, product, (2,))
        assert kit.simplified(picked).op == "swizzle"
