"""Spans: between which numbers each term lies over the whole domain, for the rules of terms.

They are plain intervals of Python's floats, rounded outward. The bounds of single boxes are those
of ``compiler/reference/bounds``.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple, Protocol

_SLACK = 2.0**-48
_SHORT = 2.0**13
_INTEGERS = ("bit_and", "bit_or", "bit_xor", "shift_left", "shift_right", "quotient", "remainder",
             "int", "exponent")  # fmt: skip
_CONDITIONS = ("less", "equal", "not", "and")
_CHOICES = ("where", "min", "max")

WHOLE: Mapping[str, Callable[[int, int], int]] = {
    "bit_and": operator.and_,
    "bit_or": operator.or_,
    "bit_xor": operator.xor,
    "shift_left": operator.lshift,
    "shift_right": operator.rshift,
    "quotient": operator.floordiv,
    "remainder": operator.mod,
}
"""Operations on whole numbers."""


class Span(NamedTuple):
    """An interval that contains all values of a term."""

    low: float
    high: float

    @property
    def most(self) -> float:
        """The largest magnitude."""
        return max(abs(self.low), abs(self.high))


class Spanned(Protocol):
    """A term, as far as spans need it."""

    span: Span
    kind: str


ALL = Span(-math.inf, math.inf)
UNIT = Span(0.0, 1.0)


def kind_of(op: str, args: Sequence[Spanned], data: Any) -> str:
    """``f`` for floats, ``i`` for whole numbers, ``b`` for conditions."""
    if op == "constant":
        kind: str = data[1]
        return kind
    if op in ("variable", "element", "read"):
        return str(data.kind)
    if op in _CONDITIONS:
        return "b"
    if op in _INTEGERS:
        return "i"
    if op in ("add", "mul", "abs", "crossed", *_CHOICES):
        parts = args[1:] if op == "where" else args
        return "f" if any(part.kind == "f" for part in parts) else parts[0].kind
    return "f"


def span_of(op: str, args: Sequence[Spanned], data: Any) -> Span:
    """The span of an operation, from those of its arguments."""
    if op == "constant":
        return _of_number(data[0])
    if op in ("variable", "element", "read"):
        return Span(data.low, data.high)
    rule = _RULES.get(op)
    found = ALL if rule is None else rule(*(arg.span for arg in args))
    if op == "mul" and args[0] is args[1]:
        found = Span(max(found.low, 0.0), found.high)
    return ALL if math.isnan(found.low) or math.isnan(found.high) else found


def stepped(op: str, x: Span) -> Span:
    """The span of ``floor``, ``rint`` or ``trunc``."""
    if not math.isfinite(x.low) or not math.isfinite(x.high):
        return x
    functions: Mapping[str, Callable[[float], int]] = {
        "floor": math.floor, "rint": round, "trunc": math.trunc,
    }  # fmt: skip
    function = functions[op]
    return Span(float(function(x.low)), float(function(x.high)))


def _of_number(value: Fraction) -> Span:
    try:
        number = float(value)
    except OverflowError:
        return Span(1e300, math.inf) if value > 0 else Span(-math.inf, -1e300)
    return Span(number, number) if number == value else _outward(number, number)


def _outward(low: float, high: float) -> Span:
    def widened(end: float, sign: float) -> float:
        return end + sign * (abs(end) * _SLACK + 5e-324) if end else end

    return Span(widened(low, -1.0), widened(high, 1.0))


def _add(x: Span, y: Span) -> Span:
    low, high = x.low + y.low, x.high + y.high
    widened = _outward(low, high)
    return Span(
        low if low - x.low == y.low and low - y.low == x.low else widened.low,
        high if high - x.high == y.high and high - y.high == x.high else widened.high,
    )


def _mul(x: Span, y: Span) -> Span:
    products = [a * b if a and b else 0.0 for a in x for b in y]
    low, high = min(products), max(products)
    return Span(low, high) if all(map(_is_short, (*x, *y))) else _outward(low, high)


def _is_short(end: float) -> bool:
    """True if a number has so few digits that products with others of this kind are exact."""
    return abs(end) <= _SHORT and (end * _SHORT).is_integer()


def _reciprocal(x: Span) -> Span:
    if x.low > 0 or x.high < 0:
        return _outward(1.0 / x.high, 1.0 / x.low)
    if x.low == 0 and x.high > 0:
        return Span(_outward(1.0 / x.high, 0.0).low, math.inf)
    return ALL


def _abs(x: Span) -> Span:
    inside = x.low <= 0 <= x.high
    return Span(0.0 if inside else min(abs(x.low), abs(x.high)), x.most)


def _hull(x: Span, y: Span) -> Span:
    return Span(min(x.low, y.low), max(x.high, y.high))


def _sqrt(x: Span) -> Span:
    return _outward(math.sqrt(max(x.low, 0.0)), math.sqrt(max(x.high, 0.0)))


def _inverse_root(x: Span) -> Span:
    low, high = (1.0 / math.sqrt(end) if end > 0 else math.inf for end in (x.high, x.low))
    return _outward(low, high)


def _power(x: Span, y: Span) -> Span:
    def at(base: float, exponent: float) -> float:
        try:
            return math.pow(max(base, 0.0), exponent)
        except (OverflowError, ValueError):
            return math.inf

    ends = [at(a, b) for a in x for b in y]
    return Span(0.0, _outward(0.0, max(ends)).high if y.low >= 0 else math.inf)


def _exp2(x: Span) -> Span:
    high = 2.0**x.high if x.high < 1000 else math.inf
    return _outward(2.0**x.low if x.low > -1000 else 0.0, high)


def _log2(x: Span) -> Span:
    low, high = (math.log2(end) if end > 0 else -math.inf for end in x)
    return _outward(low, high)


_RULES: Mapping[str, Callable[..., Span]] = {
    "add": _add,
    "mul": _mul,
    "reciprocal": _reciprocal,
    "abs": _abs,
    "min": lambda x, y: Span(min(x.low, y.low), min(x.high, y.high)),
    "max": lambda x, y: Span(max(x.low, y.low), max(x.high, y.high)),
    "where": lambda _condition, x, y: _hull(x, y),
    "sqrt": _sqrt,
    "inverse_root": _inverse_root,
    "power": _power,
    "exp2": _exp2,
    "log2": _log2,
    "sin": lambda _x: Span(-1.0, 1.0),
    "cos": lambda _x: Span(-1.0, 1.0),
    "tanh": lambda _x: Span(-1.0, 1.0),
    "arcsin": lambda _x: Span(-1.5708, 1.5708),
    "arctan": lambda _x: Span(-1.5708, 1.5708),
    "arctan2": lambda _y, _x: Span(-3.1416, 3.1416),
    "floor": lambda x: stepped("floor", x),
    "rint": lambda x: stepped("rint", x),
    "trunc": lambda x: stepped("trunc", x),
    "float": lambda x: x,
    "int": lambda x: stepped("trunc", x),
    "crossed": lambda x: x,
    "less": lambda _x, _y: UNIT,
    "equal": lambda _x, _y: UNIT,
    "not": lambda _x: UNIT,
    "and": lambda _x, _y: UNIT,
    "bit_and": lambda x, y: (
        Span(0.0, min(x.high, y.high)) if x.low >= 0 and y.low >= 0
        else Span(0.0, max(x.high, y.high)) if x.low >= 0 or y.low >= 0
        else ALL
    ),
    "shift_right": lambda x, _y: Span(0.0, x.high) if x.low >= 0 else ALL,
    "remainder": lambda _x, y: Span(0.0, y.high) if y.low >= 0 else ALL,
}  # fmt: skip
"""The spans of operations; of all others nothing is known."""
