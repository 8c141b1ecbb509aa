"""Numbers that operands of the corpus are chosen from, and that are drawn at random.

``EDGES`` and ``WHOLE_EDGES`` are those that operations stumble over. The others are drawn from
different kinds of distributions, so that some lie in any domain.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from random import Random
from typing import TypeVar

from ....stdlib.builtins.facts import LARGEST_FLOAT

T = TypeVar("T")

EDGES = (
    0.0, -0.0, 2.0**-149, -1e-40, 2.0**-126, -(2.0**-126), 2.0**-127, 2.0**-64, 2.0**-60, 2.0**-24,
    0.5, -0.5, 1.0, -1.0, 1.0 - 2.0**-24, 1.0 + 2.0**-23, -1.0 - 2.0**-23, 1.5, 2.0, -2.0, 2.5,
    3.0, math.pi, -math.pi, math.pi / 2, -math.pi / 2, 2 * math.pi, 100.0, 255.0, 65504.0, 2.0**23,
    2.0**24 + 2.0, 2.0**31, -(2.0**31), 2.0**32, 2.0**63, 2.0**64, 2.0**126, 2.0**127, -(2.0**127),
    LARGEST_FLOAT, -LARGEST_FLOAT, 16.0, -16.0, 88.0, -88.0, 127.0, -126.0, 128.0, -149.0,
)  # fmt: skip
"""Zeros, subnormal numbers, both ends of float32, halves, ends of domains, quarter turns."""

WHOLE_EDGES = (
    0, 1, -1, 2, -2, 3, 7, -7, 31, 32, 33, 24, 16, 8, 4, 255, 256, 65535, 65536, 2**31 - 1,
    -(2**31), -(2**31) + 1, 2**30, 2**24 + 1, 0x55555555, -252, 254, -126, 127, 128, 0x3F800000,
    0x7F800000, 0x7FC00001, -(2**23), 0x00800000, 0x007FFFFF,
)  # fmt: skip
"""Integers at the ends of their range and of fields of bits, and the bits of special floats."""


def float32(number: float) -> float:
    """The nearest float32; the largest one of numbers beyond it."""
    limited = min(max(number, -LARGEST_FLOAT), LARGEST_FLOAT)
    rounded: float = struct.unpack("<f", struct.pack("<f", limited))[0]
    return rounded


def beside(number: float, steps: int) -> float:
    """The float32 that is so many steps farther from zero than a number; zero stays zero."""
    (bits,) = struct.unpack("<I", struct.pack("<f", float32(number)))
    if not bits & 0x7FFFFFFF:
        return number
    (found,) = struct.unpack("<f", struct.pack("<I", bits + steps))
    return float(found) if math.isfinite(found) else number


def _uniform(low: float, high: float) -> Callable[[Random], float]:
    return lambda chance: low + (high - low) * chance.random()


def _scaled(low: float, high: float) -> Callable[[Random], float]:
    """Numbers of either sign whose magnitudes are spread evenly over powers of two."""
    exponent = _uniform(low, high)
    return lambda chance: _sign(chance) * math.pow(2.0, exponent(chance))


def _sign(chance: Random) -> float:
    return 1.0 if chance.random() < 0.5 else -1.0


def _near_one(chance: Random) -> float:
    away = (2.0 * chance.random() - 1.0) * math.pow(2.0, -23.0 * chance.random())
    return _sign(chance) * (1.0 + away)


def _half(chance: Random) -> float:
    return round(160.0 * (chance.random() - 0.5)) / 2


def _near_quarter_turn(chance: Random) -> float:
    turns = round(18.0 * (chance.random() - 0.5))
    return math.pi / 2 * turns + 1e-3 * (chance.random() - 0.5)


def one_of(chance: Random, choices: Sequence[T]) -> T:
    """An element; always the same one for the same state of the generator, in any version."""
    return choices[int(chance.random() * len(choices))]


_MODERATE = (
    _uniform(-1.0, 1.0), _uniform(0.0, 1.0), _uniform(0.0, 8.0), _uniform(-8.0, 8.0),
    _scaled(-3.0, 10.0), _scaled(-20.0, 20.0), _near_one, _half,
)  # fmt: skip
_FLOATS = (
    *_MODERATE, _uniform(-130.0, 130.0), _scaled(-60.0, 60.0), _scaled(-126.0, 128.0),
    _near_quarter_turn,
)  # fmt: skip
_WHOLE: tuple[Callable[[Random], int], ...] = (
    lambda chance: int(chance.random() * 2**32) - 2**31,
    lambda chance: int(chance.random() * 81) - 40,
    lambda chance: int(math.pow(2.0, 31.0 * chance.random())),
    lambda chance: one_of(chance, WHOLE_EDGES),
)

Draw = Callable[[Random], float]
"""A function that draws a number."""


def distribution(chance: Random, kind: str, *, moderate: bool) -> Draw:
    """One of the distributions of a kind of lanes; none of very large or small numbers if
    ``moderate``."""
    if kind == "float":
        draw = one_of(chance, _MODERATE if moderate else _FLOATS)
        return lambda chance: float32(draw(chance))
    return one_of(chance, _WHOLE)
