"""Rows for builtins that treat integers as 32 bits, and for those that read the bits of floats."""

from __future__ import annotations

import math

from ...support.frozen import changed
from .accuracy import CORRECT, EXACT
from .facts import Fact
from .row import Builtin, everywhere, nowhere

_PAIR = ("I, I -> I",)
_SHIFT = ("I, U -> I", "I, J -> I", "I, uint -> I", "I, int -> I")
_TO_UINT = ("float -> uint", "vec2 -> uvec2", "vec3 -> uvec3", "vec4 -> uvec4")
_FROM_UINT = ("uint -> float", "uvec2 -> vec2", "uvec3 -> vec3", "uvec4 -> vec4")
_BY_32 = "Only the lowest five bits of the amount count, as in WGSL: `x << 33` is `x << 1`."
_FIELD = "The field ends at bit 31: an offset is clamped to 0 to 32, and the count to what is left."
BITS = 32


def _intersection(facts: tuple[Fact, ...], _same: bool) -> Fact:
    """No bit is added, so an operand that is not negative bounds the result."""
    ends = [fact.hi for fact in facts if fact.lo >= 0]
    kind = facts[0].kind
    return Fact(0.0, min(ends), kind=kind) if ends else Fact().as_kind(kind)


def _difference(facts: tuple[Fact, ...], _same: bool) -> Fact:
    """The range of an exclusive or.

    If no operand is negative, the highest bit of the operands is the highest of the result.
    """
    kind = facts[0].kind
    if any(fact.lo < 0 for fact in facts):
        return Fact().as_kind(kind)
    top = 2.0 ** int(max(fact.hi for fact in facts)).bit_length() - 1
    return Fact(0.0, top, kind=kind)


def _union(facts: tuple[Fact, ...], same: bool) -> Fact:
    """The range of bits that are set in one of the operands, of which none gets lost."""
    union = _difference(facts, same)
    return changed(union, lo=max(fact.lo for fact in facts)) if union.lo >= 0 else union


def _shifted_left(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, amount = facts
    if x.lo < 0 or not amount.within(0, BITS - 1):
        return Fact().as_kind(x.kind)
    return Fact(x.lo * 2.0**amount.lo, x.hi * 2.0**amount.hi).as_kind(x.kind)


def _shifted_right(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, amount = facts
    least = amount.lo if amount.within(0, BITS - 1) else 0.0
    most = amount.hi if amount.within(0, BITS - 1) else BITS - 1.0
    ends = [math.floor(end / 2.0**by) for end in (x.lo, x.hi) for by in (least, most)]
    return Fact(min(ends), max(ends), kind=x.kind)


def _shifts(facts: tuple[Fact, ...]) -> bool:
    """True where all backends agree: for a ``uint`` below 32."""
    amount = facts[1]
    return amount.kind == "uint" and amount.hi < BITS


def _count(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    return Fact(0.0, BITS, kind="int")


def _is_number(facts: tuple[Fact, ...]) -> bool:
    return facts[0].excludes_zero


def _are_numbers(facts: tuple[Fact, ...]) -> bool:
    """True if the bits are those of a number that is not zero, subnormal, infinite or NaN."""
    (x,) = facts
    return x.within(0x00800000, 0x7F7FFFFF) or x.within(0x80800000, 0xFF7FFFFF)


ROWS = (
    Builtin(
        name="bit_and",
        signatures=_PAIR,
        doc="The bits that are set in both operands.",
        operator="&",
        range=_intersection,
        accuracy=EXACT,
    ),
    Builtin(
        name="bit_or",
        signatures=_PAIR,
        doc="The bits that are set in at least one operand.",
        operator="|",
        range=_union,
        accuracy=EXACT,
    ),
    Builtin(
        name="bit_xor",
        signatures=_PAIR,
        doc="The bits that are set in exactly one operand.",
        operator="^",
        range=_difference,
        accuracy=EXACT,
    ),
    Builtin(
        name="bit_not",
        signatures=("I -> I",),
        doc="All bits inverted.",
        operator="~",
        accuracy=EXACT,
    ),
    Builtin(
        name="shift_left",
        signatures=_SHIFT,
        doc="The bits shifted up and filled with zeros. The amount is an `int` or a `uint`.",
        operator="<<",
        domain=_shifts,
        needs="the amount is a `uint` below 32",
        outside=_BY_32,
        expansion="shift_left",
        by_profile=everywhere,
        range=_shifted_left,
        accuracy=EXACT,
        samples=((1, 31), (1, 32), (1, 33), (-1, 4)),
    ),
    Builtin(
        name="shift_right",
        signatures=_SHIFT,
        doc=(
            "The bits shifted down. An `int` is filled with copies of its sign, so the result is "
            "the quotient by a power of two, rounded down; a `uint` is filled with zeros."
        ),
        operator=">>",
        domain=_shifts,
        needs="the amount is a `uint` below 32",
        outside=_BY_32,
        expansion="shift_right",
        by_profile=everywhere,
        range=_shifted_right,
        accuracy=EXACT,
        samples=((-16, 2), (1, 32), (-1, 31), (-1, 33)),
    ),
    Builtin(
        name="count_bits",
        signatures=("I -> J",),
        doc="The number of bits that are set.",
        definition="count_bits",
        range=_count,
        accuracy=EXACT,
        cost=2,
        samples=((0,), (-1,), (1,)),
    ),
    Builtin(
        name="reverse_bits",
        signatures=("I -> I",),
        doc="The bits in the opposite order.",
        definition="reverse_bits",
        accuracy=EXACT,
        cost=2,
        samples=((0,), (1,), (-2,)),
    ),
    Builtin(
        name="first_leading_bit",
        signatures=("I -> J",),
        doc=(
            "The position of the highest bit that is set, counted from 0; for a negative `int`, of "
            "the highest that is not set. -1 if there is none."
        ),
        definition="first_leading_bit",
        accuracy=EXACT,
        cost=2,
        samples=((0,), (-1,), (1,), (-2,)),
    ),
    Builtin(
        name="first_trailing_bit",
        signatures=("I -> J",),
        doc="The position of the lowest bit that is set, counted from 0; -1 if there is none.",
        definition="first_trailing_bit",
        accuracy=EXACT,
        cost=2,
        samples=((0,), (-1,), (8,)),
    ),
    Builtin(
        name="extract_bits",
        signatures=("I, int, int -> I",),
        doc=(
            "extract_bits(x, offset, count): `count` bits of x from bit `offset` on, moved down to "
            "bit 0. For an `int`, the highest of them is the sign."
        ),
        domain=nowhere,
        outside=_FIELD,
        expansion="extract_bits",
        accuracy=EXACT,
        cost=6,
        samples=((-256, 4, 8), (7, 0, 0), (-1, 28, 9), (-1, -3, 40), (5, 40, 2)),
    ),
    Builtin(
        name="insert_bits",
        signatures=("I, I, int, int -> I",),
        doc=(
            "insert_bits(x, y, offset, count): x, in which the lowest `count` bits of y replace "
            "those from bit `offset` on."
        ),
        domain=nowhere,
        outside=_FIELD,
        expansion="insert_bits",
        accuracy=EXACT,
        cost=8,
        samples=((0, -1, 4, 8), (7, 0, 0, 0), (0, -1, 28, 9), (5, -1, 40, 2)),
    ),
    Builtin(
        name="bits_of",
        signatures=_TO_UINT,
        doc="The bits of the float32 (IEEE 754 binary32): sign, 8 of exponent, 23 of fraction.",
        domain=_is_number,
        needs="the operand is not 0",
        outside="Magnitudes below 2^-126 and -0.0 count as 0, whose bits are 0.",
        expansion="bits_of",
        accuracy=EXACT,
        samples=((0.0,), (-0.0,), (1.0,), (-2.5,), (1e-40,), (3.4028234663852886e38,)),
    ),
    Builtin(
        name="float_of_bits",
        signatures=_FROM_UINT,
        doc="The float32 that has these bits.",
        domain=_are_numbers,
        needs="the bits of a number that is not 0",
        outside=(
            "0 for the bits of infinities and NaN, and of all magnitudes below 2^-126, which "
            "include the zeros."
        ),
        expansion="float_of_bits",
        accuracy=EXACT,
        cost=3,
        samples=((0x3F800000,), (0x7F800000,), (0x7FC00000,), (1,), (0x80000000,), (0xFF7FFFFF,)),
    ),
    Builtin(
        name="exponent",
        signatures=("float -> int", "vec2 -> ivec2", "vec3 -> ivec3", "vec4 -> ivec4"),
        doc="The n for which x is mantissa(x) * 2^n; see `mantissa`.",
        domain=nowhere,
        outside="0 for magnitudes below 2^-126.",
        expansion="exponent",
        accuracy=EXACT,
        cost=4,
        samples=((0.0,), (1.0,), (-0.75,), (1e-40,)),
    ),
    Builtin(
        name="mantissa",
        signatures=("T -> T",),
        doc="x / 2^exponent(x): from 1/2 to below 1 in magnitude, with the sign of x.",
        domain=nowhere,
        outside="0 for magnitudes below 2^-126.",
        expansion="mantissa",
        accuracy=EXACT,
        cost=4,
        samples=((0.0,), (1.0,), (-0.75,), (1e-40,)),
    ),
    Builtin(
        name="ldexp",
        signatures=("T, J -> T", "T, int -> T"),
        doc="ldexp(x, n): x * 2^n, without any rounding.",
        domain=nowhere,
        outside="n is clamped to -252 to 254, far beyond what float32 holds.",
        expansion="ldexp",
        accuracy=CORRECT,
        cost=8,
        samples=((0.75, 3.0), (1.0, -126.0), (1.0, 127.0), (3.0, -400.0)),
    ),
)
