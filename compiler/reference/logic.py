"""Defines the meaning of comparisons, logic and choices; ``functions.py`` has them in its table."""

from __future__ import annotations

from functools import reduce

from .namespace import Lane, Lanes, Namespace


def eq(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x == y


def ne(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x != y


def lt(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x < y


def le(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x <= y


def gt(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x > y


def ge(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x >= y


def and_(xp: Namespace, x: Lane, y: Lane) -> Lane:
    return xp.logical_and(x, y)


def or_(xp: Namespace, x: Lane, y: Lane) -> Lane:
    return xp.logical_or(x, y)


def not_(xp: Namespace, x: Lane) -> Lane:
    return xp.logical_not(x)


def choose(xp: Namespace, condition: Lane, x: Lane, y: Lane) -> Lane:
    return xp.where(condition, x, y)


def any_(xp: Namespace, x: Lanes) -> Lanes:
    return (reduce(xp.logical_or, x),)


def all_(xp: Namespace, x: Lanes) -> Lanes:
    return (reduce(xp.logical_and, x),)
