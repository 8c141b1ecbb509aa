"""Rows for rounding, limits and blending: functions that are cheap on every device."""

from __future__ import annotations

import math
from collections.abc import Callable

from .accuracy import COMMON, CORRECT, Inherited, Rounded, in_table, inherited, promised, silent
from .arithmetic import SIGNED
from .facts import Fact
from .intervals import around, inexact, monotone, product, products, rounded
from .row import Builtin, RangeRule
from .weakest import ROUNDING, relative

_FLOATS = ("T -> T",)
_THREE_ROUNDINGS = relative(CORRECT, CORRECT, CORRECT)
_PAIRS = ("N, N -> N", "N, L -> N")


def _absolute(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    return Fact(x.least, x.most, x.nonzero, x.unit, x.length).as_kind(x.kind)


def _sign(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    return Fact(_sign_of(x.lo), _sign_of(x.hi), x.excludes_zero, kind=x.kind)


def _sign_of(bound: float) -> float:
    return float((bound > 0) - (bound < 0))


def _rounding(function: Callable[[float], int]) -> RangeRule:
    """The range rule of a monotonic function whose results are whole numbers."""

    def whole(bound: float) -> float:
        return bound if math.isinf(bound) else float(function(bound))

    return lambda facts, _same: monotone(whole, facts[0])


def _fraction(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    return Fact(0.0, 1.0)  # 1 itself, once x - floor(x) is rounded


def _lesser(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts
    return Fact(min(x.lo, y.lo), min(x.hi, y.hi), x.nonzero and y.nonzero, kind=x.kind)


def _greater(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts
    return Fact(max(x.lo, y.lo), max(x.hi, y.hi), x.nonzero and y.nonzero, kind=x.kind)


def _clamped(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, low, high = facts
    return _lesser((_greater((x, low), False), high), False)


def _saturated(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    return Fact(min(max(x.lo, 0.0), 1.0), min(max(x.hi, 0.0), 1.0))


def _blended(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y, a = facts
    rest = rounded(1.0 - a.hi, 1.0 - a.lo)
    if not a.within(0.0, 1.0):
        (x_lo, x_hi), (y_lo, y_hi) = products(x, rest), products(y, a)
        exact = rounded(x_lo + y_lo, x_hi + y_hi)
    else:
        exact = x.union(y)
    # Backends write this in two ways, whose rounding errors grow with the larger operand: each of
    # both is rounded three times at most. Neither turns a blend of non-negative values negative.
    slack = around(exact, (x.most + y.most) * (1.0 + a.most) * _THREE_ROUNDINGS)
    if a.within(0.0, 1.0) and min(x.lo, y.lo) >= 0:
        return Fact(max(slack.lo, 0.0), slack.hi)
    return Fact(slack.lo, slack.hi)


def _multiplied_and_added(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y, z = facts
    lo, hi = products(x, y)
    return around(rounded(lo + z.lo, hi + z.hi), product(product(x.most, y.most), 2.0 * ROUNDING))


def _stepped(facts: tuple[Fact, ...], _same: bool) -> Fact:
    edge, x = facts
    if x.hi < edge.lo:
        return Fact(0.0, 0.0)
    return Fact(1.0, 1.0) if x.lo >= edge.hi else Fact(0.0, 1.0)


def _ramped(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    # t * t * (3 - 2 * t), of which 2 * t is exact.
    return inexact(0.0, 1.0, _THREE_ROUNDINGS)


def _ordered(facts: tuple[Fact, ...]) -> bool:
    _x, low, high = facts
    return low.hi <= high.lo


NARROWEST = 2.0**-64
"""The least distance of the edges of a smooth step, as ``meaning.burnish`` has it."""


def _apart(facts: tuple[Fact, ...]) -> bool:
    low, high, _x = facts
    return high.lo - low.hi >= NARROWEST


BLEND = promised(
    Inherited("x * (1 - z) + y * z"),
    silent(Inherited("x + (y - x) * z"), "the reference of HLSL defines `lerp` so", "direct3d"),
)
FRACTION = promised(Inherited("x - floor(x)"), in_table("vulkan", Rounded()))

ROWS = (
    Builtin(
        name="abs",
        signatures=SIGNED,
        meaning="limits",
        doc="Absolute value. The lowest integer stays as it is, because its negative does not fit.",
        definition="magnitude",
        range=_absolute,
        accuracy=COMMON,
    ),
    Builtin(
        name="sign",
        signatures=SIGNED,
        meaning="numbers",
        doc="-1, 0 or 1, in the operand's own type; 0 for 0.0 and for -0.0.",
        definition="direction",
        range=_sign,
        accuracy=COMMON,
        cost=2,
        samples=((0.0,), (-0.0,), (-2.0,), (3.0,)),
    ),
    Builtin(
        name="floor",
        signatures=_FLOATS,
        doc="The greatest whole number that is not above the operand.",
        range=_rounding(math.floor),
        accuracy=COMMON,
    ),
    Builtin(
        name="ceil",
        signatures=_FLOATS,
        doc="The least whole number that is not below the operand.",
        range=_rounding(math.ceil),
        accuracy=COMMON,
    ),
    Builtin(
        name="round",
        signatures=_FLOATS,
        doc="The nearest whole number; a half is rounded to the even neighbour.",
        definition="to_nearest",
        range=_rounding(round),
        accuracy=COMMON,
        samples=((0.5,), (1.5,), (2.5,), (-0.5,), (-1.5,)),
    ),
    Builtin(
        name="trunc",
        signatures=_FLOATS,
        doc="The operand without its fraction, so rounded towards zero.",
        definition="towards_zero",
        range=_rounding(math.trunc),
        accuracy=COMMON,
    ),
    Builtin(
        name="fract",
        signatures=_FLOATS,
        doc="The part above the floor: x - floor(x).",
        range=_fraction,
        accuracy=FRACTION,
        samples=((-0.25,), (1.75,)),
    ),
    Builtin(
        name="min",
        signatures=_PAIRS,
        meaning="limits",
        doc="The lesser of two values.",
        definition="lesser",
        range=_lesser,
        accuracy=COMMON,
    ),
    Builtin(
        name="max",
        signatures=_PAIRS,
        meaning="limits",
        doc="The greater of two values.",
        definition="greater",
        range=_greater,
        accuracy=COMMON,
    ),
    Builtin(
        name="clamp",
        signatures=("N, N, N -> N", "N, L, L -> N"),
        meaning="limits",
        doc="The first value, limited to the range from the second to the third.",
        domain=_ordered,
        needs="the lower limit is at most the upper one",
        outside="Limits in the wrong order give the upper limit: min(max(x, low), high).",
        expansion="clamp",
        definition="clamp",
        range=_clamped,
        accuracy=COMMON,
        cost=2,
        samples=((0.5, 1.0, 0.0), (-1.0, 0.0, 1.0), (2.0, 0.0, 1.0)),
    ),
    Builtin(
        name="saturate",
        signatures=_FLOATS,
        doc="The value, limited to the range from 0 to 1.",
        range=_saturated,
        accuracy=COMMON,
    ),
    Builtin(
        name="mix",
        signatures=("T, T, T -> T", "T, T, S -> T"),
        meaning="blend",
        doc="Blend: x * (1 - a) + y * a. Extrapolates for an a outside of 0 to 1.",
        range=_blended,
        accuracy=BLEND,
        cost=2,
    ),
    Builtin(
        name="fma",
        signatures=("T, T, T -> T",),
        doc="fma(x, y, z): x * y + z. The device chooses whether it rounds once or twice.",
        range=_multiplied_and_added,
        accuracy=inherited("x * y + z"),
        cost=1,
    ),
    Builtin(
        name="step",
        signatures=("T, T -> T", "S, T -> T"),
        meaning="numbers",
        doc="1 if the second value is at least the first, the edge; otherwise 0.",
        range=_stepped,
        accuracy=COMMON,
        cost=2,
        samples=((0.5, 0.5), (0.0, -0.0)),
    ),
    Builtin(
        name="smoothstep",
        signatures=("T, T, T -> T", "S, S, T -> T"),
        meaning="numbers",
        doc="A smooth rise from 0 at the first edge to 1 at the second.",
        domain=_apart,
        needs="the first edge lies below the second",
        outside=(
            "Edges in the wrong order mirror the curve. Edges closer than 2^-64 count as 2^-64 "
            "apart, the second above the first: with equal edges it is 0 up to the edge and 1 "
            "behind it."
        ),
        expansion="smoothstep",
        range=_ramped,
        accuracy=inherited("t * t * (3 - 2 * t)"),
        cost=7,
        samples=((0.0, 1.0, 0.5), (0.5, 0.5, 0.5), (0.5, 0.5, 0.25), (1.0, 0.0, 0.25)),
    ),
)
