"""Defines the meaning of builtins for whole vectors; ``functions.py`` has them in its table."""

from __future__ import annotations

from functools import reduce
from operator import add, mul

from . import floats
from .namespace import Lane, Lanes, Namespace


def scaled(v: Lanes, factor: Lane) -> Lanes:
    """Every lane multiplied by ``factor``."""
    return tuple(lane * factor for lane in v)


def inner(x: Lanes, y: Lanes) -> Lane:
    """The inner product, as a single lane."""
    return reduce(add, map(mul, x, y))


def dot(_xp: Namespace, x: Lanes, y: Lanes) -> Lanes:
    return (inner(x, y),)


def cross(_xp: Namespace, x: Lanes, y: Lanes) -> Lanes:
    return (
        x[1] * y[2] - x[2] * y[1],
        x[2] * y[0] - x[0] * y[2],
        x[0] * y[1] - x[1] * y[0],
    )


def length(xp: Namespace, v: Lanes) -> Lanes:
    return (xp.sqrt(inner(v, v)),)


def distance(xp: Namespace, x: Lanes, y: Lanes) -> Lanes:
    return length(xp, tuple(a - b for a, b in zip(x, y, strict=True)))


def normalize(xp: Namespace, v: Lanes) -> Lanes:
    return scaled(v, floats.inversesqrt(xp, inner(v, v)))


def nonzero(_xp: Namespace, v: Lanes) -> Lanes:
    return v


def reflect(_xp: Namespace, incident: Lanes, normal: Lanes) -> Lanes:
    twice = 2.0 * inner(normal, incident)
    return tuple(i - twice * n for i, n in zip(incident, normal, strict=True))


def refract(xp: Namespace, incident: Lanes, normal: Lanes, ratio: Lanes) -> Lanes:
    (eta,) = ratio
    cosine = inner(normal, incident)
    square = 1.0 - eta * eta * (1.0 - cosine * cosine)
    along = eta * cosine + floats.sqrt(xp, square)
    return tuple(
        xp.where(square < 0, 0.0, eta * i - along * n)
        for i, n in zip(incident, normal, strict=True)
    )


def faceforward(xp: Namespace, normal: Lanes, incident: Lanes, reference: Lanes) -> Lanes:
    faces = inner(reference, incident) < 0
    return tuple(xp.where(faces, lane, -lane) for lane in normal)


def lit(xp: Namespace, diffuse: Lanes, specular: Lanes, power: Lanes) -> Lanes:
    (nl,), (nh,), (exponent,) = diffuse, specular, power
    unlit = xp.logical_or(nl < 0, nh < 0)
    highlight = xp.where(unlit, 0.0, floats.pow_(xp, nh, exponent))
    return (1.0, xp.maximum(nl, 0.0), highlight, 1.0)
