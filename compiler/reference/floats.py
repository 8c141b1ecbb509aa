"""Defines the meaning of builtins for floats, lane by lane.

``functions.py`` has them in its table. The names are those of the builtins, with an underscore if
Python already has the name. An operand outside of the domain of Python's or NumPy's function is
replaced *before* the function is called, as in the shaders, so that NaN never occurs. An array
library may have some of these as functions of its own (``OwnFunctions``).
"""

from __future__ import annotations

import math

from ...stdlib.builtins.facts import SMALLEST_NORMAL
from .namespace import Lane, Namespace, OwnFunctions

NARROWEST = 2.0**-64
"""Edges of ``smoothstep`` that are closer than this count as this far apart."""


def _is_tiny(x: Lane) -> Lane:
    """True if a device may treat the number as zero."""
    return abs(x) < SMALLEST_NORMAL


def add(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x + y


def sub(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x - y


def mul(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x * y


def div(xp: Namespace, x: Lane, y: Lane) -> Lane:
    tiny = _is_tiny(y)
    return xp.where(tiny, 0.0, xp.divide(x, xp.where(tiny, 1.0, y)))


def mod(xp: Namespace, x: Lane, y: Lane) -> Lane:
    tiny = _is_tiny(y)
    return xp.where(tiny, 0.0, xp.remainder(x, xp.where(tiny, 1.0, y)))


def neg(_xp: Namespace, x: Lane) -> Lane:
    return -x


def abs_(_xp: Namespace, x: Lane) -> Lane:
    return abs(x)


def sign(xp: Namespace, x: Lane) -> Lane:
    return xp.where(x > 0, 1.0, xp.where(x < 0, -1.0, 0.0))


def floor(xp: Namespace, x: Lane) -> Lane:
    return xp.floor(x)


def ceil(xp: Namespace, x: Lane) -> Lane:
    return xp.ceil(x)


def round_(xp: Namespace, x: Lane) -> Lane:
    return xp.rint(x)


def trunc(xp: Namespace, x: Lane) -> Lane:
    return xp.trunc(x)


def fract(xp: Namespace, x: Lane) -> Lane:
    return xp.fract(x) if isinstance(xp, OwnFunctions) else x - xp.floor(x)


def min_(xp: Namespace, x: Lane, y: Lane) -> Lane:
    return xp.minimum(x, y)


def max_(xp: Namespace, x: Lane, y: Lane) -> Lane:
    return xp.maximum(x, y)


def clamp(xp: Namespace, x: Lane, low: Lane, high: Lane) -> Lane:
    return xp.minimum(xp.maximum(x, low), high)


def saturate(xp: Namespace, x: Lane) -> Lane:
    return clamp(xp, x, 0.0, 1.0)


def mix(xp: Namespace, x: Lane, y: Lane, a: Lane) -> Lane:
    return xp.mix(x, y, a) if isinstance(xp, OwnFunctions) else x * (1.0 - a) + y * a


def fma(_xp: Namespace, x: Lane, y: Lane, z: Lane) -> Lane:
    return x * y + z


def step(xp: Namespace, edge: Lane, x: Lane) -> Lane:
    return xp.where(x >= edge, 1.0, 0.0)


def smoothstep(xp: Namespace, low: Lane, high: Lane, x: Lane) -> Lane:
    width = high - low
    meets = abs(width) < NARROWEST
    t = saturate(xp, xp.divide(x - low, xp.where(meets, NARROWEST, width)))
    return t * t * (3.0 - 2.0 * t)


def sqrt(xp: Namespace, x: Lane) -> Lane:
    return xp.sqrt(xp.maximum(x, 0.0))


def inversesqrt(xp: Namespace, x: Lane) -> Lane:
    positive = xp.maximum(x, SMALLEST_NORMAL)
    if isinstance(xp, OwnFunctions):
        return xp.inversesqrt(positive)
    return xp.divide(1.0, xp.sqrt(positive))


def pow_(xp: Namespace, x: Lane, y: Lane) -> Lane:
    tiny = x < SMALLEST_NORMAL
    without_power = xp.logical_and(tiny, y < SMALLEST_NORMAL)
    of_zero = xp.where(_is_tiny(y), 1.0, 0.0)
    return xp.where(without_power, of_zero, xp.power(xp.where(tiny, 0.0, x), y))


def exp(xp: Namespace, x: Lane) -> Lane:
    return xp.exp(x)


def exp2(xp: Namespace, x: Lane) -> Lane:
    return xp.exp2(x)


def log(xp: Namespace, x: Lane) -> Lane:
    return xp.log(xp.maximum(x, SMALLEST_NORMAL))


def log10(xp: Namespace, x: Lane) -> Lane:
    return math.log10(2.0) * log2(xp, x)


def log2(xp: Namespace, x: Lane) -> Lane:
    return xp.log2(xp.maximum(x, SMALLEST_NORMAL))


def sin(xp: Namespace, x: Lane) -> Lane:
    return xp.sin(x)


def cos(xp: Namespace, x: Lane) -> Lane:
    return xp.cos(x)


def tan(xp: Namespace, x: Lane) -> Lane:
    return xp.tan(x)


def asin(xp: Namespace, x: Lane) -> Lane:
    return xp.arcsin(clamp(xp, x, -1.0, 1.0))


def acos(xp: Namespace, x: Lane) -> Lane:
    return xp.arccos(clamp(xp, x, -1.0, 1.0))


def atan(xp: Namespace, x: Lane) -> Lane:
    return xp.arctan(x)


def atan2(xp: Namespace, y: Lane, x: Lane) -> Lane:
    on_axis = xp.where(x <= -SMALLEST_NORMAL, math.pi, 0.0)
    return xp.where(_is_tiny(y), on_axis, xp.arctan2(y, x))


def radians(_xp: Namespace, x: Lane) -> Lane:
    return x * (math.pi / 180.0)


def degrees(_xp: Namespace, x: Lane) -> Lane:
    return x * (180.0 / math.pi)
