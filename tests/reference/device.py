"""Devices that conform and choose at random: what bounds must contain.

A ``Device`` is an array library, as ``Bounds`` is, so the reference evaluates a graph with it in
the same way. Its lanes (``chosen.py``) have float32 numbers. Wherever specifications leave a
choice, it makes one: which neighbour an operation rounds to, whether a product and a sum are fused,
in which order the terms of a sum or the factors of a product are combined, whether subnormal
numbers become zero, whether a constant is rounded before it is used, and how far a function is off
within its row. ``test_soundness.py`` checks that no choice leads out of the bounds.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from burnish.compiler.reference.bounds import Errors
from burnish.compiler.reference.namespace import OwnFunctions
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL

from .chosen import Array, Chosen

MOST_PARTS = 8
"""The most terms or factors that are reordered; longer sums and products keep their order."""


@dataclass(frozen=True)
class Habits:
    """The probabilities with which a device makes each choice."""

    up: float = 0.5
    """The device rounds to the upper neighbour instead of the lower one."""
    nearest: float = 0.5
    """The device rounds to the nearest number, instead of either neighbour."""
    fuses: float = 0.5
    reorders: float = 0.5
    flushes: float = 0.5
    folds: float = 0.5
    """The device computes with a constant before rounding it, as a compiler that folds may."""
    error: tuple[float, float] = (-1.0, 1.0)
    """The range of a function's error, as parts of the allowed error."""


HABITS = (
    Habits(up=0.0, nearest=1.0, fuses=0.0, reorders=0.0, flushes=0.0, folds=0.0, error=(0.0, 0.0)),
    Habits(up=1.0, nearest=0.0, fuses=0.0, reorders=0.0, flushes=0.0, error=(1.0, 1.0)),
    Habits(up=0.0, nearest=0.0, fuses=0.0, reorders=0.0, flushes=1.0, error=(-1.0, -1.0)),
    Habits(nearest=1.0, fuses=1.0, reorders=1.0, error=(-1.0, 1.0)),
    Habits(),
    Habits(nearest=0.0, reorders=1.0, flushes=0.0),
)
"""Devices that differ; the first one rounds as IEEE 754 says, and its functions are exact."""


class Device(OwnFunctions):
    """An array library whose lanes are ``Chosen``."""

    def __init__(self, errors: Errors, habits: Habits, seed: int) -> None:
        self._errors = errors
        self._habits = habits
        self._seed = seed
        self._chance = np.random.default_rng(seed)

    def lane(self, value: Any) -> Chosen:
        """A lane as it is; a plain float is a constant of the program."""
        if isinstance(value, Chosen):
            return value
        if isinstance(value, float):
            return Chosen(self, value if self._does(self._habits.folds) else _nearest(value))
        return Chosen(self, value)

    def given(self, value: Array, error: float, place: str) -> Chosen:
        """A leaf, with any error within the relative one: that depends on its place only.

        So it is the same whatever else the graph computes.
        """
        if not error:
            return self.lane(value)
        chance = np.random.default_rng([self._seed, *place.encode()])
        allowed = error * np.abs(value)
        found = _nearest(value + allowed * chance.uniform(-1.0, 1.0, np.shape(value)))
        return Chosen(self, _within(found, value, allowed))

    # --- choices of the device --------------------------------------------------------------------

    def _does(self, probability: float) -> bool:
        return bool(self._chance.random() < probability)

    def _where(self, probability: float, shape: tuple[int, ...]) -> Array:
        return self._chance.random(shape) < probability

    def rounded(self, exact: Array) -> Array:
        """A float32 neighbour of each number; a subnormal one may be zero."""
        nearest = _nearest(exact)
        below = np.where(nearest > exact, _next(nearest, -np.inf), nearest)
        above = np.where(nearest < exact, _next(nearest, np.inf), nearest)
        shape = np.shape(exact)
        either = np.where(self._where(self._habits.up, shape), above, below)
        return self._flushed(np.where(self._where(self._habits.nearest, shape), nearest, either))

    def _flushed(self, value: Array) -> Array:
        subnormal = np.abs(value) < SMALLEST_NORMAL
        return np.where(subnormal & self._where(self._habits.flushes, np.shape(value)), 0.0, value)

    def _off(self, name: str, operand: Array, exact: Array) -> Chosen:
        """The result of a function: a float32 number no farther from it than its row allows."""
        allowed = self._errors(name, np.abs(operand), np.abs(exact))
        part = self._chance.uniform(*self._habits.error, np.shape(exact))
        found = _nearest(np.where(exact == 0, 0.0, exact + part * allowed))
        found = _within(found, exact, allowed)
        # Where no float32 number is that close, the correctly rounded one is right.
        found = np.where(np.abs(found - exact) > allowed, _nearest(exact), found)
        return Chosen(self, self._flushed(np.where(np.isfinite(exact), found, exact)))

    # --- sums and products ------------------------------------------------------------------------

    def add(self, x: Any, y: Any) -> Chosen:
        """The sum, in any order of its terms, of products that are rounded or not.

        If both terms are products with the same factor, it may be taken out, as Mesa does.
        """
        x, y = self.lane(x), self.lane(y)
        if x.value.dtype.kind != "f":
            return Chosen(self, x.value + y.value)
        terms = (*_parts(x, x.terms), *_parts(y, y.terms))
        if 2 < len(terms) <= MOST_PARTS and self._does(self._habits.reorders):
            return Chosen(self, self._in_any_order(terms, operator.add), terms)
        common = _common_factor(x, y)
        if common is not None and self._does(self._habits.reorders):
            factor, first, second = common
            return Chosen(self, self.rounded(factor * self.rounded(first + second)), terms)
        first, second = self._unrounded(x), self._unrounded(y)
        if first is not x.value and second is not y.value:  # Only one product can be fused.
            second = y.value
        return Chosen(self, self.rounded(first + second), terms)

    def multiply(self, x: Any, y: Any) -> Chosen:
        """The product, in any order of its factors."""
        x, y = self.lane(x), self.lane(y)
        if x.value.dtype.kind != "f":
            return Chosen(self, x.value * y.value)
        factors = (*_parts(x, x.factors), *_parts(y, y.factors))
        if 2 < len(factors) <= MOST_PARTS and self._does(self._habits.reorders):
            ordered = self._in_any_order(factors, operator.mul)
            found = np.where(_stays_normal(factors), ordered, self.rounded(x.value * y.value))
        else:
            found = self.rounded(x.value * y.value)
        return Chosen(self, found, (), factors)

    def _unrounded(self, x: Chosen) -> Array:
        """The exact product of two numbers, if the device fuses it with the sum that it is in."""
        if len(x.factors) == 2 and self._does(self._habits.fuses):
            product = x.factors[0] * x.factors[1]
            return np.where(np.abs(product) < SMALLEST_NORMAL, x.value, product)
        return x.value

    def _in_any_order(
        self, parts: tuple[Array, ...], combine: Callable[[Array, Array], Array]
    ) -> Array:
        left = list(parts)
        while len(left) > 1:
            first, second = (left.pop(self._chance.integers(len(left))) for _ in range(2))
            left.append(self.rounded(combine(first, second)))
        return left[0]

    # --- the array library ------------------------------------------------------------------------

    def where(self, condition: Any, x: Any, y: Any, /) -> Chosen:
        """``x`` where the condition holds, else ``y``."""
        condition, x, y = (self.lane(each).value for each in (condition, x, y))
        return Chosen(self, np.where(condition, x, y))

    def _plainly(self, function: Callable[..., Array], *lanes: Any) -> Chosen:
        """A function whose results every device has."""
        return Chosen(self, function(*(self.lane(lane).value for lane in lanes)))

    def logical_and(self, x: Any, y: Any, /) -> Chosen:
        return self._plainly(np.logical_and, x, y)

    def logical_or(self, x: Any, y: Any, /) -> Chosen:
        return self._plainly(np.logical_or, x, y)

    def logical_not(self, x: Any, /) -> Chosen:
        return self._plainly(np.logical_not, x)

    def minimum(self, x: Any, y: Any, /) -> Chosen:
        return self._plainly(np.minimum, x, y)

    def maximum(self, x: Any, y: Any, /) -> Chosen:
        return self._plainly(np.maximum, x, y)

    def floor(self, x: Any, /) -> Chosen:
        return self._plainly(np.floor, x)

    def ceil(self, x: Any, /) -> Chosen:
        return self._plainly(np.ceil, x)

    def rint(self, x: Any, /) -> Chosen:
        return self._plainly(np.rint, x)

    def trunc(self, x: Any, /) -> Chosen:
        return self._plainly(np.trunc, x)

    def float64(self, x: Any, /) -> Chosen:
        return Chosen(self, self.rounded(np.asarray(self.lane(x).value, np.float64)))

    def int64(self, x: Any, /) -> Chosen:
        value = self.lane(x).value
        return Chosen(self, np.where(np.isfinite(value), value, 0).astype(np.int64))

    def frexp(self, x: Any, /) -> tuple[Chosen, Chosen]:
        part, exponent = np.frexp(self.lane(x).value)
        return Chosen(self, part), Chosen(self, exponent.astype(np.int64))

    def ldexp(self, x: Any, n: Any, /) -> Chosen:
        return Chosen(self, self.rounded(np.ldexp(self.lane(x).value, self.lane(n).value)))

    def divide(self, x: Any, y: Any, /) -> Chosen:
        x, y = self.lane(x).value, self.lane(y).value
        return self._off("div", y, x / y)

    def remainder(self, x: Any, y: Any, /) -> Chosen:
        x, y = self.lane(x), self.lane(y)
        if x.value.dtype.kind == "i":
            return Chosen(self, np.remainder(x.value, y.value))
        left: Chosen = x - y * self.floor(self.divide(x, y))
        return left

    def power(self, x: Any, y: Any, /) -> Chosen:
        return self.exp2(self.lane(y) * self.log2(x))

    def tan(self, x: Any, /) -> Chosen:
        return self.divide(self.sin(x), self.cos(x))

    def _function(self, name: str, function: Callable[[Array], Array], x: Any) -> Chosen:
        value = self.lane(x).value
        return self._off(name, value, function(value))

    def arctan2(self, y: Any, x: Any, /) -> Chosen:
        y, x = self.lane(y).value, self.lane(x).value
        return self._off("atan2", y, np.arctan2(y, x))

    def sqrt(self, x: Any, /) -> Chosen:
        root = self._function("sqrt", np.sqrt, self.maximum(x, 0.0))
        return Chosen(self, np.maximum(root.value, 0.0))

    def rising(self, function: Callable[[Any, Any], Any], x: Any, /) -> Any:
        return function(self, x)

    def fract(self, x: Any, /) -> Any:
        return x - self.floor(x)

    def mix(self, x: Any, y: Any, a: Any, /) -> Any:
        """The mixture, by the formula of WGSL and Vulkan or by that of Direct3D."""
        return x + (y - x) * a if self._does(self._habits.reorders) else x * (1.0 - a) + y * a

    def inversesqrt(self, x: Any, /) -> Chosen:
        return self._function("inversesqrt", lambda value: 1.0 / np.sqrt(value), x)

    def exp(self, x: Any, /) -> Chosen:
        return self.maximum(self._function("exp", np.exp, x), 0.0)

    def exp2(self, x: Any, /) -> Chosen:
        return self.maximum(self._function("exp2", np.exp2, x), 0.0)

    def log(self, x: Any, /) -> Chosen:
        return self._function("log", np.log, x)

    def log2(self, x: Any, /) -> Chosen:
        return self._function("log2", np.log2, x)

    def sin(self, x: Any, /) -> Chosen:
        return self._function("sin", np.sin, x)

    def cos(self, x: Any, /) -> Chosen:
        return self._function("cos", np.cos, x)

    def arcsin(self, x: Any, /) -> Chosen:
        return self._function("asin", np.arcsin, x)

    def arccos(self, x: Any, /) -> Chosen:
        return self._function("acos", np.arccos, x)

    def arctan(self, x: Any, /) -> Chosen:
        return self._function("atan", np.arctan, x)

    def sinh(self, x: Any, /) -> Chosen:
        return self._function("sinh", np.sinh, x)

    def cosh(self, x: Any, /) -> Chosen:
        return self._function("cosh", np.cosh, x)

    def tanh(self, x: Any, /) -> Chosen:
        return self._function("tanh", np.tanh, x)

    def arcsinh(self, x: Any, /) -> Chosen:
        return self._function("asinh", np.arcsinh, x)

    def arccosh(self, x: Any, /) -> Chosen:
        return self._function("acosh", np.arccosh, x)

    def arctanh(self, x: Any, /) -> Chosen:
        return self._function("atanh", np.arctanh, x)


def _stays_normal(factors: tuple[Array, ...]) -> Array:
    """True where every product of some of the factors is a normal number."""
    magnitudes = [np.abs(factor) for factor in factors]
    least = math.prod(np.minimum(magnitude, 1.0) for magnitude in magnitudes)
    most = math.prod(np.maximum(magnitude, 1.0) for magnitude in magnitudes)
    return (least >= 4 * SMALLEST_NORMAL) & (most < 0.25 / SMALLEST_NORMAL)


def _common_factor(x: Chosen, y: Chosen) -> tuple[Array, Array, Array] | None:
    """A factor that both products have, and the other factor of each."""
    if len(x.factors) != 2 or len(y.factors) != 2:
        return None
    for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
        if x.factors[i] is y.factors[j]:
            return x.factors[i], x.factors[1 - i], y.factors[1 - j]
    return None


def _parts(x: Chosen, parts: tuple[Array, ...]) -> tuple[Array, ...]:
    return parts or (x.value,)


def _nearest(x: Array) -> Array:
    return np.asarray(x, np.float32).astype(np.float64)


def _within(x: Array, exact: Array, allowed: Array) -> Array:
    """Float32 numbers, or where these are farther off than is allowed, the next ones inward."""
    inward = np.where(x > exact, -np.inf, np.inf)
    return np.where(np.abs(x - exact) > allowed, _next(x, inward), x)


def _next(x: Array, towards: Array) -> Array:
    return np.nextafter(np.asarray(x, np.float32), np.float32(towards)).astype(np.float64)
