"""Simplification rules that depend on ranges: limits, comparisons, known signs and lengths."""

from __future__ import annotations

from collections.abc import Callable

from ...ir.comparisons import HOLDS
from ...ir.node import Node
from ...ir.operations import CALL
from ...ir.refinements import OPPOSITES
from .rule import (
    ANY,
    Builder,
    Rule,
    Site,
    are_same,
    builtin,
    constant,
    inner,
    is_float,
    is_whole_bool,
    lanes,
    operand,
)


def _holds(comparison: str) -> Callable[[Builder, Site], bool]:
    """Whether ranges show that a comparison of the two operands always holds."""
    decision = HOLDS[comparison]
    return lambda b, at: decision(*map(b.ranges.of, at.operands))


def _within_limits(b: Builder, at: Site) -> bool:
    value, low, high = map(b.ranges.of, at.operands)
    return value.within(low.hi, high.lo)


def _is_whole_float(b: Builder, at: Site) -> bool:
    return is_float(b, at) and at.operands[0].type == at.type


def _comparison(name: str, words: str) -> tuple[Rule, Rule]:
    return (
        Rule(f"{name} holds", f"Ranges show that the left value is always {words} the right one.",
             (name,), (ANY, ANY), constant(True), _holds(name), drops=True),
        Rule(f"{name} fails", f"Ranges show that the left value is never {words} the right one.",
             (name,), (ANY, ANY), constant(False), _holds(OPPOSITES[name]), drops=True),
    )  # fmt: skip


def _equality(name: str, equal: bool) -> tuple[Rule, ...]:
    """``==`` (``equal``) and ``!=``."""
    return (
        Rule(f"{name} a bool", "A bool compared with true or false is the bool itself.",
             (name,), (lanes(equal), ANY), operand(1), is_whole_bool(1), either=True, drops=True),
        Rule(f"{name} the other bool", "A bool compared with true or false is its opposite.",
             (name,), (lanes(not equal), ANY),
             lambda b, at: b.make(at.op, at.type, at.operands[1:], "not"),
             is_whole_bool(1), either=True, drops=True),
        Rule(f"{name} itself", "A value equals itself.",
             (name,), (ANY, ANY), constant(equal), are_same, drops=True),
        Rule(f"{name} apart", "Ranges without a common value show that two values differ.",
             (name,), (ANY, ANY), constant(not equal), _holds("ne"), drops=True),
    )  # fmt: skip


def _opposite(b: Builder, at: Site) -> Node:
    (comparison,) = at.operands
    return b.make(at.op, at.type, comparison.operands, OPPOSITES[CALL.data(comparison)])


BOUNDS = (
    Rule("least is left", "Ranges show which value is the least.",
         ("min",), (ANY, ANY), operand(0), _holds("le"), drops=True),
    Rule("least is right", "Ranges show which value is the least.",
         ("min",), (ANY, ANY), operand(1), _holds("ge"), drops=True),
    Rule("greatest is left", "Ranges show which value is the greatest.",
         ("max",), (ANY, ANY), operand(0), _holds("ge"), drops=True),
    Rule("greatest is right", "Ranges show which value is the greatest.",
         ("max",), (ANY, ANY), operand(1), _holds("le"), drops=True),
    Rule("within limits", "A value that stays between the limits is not changed by `clamp`.",
         ("clamp",), (ANY, ANY, ANY), operand(0), _within_limits, drops=True),
    Rule("limits of zero and one", "To clamp between zero and one is to saturate.",
         ("clamp",), (ANY, lanes(0), lanes(1)),
         lambda b, at: b.call("saturate", at.type, at.operands[0]), _is_whole_float),
    Rule("saturated already", "A value between zero and one is not changed by `saturate`.",
         ("saturate",), (ANY,), operand(0),
         lambda b, at: b.ranges.of(at.operands[0]).within(0.0, 1.0), drops=True),
    Rule("not negative", "A value that is not negative is its own magnitude.",
         ("abs",), (ANY,), operand(0),
         lambda b, at: b.ranges.of(at.operands[0]).lo >= 0, drops=True),
    Rule("of length one", "A vector of length one is normalized already.",
         ("normalize",), (ANY,), operand(0),
         lambda b, at: b.ranges.of(at.operands[0]).unit, drops=True),
    *_comparison("lt", "below"),
    *_comparison("ge", "at least"),
    *_comparison("le", "at most"),
    *_comparison("gt", "above"),
    *_equality("eq", True),
    *_equality("ne", False),
    Rule("not twice", "The opposite of the opposite is the bool itself.",
         ("not",), (builtin("not"),), inner),
    Rule("comparison negated", "The opposite of a comparison is the opposite comparison.",
         ("not",), (builtin(*OPPOSITES),), _opposite,
         lambda _b, at: at.operands[0].op == at.op),
)  # fmt: skip
