"""Elementary functions to a hundred decimal places, by their series, from numbers as fractions.

Python's ``decimal`` computes roots, exponentials and logarithms, and the rest follows from these
and from two series. Nothing here shares a formula or a library with the reference.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from decimal import Context, Decimal, localcontext
from fractions import Fraction
from functools import cache, wraps

_DIGITS = 160
"""Enough for angles of up to 39 digits before the point, and for small differences behind it."""
_LEAST = Decimal(10) ** -150
_FAR = Decimal(10_000)
"""The largest exponent of e of which anything is computed: float64 ends long before it."""

Function = Callable[..., Fraction | float]


def _precise(function: Callable[..., Decimal]) -> Function:
    """A function of decimals as one of fractions; infinite beyond what float64 holds."""

    @wraps(function)
    def of_fractions(*operands: Fraction) -> Fraction | float:
        with localcontext(Context(prec=_DIGITS)):
            found = function(*map(_decimal, operands))
            return Fraction(found) if found.is_finite() else math.copysign(math.inf, found)

    return of_fractions


def _decimal(number: Fraction) -> Decimal:
    return Decimal(number.numerator) / Decimal(number.denominator)


@cache
def _pi() -> Decimal:
    """By Machin's formula."""
    return 16 * _arctan_series(Decimal(1) / 5) - 4 * _arctan_series(Decimal(1) / 239)


def _arctan_series(x: Decimal) -> Decimal:
    total = term = x
    n = 1
    while abs(term) > _LEAST * abs(x):
        term *= -x * x
        n += 2
        total += term / n
    return total


def _sine_series(x: Decimal) -> Decimal:
    total = term = x
    n = 1
    while abs(term) > _LEAST * abs(x):
        term *= -x * x / ((n + 1) * (n + 2))
        n += 2
        total += term
    return total


def _sin(x: Decimal) -> Decimal:
    """The sine of what is left of an angle behind whole half turns."""
    halves = (x / _pi()).to_integral_value()
    rest = _sine_series(x - halves * _pi())
    return -rest if int(halves) % 2 else rest


def _cos(x: Decimal) -> Decimal:
    return _sin(x + _pi() / 2)


def _exp(x: Decimal) -> Decimal:
    if x > _FAR:
        return Decimal("Infinity")
    return Decimal(0) if x < -_FAR else x.exp()


def _atan(x: Decimal) -> Decimal:
    """Twice the arc of ``x / (1 + sqrt(1 + x * x))``, until that is small."""
    halvings = 0
    while abs(x) > Decimal("0.05"):
        x /= 1 + (1 + x * x).sqrt()
        halvings += 1
    return _arctan_series(x) * Decimal(2) ** halvings


def _atan2(y: Decimal, x: Decimal) -> Decimal:
    if x > 0:
        return _atan(y / x)
    quarter = _pi() / 2 if y > 0 else -_pi() / 2
    return quarter - _atan(x / y)


def _asin(x: Decimal) -> Decimal:
    return _atan2(x, (1 - x * x).sqrt())


def _acos(x: Decimal) -> Decimal:
    root = (1 - x * x).sqrt()
    return _atan2(root, x) if root else (_pi() if x < 0 else Decimal(0))


def _sinh(x: Decimal) -> Decimal:
    if abs(x) > 1:
        return (_exp(x) - _exp(-x)) / 2
    total = term = x
    n = 1
    while abs(term) > _LEAST * abs(x):
        term *= x * x / ((n + 1) * (n + 2))
        n += 2
        total += term
    return total


def _tanh(x: Decimal) -> Decimal:
    if abs(x) > 1000:
        return Decimal(1).copy_sign(x)
    return _sinh(x) / ((_exp(x) + _exp(-x)) / 2)


def _asinh(x: Decimal) -> Decimal:
    return (abs(x) + (x * x + 1).sqrt()).ln().copy_sign(x)


pi = _precise(_pi)
sqrt = _precise(lambda x: x.sqrt())
exp = _precise(_exp)
ln = _precise(lambda x: x.ln())
log10 = _precise(lambda x: x.log10())
log2 = _precise(lambda x: x.ln() / Decimal(2).ln())
power = _precise(lambda x, y: _exp(y * x.ln()))
sin = _precise(_sin)
cos = _precise(_cos)
tan = _precise(lambda x: _sin(x) / _cos(x))
asin = _precise(_asin)
acos = _precise(_acos)
atan = _precise(_atan)
atan2 = _precise(_atan2)
sinh = _precise(_sinh)
cosh = _precise(lambda x: (_exp(x) + _exp(-x)) / 2)
tanh = _precise(_tanh)
asinh = _precise(_asinh)
acosh = _precise(lambda x: (x + (x * x - 1).sqrt()).ln())
atanh = _precise(lambda x: ((1 + x) / (1 - x)).ln() / 2)
