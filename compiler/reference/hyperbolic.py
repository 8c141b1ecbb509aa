"""Defines the meaning of the hyperbolic functions, lane by lane.

``functions.py`` has them in its table.
"""

from __future__ import annotations

from .namespace import Lane, Namespace

_BELOW_ONE = 1.0 - 2.0**-24
"""The largest float32 below 1."""


def sinh(xp: Namespace, x: Lane) -> Lane:
    return xp.sinh(x)


def cosh(xp: Namespace, x: Lane) -> Lane:
    return xp.cosh(x)


def tanh(xp: Namespace, x: Lane) -> Lane:
    return xp.tanh(x)


def asinh(xp: Namespace, x: Lane) -> Lane:
    return xp.arcsinh(x)


def acosh(xp: Namespace, x: Lane) -> Lane:
    return xp.arccosh(xp.maximum(x, 1.0))


def atanh(xp: Namespace, x: Lane) -> Lane:
    return xp.arctanh(xp.minimum(xp.maximum(x, -_BELOW_ONE), _BELOW_ONE))
