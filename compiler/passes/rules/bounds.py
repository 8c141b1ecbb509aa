"""Simplification rules that depend on ranges: limits, comparisons, known signs and lengths."""

from __future__ import annotations

from ...ir.node import Node
from ...ir.refinements import OPPOSITES
from ...ir.types import Type
from .builder import Builder
from .conditions import gives_float, is_whole
from .rule import Rule
from .terms import computed, condition, either, function, proven
from .vocabulary import abs_, clamp, max_, min_, normalize, not_, saturate, x, y, z


@condition("{} is of length one")
def _is_unit(builder: Builder, _type: Type, value: Node) -> bool:
    return builder.ranges.of(value).unit


@computed
def _opposite(builder: Builder, type_: Type, comparison: str, left: Node, right: Node) -> Node:
    return builder.call(OPPOSITES[comparison], type_, left, right)


def _comparison(name: str, words: str) -> tuple[Rule, Rule]:
    compared = function(name)
    return (
        Rule(f"{name} holds", compared(x, y), True,
             f"Ranges show that the left value is always {words} the right one.",
             where=proven(name, x, y), drops=True),
        Rule(f"{name} fails", compared(x, y), False,
             f"Ranges show that the left value is never {words} the right one.",
             where=proven(OPPOSITES[name], x, y), drops=True),
    )  # fmt: skip


def _equality(name: str, equal: bool) -> tuple[Rule, ...]:
    """``==`` (``equal``) and ``!=``."""
    compared = function(name)
    return (
        Rule(f"{name} a bool", either(compared(equal, x)), x,
             "A bool compared with true or false is the bool itself.",
             where=is_whole(x), drops=True),
        Rule(f"{name} the other bool", either(compared(not equal, x)), not_(x),
             "A bool compared with true or false is its opposite.",
             where=is_whole(x), drops=True),
        Rule(f"{name} itself", compared(x, x), equal, "A value equals itself.", drops=True),
        Rule(f"{name} apart", compared(x, y), not equal,
             "Ranges without a common value show that two values differ.",
             where=proven("ne", x, y), drops=True),
    )  # fmt: skip


_COMPARISON = function(*OPPOSITES)

BOUNDS = (
    Rule("least is left", min_(x, y), x,
         "Ranges show which value is the least.", where=x <= y, drops=True),
    Rule("least is right", min_(x, y), y,
         "Ranges show which value is the least.", where=x >= y, drops=True),
    Rule("greatest is left", max_(x, y), x,
         "Ranges show which value is the greatest.", where=x >= y, drops=True),
    Rule("greatest is right", max_(x, y), y,
         "Ranges show which value is the greatest.", where=x <= y, drops=True),
    Rule("within limits", clamp(x, y, z), x,
         "A value that stays between the limits is not changed by `clamp`.",
         where=(y <= x, x <= z), drops=True),
    Rule("limits of zero and one", clamp(x, 0, 1), saturate(x),
         "To clamp between zero and one is to saturate.", where=(gives_float(), is_whole(x))),
    Rule("saturated already", saturate(x), x,
         "A value between zero and one is not changed by `saturate`.",
         where=(x >= 0, x <= 1), drops=True),
    Rule("not negative", abs_(x), x,
         "A value that is not negative is its own magnitude.", where=x >= 0, drops=True),
    Rule("of length one", normalize(x), x,
         "A vector of length one is normalized already.", where=_is_unit(x), drops=True),
    *_comparison("lt", "below"),
    *_comparison("ge", "at least"),
    *_comparison("le", "at most"),
    *_comparison("gt", "above"),
    *_equality("eq", True),
    *_equality("ne", False),
    Rule("not twice", not_(not_(x)), x, "The opposite of the opposite is the bool itself."),
    Rule("comparison negated", not_(_COMPARISON(x, y)), _opposite(_COMPARISON, x, y),
         "The opposite of a comparison is the opposite comparison."),
)  # fmt: skip
