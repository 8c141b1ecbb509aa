"""Equations of rules: what their terms match, what they build, and how they are printed."""

from __future__ import annotations

import pytest

from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.ranges import Ranges
from burnish.compiler.ir.shader import Notes
from burnish.compiler.ir.types import FLOAT, VEC3, Type
from burnish.compiler.passes.rules.notation import conditions, equations
from burnish.compiler.passes.rules.rule import Rule
from burnish.compiler.passes.rules.terms import Operand, Operation, Several, either, function
from burnish.compiler.passes.rules.vocabulary import (
    a,
    abs_,
    b,
    c,
    d,
    lanes,
    max_,
    not_,
    pow_,
    sqrt,
    swizzle,
    x,
    y,
    z,
)
from burnish.compiler.passes.simplify import Simplifier


class Trial:
    """A graph with some leaves, and what a rule makes of its values."""

    def __init__(self) -> None:
        self.graph = Graph()

    def leaf(self, name: str, type_: Type = FLOAT) -> Node:
        return self.graph.node("parameter", type_, (), Parameter(name, type_, "material"))

    def call(self, name: str, *operands: Node, type_: Type | None = None) -> Node:
        return self.graph.node("call", type_ or operands[0].type, operands, name)

    def number(self, value: float) -> Node:
        return build.floating(self.graph, value)

    def applied(self, node: Node, left: Operation, right: Operand) -> Node | None:
        simplifier = Simplifier(self.graph, Ranges([node]), Notes())
        rule = Rule("tried", left, right, "")
        return rule.apply(simplifier, node.op, node.type, node.operands, node.data)


@pytest.fixture
def trial() -> Trial:
    return Trial()


def test_a_name_is_one_value(trial: Trial) -> None:
    p, q = trial.leaf("p"), trial.leaf("q")
    square, product = trial.call("mul", p, p), trial.call("mul", p, q)
    assert trial.applied(trial.call("sqrt", square), sqrt(x * x), x) is p
    assert trial.applied(trial.call("sqrt", product), sqrt(x * x), x) is None
    twice = trial.call("add", square, trial.call("mul", p, q))
    assert trial.applied(twice, x * x + x * y, y) is q


def test_numbers_are_constants_with_the_number_in_every_lane(trial: Trial) -> None:
    p = trial.leaf("p")
    for exponent, result in ((2.0, p), (2.5, None)):
        power = trial.call("pow", p, trial.number(exponent))
        assert trial.applied(power, pow_(x, 2), x) is result


def test_constants_match_constants_only(trial: Trial) -> None:
    p, half = trial.leaf("p"), trial.number(0.5)
    assert trial.applied(trial.call("mul", p, half), x * c, c) is half
    assert trial.applied(trial.call("mul", p, p), x * c, c) is None


def test_operands_stand_in_either_order_where_that_is_said(trial: Trial) -> None:
    p, q = trial.leaf("p"), trial.leaf("q")
    negated = trial.call("neg", q)
    for sum_ in (trial.call("add", p, negated), trial.call("add", negated, p)):
        assert trial.applied(sum_, either(x + -y), y) is q
    assert trial.applied(trial.call("add", negated, p), x + -y, y) is None
    products = trial.call("add", trial.call("mul", p, q), trial.call("mul", q, trial.leaf("r")))
    assert trial.applied(products, either(x * a) + either(x * b), x) is q


def test_a_label_and_the_parts_below_it_are_named(trial: Trial) -> None:
    p, half = trial.leaf("p"), trial.number(0.5)
    inner = trial.call("add", p, half)
    outer = trial.call("mul", inner, trial.number(3.0))
    for right, value in ((z, inner), (x, p), (c, half)):
        assert trial.applied(outer, z @ (x + c) * d, right) is value


def test_results_have_the_type_of_what_they_replace(trial: Trial) -> None:
    v, s, zero = (
        trial.leaf("v", VEC3),
        trial.leaf("s"),
        build.constant(trial.graph, VEC3, (0.0,) * 3),
    )
    negated = trial.applied(trial.call("sub", zero, s, type_=VEC3), 0 - x, -x)
    assert negated is not None and negated.type == VEC3 and negated.operands[0].op == "splat"
    assert trial.applied(trial.call("mul", v, s), x * y, 1) is build.constant(
        trial.graph, VEC3, (1.0,) * 3
    )
    inner = trial.applied(trial.call("abs", s), abs_(x), max_(x + 0.25, 0))
    assert inner is trial.call("max", trial.call("add", s, trial.number(0.25)), trial.number(0))


PRINTED: dict[str, tuple[Operation, Operand]] = {
    "x * (y + z) → x * y + x * z": (x * (y + z), x * y + x * z),
    "x - (y - z) → x - y + z": (x - (y - z), (x - y) + z),
    "-(-x) → x": (function("neg")(-x), x),
    "not (x and y) → not x": (not_(function("and")(x, y)), not_(x)),
    "z@(x + c) * d → pow(x, 0.5)": (z @ (x + c) * d, pow_(x, 0.5)),
    "swizzle[lanes](x) → true": (swizzle[lanes](x), True),
    "max(xs…) → -1": (max_(Several("xs")), -1),
}


@pytest.mark.parametrize("text", PRINTED)
def test_rules_are_printed_as_equations(text: str) -> None:
    left, right = PRINTED[text]
    assert equations(Rule("tried", left, right, "")) == (text,)


def test_conditions_are_printed_in_words() -> None:
    rounded = function("floor", "ceil")
    rule = Rule("tried", rounded(x), x, "", where=(x >= 0, x < y), of_calls=True)
    assert conditions(rule) == (
        "f is ceil or floor, x >= 0, x < y, none is a hardware operation yet"
    )
