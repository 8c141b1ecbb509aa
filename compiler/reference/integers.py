"""Defines the meaning of builtins for 32-bit integers, lane by lane, before wrapping.

``functions.py`` has them in its table, and calls ``wrap``.
"""

from __future__ import annotations

from typing import Literal

from ...stdlib.builtins.conversion import LARGEST_INT, LARGEST_UINT
from .namespace import Lane, Namespace

IntegerKind = Literal["int", "uint"]
_MASK = 0xFFFFFFFF
_HALF = 0x80000000


def wrap(kind: IntegerKind, x: Lane) -> Lane:
    """The integer of type ``kind`` with the lowest 32 bits of ``x``."""
    return ((x + _HALF) & _MASK) - _HALF if kind == "int" else x & _MASK


def div(xp: Namespace, x: Lane, y: Lane) -> Lane:
    zero = y == 0
    magnitude = abs(x) // xp.maximum(abs(y), 1)
    return xp.where(zero, x, xp.where((x < 0) != (y < 0), -magnitude, magnitude))


def mod(xp: Namespace, x: Lane, y: Lane) -> Lane:
    zero = y == 0
    return xp.where(zero, 0, x % xp.where(zero, 1, y))


def sign(xp: Namespace, x: Lane) -> Lane:
    return xp.where(x > 0, 1, xp.where(x < 0, -1, 0))


def to_float(xp: Namespace, x: Lane) -> Lane:
    return xp.float64(x)


def to_int(xp: Namespace, x: Lane) -> Lane:
    return xp.int64(xp.minimum(xp.maximum(x, float(-_HALF)), LARGEST_INT))


def to_uint(xp: Namespace, x: Lane) -> Lane:
    return xp.int64(xp.minimum(xp.maximum(x, 0.0), LARGEST_UINT))
