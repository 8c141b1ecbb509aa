"""Evaluates terms in float64 at many points at once.

``points.py`` makes the points. What a texture or a buffer holds is made up: numbers that change
smoothly with the place, so that reads of one place are equal, and of all other places differ.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any
from zlib import crc32

import numpy as np

from ...stdlib.builtins.facts import SMALLEST_NORMAL
from .leaves import Source
from .term import Term, below

Array = Any
Points = Mapping[int, Array]
"""The numbers of variables at each point, by their ids."""


class Numbers:
    """The values of terms at some points, each worked out once."""

    def __init__(self, points: Points, count: int, dtype: Any = np.float64, seed: int = 0) -> None:
        self._points, self._count, self._dtype, self._seed = points, count, dtype, seed
        self.known: dict[int, Array] = {}

    def of(self, roots: Iterable[Term]) -> list[Array]:
        """The values of terms, which all stay known."""
        roots = list(roots)
        with np.errstate(all="ignore"):
            for term in below(roots, self.known):
                self.known[term.id] = self._value(term)
        return [np.broadcast_to(self.known[root.id], (self._count,)) for root in roots]

    def _value(self, term: Term) -> Array:
        if term.op == "constant":
            value, kind = term.data
            return int(value) if kind == "i" else bool(value) if kind == "b" else self._real(value)
        if term.op == "variable":
            return self._points[term.id]
        args = [self.known[arg.id] for arg in term.args]
        if isinstance(term.data, Source):
            return self._read(term.data, args)
        return OPERATIONS[term.op](*args)

    def _real(self, value: Any) -> Array:
        return self._dtype(value.numerator) / self._dtype(value.denominator) if (
            abs(value.numerator) < 2**1000 and value.denominator < 2**1000
        ) else self._dtype(float(value))  # fmt: skip

    def _read(self, source: Source, place: list[Array]) -> Array:
        """A number that changes smoothly with the place, and reaches both ends of its range."""
        axes = 2 if source.method.startswith("sample_grad") else len(place)
        state = source.method.partition(" ")[2]
        chance = np.random.default_rng(crc32(f"{source.name} {state}".encode()) + self._seed)
        wave = chance.uniform(0.0, 7.0)
        for coordinate in place[:axes]:
            wave = wave + chance.uniform(0.5, 2.0) * coordinate
        share = np.clip(0.5 + 0.6 * np.sin(wave), 0.0, 1.0)
        value = source.low + (source.high - source.low) * share
        if source.kind == "b":
            return share > 0.5
        return np.floor(value).astype(np.int64) if source.kind == "i" else value


def _power(x: Array, y: Array) -> Array:
    return np.where((x == 0) & (y > 0), 0.0, np.power(np.maximum(x, 0.0), y))


def _whole(x: Array) -> Array:
    limited = np.where(np.isfinite(x), np.clip(x, -(2.0**62), 2.0**62), 0.0)
    return limited.astype(np.int64)


def _shifted(function: Callable[[Array, Array], Array]) -> Callable[[Array, Array], Array]:
    return lambda x, y: function(np.asarray(x, np.int64), np.clip(y, 0, 62))


def _divided(function: Callable[[Array, Array], Array]) -> Callable[[Array, Array], Array]:
    return lambda x, y: function(x, np.where(np.asarray(y) == 0, 1, y))


OPERATIONS: Mapping[str, Callable[..., Array]] = {
    "add": lambda x, y: x + y,
    "mul": lambda x, y: x * y,
    "reciprocal": lambda x: 1.0 / x,
    "inverse": lambda x: np.where(np.abs(x) < SMALLEST_NORMAL, 0.0, 1.0 / x),
    "abs": np.abs,
    "min": np.minimum,
    "max": np.maximum,
    "where": np.where,
    "sqrt": lambda x: np.sqrt(np.maximum(x, 0.0)),
    "inverse_root": lambda x: np.where(x < SMALLEST_NORMAL, np.nan, 1.0 / np.sqrt(np.abs(x))),
    "power": _power,
    "exp2": np.exp2,
    "log2": np.log2,
    "sin": np.sin,
    "cos": np.cos,
    "tanh": np.tanh,
    "arcsin": np.arcsin,
    "arctan": np.arctan,
    "arctan2": np.arctan2,
    "arcsinh": np.arcsinh,
    "arccosh": np.arccosh,
    "arctanh": np.arctanh,
    "floor": np.floor,
    "rint": np.rint,
    "trunc": np.trunc,
    "float": lambda x: np.asarray(x) * 1.0,
    "int": _whole,
    "mantissa": lambda x: np.frexp(x)[0],
    "exponent": lambda x: np.frexp(x)[1].astype(np.int64),
    "less": np.less,
    "equal": np.equal,
    "not": np.logical_not,
    "and": np.logical_and,
    "crossed": lambda x: x,
    "bit_and": np.bitwise_and,
    "bit_or": np.bitwise_or,
    "bit_xor": np.bitwise_xor,
    "shift_left": _shifted(np.left_shift),
    "shift_right": _shifted(np.right_shift),
    "quotient": _divided(np.floor_divide),
    "remainder": _divided(np.remainder),
}
"""The operations of terms for arrays. A crossing has the value of vertices that are all alike.

A vector without length has no direction: where one is needed, nothing is compared.
"""
