"""The functions of lanes with bounds, each with the error that a platform allows it.

They have NumPy's names and stand in its place (``namespace.py``), so the definitions of builtins
need not know which they get. ``stage_evaluation.py`` makes a ``Bounds`` for each picture.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ....stdlib.builtins.facts import SMALLEST_NORMAL, ULP
from ..namespace import OpenLoops, OwnFunctions
from .affine import Derivative, Form, curved
from .blend import blend
from .bounded import Bounded, as_bounded, exact, negated, widened
from .choices import certain_choice, of_conditions, of_ends, open_choice
from .lanes import limited, rounded
from .loop_ends import LoopEnds
from .products import products
from .rounding import ROUNDED_UP, Array, outward
from .whole import LARGEST, LEAST

Errors = Callable[[str, Array, Array], Array]
"""A function that returns the largest absolute error of a builtin.

It gets the builtin's name, and the largest magnitudes of its operand and of its result.
"""

_TURN = 2.0 * math.pi
_ONE = np.float64(1.0)
_ROUGH = 2.0**-16
"""An error of a result of about 1 from which functions are rough."""
_BELOW_ONE = 2.0**-24
"""The distance of the last float32 below 1 from 1."""
_LN2 = math.log(2.0)


class Bounds(OwnFunctions, OpenLoops):
    """An array library whose lanes are ``Bounded``, for platforms with these errors of functions.

    Operands may be plain where they are exact. A plain float is a constant of the program.
    """

    def __init__(self, errors: Errors) -> None:
        self._errors = errors
        self._rough: dict[str, bool] = {}
        """The functions that are rough or not, as far as that was asked."""
        self._rounds: Callable[[str], bool] = getattr(errors, "rounds", lambda _name: False)

    def endings(self) -> LoopEnds:
        """The endings of a loop."""
        return LoopEnds()

    # --- choices ----------------------------------------------------------------------------------

    def where(self, condition: Any, x: Any, y: Any, /) -> Any:
        """``x`` where the condition holds, else ``y``; both where it may hold or not."""
        if not isinstance(condition, Bounded):
            condition = exact(condition)
        x, y = as_bounded(x), as_bounded(y)
        if condition.is_exact and np.ndim(condition.value) == 0:
            return x if condition.value else y
        value = np.where(condition.value, x.value, y.value)
        if condition.is_exact:
            if x.is_exact and y.is_exact:
                return exact(value)
            return certain_choice(value, condition.value, x, y)
        return open_choice(value, condition.low, np.logical_not(condition.high), x, y)

    def logical_and(self, x: Any, y: Any, /) -> Bounded:
        """True where both conditions hold."""
        return of_conditions(np.logical_and, x, y)

    def logical_or(self, x: Any, y: Any, /) -> Bounded:
        """True where at least one condition holds."""
        return of_conditions(np.logical_or, x, y)

    def logical_not(self, x: Any, /) -> Bounded:
        """True where the condition does not hold."""
        return negated(as_bounded(x))

    def minimum(self, x: Any, y: Any, /) -> Bounded:
        """The lesser number."""
        return of_ends(np.minimum, np.less_equal, x, y)

    def maximum(self, x: Any, y: Any, /) -> Bounded:
        """The greater number."""
        return of_ends(np.maximum, np.greater_equal, x, y)

    def mix(self, x: Any, y: Any, a: Any, /) -> Bounded:
        """A blend of ``x`` and ``y`` with the weight ``a``."""
        return blend(as_bounded(x), as_bounded(y), as_bounded(a))

    def fract(self, x: Any, /) -> Bounded:
        """The part above the floor. Just below a whole number it is 1, or the float before 1.

        If the product that ``x`` may be is not rounded before the floor is taken from it, the part
        may leave 0..1 by that rounding. Compilers that combine ``x`` and the floor with further
        terms of a sum are not allowed for.
        """
        x = as_bounded(x)
        found = x - self.floor(x)
        found = widened(found, np.where(found.high >= 1.0, _BELOW_ONE, 0.0))
        rounding = 0.0 if x.is_exact else ULP * x.magnitude
        return limited(found, np.minimum(-rounding, 0.0), np.maximum(1.0 + rounding, 1.0))

    def rising(self, function: Callable[[Any, Array], Array], x: Any, /) -> Bounded:
        """A function that never falls and does not round, given NumPy in the place of this."""
        x = as_bounded(x)
        value = function(np, x.value)
        if x.is_exact:
            return exact(value)
        unknown = np.isnan(x.low) | np.isnan(x.high)
        low, high = (function(np, np.where(unknown, 0.0, end)) for end in (x.low, x.high))
        return Bounded(value, np.where(unknown, LEAST, low), np.where(unknown, LARGEST, high))

    # --- conversions ------------------------------------------------------------------------------

    def float64(self, x: Any, /) -> Bounded:
        """The number as a float, which is rounded if float32 does not have it."""
        x = as_bounded(x)
        value = np.asarray(x.value, np.float64)[()]
        if x.is_exact:
            return exact(value) if (np.abs(value) <= 2**24).all() else _rounded(value, value, value)
        return _rounded(value, np.asarray(x.low, np.float64), np.asarray(x.high, np.float64))

    def int64(self, x: Any, /) -> Bounded:
        """The number truncated to an integer; any integer where nothing is known of it."""
        x = as_bounded(x)
        value = _to_whole(x.value, 0)
        if x.is_exact:
            return exact(value)
        return Bounded(value, _to_whole(x.low, LEAST), _to_whole(x.high, LARGEST))

    def floor(self, x: Any, /) -> Bounded:
        """The next whole number below."""
        return _stepped(np.floor, x)

    def ceil(self, x: Any, /) -> Bounded:
        """The next whole number above."""
        return _stepped(np.ceil, x)

    def rint(self, x: Any, /) -> Bounded:
        """The nearest whole number, an even one in the middle between two."""
        return _stepped(np.rint, x)

    def trunc(self, x: Any, /) -> Bounded:
        """The next whole number towards zero."""
        return _stepped(np.trunc, x)

    def frexp(self, x: Any, /) -> tuple[Bounded, Bounded]:
        """The fraction, whose magnitude is at least a half and below one, and the exponent."""
        x = as_bounded(x)
        part, exponent = np.frexp(x.value)
        if x.is_exact:
            return exact(part), exact(np.asarray(exponent, np.int64))
        (low, least), (high, most) = np.frexp(x.low), np.frexp(x.high)
        same = (least == most) & (np.sign(low) == np.sign(high))
        crosses = (x.low <= 0) & (x.high >= 0)
        smallest = np.where(crosses, -1100, np.minimum(least, most)).astype(np.int64)
        return (
            Bounded(part, np.where(same, low, -1.0), np.where(same, high, 1.0)),
            Bounded(exponent.astype(np.int64), smallest, np.maximum(least, most).astype(np.int64)),
        )

    def ldexp(self, x: Any, n: Any, /) -> Bounded:
        """``x`` times two to the power of ``n``."""
        x, n = as_bounded(x), as_bounded(n)
        value = np.ldexp(x.value, n.value)
        if x.is_exact and n.is_exact:
            return _rounded(value, value, value)
        ends = [np.ldexp(a, b) for a in (x.low, x.high) for b in (n.low, n.high)]
        return _rounded(value, np.fmin.reduce(ends), np.fmax.reduce(ends))

    # --- quotients and powers ---------------------------------------------------------------------

    def divide(self, x: Any, y: Any, /) -> Bounded:
        """The quotient; nothing is known of it where the divisor may be zero."""
        x, y = as_bounded(x), as_bounded(y)
        value = np.divide(x.value, y.value)
        crosses = (y.low <= 0) & (y.high >= 0)
        with np.errstate(all="ignore"):
            low, high = products(x, Bounded(y.value, 1.0 / y.high, 1.0 / y.low))
            form = _quotient_form(x, y)
        nothing = (x.low == 0) & (x.high == 0)
        low = np.where(crosses, np.where(nothing, 0.0, -np.inf), low)
        high = np.where(crosses, np.where(nothing, 0.0, np.inf), high)
        if not (np.isfinite(low).all() and np.isfinite(high).all()):
            unknown = np.isnan(x.magnitude) | np.isnan(y.magnitude)
            unknown |= np.isinf(x.magnitude) & np.isinf(y.magnitude)
            low, high = np.where(unknown, np.nan, low), np.where(unknown, np.nan, high)
        return self._with_error("div", y, Bounded(value, low, high, form))

    def remainder(self, x: Any, y: Any, /) -> Bounded:
        """The remainder of the quotient rounded down, computed as ``x - y * floor(x / y)``."""
        x, y = as_bounded(x), as_bounded(y)
        if x.is_exact and y.is_exact and x.kind == "i":
            return exact(np.remainder(x.value, y.value))
        found = self._remainder(x, y)
        return Bounded(np.remainder(x.value, y.value), found.low, found.high, found.form)

    def _remainder(self, x: Bounded, y: Bounded) -> Bounded:
        return x - y * self.floor(self.divide(x, y))

    def sqrt(self, x: Any, /) -> Bounded:
        """The square root; its operand is not negative."""
        root = self._rising("sqrt", np.sqrt, self.maximum(x, 0.0), lambda at: 0.5 / np.sqrt(at))
        return _not_negative(root)

    def inversesqrt(self, x: Any, /) -> Bounded:
        """The reciprocal of the square root; nothing is known of it at zero."""
        x = as_bounded(x)
        form = _bent(x, lambda at: -0.5 / (at * np.sqrt(at)))
        root = Bounded(1 / np.sqrt(x.value), 1 / np.sqrt(x.high), 1 / np.sqrt(x.low), form)
        return self._with_error("inversesqrt", x, root)

    def power(self, x: Any, y: Any, /) -> Bounded:
        """``x`` to the power of ``y``, computed as ``exp2(y * log2(x))``; ``x`` is not negative.

        No specification says what the logarithm of zero is. SwiftShader's is -127, and so its power
        of zero is not zero: the power of the smallest normal number is more.
        """
        x, y = as_bounded(x), as_bounded(y)
        found = self.exp2(y * self.log2(self.maximum(x, SMALLEST_NORMAL)))
        may_vanish = x.low < SMALLEST_NORMAL
        low = np.where(may_vanish, np.minimum(found.low, 0.0), found.low)
        of_tiny = np.power(SMALLEST_NORMAL, np.maximum(y.low, 0.0))
        form = found.form and found.form.widened(np.where(may_vanish, of_tiny, 0.0))
        return Bounded(np.power(x.value, y.value), low, found.high, form)

    def exp(self, x: Any, /) -> Bounded:
        return _not_negative(self._rising("exp", np.exp, x, np.exp))

    def exp2(self, x: Any, /) -> Bounded:
        return _not_negative(self._rising("exp2", np.exp2, x, lambda at: _LN2 * np.exp2(at)))

    def log(self, x: Any, /) -> Bounded:
        return self._rising("log", np.log, x, np.reciprocal)

    def log2(self, x: Any, /) -> Bounded:
        return self._rising("log2", np.log2, x, lambda at: 1.0 / (_LN2 * at))

    # --- angles -----------------------------------------------------------------------------------

    def sin(self, x: Any, /) -> Bounded:
        return self._wave("sin", np.sin, x, math.pi / 2)

    def cos(self, x: Any, /) -> Bounded:
        return self._wave("cos", np.cos, x, 0.0)

    def tan(self, x: Any, /) -> Bounded:
        """The tangent, computed as the quotient of sine and cosine."""
        x = as_bounded(x)
        found = self.divide(self.sin(x), self.cos(x))
        return Bounded(np.tan(x.value), found.low, found.high)

    def arcsin(self, x: Any, /) -> Bounded:
        return self._rising("asin", np.arcsin, x)

    def arccos(self, x: Any, /) -> Bounded:
        x = as_bounded(x)
        angle = Bounded(np.arccos(x.value), np.arccos(x.high), np.arccos(x.low))
        return self._with_error("acos", x, angle)

    def arctan(self, x: Any, /) -> Bounded:
        return self._rising("atan", np.arctan, x)

    def arctan2(self, y: Any, x: Any, /) -> Bounded:
        """The angle between the x axis and the point (x, y); it jumps along the negative axis."""
        y, x = as_bounded(y), as_bounded(x)
        corners = [np.arctan2(b, a) for b in (y.low, y.high) for a in (x.low, x.high)]
        cut = (x.low <= 0) & (y.low <= 0) & (y.high >= 0) & ~(y.is_exact & (y.low == y.high))
        angle = Bounded(
            np.arctan2(y.value, x.value),
            np.where(cut, -math.pi, np.minimum.reduce(np.broadcast_arrays(*corners))),
            np.where(cut, math.pi, np.maximum.reduce(np.broadcast_arrays(*corners))),
        )
        return self._with_error("atan2", y, angle)

    # --- hyperbolic functions ---------------------------------------------------------------------

    def sinh(self, x: Any, /) -> Bounded:
        return self._rising("sinh", np.sinh, x)

    def cosh(self, x: Any, /) -> Bounded:
        x = abs(as_bounded(x))
        return self._rising("cosh", np.cosh, x)

    def tanh(self, x: Any, /) -> Bounded:
        return self._rising("tanh", np.tanh, x)

    def arcsinh(self, x: Any, /) -> Bounded:
        return self._rising("asinh", np.arcsinh, x)

    def arccosh(self, x: Any, /) -> Bounded:
        return self._rising("acosh", np.arccosh, x)

    def arctanh(self, x: Any, /) -> Bounded:
        return self._rising("atanh", np.arctanh, x)

    # --- inside -----------------------------------------------------------------------------------

    def _rising(
        self,
        name: str,
        function: Callable[[Array], Array],
        lane: Any,
        derivative: Derivative | None = None,
    ) -> Bounded:
        """A function that never falls; it keeps the form of its operand if it has a derivative."""
        x = as_bounded(lane)
        form = None if derivative is None else _bent(x, derivative)
        found = Bounded(function(x.value), function(x.low), function(x.high), form)
        return self._with_error(name, x, found)

    def _wave(
        self, name: str, function: Callable[[Array], Array], lane: Any, crest: float
    ) -> Bounded:
        """A sine or cosine, with a maximum at ``crest`` and in every turn from there."""
        x = as_bounded(lane)
        one, other = function(x.low), function(x.high)
        low = np.where(_passes(x, crest + math.pi), -1.0, np.minimum(one, other))
        high = np.where(_passes(x, crest), 1.0, np.maximum(one, other))
        form = None
        if x.form is not None:
            slope = -np.sin(x.value - crest)
            # The second derivative is between -1 and 1.
            form = x.form.scaled(slope).widened(0.5 * x.radius**2)
        return self._with_error(name, x, Bounded(function(x.value), low, high, form))

    def _with_error(self, name: str, operand: Bounded, result: Bounded) -> Bounded:
        if self._rounds(name):
            return rounded(result)
        # A result just below a power of two has half the step of the power itself.
        largest = result.magnitude * ROUNDED_UP
        return widened(result, self._errors(name, operand.magnitude, largest))

    def is_rough(self, name: str) -> bool:
        """True if so much of a function's result may be off that it pays to know what shares it."""
        if name not in self._rough:
            self._rough[name] = bool(self._errors(name, _ONE, _ONE) > _ROUGH)
        return self._rough[name]


def _bent(x: Bounded, derivative: Derivative) -> Form | None:
    """The form of a function with this derivative, which must not turn."""
    if x.form is None:
        return None
    ends = derivative(x.low), derivative(x.high)
    return curved(x.form, derivative(x.value), ends, x.radius)


def _quotient_form(x: Bounded, y: Bounded) -> Form | None:
    """The form of a quotient, as the product with the reciprocal.

    There is none where the divisor may be 0.
    """
    if x.form is None and y.form is None:
        return None
    nearest = np.minimum(np.abs(y.low), np.abs(y.high))
    inverse = 1.0 / y.value
    bend = y.radius**2 * np.abs(inverse) * np.abs(inverse) / nearest
    reciprocal = y.any_form.scaled(-inverse * inverse).widened(bend)
    spread = np.abs(inverse) * y.radius / nearest
    form = x.any_form.scaled(inverse).plus(reciprocal.scaled(x.value))
    form = form.widened(x.radius * spread)
    crosses = (y.low <= 0) & (y.high >= 0)
    return form.widened(np.where(crosses, np.inf, 0.0))


def _passes(x: Bounded, place: float) -> Array:
    """True where an interval contains a place that repeats every full turn."""
    return np.floor((x.high - place) / _TURN) != np.floor((x.low - place) / _TURN)


def _rounded(value: Array, low: Array, high: Array) -> Bounded:
    return Bounded(value, *outward(low, high))


def _not_negative(x: Bounded) -> Bounded:
    return x.within(np.maximum(x.low, 0.0), x.high)


def _stepped(function: Callable[[Array], Array], lane: Any) -> Bounded:
    """A function that never falls, and whose results every device has."""
    x = as_bounded(lane)
    value = function(x.value)
    return exact(value) if x.is_exact else Bounded(value, function(x.low), function(x.high))


def _to_whole(x: Array, otherwise: int) -> Array:
    """The numbers truncated to integers; ``otherwise`` for NaN."""
    number = np.where(np.isnan(x), otherwise, np.clip(x, float(LEAST), float(LARGEST)))
    return number.astype(np.int64)[()]
