"""Planted errors in the passes: missing guards, wrong ranges, wrong rewrites."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

from burnish.compiler.ir import range_rules, ranges
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.refinements import refinements
from burnish.compiler.passes import (
    guard,
    lower_reads,
    move_to_vertices,
    path_conditions,
    split_stages,
)
from burnish.compiler.passes.rules import table
from burnish.compiler.passes.rules.rule import Rule
from burnish.compiler.passes.rules.terms import Term, Variable
from burnish.compiler.passes.rules.vocabulary import a, x
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import UNIT, Fact
from burnish.stdlib.builtins.row import RangeRule, everywhere
from burnish.support.frozen import changed

from .planting import QUICKEST, Plant, Planted, promised, replaced


def unguarded(builtin: str) -> Plant:
    """Use the hardware's operation for a builtin, whatever the operands."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        row = changed(BUILTINS[builtin], domain=everywhere)
        patch.setattr(guard, "BUILTINS", {**BUILTINS, builtin: row})

    return plant


def claimed(builtin: str, rule: RangeRule) -> Plant:
    """Give a builtin a range rule that its values do not obey."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        row = changed(BUILTINS[builtin], range=rule)
        patch.setattr(range_rules, "BUILTINS", {**BUILTINS, builtin: row})

    return plant


Known = Sequence[Fact]


def derived(operation: str, derive: Callable[[Any, Node, Known], Fact]) -> Plant:
    """Give an operation that is no builtin a range rule that its values do not obey."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        row = changed(range_rules.RULES[operation], derive=derive)
        patch.setattr(ranges, "RULES", {**range_rules.RULES, operation: row})

    return plant


def turning(analysis: Any, node: Node, known: Known) -> Fact:
    """The range of a fold that makes a turn at least, which many do not."""
    count, start, body = known
    at_least = changed(count, lo=max(count.lo, 1.0))
    return range_rules.RULES["fold"].derive(analysis, node, (at_least, start, body))


def rewriting(name: str, right: Term) -> Plant:
    """Give all equations of a rule of ``simplify`` a right side that is wrong."""

    def wrong(rule: Rule) -> Rule:
        return changed(rule, right=right, also=tuple((left, right) for left, _ in rule.also))

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        assert any(rule.name == name for rule in table.RULES)
        rules = [wrong(rule) if rule.name == name else rule for rule in table.RULES]
        patch.setattr(table, "ALL", table.RuleTable(rules))

    return plant


def _holding(fact: Any, condition: Any, _holds: bool, without: Any) -> Any:
    """The refinements of a condition that holds, also where it does not hold."""
    return refinements(fact, condition, True, without)


GUARDS = [
    ("div", "operations: Arithmetic", "glsl"),
    ("mod", "operations: Arithmetic", "hlsl"),
    ("mod", "operations: Arithmetic", "wgsl"),
    ("smoothstep", "operations: Limits", "wgsl"),
    ("sqrt", "operations: Powers", "glsl"),
    ("inversesqrt", "operations: Powers", "hlsl"),
    ("log", "operations: Powers", "wgsl"),
    ("log2", "operations: Powers", "glsl"),
    ("pow", "operations: Powers", "hlsl"),
    ("asin", "operations: Angles", "wgsl"),
    ("acos", "operations: Angles", "glsl"),
    ("atan2", "operations: Angles", "hlsl"),
    ("normalize", "operations: Geometry", "wgsl"),
    ("div", "integers: Signed", "glsl"),
    ("div", "integers: Unsigned", "hlsl"),
    ("mod", "integers: Signed", "wgsl"),
    ("mod", "integers: Unsigned", "glsl"),
    ("to_int", "integers: Converted", "glsl"),
    ("to_uint", "integers: Converted", "hlsl"),
    ("float_of_bits", "bits: Floats", "glsl"),
]
"""A builtin, a material that needs its guard, and a language."""

PLANTED = [
    *(
        Planted(f"{builtin} without its guard", material, QUICKEST[language], unguarded(builtin))
        for builtin, material, language in GUARDS
    ),
    Planted("first_leading_bit as DXC has it", "bits: Counted", "lavapipe:hlsl-dxc",
            promised("hlsl", "first_leading_bit")),
    Planted("a promise of quotients", "integers: Signed", QUICKEST["glsl"],
            promised("glsl", "div")),
    Planted("a promise of remainders", "integers: Unsigned", QUICKEST["hlsl"],
            promised("hlsl", "mod")),
    Planted("clamp without its guard", "operations: Crossed", "chromium:webgpu", unguarded("clamp"),
            "failed"),
    Planted("differences are never negative", "operations: Powers", QUICKEST["glsl"],
            claimed("sub", lambda _facts, _same: Fact(0.0, 1e9))),
    Planted("floors lie between 0 and 1", "operations: Limits", QUICKEST["hlsl"],
            claimed("floor", lambda _facts, _same: Fact(0.5, 1.0))),
    Planted("products have length one", "operations: Geometry", QUICKEST["wgsl"],
            claimed("mul", lambda _facts, _same: UNIT)),
    Planted("absolute values are not zero", "integers: Unsigned", QUICKEST["glsl"],
            claimed("abs", lambda _facts, _same: Fact(1.0, 9.0))),
    Planted("conditions hold on both sides", "operations: Simplified", QUICKEST["glsl"],
            replaced(path_conditions, "refinements", _holding)),
    Planted("reads within branches", "choices: Reads", "chromium:webgpu",
            replaced(split_stages, "needing_uniform_flow", lambda _nodes: frozenset()), "failed"),
    Planted("magnitudes are not zero", "rules: Zeros", QUICKEST["hlsl"],
            claimed("abs", lambda _facts, _same: Fact(1.0, 9.0))),
    Planted("squares are not zero", "rules: Zeros", QUICKEST["wgsl"],
            claimed("mul", lambda _facts, _same: Fact(1.0, 9.0))),
    Planted("lengths are not zero", "rules: Zeros", QUICKEST["glsl"],
            claimed("length", lambda _facts, _same: Fact(1.0, 9.0))),
    Planted("folds make a turn at least", "rules: Guarded", QUICKEST["glsl"],
            derived("fold", turning)),
    Planted("folds are never negative", "rules: Guarded", QUICKEST["hlsl"],
            derived("fold", lambda _ranges, _node, _known: Fact(0.0))),
    Planted("states stay what they were at the start", "rules: Guarded", QUICKEST["wgsl"],
            derived("iterate", lambda _ranges, _node, known: known[1])),
    Planted("what crosses is never negative", "rules: Guarded", QUICKEST["glsl"],
            derived("cross", lambda _ranges, _node, _known: Fact(0.0))),
    Planted("a sum of constant terms without the second", "rules: Gathered", QUICKEST["glsl"],
            rewriting("constants added", Variable("s"))),
    Planted("a product of constant factors without the second", "rules: Gathered",
            QUICKEST["hlsl"], rewriting("constant factors", Variable("p"))),
    Planted("a common factor without the other one", "rules: Gathered", QUICKEST["wgsl"],
            rewriting("common factor", x * a)),
    Planted("columns of the next matrix", "buffers: Shapes", QUICKEST["glsl"],
            replaced(lower_reads, "stored_elements", lambda _element: 1)),
    Planted("everything is affine", "pipeline: Crossing", QUICKEST["glsl"],
            replaced(move_to_vertices, "_is_affine", lambda _node: True)),
]  # fmt: skip
