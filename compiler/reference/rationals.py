"""The array library of exact numbers: what a builtin means, without the rounding of float64.

A lane is a ``Rational``: a fraction, and how far the true number may be from it. Sums, products,
quotients and whole numbers are exact; roots have 512 binary places; only functions such as ``exp``
are those of Python, and off by some units in the last place of a float64. The corpus asks it for
results, so that these can be rounded to float32 once, and correctly. See ``namespace``.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable
from fractions import Fraction
from operator import add, mul, sub
from typing import Any

from . import scalars
from .scalars import logical_and, logical_not, logical_or, where

_PLACES = 512
"""The binary places of a root that is no fraction."""
_OF_FLOAT64 = Fraction(1, 2**53)
"""The error of a constant that float64 has rounded, relative to it."""
_OF_FUNCTION = Fraction(1, 2**50)
"""The error of Python's functions, relative to the result: four units in the last place."""
_LEAST = Fraction(1, 2**1074)
"""The step of the smallest float64 numbers."""

Number = Any
"""A ``Rational``, a plain number, or a float that is infinite or NaN."""


class Rational:
    """A number: a fraction, and the largest error that it may have."""

    __slots__ = ("error", "value")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, value: Fraction, error: Fraction = Fraction(0)) -> None:
        self.value, self.error = value, error

    @classmethod
    def of(cls, number: Number) -> Rational:
        """A finite number as a lane.

        A float that float32 does not have is a constant that stands for a longer number, such as
        ``math.pi``.
        """
        if isinstance(number, Rational):
            return number
        value = Fraction(number)
        is_longer = isinstance(number, float) and not _is_float32(number)
        return cls(value, abs(value) * _OF_FLOAT64 if is_longer else Fraction(0))

    def __float__(self) -> float:
        try:
            return float(self.value)
        except OverflowError:
            return math.inf if self.value > 0 else -math.inf

    def __bool__(self) -> bool:
        return self.value != 0

    def __add__(self, other: Number) -> Number:
        return _combined(add, self, other, lambda y: self.error + y.error)

    def __sub__(self, other: Number) -> Number:
        return _combined(sub, self, other, lambda y: self.error + y.error)

    def __mul__(self, other: Number) -> Number:
        return _combined(mul, self, other, lambda y: _error_of_product(self, y))

    def __truediv__(self, other: Number) -> Number:
        return divide(self, other)

    def __radd__(self, other: Number) -> Number:
        return self + other

    def __rsub__(self, other: Number) -> Number:
        return -self + other

    def __rmul__(self, other: Number) -> Number:
        return self * other

    def __rtruediv__(self, other: Number) -> Number:
        return divide(other, self)

    def __neg__(self) -> Rational:
        return Rational(-self.value, self.error)

    def __abs__(self) -> Rational:
        return Rational(abs(self.value), self.error)

    def __lt__(self, other: Number) -> bool:
        return bool(self.value < _value(other))

    def __le__(self, other: Number) -> bool:
        return bool(self.value <= _value(other))

    def __gt__(self, other: Number) -> bool:
        return bool(self.value > _value(other))

    def __ge__(self, other: Number) -> bool:
        return bool(self.value >= _value(other))

    def __eq__(self, other: object) -> bool:
        return bool(self.value == _value(other))


def _value(number: Number) -> Any:
    return number.value if isinstance(number, Rational) else number


def _is_float32(number: float) -> bool:
    try:
        return bool(struct.unpack("f", struct.pack("f", number))[0] == number)
    except OverflowError:
        return False


def _is_endless(number: Number) -> bool:
    """True for an infinite float, and for NaN."""
    return isinstance(number, float) and not math.isfinite(number)


def _combined(
    operation: Callable[[Any, Any], Any],
    x: Rational,
    other: Number,
    error: Callable[[Rational], Fraction],
) -> Number:
    """A sum or a product, with the error that it has from those of its operands."""
    if _is_endless(other):
        return operation(float(x), other)
    y = Rational.of(other)
    return Rational(operation(x.value, y.value), error(y))


def _error_of_product(x: Rational, y: Rational) -> Fraction:
    if not x.error and not y.error:
        return x.error
    return abs(x.value) * y.error + abs(y.value) * x.error + x.error * y.error


# --- the functions of the library -----------------------------------------------------------------


def float64(x: Number, /) -> Number:
    """The number as a lane of floats."""
    return x if _is_endless(x) else Rational.of(x)


def int64(x: Number, /) -> int:
    """The number truncated to an integer; 0 for infinity and NaN."""
    return 0 if _is_endless(x) else math.trunc(_value(x))


def minimum(x: Number, y: Number, /) -> Number:
    """The lesser number."""
    return y if y < x else x


def maximum(x: Number, y: Number, /) -> Number:
    """The greater number."""
    return y if y > x else x


def divide(x: Number, y: Number, /) -> Number:
    """The quotient; infinite or NaN where the divisor is zero."""
    if _is_endless(x) or _is_endless(y) or _value(y) == 0:
        return scalars.divide(float(x), float(y))
    x, y = Rational.of(x), Rational.of(y)
    value = x.value / y.value
    if not x.error and not y.error:
        return Rational(value)
    least = abs(y.value) - y.error
    return Rational(value, (x.error + abs(value) * y.error) / least) if least > 0 else math.nan


def remainder(x: Number, y: Number, /) -> Number:
    """The remainder of the quotient rounded down."""
    return Rational(Rational.of(x).value % Rational.of(y).value) if _value(y) != 0 else math.nan


def _whole(function: Callable[[Fraction], int]) -> Callable[[Number], Number]:
    """A rounding function that returns infinity and NaN unchanged."""
    return lambda x: x if _is_endless(x) else Rational(Fraction(function(Rational.of(x).value)))


def sqrt(x: Number, /) -> Number:
    """The square root of a number without an error."""
    if _is_endless(x) or x < 0:
        return scalars.sqrt(float(x))
    number = Rational.of(x)
    assert not number.error, "a root is only taken of what is known exactly"
    above, below = number.value.numerator, number.value.denominator
    roots = math.isqrt(above), math.isqrt(below)
    if roots[0] ** 2 == above and roots[1] ** 2 == below:
        return Rational(Fraction(*roots))
    places = _PLACES + max(below.bit_length() - above.bit_length(), 0)
    return Rational(
        Fraction(math.isqrt((above << 2 * places) // below), 1 << places), Fraction(1, 1 << places)
    )


def _approximate(function: Callable[..., float]) -> Callable[..., Number]:
    """One of Python's functions, of numbers without an error that a float64 has."""

    def approximate(*operands: Number) -> Number:
        assert not any(isinstance(x, Rational) and x.error for x in operands)
        found = function(*map(float, operands))
        if not math.isfinite(found):
            return found
        value = Fraction(found)
        return Rational(value, abs(value) * _OF_FUNCTION + _LEAST)

    return approximate


def frexp(x: Number, /) -> tuple[Number, int]:
    """The fraction, whose magnitude is at least a half and below one, and the exponent."""
    part, exponent = math.frexp(float(x))
    return Rational(Fraction(part)), exponent


def ldexp(x: Number, n: int, /) -> Number:
    """``x`` times two to the power of ``n``."""
    return x * Rational(Fraction(2) ** n)


floor = _whole(math.floor)
ceil = _whole(math.ceil)
rint = _whole(round)
trunc = _whole(math.trunc)
power = _approximate(scalars.power)
exp = _approximate(scalars.exp)
exp2 = _approximate(scalars.exp2)
log = _approximate(scalars.log)
log2 = _approximate(scalars.log2)
sin = _approximate(scalars.sin)
cos = _approximate(scalars.cos)
tan = _approximate(scalars.tan)
arcsin = _approximate(scalars.arcsin)
arccos = _approximate(scalars.arccos)
arctan = _approximate(scalars.arctan)
arctan2 = _approximate(scalars.arctan2)
sinh = _approximate(scalars.sinh)
cosh = _approximate(scalars.cosh)
tanh = _approximate(scalars.tanh)
arcsinh = _approximate(scalars.arcsinh)
arccosh = _approximate(scalars.arccosh)
arctanh = _approximate(scalars.arctanh)

__all__ = [
    "Rational", "arccos", "arccosh", "arcsin", "arcsinh", "arctan", "arctan2", "arctanh", "ceil",
    "cos", "cosh", "divide", "exp", "exp2", "float64", "floor", "frexp", "int64", "ldexp", "log",
    "log2", "logical_and", "logical_not", "logical_or", "maximum", "minimum", "power", "remainder",
    "rint", "sin", "sinh", "sqrt", "tan", "tanh", "trunc", "where",
]  # fmt: skip
