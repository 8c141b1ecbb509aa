"""Every simplification rule keeps values, shows in a text, and would be missed if it were wrong."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache

import pytest

from burnish.compiler.ir import build
from burnish.compiler.ir.node import HEADS, Node, reachable
from burnish.compiler.ir.ranges import Ranges
from burnish.compiler.ir.shader import Notes
from burnish.compiler.ir.types import Type, Vector, scalar_kind
from burnish.compiler.ir.verify import InvalidGraphError, verify
from burnish.compiler.passes.known_values import ONE_VALUE
from burnish.compiler.passes.pipeline import Options, stage
from burnish.compiler.passes.rules.builder import Builder
from burnish.compiler.passes.rules.rule import Rule
from burnish.compiler.passes.rules.table import RULES
from burnish.compiler.passes.rules.terms import computed, condition, either, function
from burnish.compiler.passes.rules.vocabulary import (
    a,
    abs_,
    b,
    c,
    cs,
    lanes,
    mode,
    select,
    sqrt,
    swizzle,
    x,
    y,
)
from burnish.compiler.passes.simplify import Simplifier
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.reference.namespace import Lanes
from burnish.compiler.reference.operations import apply, constant_lanes
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import LARGEST_FLOAT
from burnish.support.frozen import changed
from burnish.targets import registry
from burnish.targets.emit.emitter import emit
from burnish.targets.legalise.legalise import legalise

from .kit import World, range_rules, shader
from .rule_programs import EQUATIONS, program
from .sites import Sites
from .typings import UnsuitableError

WANTED = 100
"""Operations on which each rule is tried."""
ATTEMPTS = 6_000
"""Random operations among which there have to be so many."""
WORLDS = 6
"""Values of the leaves of each."""
BY_NAME = {rule.name: rule for rule in RULES}


# --- what a rule gives has the value that it replaces --------------------------------------------


def applications(rule: Rule) -> Iterator[tuple[Node, Node]]:
    """Operations to which a rule applies, and what it makes of them."""
    for seed in range(ATTEMPTS):
        sites = Sites(rule, seed)
        try:
            before = sites.operation()
        except UnsuitableError:
            continue
        simplifier = Simplifier(sites.graph, Ranges([before]), Notes())
        after = rule.apply(simplifier, before.op, before.type, before.operands, before.data)
        if after is not None and after is not before:
            if sites.uses_outer(before):
                before, after = sites.summed_up(before), sites.summed_up(after)
            yield before, after


def disagreement(rule: Rule, wanted: int = WANTED) -> str | None:
    """A difference between the values before and after a rule, or a lack of applications."""
    tried = 0
    for before, after in applications(rule):
        try:
            verify([before, after], stage="opened")
        except InvalidGraphError as error:
            return str(error)
        largest = max(map(magnitude, reachable([after])))
        if largest > LARGEST_FLOAT:
            return f"{before} becomes {after}, which float32 does not hold"
        # A constant that has overflowed is outside of what any rule promises.
        for seed in range(WORLDS if largest < LARGEST_FLOAT else 0):
            world = World(seed, traps=seed % 2 == 1)
            old, new = evaluate(before, world), evaluate(after, world)
            if not same(old, new):
                return f"{before}: {old} becomes {after}: {new}"
        tried += 1
        if tried == wanted:
            return None
    return f"{rule.name} applies to {tried} random operations only"


def magnitude(node: Node) -> float:
    """The magnitude of the largest lane of a constant."""
    if node.op != "constant":
        return 0.0
    return float(max(map(abs, _flat(constant_lanes(node.type, node.data)))))


def same(old: Lanes, new: Lanes) -> bool:
    """True if values agree within double precision, and within the range of float32."""
    return all(map(_lane_same, _flat(old), _flat(new))) and len(_flat(old)) == len(_flat(new))


def _flat(value: Lanes) -> list[float | int | bool]:
    return [lane for part in value for lane in (_flat(part) if isinstance(part, tuple) else [part])]


def _lane_same(old: float | int | bool, new: float | int | bool) -> bool:
    if isinstance(old, bool) or isinstance(new, bool):
        return old is new
    if math.isfinite(old) and math.isfinite(new):
        old, new = (max(min(each, LARGEST_FLOAT), -LARGEST_FLOAT) for each in (old, new))
        return math.isclose(old, new, rel_tol=1e-9, abs_tol=1e-12)
    # What overflows before and after is outside of what any rule promises.
    return not math.isfinite(old)


@pytest.mark.parametrize("name", BY_NAME)
def test_a_rule_keeps_the_value(name: str) -> None:
    assert disagreement(BY_NAME[name]) is None


# --- a wrong rule is found -----------------------------------------------------------------------


@computed
def folded(builder: Builder, type_: Type, name: str, operands: tuple[Node, ...]) -> Node:
    values = [constant_lanes(each.type, each.data) for each in operands]
    made = apply(builder.graph.node("call", type_, operands, name), values)
    return build.constant(builder.graph, type_, made if isinstance(type_, Vector) else made[0])


@condition("{} is an integer")
def is_integer(_builder: Builder, _type: Type, value: Node) -> bool:
    return scalar_kind(value.type) == "int"


f = BY_NAME["constants"].left.function

WRONG = {
    "sqrt(x)² → x + 1": Rule("planted", sqrt(x) * sqrt(x), x + 1, ""),
    "x - y → 0": changed(BY_NAME["subtracted from itself"], left=x - y),
    "x / 2 → x": changed(BY_NAME["divided by one"], left=x / c),
    "max for min": changed(BY_NAME["greatest is left"], where=x <= y),
    "every value saturated": changed(BY_NAME["saturated already"], where=()),
    "every vector of length one": changed(BY_NAME["of length one"], where=()),
    "pow(x, 1) of negative x": changed(BY_NAME["to the power of one"], right=1),
    "x < y decided by equality": changed(BY_NAME["lt holds"], where=x <= y),
    "sides not swapped": changed(BY_NAME["chosen by an opposite"], right=select[mode](a, x, y)),
    "lanes of lanes in the wrong order": changed(
        BY_NAME["lanes of lanes"], right=swizzle[lanes](x)
    ),
    "any mask keeps all bits": changed(BY_NAME["all bits kept"], where=()),
    "shifts by 33 as by 0": changed(BY_NAME["shifted by nothing"], where=()),
    "a product of ones": changed(BY_NAME["fold of neutral terms"], where=()),
    "the other side": changed(BY_NAME["chosen already"], right=y),
    "first element for all": changed(BY_NAME["element of equal ones"], where=()),
    "0 - x as x - 0": changed(BY_NAME["zero subtracted"], left=either(x - 0)),
    "constants beyond float32": changed(BY_NAME["constants"], right=folded(f, cs)),
    "loops that go on": changed(BY_NAME["loop that stops at once"], where=()),
    "two factors in common": changed(
        BY_NAME["common factor"], left=x * a + y * b, right=(a + b) * x
    ),
    "a negation of a difference": Rule("planted", -(x - y), x - y, ""),
    "nearly positive": changed(BY_NAME["not negative"], where=x >= -0.001),
    "nearly saturated": changed(BY_NAME["saturated already"], where=(x >= -0.001, x <= 1)),
    "nearly ordered": Rule("planted", function("lt")(x, 0), False, "", where=x >= -1e-20),
    "not zero": Rule("planted", function("gt")(x, 0), True, "", where=x >= 0),
    "squares of integers that wrap": Rule(
        "planted", abs_(x * x), x * x, "", where=is_integer(x)
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_rule_is_found(name: str) -> None:
    found = disagreement(WRONG[name], wanted=200)
    assert found is not None and "random operations only" not in found


# --- a rule is good for something ----------------------------------------------------------------


def snapshot(text: str, *without: str) -> tuple[str, ...]:
    """A program's texts and guards, without some rules; or why no text can be made.

    Ranges alone make constants of most values that rules find to be zero or one, so here they do
    not.
    """
    options = Options(hoist=False, without=frozenset((*without, ONE_VALUE)))
    try:
        staged = stage(shader(text), options)
    except InvalidGraphError as error:
        return (str(error),)
    texts = [
        file.text
        for language in ("glsl", "hlsl")
        for target in (registry.load(language),)
        for file in emit(legalise(staged.program, target, target.profiles[0])).files
    ]
    return (*texts, *sorted(f"{guard.builtin} {guard.span}" for guard in staged.guards))


@cache
def usual(rule: str) -> tuple[str, ...]:
    return snapshot(program(rule))


@pytest.mark.parametrize("name", BY_NAME)
def test_a_rule_shows_in_the_text_of_its_program(name: str) -> None:
    assert snapshot(program(name), name) != usual(name)


def test_each_rule_has_a_program_and_a_name_of_its_own() -> None:
    assert len(BY_NAME) == len(RULES)
    assert EQUATIONS.keys() == BY_NAME.keys()
    assert BY_NAME.keys().isdisjoint(range_rules())


def test_each_rule_is_for_operations_that_exist_and_says_why_it_holds() -> None:
    for rule in RULES:
        assert all(head in BUILTINS or head in HEADS.values() for head in rule.heads)
        assert all(left.function.heads == rule.heads for left, _ in rule.equations)
        assert rule.says[0].isupper() and rule.says.endswith("."), rule.name
