"""Comparisons, logic and choices, lane by lane."""

from __future__ import annotations

from collections.abc import Callable

from .facts import Fact
from .row import EXACT, Builtin, nowhere

_ORDERED = ("N, N -> Q",)
_LOGIC = ("B, B -> B",)
_LANES = ("bvec2 -> bool", "bvec3 -> bool", "bvec4 -> bool")
_EITHER = Fact(0.0, 1.0, kind="bool")
_NO = Fact(0.0, 0.0, kind="bool")
_YES = Fact(1.0, 1.0, kind="bool")


def _opposite(fact: Fact) -> Fact:
    return Fact(1.0 - fact.hi, 1.0 - fact.lo, kind="bool")


def _less(facts: tuple[Fact, ...], same: bool) -> Fact:
    x, y = facts
    if x.hi < y.lo:
        return _YES
    return _NO if same or x.lo >= y.hi else _EITHER


def _greater(facts: tuple[Fact, ...], same: bool) -> Fact:
    return _less(facts[::-1], same)


def _not_less(facts: tuple[Fact, ...], same: bool) -> Fact:
    return _opposite(_less(facts, same))


def _not_greater(facts: tuple[Fact, ...], same: bool) -> Fact:
    return _opposite(_greater(facts, same))


def _equal(facts: tuple[Fact, ...], same: bool) -> Fact:
    x, y = facts
    if same or x.lo == x.hi == y.lo == y.hi:
        return _YES
    apart = x.hi < y.lo or y.hi < x.lo or (x.nonzero and y.most == 0) or (y.nonzero and x.most == 0)
    return _NO if apart else _EITHER


def _unequal(facts: tuple[Fact, ...], same: bool) -> Fact:
    return _opposite(_equal(facts, same))


def _both(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts
    return Fact(min(x.lo, y.lo), min(x.hi, y.hi), kind="bool")


def _one(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts
    return Fact(max(x.lo, y.lo), max(x.hi, y.hi), kind="bool")


def _negation(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return _opposite(facts[0])


def _lanes(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return facts[0]


def _either(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts[1:]
    return Fact(min(x.lo, y.lo), max(x.hi, y.hi), x.excludes_zero and y.excludes_zero, kind=x.kind)


def _comparison(
    name: str,
    operator: str,
    doc: str,
    rule: Callable[[tuple[Fact, ...], bool], Fact],
    signatures: tuple[str, ...] = _ORDERED,
) -> Builtin:
    """Comparisons differ in nothing but their sign, doc line and rule."""
    return Builtin(
        name=name,
        signatures=signatures,
        doc=doc,
        operator=operator,
        range=rule,
        accuracy=EXACT,
        samples=((0.0, -0.0), (1.0, 1.0), (1.0, 2.0), (2.0, 1.0)),
    )


ROWS = (
    _comparison("eq", "==", "Whether two values are equal, lane by lane.", _equal, ("P, P -> Q",)),
    _comparison("ne", "!=", "Whether two values differ, lane by lane.", _unequal, ("P, P -> Q",)),
    _comparison("lt", "<", "Whether the first value is less.", _less),
    _comparison("le", "<=", "Whether the first value is less or equal.", _not_greater),
    _comparison("gt", ">", "Whether the first value is greater.", _greater),
    _comparison("ge", ">=", "Whether the first value is greater or equal.", _not_less),
    Builtin(
        name="and",
        signatures=_LOGIC,
        doc="Whether both hold.",
        operator="&&",
        range=_both,
        accuracy=EXACT,
    ),
    Builtin(
        name="or",
        signatures=_LOGIC,
        doc="Whether at least one holds.",
        operator="||",
        range=_one,
        accuracy=EXACT,
    ),
    Builtin(
        name="not",
        signatures=("B -> B",),
        doc="Whether it does not hold.",
        operator="!",
        range=_negation,
        accuracy=EXACT,
    ),
    Builtin(
        name="any",
        signatures=_LANES,
        doc="Whether at least one lane holds.",
        range=_lanes,
        accuracy=EXACT,
    ),
    Builtin(
        name="all",
        signatures=_LANES,
        doc="Whether every lane holds.",
        range=_lanes,
        accuracy=EXACT,
    ),
    Builtin(
        name="choose",
        signatures=("Q, P, P -> P",),
        doc="choose(c, x, y): x where the condition holds, else y, lane by lane.",
        domain=nowhere,
        outside="Both are computed: it is no branch. For one condition, write `if`.",
        expansion="choose",
        range=_either,
        accuracy=EXACT,
    ),
)
