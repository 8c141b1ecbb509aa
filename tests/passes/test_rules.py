"""Every simplification rule keeps values, shows in a text, and would be missed if it were wrong."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache

import pytest

from burnish.compiler.ir import build
from burnish.compiler.ir.node import Node, reachable
from burnish.compiler.ir.ranges import Ranges
from burnish.compiler.ir.shader import Notes
from burnish.compiler.ir.types import Vector
from burnish.compiler.ir.verify import InvalidGraphError, verify
from burnish.compiler.passes.pipeline import Options, stage
from burnish.compiler.passes.rules.rule import (
    ANY,
    CONSTANT,
    Builder,
    Rule,
    Site,
    always,
    builtin,
    constant,
    operand,
)
from burnish.compiler.passes.rules.table import RULES
from burnish.compiler.passes.simplify import Simplifier
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.reference.namespace import Lanes
from burnish.compiler.reference.operations import apply, constant_lanes
from burnish.frozen import changed
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import LARGEST_FLOAT
from burnish.targets import registry
from burnish.targets.emit.emitter import emit
from burnish.targets.legalise.legalise import legalise

from .kit import World, range_rules, shader
from .rule_programs import EQUATIONS, program
from .sites import Sites, UnsuitableError

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
            site = sites.site()
        except UnsuitableError:
            continue
        before = sites.operation(site)
        simplifier = Simplifier(sites.graph, Ranges([before]), Notes())
        if not rule.admits(tuple(each.head for each in site.operands)):
            continue
        after = rule.apply(simplifier, site, rule.closer)
        if after is not None and after is not before:
            if sites.uses_outer(before):
                before, after = sites.summed_up(before), sites.summed_up(after)
            yield before, after


def disagreement(rule: Rule, wanted: int = WANTED) -> str | None:
    """Where the values before and after a rule differ, if they do; and how often it was tried."""
    tried = 0
    for before, after in applications(rule):
        try:
            verify([before, after], stage="opened")
        except InvalidGraphError as error:
            return str(error)
        if not all(map(is_representable, reachable([after]))):
            return f"{before} becomes {after}, which float32 does not hold"
        for seed in range(WORLDS):
            world = World(seed, traps=seed % 2 == 1)
            old, new = evaluate(before, world), evaluate(after, world)
            if not same(old, new):
                return f"{before}: {old} becomes {after}: {new}"
        tried += 1
        if tried == wanted:
            return None
    return f"{rule.name} applies to {tried} random operations only"


def is_representable(node: Node) -> bool:
    """Whether a value is one that float32 can hold, if it is a constant."""
    if node.op != "constant":
        return True
    return all(abs(lane) <= LARGEST_FLOAT for lane in _flat(constant_lanes(node.type, node.data)))


def same(old: Lanes, new: Lanes) -> bool:
    """Whether values agree as far as double precision goes, within what float32 holds."""
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


def _one_more(b: Builder, at: Site) -> Node:
    radicand = at.operands[0].operands[0]
    return b.call("add", at.type, radicand, b.constant(at.type, 1))


def _unswapped(b: Builder, at: Site) -> Node:
    condition, *sides = at.operands
    return b.make("select", at.type, (condition.operands[0], *sides), at.data)


def _lanes_of_outer(b: Builder, at: Site) -> Node:
    source = at.operands[0].operands[0]
    assert isinstance(at.data, tuple)
    return b.make("swizzle", at.type, (source,), at.data)


def _folded(b: Builder, at: Site) -> Node:
    values = [constant_lanes(each.type, each.data) for each in at.operands]
    made = apply(b.graph.node("call", at.type, at.operands, at.data), values)
    return build.constant(b.graph, at.type, made if isinstance(at.type, Vector) else made[0])


WRONG = {
    "sqrt(x)² → x + 1": Rule(
        "planted", "", ("mul",), (builtin("sqrt"), builtin("sqrt")), _one_more,
        lambda _b, at: at.operands[0] is at.operands[1],
    ),
    "x - y → 0": changed(BY_NAME["subtracted from itself"], when=always),
    "x / 2 → x": changed(BY_NAME["divided by one"], pattern=(ANY, CONSTANT)),
    "max for min": changed(BY_NAME["greatest is left"], when=BY_NAME["greatest is right"].when),
    "every value saturated": changed(BY_NAME["saturated already"], when=always),
    "every vector of length one": changed(BY_NAME["of length one"], when=always),
    "pow(x, 1) of negative x": changed(BY_NAME["to the power of one"], gives=constant(1)),
    "x < y decided by equality": changed(BY_NAME["lt holds"], when=BY_NAME["le holds"].when),
    "sides not swapped": changed(BY_NAME["chosen by an opposite"], gives=_unswapped),
    "lanes of lanes in the wrong order": changed(BY_NAME["lanes of lanes"], gives=_lanes_of_outer),
    "any mask keeps all bits": changed(BY_NAME["all bits kept"], when=always),
    "shifts by 33 as by 0": changed(BY_NAME["shifted by nothing"], when=always),
    "a product of ones": changed(BY_NAME["fold of neutral terms"], when=always),
    "the other side": changed(BY_NAME["chosen already"], gives=operand(2)),
    "first element for all": changed(BY_NAME["element of equal ones"], when=always),
    "0 - x as x - 0": changed(BY_NAME["zero subtracted"], either=True),
    "constants beyond float32": changed(BY_NAME["constants"], gives=_folded),
    "loops that go on": changed(BY_NAME["loop that stops at once"], when=always),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_rule_is_found(name: str) -> None:
    found = disagreement(WRONG[name], wanted=200)
    assert found is not None and "random operations only" not in found


# --- a rule is good for something ----------------------------------------------------------------


def snapshot(text: str, *without: str) -> tuple[str, ...]:
    """A program's texts and guards, without some rules; or why no text can be made."""
    try:
        staged = stage(shader(text), Options(hoist=False, without=frozenset(without)))
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
        assert all(on in BUILTINS or on.startswith((".", "*")) for on in rule.on)
        assert rule.says[0].isupper() and rule.says.endswith("."), rule.name
