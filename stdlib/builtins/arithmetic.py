"""Rows for the operators on numbers: ``+ - * /``, ``mod`` and negation.

Integers are 32 bits wide and wrap. Division by zero has WGSL's result for integers, and is zero for
floats. ``mod`` rounds the quotient down, so that its result has the sign of the divisor.
"""

from __future__ import annotations

import math

from ...support.frozen import changed
from .accuracy import CORRECT, Error, Within, in_table, inherited, promised
from .facts import SMALLEST_NORMAL, ULP, Fact
from .intervals import around, inexact, products, quotients, rounded, squares
from .row import Builtin
from .weakest import ROUNDING, limit, relative

_LANEWISE = ("N, N -> N", "N, L -> N", "L, N -> N")
SIGNED = ("T -> T", "int -> int", "ivec2 -> ivec2", "ivec3 -> ivec3", "ivec4 -> ivec4")


def _sum(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts
    return rounded(x.lo + y.lo, x.hi + y.hi).as_kind(x.kind)


def _difference(facts: tuple[Fact, ...], same: bool) -> Fact:
    x, y = facts
    if same:
        return Fact(0.0, 0.0, kind=x.kind)
    return rounded(x.lo - y.hi, x.hi - y.lo).as_kind(x.kind)


def _product(facts: tuple[Fact, ...], same: bool) -> Fact:
    x, y = facts
    if "matrix" in (x.kind, y.kind):
        return Fact(kind="matrix")
    return rounded(*(squares(x) if same else products(x, y))).as_kind(x.kind)


def quotient_range(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts
    if x.kind != "float":
        return _whole_quotient(x, y)
    ends = quotients(x, y, SMALLEST_NORMAL, _USUAL_DIVISOR)
    if not y.excludes_zero:
        ends.append(0.0)
    if y.most <= _USUAL_DIVISOR:
        return inexact(min(ends), max(ends), _QUOTIENT_ERROR)
    # The quotient by a divisor whose reciprocal may be flushed to zero.
    far = quotients(x, y, _USUAL_DIVISOR, math.inf)
    beyond = inexact(min(far), max(far), _LARGEST_QUOTIENT_ERROR)
    return inexact(min(ends), max(ends), _QUOTIENT_ERROR).union(beyond) if ends else beyond


def _whole_quotient(x: Fact, y: Fact) -> Fact:
    ends: list[float] = [math.trunc(end) for end in quotients(x, y, 1.0, math.inf)]
    if not y.excludes_zero:
        ends += [x.lo, x.hi]
    return Fact(min(ends), max(ends)).as_kind(x.kind)


def _remainder(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts
    if x.kind != "float":
        return Fact(min(y.lo + 1, 0.0), max(y.hi - 1, 0.0)).as_kind(x.kind)
    exact = Fact(min(y.lo, 0.0), max(y.hi, 0.0))
    # Where the quotient is off, it may be rounded down to another whole number. Its product with y
    # is rounded, and so is the difference between x and that.
    quotient = _QUOTIENT_ERROR if y.most <= _USUAL_DIVISOR else _LARGEST_QUOTIENT_ERROR
    another = x.most * quotient
    of_product = (x.most + another + y.most) * ROUNDING
    of_difference = (y.most + another + of_product) * ROUNDING
    return around(exact, another + of_product + of_difference + (1.0 + y.most) * SMALLEST_NORMAL)


def _negated(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    return changed(x, lo=-x.hi, hi=-x.lo, kind="float").as_kind(x.kind)


def _divides(facts: tuple[Fact, ...]) -> bool:
    x, y = facts
    # The lowest integer divided by -1 overflows, and only WGSL defines the result.
    overflows = x.kind == "int" and x.lo == -(2.0**31) and y.lo <= -1 <= y.hi
    return y.excludes_zero and not overflows


def _whole(facts: tuple[Fact, ...]) -> bool:
    return facts[0].kind != "float"


def _unsigned(facts: tuple[Fact, ...]) -> bool:
    return facts[0].kind == "uint"


def _counts(facts: tuple[Fact, ...]) -> bool:
    x, y = facts
    return x.kind != "float" and x.lo >= 0 and y.lo >= 1


_FLUSHED = "the reciprocal of a larger divisor is subnormal, so it may be flushed to zero"
_LARGE = 2.0**126
_FLUSHED_QUOTIENT = Error(relative=1.0)
QUOTIENT = promised(
    Within(Error(ulp=2.5), _LARGE, beyond=_FLUSHED_QUOTIENT),
    # x * (1 / y), whose reciprocal has an error of 1 ulp.
    in_table(
        "direct3d",
        Within(Error(ulp=1.0, relative=ULP), _LARGE, beyond=_FLUSHED_QUOTIENT),
        beyond_assumed=_FLUSHED,
    ),
    beyond_assumed=_FLUSHED,
)
"""Quotients of floats; those of integers are exact."""
_USUAL_DIVISOR = limit(QUOTIENT)
_QUOTIENT_ERROR = relative(QUOTIENT)
_LARGEST_QUOTIENT_ERROR = relative(QUOTIENT, operand=math.inf)

ROWS = (
    Builtin(
        name="add",
        signatures=(*_LANEWISE, "M, M -> M"),
        meaning="sum",
        doc="Sum, lane by lane. Integers wrap.",
        operator="+",
        range=_sum,
        accuracy=CORRECT,
    ),
    Builtin(
        name="sub",
        signatures=(*_LANEWISE, "M, M -> M"),
        meaning="difference",
        doc="Difference, lane by lane. Integers wrap.",
        operator="-",
        range=_difference,
        accuracy=CORRECT,
    ),
    Builtin(
        name="mul",
        signatures=(*_LANEWISE, "M, O -> C", "M, Z -> Y", "M, S -> M", "S, M -> M"),
        meaning="product",
        doc="Product: lane by lane for numbers and vectors, that of linear algebra for matrices.",
        operator="*",
        definition="product",
        range=_product,
        accuracy=CORRECT,
    ),
    Builtin(
        name="div",
        signatures=_LANEWISE,
        meaning="quotient",
        doc="Quotient, lane by lane. Quotients of integers are truncated towards zero.",
        operator="/",
        domain=_divides,
        needs="the divisor is not 0, and no integer overflows",
        outside=(
            "A float over zero is 0. An integer over zero is the integer, "
            "and the lowest integer over -1 is itself, both as in WGSL."
        ),
        expansion="div",
        by_profile=_whole,
        range=quotient_range,
        accuracy=QUOTIENT,
        cost=4,
        samples=((1.0, 0.0), (0.0, 0.0), (-3.0, 0.0), (1.0, -0.0), (1.0, 1e-40), (7.0, -2.0)),
    ),
    Builtin(
        name="mod",
        signatures=_LANEWISE,
        meaning="remainder",
        doc=(
            "Remainder of the quotient rounded down; it has the sign of the divisor. Of floats, a "
            "quotient that a device computes roughly may be rounded down to another whole number: "
            "then the result is the divisor itself, like 41 for `x mod 41.0`, or up to some ulps "
            "beyond it or beyond 0. Quotients of whole floats up to 800 000 by whole constants up "
            "to 512 are exact, and quotients by constant powers of two."
        ),
        operator="%",
        domain=_counts,
        needs="integers, the first not negative, the divisor 1 or more",
        outside="Modulo zero, and modulo a magnitude below 2^-126, is 0.",
        expansion="modulo",
        by_profile=_unsigned,
        range=_remainder,
        accuracy=inherited("x - y * floor(x / y)"),
        cost=6,
        samples=((5.5, 2.0), (-5.5, 2.0), (5.5, -2.0), (-5.5, -2.0), (1.0, 0.0), (-0.25, 1.0)),
    ),
    Builtin(
        name="neg",
        signatures=(*SIGNED, "M -> M"),
        meaning="negation",
        doc="The value with the opposite sign. The lowest integer stays as it is.",
        operator="-",
        range=_negated,
        accuracy=CORRECT,
    ),
)
