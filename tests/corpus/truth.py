"""The meaning of each operation, written a second time from the manual (docs/builtins.md).

Floats are fractions, so nothing is rounded, and integers are Python's. A function gets the lanes of
each operand, and returns the lanes of the result; an integer need not be wrapped to 32 bits yet.
"""

from __future__ import annotations

import math
import operator
import struct
from collections.abc import Callable, Mapping
from fractions import Fraction
from itertools import permutations
from typing import Any

from . import decimals as d

TINY = Fraction(1, 2**126)
"""The smallest normal number; what is smaller counts as zero where it would matter."""
BELOW_ONE = 1 - Fraction(1, 2**24)
NARROWEST = Fraction(1, 2**64)

Lane = Any
Value = list[Lane]
"""The lanes of a value, those of a matrix column by column."""


# --- lane by lane ---------------------------------------------------------------------------------


def div(x: Lane, y: Lane) -> Lane:
    if isinstance(x, Fraction):
        return Fraction(0) if abs(y) < TINY else x / y
    return x if y == 0 else int(Fraction(x, y))


def mod(x: Lane, y: Lane) -> Lane:
    if isinstance(x, Fraction):
        return Fraction(0) if abs(y) < TINY else x - y * math.floor(x / y)
    return 0 if y == 0 else x - y * math.floor(Fraction(x, y))


def clamp(x: Lane, low: Lane, high: Lane) -> Lane:
    return high if high < max(x, low) else max(x, low)


def to_even(x: Fraction) -> int:
    below = math.floor(x)
    rest = x - below
    return below + (rest > Fraction(1, 2) or (rest == Fraction(1, 2) and below % 2))


def smoothstep(low: Fraction, high: Fraction, x: Fraction) -> Fraction:
    width = high - low
    if abs(width) < NARROWEST:
        width = NARROWEST
    t = clamp((x - low) / width, 0, 1)
    return Fraction(3 * t**2 - 2 * t**3)


def power(x: Fraction, y: Fraction) -> Lane:
    if x < TINY and y < TINY:
        return Fraction(abs(y) < TINY)
    return Fraction(0) if x < TINY else d.power(x, y)


def atan2(y: Fraction, x: Fraction) -> Lane:
    if abs(y) >= TINY:
        return d.atan2(y, x)
    return d.pi() if x <= -TINY else Fraction(0)


def truncated(least: int, most: int) -> Callable[[Lane], int]:
    """A conversion that keeps the bits of integers, and clamps floats to those that fit."""
    return lambda x: int(clamp(x, least, most) if isinstance(x, Fraction) else x)


def bits_of(x: Fraction) -> int:
    return 0 if abs(x) < TINY else int(struct.pack(">f", x).hex(), 16)


def float_of_bits(bits: int) -> Fraction:
    (number,) = struct.unpack(">f", (bits & 0xFFFFFFFF).to_bytes(4, "big"))
    return Fraction(number) if math.isfinite(number) and abs(number) >= TINY else Fraction(0)


def exponent(x: Fraction) -> int:
    return 0 if abs(x) < TINY else math.frexp(x)[1]


def ldexp(x: Fraction, n: int) -> Fraction:
    power_of_two: int = clamp(n, -252, 254)
    return x * Fraction(2) ** power_of_two


def half_bits(x: Fraction) -> int:
    number = struct.pack(">e", clamp(x, -65504, 65504))
    return int(number.hex(), 16) if any(number[1:]) or number[0] & 0x7F else 0


def of_half_bits(bits: int) -> Fraction:
    (number,) = struct.unpack(">e", bits.to_bytes(2, "big"))
    return Fraction(number) if math.isfinite(number) else Fraction(0)


def in_binary(x: int) -> str:
    """The 32 bits of an integer, the lowest first."""
    return f"{x & 0xFFFFFFFF:032b}"[::-1]


def of_binary(bits: str) -> int:
    return int(bits[::-1] or "0", 2)


def leading(x: int) -> int:
    return (x if x >= 0 else -1 - x).bit_length() - 1


def shift_right(x: int, by: int) -> int:
    return math.floor(Fraction(x, 2 ** (by % 32)))


def field(offset: int, count: int) -> slice:
    first = clamp(offset, 0, 32)
    return slice(first, first + clamp(count, 0, 32 - first))


def extract_bits(x: int, offset: int, count: int) -> int:
    return of_binary(in_binary(x)[field(offset, count)])


def extract_signed(x: int, offset: int, count: int) -> int:
    bits = in_binary(x)[field(offset, count)]
    return of_binary(bits) - (2 ** len(bits) if bits.endswith("1") else 0)


def insert_bits(x: int, y: int, offset: int, count: int) -> int:
    into, place = in_binary(x), field(offset, count)
    return of_binary(into[: place.start] + in_binary(y)[: place.stop - place.start]
                     + into[place.stop :])  # fmt: skip


LANEWISE: Mapping[str, Callable[..., Lane]] = {
    "add": operator.add, "sub": operator.sub, "mul": operator.mul, "neg": operator.neg,
    "div": div, "mod": mod, "abs": lambda x: x if x >= 0 else -x,
    "eq": operator.eq, "ne": operator.ne, "lt": operator.lt, "le": operator.le, "gt": operator.gt,
    "ge": operator.ge,
    "and": lambda x, y: bool(x) and bool(y), "or": lambda x, y: bool(x) or bool(y),
    "not": lambda x: not x, "choose": lambda c, x, y: x if c else y,
    "sign": lambda x: type(x)((x > 0) - (x < 0)),
    "floor": math.floor, "ceil": math.ceil, "trunc": int, "round": to_even,
    "fract": lambda x: x - math.floor(x), "saturate": lambda x: clamp(x, 0, 1),
    "min": lambda x, y: x if x < y else y, "max": lambda x, y: y if x < y else x, "clamp": clamp,
    "mix": lambda x, y, a: x + (y - x) * a, "fma": lambda x, y, z: x * y + z,
    "step": lambda edge, x: int(x >= edge), "smoothstep": smoothstep,
    "sqrt": lambda x: d.sqrt(max(x, Fraction(0))),
    "inversesqrt": lambda x: 1 / Fraction(d.sqrt(max(x, TINY))),
    "pow": power, "exp": d.exp, "exp2": lambda x: d.power(Fraction(2), x),
    "log": lambda x: d.ln(max(x, TINY)), "log2": lambda x: d.log2(max(x, TINY)),
    "log10": lambda x: d.log10(max(x, TINY)),
    "sin": d.sin, "cos": d.cos, "tan": d.tan,
    "asin": lambda x: d.asin(Fraction(clamp(x, -1, 1))),
    "acos": lambda x: d.acos(Fraction(clamp(x, -1, 1))), "atan": d.atan, "atan2": atan2,
    "radians": lambda x: x * Fraction(d.pi()) / 180,
    "degrees": lambda x: x * 180 / Fraction(d.pi()),
    "sinh": d.sinh, "cosh": d.cosh, "tanh": d.tanh, "asinh": d.asinh,
    "acosh": lambda x: d.acosh(max(x, Fraction(1))),
    "atanh": lambda x: d.atanh(clamp(x, -BELOW_ONE, BELOW_ONE)),
    "to_float": int, "to_int": truncated(-(2**31), 2**31 - 128),
    "to_uint": truncated(0, 2**32 - 256),
    "bit_and": operator.and_, "bit_or": operator.or_, "bit_xor": operator.xor,
    "bit_not": operator.invert,
    "shift_left": lambda x, by: x * 2 ** (by % 32), "shift_right": shift_right,
    "count_bits": lambda x: in_binary(x).count("1"),
    "reverse_bits": lambda x: of_binary(in_binary(x)[::-1]),
    "first_leading_bit": leading, "first_trailing_bit": lambda x: in_binary(x).find("1"),
    "extract_bits": extract_bits, "insert_bits": insert_bits,
    "bits_of": bits_of, "float_of_bits": float_of_bits, "exponent": exponent, "ldexp": ldexp,
    "mantissa": lambda x: x / Fraction(2) ** exponent(x) if abs(x) >= TINY else Fraction(0),
    "quantize_half": lambda x: of_half_bits(half_bits(x)),
}  # fmt: skip


# --- whole values ---------------------------------------------------------------------------------


def dot(x: Value, y: Value) -> Lane:
    return sum(map(operator.mul, x, y))


def cross(x: Value, y: Value) -> Value:
    return [
        determinant_of([[x[i], x[j]], [y[i], y[j]]]) for i, j in ((1, 2), (2, 0), (0, 1))
    ]  # fmt: skip


def length(v: Value) -> Lane:
    return d.sqrt(Fraction(dot(v, v)))


def normalize(v: Value) -> Value:
    size = Fraction(d.sqrt(max(dot(v, v), TINY)))
    return [lane / size for lane in v]


def reflect(i: Value, n: Value) -> Value:
    return [a - 2 * dot(n, i) * b for a, b in zip(i, n, strict=True)]


def refract(i: Value, n: Value, ratio: Value) -> Value:
    (eta,) = ratio
    square = 1 - eta**2 * (1 - dot(n, i) ** 2)
    if square < 0:
        return [Fraction(0)] * len(i)
    along = eta * dot(n, i) + Fraction(d.sqrt(square))
    return [eta * a - along * b for a, b in zip(i, n, strict=True)]


def faceforward(n: Value, i: Value, reference: Value) -> Value:
    return n if dot(reference, i) < 0 else [-lane for lane in n]


def lit(diffuse: Value, specular: Value, exponent: Value) -> Value:
    (nl,), (nh,), (m,) = diffuse, specular, exponent
    return [1, max(nl, 0), 0 if nl < 0 or nh < 0 else power(nh, m), 1]


def pack(largest: int, lowest: int) -> Callable[[Value], Value]:
    bits = (largest - lowest).bit_length()
    return lambda v: [
        sum(
            (to_even(clamp(lane, -1 if lowest else 0, 1) * largest) % 2**bits) << bits * place
            for place, lane in enumerate(v)
        )
    ]


def unpack(largest: int, lowest: int) -> Callable[[Value], Value]:
    bits = (largest - lowest).bit_length()

    def lanes(packed: Value) -> Value:
        parts = [packed[0] >> bits * place & (1 << bits) - 1 for place in range(32 // bits)]
        signed = [part - 2**bits if part > largest else part for part in parts]
        return [max(Fraction(part, largest), Fraction(-1)) for part in signed]

    return lanes


WHOLE: Mapping[str, Callable[..., Value]] = {
    "any": lambda v: [sum(v) > 0], "all": lambda v: [sum(v) == len(v)],
    "dot": lambda x, y: [dot(x, y)], "cross": cross, "length": lambda v: [length(v)],
    "distance": lambda x, y: [length([a - b for a, b in zip(x, y, strict=True)])],
    "normalize": normalize, "reflect": reflect, "refract": refract, "faceforward": faceforward,
    "lit": lit,
    "pack_unorm4x8": pack(255, 0), "pack_snorm4x8": pack(127, -127),
    "pack_unorm2x16": pack(65535, 0), "pack_snorm2x16": pack(32767, -32767),
    "pack_half2x16": lambda v: [half_bits(v[0]) | half_bits(v[1]) << 16],
    "unpack_unorm4x8": unpack(255, 0), "unpack_snorm4x8": unpack(127, -127),
    "unpack_unorm2x16": unpack(65535, 0), "unpack_snorm2x16": unpack(32767, -32767),
    "unpack_half2x16": lambda p: [of_half_bits(p[0] & 0xFFFF), of_half_bits(p[0] >> 16)],
}  # fmt: skip


# --- matrices -------------------------------------------------------------------------------------

Columns = list[Value]


def determinant_of(m: Columns) -> Lane:
    """By Leibniz: over all permutations, with their signs."""
    return sum(
        sign_of(order) * math.prod(column[row] for column, row in zip(m, order, strict=True))
        for order in permutations(range(len(m)))
    )


def sign_of(order: tuple[int, ...]) -> int:
    turned = sum(a > b for place, a in enumerate(order) for b in order[place + 1 :])
    return -1 if turned % 2 else 1


def inverse(m: Columns) -> Columns:
    """By Gauss and Jordan: the columns that the matrix turns into those of the identity."""
    size = len(m)
    if abs(determinant_of(m)) < TINY:
        return [[Fraction(0)] * size for _ in m]
    rows = [[m[c][r] for c in range(size)] + [Fraction(r == c) for c in range(size)]
            for r in range(size)]  # fmt: skip
    for place in range(size):
        pivot = next(r for r in range(place, size) if rows[r][place])
        rows[place], rows[pivot] = rows[pivot], rows[place]
        rows[place] = [lane / rows[place][place] for lane in rows[place]]
        for r in range(size):
            if r != place:
                factor = rows[r][place]
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[place], strict=True)]
    return [[rows[r][size + c] for r in range(size)] for c in range(size)]


def product(x: Columns, y: Columns) -> Columns:
    rows = range(len(x[0]))
    return [[sum(a[r] * b for a, b in zip(x, column, strict=True)) for r in rows] for column in y]


def multiplied(x: Columns, y: Columns) -> Columns:
    """A product in which at least one operand is a matrix; a scalar is a column of one lane."""
    if len(x) == 1:
        x, y = y, x
    if len(y) == 1 and len(y[0]) == 1:
        return [[lane * y[0][0] for lane in column] for column in x]
    return product(x, y)


def by_lanes(name: str) -> Callable[..., Columns]:
    """An operator that works lane by lane on matrices as well."""
    function = LANEWISE[name]
    return lambda *operands: [list(map(function, *columns)) for columns in zip(*operands)]  # noqa: B905


MATRICES: Mapping[str, Callable[..., Columns]] = {
    "add": by_lanes("add"), "sub": by_lanes("sub"), "neg": by_lanes("neg"),
    "hadamard": by_lanes("mul"), "mul": multiplied, "inverse": inverse,
    "transpose": lambda m: [list(row) for row in zip(*m, strict=True)],
    "determinant": lambda m: [[determinant_of(m)]],
    "outer": lambda x, y: [[a * b for a in x[0]] for b in y[0]],
}  # fmt: skip
"""Functions of values as columns; a vector is one column."""
