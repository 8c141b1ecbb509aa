"""Defines the meaning of builtins that work on bits, and of those that pack numbers.

``functions.py`` has them in its table. Most functions work lane by lane. Integers come in and go
out as numbers of either sign; ``functions.py`` wraps the result to 32 bits. Floats are rounded to
float32, or to 16 bits: to the nearest number, and to an even one in the middle between two.
"""

from __future__ import annotations

from collections.abc import Callable

from ...stdlib.builtins.facts import LARGEST_FLOAT, SMALLEST_NORMAL
from .namespace import Lane, Lanes, Namespace, OwnFunctions

_MASK = 0xFFFFFFFF
_LARGEST_HALF = 65504.0
_LEAST_EXPONENT, _MOST_EXPONENT = -252, 254


def bit_and(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x & y


def bit_or(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x | y


def bit_xor(_xp: Namespace, x: Lane, y: Lane) -> Lane:
    return x ^ y


def bit_not(_xp: Namespace, x: Lane) -> Lane:
    return ~x


def shift_left(_xp: Namespace, x: Lane, amount: Lane) -> Lane:
    return x << (amount & 31)


def shift_right(_xp: Namespace, x: Lane, amount: Lane) -> Lane:
    return x >> (amount & 31)


def count_bits(_xp: Namespace, x: Lane) -> Lane:
    bits = x & _MASK
    bits = bits - ((bits >> 1) & 0x55555555)
    bits = (bits & 0x33333333) + ((bits >> 2) & 0x33333333)
    bits = (bits + (bits >> 4)) & 0x0F0F0F0F
    return ((bits * 0x01010101) & _MASK) >> 24


def reverse_bits(_xp: Namespace, x: Lane) -> Lane:
    bits = x & _MASK
    for mask, by in (
        (0x55555555, 1), (0x33333333, 2), (0x0F0F0F0F, 4), (0x00FF00FF, 8), (0x0000FFFF, 16),
    ):  # fmt: skip
        bits = ((bits >> by) & mask) | ((bits & mask) << by)
    return bits


def first_leading_bit(xp: Namespace, x: Lane) -> Lane:
    bits = xp.where(x < 0, ~x, x)
    for by in (1, 2, 4, 8, 16):
        bits = bits | (bits >> by)
    return count_bits(xp, bits) - 1


def first_trailing_bit(xp: Namespace, x: Lane) -> Lane:
    return xp.where(x == 0, -1, count_bits(xp, ~x & (x - 1)))


def _field(xp: Namespace, offset: Lane, count: Lane) -> tuple[Lane, Lane]:
    """The first bit of a field and its width, both limited to the 32 bits of an integer."""
    first = xp.minimum(xp.maximum(offset, 0), 32)
    return first, xp.minimum(xp.maximum(count, 0), 32 - first)


def extract_bits(xp: Namespace, x: Lane, offset: Lane, count: Lane) -> Lane:
    """The meaning for ``uint``; ``extract_signed_bits`` is that for ``int``."""
    first, width = _field(xp, offset, count)
    return ((x & _MASK) >> first) & ((1 << width) - 1)


def extract_signed_bits(xp: Namespace, x: Lane, offset: Lane, count: Lane) -> Lane:
    _, width = _field(xp, offset, count)
    bits = extract_bits(xp, x, offset, count)
    sign = (1 << width) >> 1
    return (bits ^ sign) - sign


def insert_bits(xp: Namespace, x: Lane, y: Lane, offset: Lane, count: Lane) -> Lane:
    first, width = _field(xp, offset, count)
    lowest = (1 << width) - 1
    return (x & ~(lowest << first)) | ((y & lowest) << first)


# --- floats --------------------------------------------------------------------------------------


def bits_of(xp: Namespace, x: Lane) -> Lane:
    magnitude = xp.minimum(abs(x), LARGEST_FLOAT)
    bits = _rising(xp, _bits_of_magnitude, magnitude)
    signed = xp.where(x < 0, bits | 0x80000000, bits)
    return xp.where(magnitude < SMALLEST_NORMAL, 0, signed)


def _rising(xp: Namespace, function: Callable[[Namespace, Lane], Lane], x: Lane) -> Lane:
    """A function that never falls: the values at two numbers are bounds of those between."""
    return xp.rising(function, x) if isinstance(xp, OwnFunctions) else function(xp, x)


def _bits_of_magnitude(xp: Namespace, magnitude: Lane) -> Lane:
    part, exponent = _taken_apart(xp, magnitude)
    # A fraction that is rounded up to 2 carries into the exponent, which is correct.
    return ((exponent + 126) << 23) + xp.int64(xp.rint(part * 2.0**24)) - (1 << 23)


def _taken_apart(xp: Namespace, x: Lane) -> tuple[Lane, Lane]:
    part, exponent = xp.frexp(x)
    return part, xp.int64(exponent)


def float_of_bits(xp: Namespace, bits: Lane) -> Lane:
    exponent = (bits >> 23) & 0xFF
    is_number = xp.logical_and(exponent > 0, exponent < 0xFF)
    fraction = xp.float64((bits & 0x7FFFFF) | 0x800000)
    value = xp.ldexp(fraction, xp.where(is_number, exponent, 127) - 150)
    return xp.where(is_number, xp.where((bits >> 31) & 1 == 1, -value, value), 0.0)


def exponent(xp: Namespace, x: Lane) -> Lane:
    bits = bits_of(xp, x)
    return xp.where(bits == 0, 0, ((bits >> 23) & 0xFF) - 126)


def mantissa(xp: Namespace, x: Lane) -> Lane:
    """The fraction of the float32 nearest to ``x``; ``exponent`` uses the same number."""
    part, _ = _taken_apart(xp, float_of_bits(xp, bits_of(xp, x)))
    return part


def ldexp(xp: Namespace, x: Lane, n: Lane) -> Lane:
    return xp.ldexp(x, xp.minimum(xp.maximum(n, _LEAST_EXPONENT), _MOST_EXPONENT))


# --- packing -------------------------------------------------------------------------------------


def _half_bits(xp: Namespace, x: Lane) -> Lane:
    bits = _rising(xp, _half_bits_of_magnitude, xp.minimum(abs(x), _LARGEST_HALF))
    return xp.where(xp.logical_and(x < 0, bits > 0), bits | 0x8000, bits)


def _half_bits_of_magnitude(xp: Namespace, magnitude: Lane) -> Lane:
    part, exponent = _taken_apart(xp, magnitude)
    normal = ((exponent + 14) << 10) + xp.int64(xp.rint(part * 2.0**11)) - (1 << 10)
    return xp.where(magnitude < 2.0**-14, xp.int64(xp.rint(magnitude * 2.0**24)), normal)


def _half_of_bits(xp: Namespace, bits: Lane) -> Lane:
    exponent, fraction = (bits >> 10) & 31, xp.float64(bits & 0x3FF)
    normal = xp.ldexp(fraction + 1024.0, exponent - 25)
    magnitude = xp.where(exponent == 0, fraction * 2.0**-24, xp.where(exponent == 31, 0.0, normal))
    return xp.where(bits & 0x8000 == 0, magnitude, -magnitude)


def quantize_half(xp: Namespace, x: Lane) -> Lane:
    return _half_of_bits(xp, _half_bits(xp, x))


def pack_half2x16(xp: Namespace, v: Lanes) -> Lanes:
    return _joined([_half_bits(xp, lane) for lane in v])


def unpack_half2x16(xp: Namespace, packed: Lanes) -> Lanes:
    return tuple(_half_of_bits(xp, bits) for bits in _parted(packed, 2))


def pack_unorm(xp: Namespace, v: Lanes) -> Lanes:
    """Any number of lanes, in equal parts of 32 bits."""
    largest = float((1 << 32 // len(v)) - 1)
    clamped = [xp.minimum(xp.maximum(lane, 0.0), 1.0) for lane in v]
    return _joined([xp.int64(xp.rint(lane * largest)) for lane in clamped])


def pack_snorm(xp: Namespace, v: Lanes) -> Lanes:
    largest = float((1 << 32 // len(v) - 1) - 1)
    clamped = [xp.minimum(xp.maximum(lane, -1.0), 1.0) for lane in v]
    return _joined([xp.int64(xp.rint(lane * largest)) for lane in clamped])


def unpack_unorm4x8(xp: Namespace, packed: Lanes) -> Lanes:
    return _unpack_unorm(xp, packed, 4)


def unpack_unorm2x16(xp: Namespace, packed: Lanes) -> Lanes:
    return _unpack_unorm(xp, packed, 2)


def unpack_snorm4x8(xp: Namespace, packed: Lanes) -> Lanes:
    return _unpack_snorm(xp, packed, 4)


def unpack_snorm2x16(xp: Namespace, packed: Lanes) -> Lanes:
    return _unpack_snorm(xp, packed, 2)


def _unpack_unorm(xp: Namespace, packed: Lanes, count: int) -> Lanes:
    largest = float((1 << 32 // count) - 1)
    return tuple(xp.float64(bits) / largest for bits in _parted(packed, count))


def _unpack_snorm(xp: Namespace, packed: Lanes, count: int) -> Lanes:
    sign = 1 << 32 // count - 1
    parts = ((bits ^ sign) - sign for bits in _parted(packed, count))
    return tuple(xp.maximum(xp.float64(part) / (sign - 1.0), -1.0) for part in parts)


def _joined(parts: list[Lane]) -> Lanes:
    """The parts in one ``uint``, the first part in the lowest bits."""
    bits = 32 // len(parts)
    joined: Lane = 0
    for number, part in enumerate(parts):
        joined = joined | ((part & ((1 << bits) - 1)) << (number * bits))
    return (joined,)


def _parted(packed: Lanes, count: int) -> list[Lane]:
    bits = 32 // count
    return [(packed[0] >> (number * bits)) & ((1 << bits) - 1) for number in range(count)]
