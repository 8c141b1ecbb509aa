"""The table of the meaning of every builtin, for Python numbers and for arrays.

``evaluate`` is called for constants while compiling, for pictures of the reference, and by the
runtime for derived values. Nothing here imports NumPy, so that compiling does not need it; the
reference's pictures pass NumPy as ``xp``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Literal

from ...stdlib.builtins import texture, work_group
from . import (
    bit_functions,
    derivatives,
    floats,
    hyperbolic,
    integers,
    logic,
    matrices,
    scalars,
    texture_reads,
    vectors,
    work_groups,
)
from .namespace import Lane, Lanes, Namespace, WorkGroups

LaneKind = Literal["float", "int", "uint", "bool"]
Function = Callable[..., Lane]

_SHARED: Mapping[str, Function] = {
    "add": floats.add,
    "sub": floats.sub,
    "mul": floats.mul,
    "neg": floats.neg,
    "abs": floats.abs_,
    "min": floats.min_,
    "max": floats.max_,
    "clamp": floats.clamp,
}
"""Functions that have one definition for floats and for integers."""

_FLOATS: Mapping[str, Function] = {
    **_SHARED,
    "div": floats.div,
    "mod": floats.mod,
    "sign": floats.sign,
    "floor": floats.floor,
    "ceil": floats.ceil,
    "round": floats.round_,
    "trunc": floats.trunc,
    "fract": floats.fract,
    "saturate": floats.saturate,
    "mix": floats.mix,
    "step": floats.step,
    "smoothstep": floats.smoothstep,
    "sqrt": floats.sqrt,
    "inversesqrt": floats.inversesqrt,
    "pow": floats.pow_,
    "exp": floats.exp,
    "exp2": floats.exp2,
    "log": floats.log,
    "log2": floats.log2,
    "sin": floats.sin,
    "cos": floats.cos,
    "tan": floats.tan,
    "asin": floats.asin,
    "acos": floats.acos,
    "atan": floats.atan,
    "atan2": floats.atan2,
    "radians": floats.radians,
    "degrees": floats.degrees,
    "fma": floats.fma,
    "log10": floats.log10,
    "sinh": hyperbolic.sinh,
    "cosh": hyperbolic.cosh,
    "tanh": hyperbolic.tanh,
    "asinh": hyperbolic.asinh,
    "acosh": hyperbolic.acosh,
    "atanh": hyperbolic.atanh,
    "mantissa": bit_functions.mantissa,
    "ldexp": bit_functions.ldexp,
    "quantize_half": bit_functions.quantize_half,
}

_INTEGERS: Mapping[str, Function] = {
    **_SHARED,
    "div": integers.div,
    "mod": integers.mod,
    "sign": integers.sign,
    "bit_and": bit_functions.bit_and,
    "bit_or": bit_functions.bit_or,
    "bit_xor": bit_functions.bit_xor,
    "bit_not": bit_functions.bit_not,
    "shift_left": bit_functions.shift_left,
    "shift_right": bit_functions.shift_right,
    "reverse_bits": bit_functions.reverse_bits,
    "extract_bits": bit_functions.extract_bits,
    "insert_bits": bit_functions.insert_bits,
}
_SIGNED: Mapping[str, Function] = {"extract_bits": bit_functions.extract_signed_bits}
"""Functions whose definition for ``int`` differs from that for ``uint``."""

_OF_ANOTHER_KIND: Mapping[str, Function] = {
    "eq": logic.eq,
    "ne": logic.ne,
    "lt": logic.lt,
    "le": logic.le,
    "gt": logic.gt,
    "ge": logic.ge,
    "and": logic.and_,
    "or": logic.or_,
    "not": logic.not_,
    "choose": logic.choose,
    "count_bits": bit_functions.count_bits,
    "first_leading_bit": bit_functions.first_leading_bit,
    "first_trailing_bit": bit_functions.first_trailing_bit,
    "bits_of": bit_functions.bits_of,
    "float_of_bits": bit_functions.float_of_bits,
    "exponent": bit_functions.exponent,
}
"""Functions whose results need no wrapping, for operands of any type."""

_CONVERSIONS: Mapping[str, Function] = {
    "to_float": integers.to_float,
    "to_int": integers.to_int,
    "to_uint": integers.to_uint,
}

WHOLE: Mapping[str, Callable[..., Lanes]] = {
    "any": logic.any_,
    "all": logic.all_,
    "cross": vectors.cross,
    "length": vectors.length,
    "distance": vectors.distance,
    "normalize": vectors.normalize,
    "nonzero": vectors.nonzero,
    "reflect": vectors.reflect,
    "refract": vectors.refract,
    "faceforward": vectors.faceforward,
    "lit": vectors.lit,
    "ddx": derivatives.ddx,
    "ddy": derivatives.ddy,
    "transpose": matrices.transpose,
    "determinant": matrices.determinant,
    "outer": matrices.outer,
    "hadamard": matrices.hadamard,
    "pack_unorm4x8": bit_functions.pack_unorm,
    "pack_unorm2x16": bit_functions.pack_unorm,
    "pack_snorm4x8": bit_functions.pack_snorm,
    "pack_snorm2x16": bit_functions.pack_snorm,
    "pack_half2x16": bit_functions.pack_half2x16,
    "unpack_unorm4x8": bit_functions.unpack_unorm4x8,
    "unpack_unorm2x16": bit_functions.unpack_unorm2x16,
    "unpack_snorm4x8": bit_functions.unpack_snorm4x8,
    "unpack_snorm2x16": bit_functions.unpack_snorm2x16,
    "unpack_half2x16": bit_functions.unpack_half2x16,
    "inverse": matrices.inverse,
    **{row.name: texture_reads.reading(row.name) for row in texture.ROWS},
}
"""Functions of whole values, which do not work lane by lane."""

_OF_GROUPS = {row.name: row.of_group for row in work_group.ROWS}
"""Functions that join the values of many invocations."""

OF_NUMBERS = frozenset((
    "dot", *WHOLE, *_CONVERSIONS, *_OF_ANOTHER_KIND, *_SIGNED, *_INTEGERS, *_FLOATS,
))  # fmt: skip
"""The names of all functions of which numbers are known beforehand, such as those of a host."""


def evaluate(
    name: str,
    operands: Sequence[Lanes],
    xp: Namespace = scalars,
    kind: LaneKind = "float",
) -> Lanes:
    """The value of the builtin ``name``; ``kind`` is the type of the operands' lanes.

    A scalar is combined with every lane of a vector. Arrays of integers are 64 bits wide, so that
    results can be wrapped to 32 bits. Never raises for operands that fit the builtin's signatures;
    a result that is too large is infinite.
    """
    if (whole := WHOLE.get(name)) is not None:
        return whole(xp, *operands)
    if (row := _OF_GROUPS.get(name)) is not None:
        assert isinstance(xp, WorkGroups)
        join = partial(_lanewise(row.joins, kind), xp)
        return work_groups.joined(xp, join, row, *operands)
    if name == "dot":
        return _dot(operands, xp, kind)
    for lanes in operands:
        if isinstance(lanes[0], tuple):
            return _on_matrices(name, operands, xp)
    width = max(map(len, operands))
    if width > 1:
        operands = [lanes * width if len(lanes) == 1 else lanes for lanes in operands]
    function = _lanewise(name, kind)
    return tuple([function(xp, *lanes) for lanes in zip(*operands, strict=True)])


def is_lanewise(name: str) -> bool:
    """True if a builtin works lane by lane on vectors."""
    return name != "dot" and name not in WHOLE and name not in _OF_GROUPS


def _dot(operands: Sequence[Lanes], xp: Namespace, kind: LaneKind) -> Lanes:
    """The inner product; of integers, wrapped to 32 bits."""
    (product,) = vectors.dot(xp, *operands)
    return (integers.wrap(kind, product) if kind in ("int", "uint") else product,)


def _on_matrices(name: str, operands: Sequence[Lanes], xp: Namespace) -> Lanes:
    """An operator on matrices: the matrix product, or any other operator column by column."""
    if name == "mul":
        return matrices.mul(xp, *operands)
    return tuple(evaluate(name, columns, xp) for columns in zip(*operands, strict=True))


def _lanewise(name: str, kind: LaneKind) -> Function:
    """The function of an array library and lanes of type ``kind``; results of integers are
    wrapped."""
    if (function := _OF_ANOTHER_KIND.get(name)) is not None:
        return function
    if name in _CONVERSIONS:
        return partial(_convert, name, kind)
    if kind in ("int", "uint"):
        signed = _SIGNED.get(name) if kind == "int" else None
        return partial(_wrapped, signed or _INTEGERS[name], kind)
    return _FLOATS[name]


def _wrapped(function: Function, kind: integers.IntegerKind, xp: Namespace, *lanes: Lane) -> Lane:
    """The result of a function of integers, wrapped to 32 bits."""
    return integers.wrap(kind, function(xp, *lanes))


def _convert(name: str, source: LaneKind, xp: Namespace, x: Lane) -> Lane:
    """A conversion; one between integers keeps the bits."""
    if source == "float" or name == "to_float":
        return _CONVERSIONS[name](xp, x)
    return integers.wrap("int" if name == "to_int" else "uint", xp.int64(x))
