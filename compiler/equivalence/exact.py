"""Evaluates terms at one point with fractions, where rounding would decide a comparison.

``searching.py`` asks when two programs differ at single points only, as ``<`` and ``<=`` do. What
is no fraction, such as a sine, is rounded; a comparison that this may tip has no answer.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from .numbers import OPERATIONS
from .spans import WHOLE
from .term import Term, below

_ROUNDED = Fraction(1, 10**9)
"""The part by which numbers that were rounded may be off."""
Number = tuple[Fraction, bool]
"""A number, and True if it was not rounded."""


class _UndecidedError(Exception):
    """Rounding may tip a comparison, or there is no such number."""


def exact_values(roots: Sequence[Term], values: Mapping[int, Any]) -> list[Fraction] | None:
    """The values of terms at a point; ``None`` if they depend on rounding."""
    known: dict[int, Number] = {}
    try:
        for term in below(roots):
            known[term.id] = _value(term, known, values)
    except (_UndecidedError, OverflowError, ZeroDivisionError, ValueError):
        return None
    return [known[root.id][0] for root in roots]


def _value(term: Term, known: Mapping[int, Number], values: Mapping[int, Any]) -> Number:
    if term.op == "constant":
        return term.data[0], True
    if term.op == "variable":
        return Fraction(float(values[term.id])), True
    args = [known[arg.id] for arg in term.args]
    if term.op in _COMPARISONS:
        return _compared(term.op, *args), True
    if term.op == "where":
        return args[1] if args[0][0] else args[2]
    if term.op in ("floor", "rint", "trunc", "int"):
        return _stepped(term.op, args[0])
    rule = _EXACT.get(term.op)
    if rule is not None:
        return rule(*(value for value, _ in args)), all(is_exact for _, is_exact in args)
    if term.op not in OPERATIONS:
        raise _UndecidedError
    rounded = float(OPERATIONS[term.op](*(float(value) for value, _ in args)))
    if not math.isfinite(rounded):
        raise _UndecidedError
    return Fraction(rounded), False


def _compared(op: str, x: Number, y: Number) -> Fraction:
    difference = x[0] - y[0]
    if not (x[1] and y[1]) and abs(difference) <= _ROUNDED * max(abs(x[0]), abs(y[0]), Fraction(1)):
        raise _UndecidedError
    return Fraction(int(difference < 0 if op == "less" else difference == 0))


def _stepped(op: str, x: Number) -> Number:
    value, is_exact = x
    if not is_exact and abs(value * 2 - round(value * 2)) <= _ROUNDED * max(
        abs(value), Fraction(1)
    ):
        raise _UndecidedError
    steps: Mapping[str, Callable[[Fraction], int]] = {
        "floor": math.floor, "rint": round, "trunc": math.trunc, "int": math.trunc,
    }  # fmt: skip
    return Fraction(steps[op](value)), True


def _inverse(x: Fraction) -> Fraction:
    return 1 / x if abs(x) > Fraction(1, 2**126) else Fraction(0)


_COMPARISONS = ("less", "equal")
_EXACT: Mapping[str, Callable[..., Fraction]] = {
    "add": lambda x, y: x + y,
    "mul": lambda x, y: x * y,
    "reciprocal": lambda x: 1 / x,
    "inverse": _inverse,
    "abs": abs,
    "min": min,
    "max": max,
    "not": lambda x: 1 - x,
    "and": lambda x, y: x * y,
    "float": lambda x: x,
    "crossed": lambda x: x,
    **{name: lambda x, y, of=of: Fraction(of(int(x), int(y))) for name, of in WHOLE.items()},
}
