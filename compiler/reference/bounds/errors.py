"""The possible errors of functions on a platform: the accuracy of the rows, as numbers.

``Bounds`` widens the result of each function by the number that ``Errors`` returns. The error of a
function whose accuracy is inherited follows here from the functions that define it. Each formula is
an upper limit for all operands and results up to the given magnitudes, not only at these.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....stdlib.builtins import BUILTINS
from ....stdlib.builtins.accuracy import Bound, Error, Exact, Platform, Rounded, Within
from ....stdlib.builtins.facts import LARGEST_FLOAT, ULP
from ....support.frozen import cached_property

Floats = NDArray[np.float64]

_EXPONENT = np.int64(0x7FF0000000000000)
"""The bits of a float64's exponent."""
_LEAST = 2.0**-149
_ROUNDED = Error(ulp=1.0)


@dataclass(frozen=True)
class Errors:
    """The largest errors on several platforms, of which the weakest promise counts.

    A text for Direct3D that is drawn with Vulkan, for instance, has to allow what either does.
    """

    platforms: tuple[Platform, ...]
    measured: tuple[tuple[str, Bound], ...] = ()
    """Builtins of which a driver was found to be more accurate than its platforms promise."""

    def __call__(self, name: str, operand: Floats, result: Floats) -> Floats:
        """The largest absolute error of the builtin ``name``, for magnitudes up to these.

        The operand of a quotient is the divisor; that of ``atan2`` does not matter. What may be
        flushed to zero is left to the caller.
        """
        operand, result = np.asarray(operand, np.float64), np.asarray(result, np.float64)
        with np.errstate(all="ignore"):
            found = [each.error(name, operand, result) for each in self._distinct(name)]
            worst = found[0]
            for other in found[1:]:
                worst = np.maximum(worst, other)
        return np.where(np.isnan(worst), np.inf, worst)

    def rounds(self, name: str) -> bool:
        """True if a builtin is correctly rounded, so that a result that float32 has is exact."""
        return all(isinstance(each.bound(name), Rounded) for each in self._distinct(name))

    def _distinct(self, name: str) -> tuple[_OfPlatform, ...]:
        """One platform of those that promise the same, also for inherited accuracy."""
        if name not in self._found:
            measured = dict(self.measured)
            names = (name, *_INHERITED_FROM)
            each = [_OfPlatform(platform, measured) for platform in self.platforms]
            distinct = {tuple(map(one.bound, names)): one for one in each}
            self._found[name] = tuple(distinct.values())
        return self._found[name]

    @cached_property
    def _found(self) -> dict[str, tuple[_OfPlatform, ...]]:
        """The cached results of ``_distinct``, which is asked for every operation of a program."""
        return {}


class _OfPlatform:
    """The errors of a single platform."""

    def __init__(self, platform: Platform, measured: Mapping[str, Bound]) -> None:
        self._platform = platform
        self._measured = measured

    def bound(self, name: str) -> Bound:
        """The bound of a builtin's error."""
        return self._measured.get(name) or self._promise(name)

    def error(self, name: str, operand: Floats, result: Floats) -> Floats:
        """The largest error for magnitudes up to these."""
        promise = self._promise(name)
        if name not in self._measured:
            return self._by(promise, name, operand, result)
        # A measured bound must not be larger than the promised one. The promise is inherited from
        # other promises, and not from measurements of other functions.
        promised = _OfPlatform(self._platform, {})._by(promise, name, operand, result)
        return np.minimum(self._by(self._measured[name], name, operand, result), promised)

    def _promise(self, name: str) -> Bound:
        return BUILTINS[name].accuracy.on(self._platform).bound

    def _by(self, bound: Bound, name: str, operand: Floats, result: Floats) -> Floats:
        """The largest error that a bound allows."""
        if isinstance(bound, Exact):
            return np.zeros_like(result)
        if isinstance(bound, Rounded):
            return _absolute(_ROUNDED, operand, result)
        if isinstance(bound, Within):
            return _within(bound, operand, result)
        if name not in _INHERITED:
            raise LookupError(f"the error of {name} follows from its definition only")
        return np.maximum(_INHERITED[name](self, operand, result), bound.at_least)

    def relative(self, name: str, operand: Floats) -> Floats:
        """The largest error relative to the result, of a function that has no absolute one.

        A unit in the last place is largest, relative to the number, at a power of two.
        """
        return self.error(name, operand, np.ones_like(operand))


def ulp(magnitude: Floats) -> Floats:
    """The unit in the last place of a float32."""
    # Without its fraction, a float is the power of two below it; infinity stays infinity.
    powers = (np.asarray(magnitude, np.float64).view(np.int64) & _EXPONENT).view(np.float64)
    return np.maximum(powers * ULP, _LEAST)


def _absolute(error: Error, operand: Floats, result: Floats) -> Floats:
    """An error as an absolute number."""
    ulps = error.ulp + error.ulp_by_operand * operand if error.ulp_by_operand else error.ulp
    found = ulps * ulp(result) + error.absolute
    if error.relative:
        found = found + error.relative * result
    if error.absolute_by_operand:
        found = found + error.absolute_by_operand * operand
    return found


def _within(bound: Within, operand: Floats, result: Floats) -> Floats:
    """The larger error of both sides of the limit, as magnitudes on either side may occur."""
    found = _absolute(bound.error, operand, result)
    if bound.limit == math.inf:
        return found
    magnitude = operand if bound.of == "operand" else result
    beyond = np.maximum(found, _absolute(bound.beyond, operand, result))
    return np.where(magnitude <= bound.limit, found, beyond)


# --- inherited accuracy ---------------------------------------------------------------------------


def _square_root(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``1 / inversesqrt(x)``."""
    inverse = of.relative("inversesqrt", operand)
    factor = 1.0 / (1.0 - inverse)
    return result * (factor - 1.0) + of.error("div", np.ones_like(result), result * factor)


def _exponential(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``exp2(x * log2(e))``: the factor is rounded, and so is the product."""
    exponent = operand * math.log2(math.e)
    rounding = np.expm1(math.log(2.0) * exponent * 1.5 * ULP)
    return result * (rounding + of.relative("exp2", exponent) * (1.0 + rounding))


def _logarithm(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``log2(x) * ln(2)``: the factor is rounded, and so is the product."""
    error = math.log(2.0) * of.error("log2", operand, result / math.log(2.0))
    return error + 1.5 * ULP * (result + error)


def _arc(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``atan2`` of ``x`` and ``sqrt(1 - x * x)``, in either order.

    The roundings of ``x * x`` and of the difference are off by ``x * x`` and ``1 - x * x`` steps,
    so by one step together. The angle changes by at most ``x`` for each unit of the root.
    """
    root = np.sqrt(np.maximum(1.0 - operand * operand, 0.0))
    moved = np.minimum(math.sqrt(ULP), np.divide(ULP, root))
    moved = moved + of.error("sqrt", operand, root + moved)
    turned = operand * moved * (1.0 + 2.0**-10)
    return turned + of.error("atan2", operand, result + turned)


def _hyperbolic_sine(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``(exp(x) - exp(-x)) * 0.5``: the sum of both exponentials is twice the cosine."""
    return _hyperbolic_cosine(of, operand, np.sqrt(1.0 + result * result))


def _hyperbolic_cosine(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``(exp(x) + exp(-x)) * 0.5``, of which the sum may be too large for float32."""
    error = of.relative("exp", operand) * result
    error = error + ULP * (result + error)
    return np.where(2.0 * (result + error) < LARGEST_FLOAT, error, np.inf)


def _hyperbolic_tangent(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``sinh(x) / cosh(x)``, both of which are off by a part of ``cosh(x)``."""
    part = of.relative("exp", operand) + 2.0 * ULP
    moved = np.where(part < 0.5, (1.0 + result) * part / (1.0 - part), np.inf)
    return moved + of.error("div", np.ones_like(result), result + moved)


def _inverse_sine(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``log(x + sqrt(x * x + 1))`` of the magnitude, the sum of two numbers that are positive."""
    return _logarithm_of(of, 2.0 * ULP + of.relative("sqrt", np.ones_like(operand)), result)


def _inverse_cosine(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``log(x + sqrt(x * x - 1))``: near 1 the difference keeps the rounding of the square."""
    lost = math.sqrt(2.0 * ULP) + ULP
    return _logarithm_of(of, lost + of.relative("sqrt", np.ones_like(operand)), result)


def _inverse_tangent(of: _OfPlatform, operand: Floats, result: Floats) -> Floats:
    """``log((1 + x) / (1 - x)) * 0.5``."""
    lost = 2.0 * ULP + of.relative("div", np.ones_like(operand))
    return 0.5 * _logarithm_of(of, lost, 2.0 * result)


def _logarithm_of(of: _OfPlatform, lost: Floats, result: Floats) -> Floats:
    """The error of a logarithm whose operand is off by a small part of it."""
    moved = lost * (1.0 + 2.0 * lost)
    return moved + of.error("log", np.ones_like(result), result + moved)


_INHERITED: Mapping[str, Callable[[_OfPlatform, Floats, Floats], Floats]] = {
    "sqrt": _square_root,
    "exp": _exponential,
    "log": _logarithm,
    "asin": _arc,
    "acos": _arc,
    "sinh": _hyperbolic_sine,
    "cosh": _hyperbolic_cosine,
    "tanh": _hyperbolic_tangent,
    "asinh": _inverse_sine,
    "acosh": _inverse_cosine,
    "atanh": _inverse_tangent,
}
"""The functions with an inherited accuracy that are evaluated as one.

All others, such as ``pow`` and ``tan``, are evaluated as the expressions that define them.
"""
_INHERITED_FROM = ("div", "sqrt", "inversesqrt", "exp", "exp2", "log", "log2", "atan2")
