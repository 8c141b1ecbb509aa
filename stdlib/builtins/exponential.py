"""Rows for powers, roots and logarithms."""

from __future__ import annotations

import math
from collections.abc import Callable

from .accuracy import CORRECT, Error, Inherited, Within, in_section, inherited, promised, silent
from .arithmetic import QUOTIENT
from .facts import SMALLEST_NORMAL, Fact
from .intervals import around, inexact, products, rounded
from .row import Builtin, nowhere
from .weakest import absolute, relative

_FLOATS = ("T -> T",)
_EXP = Within(Error(ulp=3.0, ulp_by_operand=2.0))
_D3D_EXP = in_section(Within(Error(relative=2.0**-21)), "22.10.6 exp")
EXP = promised(
    _EXP, silent(Inherited("exp2(x * 1.442695)"), "HLSL's compiler writes it so", "direct3d")
)
EXP2 = promised(_EXP, _D3D_EXP)

_NEAR_ONE = 2.0**-21
"""The absolute error of logarithms of 0.5 to 2."""
_LOG = Within(Error(absolute=_NEAR_ONE), math.log(2.0), "result", Error(ulp=3.0))
_LOG2 = Within(Error(absolute=_NEAR_ONE), 1.0, "result", Error(ulp=3.0))
_D3D_LOG2 = Within(Error(absolute=_NEAR_ONE), 1.0, "result", Error(relative=2.0**-21))
LOG = promised(
    _LOG, silent(Inherited("log2(x) * 0.6931472"), "HLSL's compiler writes it so", "direct3d")
)
LOG2 = promised(_LOG2, in_section(_D3D_LOG2, "22.10.8 log"))

ROOT = promised(
    Inherited("1 / inversesqrt(x)"),
    in_section(Within(Error(ulp=1.0)), "22.10.21 sqrt"),
)
INVERSE_ROOT = promised(
    Within(Error(ulp=2.0)),
    in_section(Within(Error(relative=2.0**-21)), "22.10.19 rsq"),
)

_INVERSE_ROOT_ERROR = relative(INVERSE_ROOT)
ROOT_ERROR = (1.0 + relative(QUOTIENT)) / (1.0 - _INVERSE_ROOT_ERROR) - 1.0
"""The largest error of a root, as a part of it: it is ``1 / inversesqrt(x)`` on most platforms."""
_LOG_ERROR = max(relative(LOG), relative(LOG2, CORRECT, CORRECT))
"""The factor of ``log2(x) * ln(2)`` is rounded, and so is the product."""
_LOG2_ERROR = relative(LOG2)

_BEYOND = 1000.0
"""An exponent far outside of float32, but small enough for Python's floats."""


def _root(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    return inexact(math.sqrt(max(x.lo, 0.0)), math.sqrt(max(x.hi, 0.0)), ROOT_ERROR)


def _inverse_root(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    lo, hi = (1.0 / math.sqrt(max(bound, SMALLEST_NORMAL)) for bound in (x.hi, x.lo))
    return inexact(lo, hi, _INVERSE_ROOT_ERROR)


def _exponential(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return _power_of_two(facts[0], math.log2(math.e), exponential_error)


def _exponential2(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return _power_of_two(facts[0], 1.0, _exponential2_error)


def exponential_error(operand: float) -> float:
    """The largest error of ``exp`` of operands up to a magnitude, as a part of the result.

    Direct3D computes ``exp2(x * log2(e))``, of which the factor and the product are rounded.
    """
    exponent = operand * math.log2(math.e)
    moved = math.expm1(operand * relative(CORRECT, CORRECT))
    of_power = (1.0 + relative(EXP2, operand=exponent)) * (1.0 + moved) - 1.0
    return max(relative(EXP, operand=operand), of_power)


def _exponential2_error(operand: float) -> float:
    return relative(EXP2, operand=operand)


def _power_of_two(x: Fact, scale: float, error: Callable[[float], float]) -> Fact:
    """Bounds of ``2 ** (scale * x)``, whose error grows with the magnitude of the operand."""
    least, most = scale * x.lo, scale * x.hi
    lo = 2.0 ** min(max(least, -_BEYOND), _BEYOND)
    hi = math.inf if most > _BEYOND else 2.0 ** max(most, -_BEYOND)
    errors = (error(min(abs(end), _BEYOND)) for end in (x.lo, x.hi))
    found = inexact(lo, hi, *errors)
    return Fact(max(found.lo, 0.0), found.hi)


def _logarithm(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return _log2(facts[0], math.log(2.0), _LOG_ERROR)


def _logarithm2(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return _log2(facts[0], 1.0, _LOG2_ERROR)


def _log2(x: Fact, scale: float, error: float) -> Fact:
    """Bounds of ``scale * log2(x)``; near 1 the error is absolute."""
    lo, hi = (
        bound if math.isinf(bound) else scale * math.log2(max(bound, SMALLEST_NORMAL))
        for bound in (max(x.lo, 0.0), x.hi)
    )
    return around(inexact(min(lo, hi), hi, error), max(absolute(LOG), absolute(LOG2)))


def _power(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts
    # A power is exp2(y * log2(x)); the logarithm of 1 may be above 0.
    if x.lo < SMALLEST_NORMAL or not math.isfinite(x.hi * y.most):
        above = Fact(0.0, absolute(LOG2))
        falls = x.hi <= 1 and y.lo >= 0
        return Fact(0.0, max(1.0, _raised(y, above).hi) if falls else math.inf)
    return _raised(y, _logarithm2((x,), False))


def _raised(y: Fact, logs: Fact) -> Fact:
    """Bounds of two to the power of a product."""
    return _exponential2((rounded(*products(logs, y)),), False)


def _not_negative(facts: tuple[Fact, ...]) -> bool:
    return facts[0].lo >= 0


def _normal(facts: tuple[Fact, ...]) -> bool:
    return facts[0].positive


def _has_power(facts: tuple[Fact, ...]) -> bool:
    x, y = facts
    return x.positive or (x.lo >= 0 and y.positive)


ROWS = (
    Builtin(
        name="sqrt",
        signatures=_FLOATS,
        doc="Square root.",
        domain=_not_negative,
        needs="the operand is 0 or more",
        outside="0 for a negative operand.",
        expansion="sqrt",
        range=_root,
        accuracy=ROOT,
        cost=4,
        samples=((0.0,), (-1.0,), (-0.0,), (2.0,)),
    ),
    Builtin(
        name="inversesqrt",
        signatures=_FLOATS,
        doc="One over the square root.",
        domain=_normal,
        needs="the operand is above 0",
        outside="Operands below the smallest normal number, 2^-126, count as this number: 2^63.",
        expansion="inversesqrt",
        range=_inverse_root,
        accuracy=INVERSE_ROOT,
        cost=4,
        samples=((0.0,), (-1.0,), (1e-40,), (4.0,)),
    ),
    Builtin(
        name="pow",
        signatures=("T, T -> T", "T, S -> T"),
        doc="The first value to the power of the second.",
        domain=_has_power,
        needs="the base is above 0, or it is 0 or more and the exponent above 0",
        outside=(
            "A negative base counts as 0. 0 to the power of 0 is 1, to any other power 0; "
            "magnitudes below 2^-126 count as 0."
        ),
        expansion="pow",
        range=_power,
        accuracy=inherited("exp2(y * log2(x))"),
        cost=9,
        samples=((0.0, 0.0), (0.0, -1.0), (-2.0, 2.0), (0.0, 3.0), (2.0, -1.5), (0.5, 64.0)),
    ),
    Builtin(
        name="exp",
        signatures=_FLOATS,
        doc="e to the power of the operand. Above 88 the result is too large for float32.",
        range=_exponential,
        accuracy=EXP,
        cost=5,
    ),
    Builtin(
        name="exp2",
        signatures=_FLOATS,
        doc="2 to the power of the operand. From 128 on the result is too large for float32.",
        range=_exponential2,
        accuracy=EXP2,
        cost=4,
    ),
    Builtin(
        name="log",
        signatures=_FLOATS,
        doc="Natural logarithm.",
        domain=_normal,
        needs="the operand is above 0",
        outside="Operands below the smallest normal number, 2^-126, count as this number.",
        expansion="log",
        range=_logarithm,
        accuracy=LOG,
        cost=5,
        samples=((0.0,), (-1.0,), (1.0,), (1e-40,)),
    ),
    Builtin(
        name="log10",
        signatures=_FLOATS,
        doc="Logarithm to base 10.",
        domain=nowhere,
        outside="Operands below the smallest normal number, 2^-126, count as this number.",
        expansion="log10",
        cost=5,
        samples=((0.0,), (-1.0,), (1.0,), (1000.0,)),
    ),
    Builtin(
        name="log2",
        signatures=_FLOATS,
        doc="Logarithm to base 2.",
        domain=_normal,
        needs="the operand is above 0",
        outside="Operands below the smallest normal number, 2^-126, count as this number: -126.",
        expansion="log2",
        range=_logarithm2,
        accuracy=LOG2,
        cost=4,
        samples=((0.0,), (-1.0,), (1.0,), (1e-40,)),
    ),
)
