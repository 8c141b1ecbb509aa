"""Rows for trigonometric functions; angles are in radians."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from ...support.frozen import EMPTY
from .accuracy import (
    CORRECT,
    Accuracy,
    Bound,
    Error,
    Inherited,
    Platform,
    Promise,
    Within,
    in_section,
    in_table,
    inherited,
    promised,
    silent,
)
from .arithmetic import quotient_range
from .facts import Fact
from .intervals import around, inexact
from .row import Builtin, RangeRule
from .weakest import absolute, relative

_FLOATS = ("T -> T",)
_REDUCTION = 2.0**-22
"""The error that float32 makes when it reduces an angle to one turn, for each radian of it."""
_REDUCED = "the error of reducing the angle to one turn in float32 is added"
_LIKE_VULKAN = "the specification limits no error; that of Vulkan is assumed"
_ONE_TURN = Within(
    Error(absolute=2.0**-11),
    math.pi,
    beyond=Error(absolute=2.0**-11, absolute_by_operand=_REDUCTION),
)
_MANY_TURNS = Within(
    Error(absolute=0.0008),
    100 * math.pi,
    beyond=Error(absolute=0.0008, absolute_by_operand=_REDUCTION),
)
WAVE = promised(
    _ONE_TURN,
    {
        **in_section(_MANY_TURNS, "22.10.20 sincos", beyond_assumed=_REDUCED),
        **silent(_ONE_TURN, _LIKE_VULKAN, "opengl", "es"),
    },
    beyond_assumed=_REDUCED,
)


def _like_vulkan(bound: Bound, others: Mapping[Platform, Promise] = EMPTY) -> Accuracy:
    """The accuracy of functions of which only WGSL and Vulkan, or ``others``, say anything."""
    return promised(bound, {**silent(bound, _LIKE_VULKAN, "direct3d", "opengl", "es"), **others})


_POLYNOMIAL = "the specification limits no error; Mesa has a polynomial that is off by 2^-11.3"


def _of_arc(definition: str, wgsl: float) -> Accuracy:
    """The accuracy of the inverse of sine or cosine; WGSL allows an absolute error as well."""
    return _like_vulkan(
        Inherited(definition),
        {
            **in_table("wgsl", Inherited(definition, wgsl)),
            **silent(Inherited(definition, 2.0**-11), _POLYNOMIAL, "opengl", "es"),
        },
    )


_ARC = Within(Error(ulp=4096.0))
ARC = _like_vulkan(_ARC)
ARC_OF_POINT = _like_vulkan(
    _ARC,
    in_table(
        "wgsl", _ARC,
        beyond_assumed="WGSL limits no error where |x| is 0 or above 2^126; the same is assumed",
    ),
)  # fmt: skip
ARC_SINE = _of_arc("atan2(x, sqrt(1 - x * x))", 6.81e-5)
ARC_COSINE = _of_arc("atan2(sqrt(1 - x * x), x)", 6.77e-5)
TANGENT = _like_vulkan(Inherited("sin(x) / cos(x)"))

_WAVE_ERROR = absolute(WAVE)
"""The error of reducing an angle to one turn does not count: no angle has a sine beyond 1."""
_ARC_ERROR = relative(ARC)
_SCALED_ERROR = relative(CORRECT, CORRECT)
"""A constant factor is rounded, and so is the product."""


def _between(lo: float, hi: float, error: float = 0.0) -> RangeRule:
    """The range rule of an angle that is that of ``atan2``, or off by an absolute error."""
    fact = inexact(lo, hi, _ARC_ERROR).union(around(Fact(lo, hi), error))
    return lambda _facts, _same: fact


def _sine(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return _wave(facts[0], -math.pi / 2, math.pi / 2, math.sin)


def _cosine(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return _wave(facts[0], math.pi, 0.0, math.cos)


def _wave(x: Fact, lowest: float, highest: float, wave: Callable[[float], float]) -> Fact:
    """Bounds of a wave with these extremes; its accuracy is promised only within -pi to pi."""
    lo, hi = -1.0, 1.0
    if x.within(-math.pi, math.pi):
        ends = wave(x.lo), wave(x.hi)
        lo = -1.0 if x.lo <= lowest <= x.hi else min(ends)
        hi = 1.0 if x.lo <= highest <= x.hi else max(ends)
    return Fact(lo - _WAVE_ERROR, hi + _WAVE_ERROR)


def _tangent(facts: tuple[Fact, ...], _same: bool) -> Fact:
    sine, cosine = _sine(facts, False), _cosine(facts, False)
    return quotient_range((sine, cosine), False) if cosine.lo > 0 else Fact()


def _scaled(factor: float) -> RangeRule:
    return lambda facts, _same: inexact(facts[0].lo * factor, facts[0].hi * factor, _SCALED_ERROR)


def _has_arc(facts: tuple[Fact, ...]) -> bool:
    return facts[0].within(-1.0, 1.0)


def _has_direction(facts: tuple[Fact, ...]) -> bool:
    return facts[0].excludes_zero


ROWS = (
    Builtin(
        name="sin",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Sine. Its accuracy is promised only within -pi to pi.",
        range=_sine,
        accuracy=WAVE,
        cost=4,
    ),
    Builtin(
        name="cos",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Cosine. Its accuracy is promised only within -pi to pi.",
        range=_cosine,
        accuracy=WAVE,
        cost=4,
    ),
    Builtin(
        name="tan",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Tangent, sin(x) / cos(x). Near its poles the result may be too large for float32.",
        range=_tangent,
        accuracy=TANGENT,
        cost=9,
    ),
    Builtin(
        name="asin",
        signatures=_FLOATS,
        meaning="angle",
        doc="The angle between -pi/2 and pi/2 that has this sine.",
        domain=_has_arc,
        needs="the operand lies within -1..1",
        outside="The operand is clamped to -1 to 1.",
        expansion="asin",
        range=_between(-math.pi / 2, math.pi / 2, absolute(ARC_SINE)),
        accuracy=ARC_SINE,
        cost=12,
        samples=((1.0,), (-1.0,), (1.0000001,), (-2.0,)),
    ),
    Builtin(
        name="acos",
        signatures=_FLOATS,
        meaning="angle",
        doc="The angle between 0 and pi that has this cosine.",
        domain=_has_arc,
        needs="the operand lies within -1..1",
        outside="The operand is clamped to -1 to 1.",
        expansion="acos",
        range=_between(0.0, math.pi, absolute(ARC_COSINE)),
        accuracy=ARC_COSINE,
        cost=12,
        samples=((1.0,), (-1.0,), (1.0000001,), (-2.0,)),
    ),
    Builtin(
        name="atan",
        signatures=_FLOATS,
        meaning="angle",
        doc="The angle between -pi/2 and pi/2 that has this tangent.",
        range=_between(-math.pi / 2, math.pi / 2),
        accuracy=ARC,
        cost=10,
    ),
    Builtin(
        name="atan2",
        signatures=("T, T -> T",),
        meaning="angle",
        doc="atan2(y, x): the angle between -pi and pi from the x axis to the point (x, y).",
        domain=_has_direction,
        needs="the first operand is not 0",
        outside=(
            "atan2(0, x) is 0, or pi for a negative x. A y of -0.0 or of a magnitude below 2^-126 "
            "counts as 0."
        ),
        expansion="atan2",
        range=_between(-math.pi, math.pi),
        accuracy=ARC_OF_POINT,
        cost=14,
        samples=((0.0, 0.0), (0.0, -1.0), (-0.0, -1.0), (1.0, 0.0), (-1.0, -1.0)),
    ),
    Builtin(
        name="radians",
        signatures=_FLOATS,
        meaning="angle",
        doc="Degrees to radians.",
        range=_scaled(math.pi / 180.0),
        accuracy=inherited("x * 0.01745329"),
    ),
    Builtin(
        name="degrees",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Radians to degrees.",
        range=_scaled(180.0 / math.pi),
        accuracy=inherited("x * 57.29578"),
    ),
)
