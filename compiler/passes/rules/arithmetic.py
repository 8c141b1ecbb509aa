"""Simplification rules for sums, products, powers and other arithmetic."""

from __future__ import annotations

import math

from ...ir import build
from ...ir.node import HEADS, Node
from ...ir.operations import builtin_of
from ...ir.types import Scalar, Type, Vector, scalar_kind
from .builder import Builder, uniform_lane
from .conditions import (
    are_no_matrices,
    gives_float,
    gives_vector,
    is_matrix,
    is_no_matrix,
    is_scalar,
    is_signed,
    is_whole,
)
from .rule import Rule
from .terms import CONSTANT, NEG, Heads, Several, Variable, computed, condition, either, function
from .vocabulary import a, abs_, b, c, floor, max_, mix, pow_, sqrt, transpose, x, y

_ROUNDED = frozenset({"floor", "ceil", "round", "trunc", "sign", "step", "to_float"})
"""Builtins whose results are whole; conversions to floats are of integers and bools."""
_KEEPING = frozenset({"add", "sub", "mul", "neg", "abs", "min", "max"})
"""Builtins that make whole numbers of whole numbers."""
MAY_BE_WHOLE: Heads = _ROUNDED | _KEEPING
"""The heads of values that are worth a closer look by ``is_whole_number``."""
_MOVING = frozenset({"splat", "swizzle", "vector"})
"""Operations that only move lanes."""
_MOST = 16
"""Values that are looked at."""


@condition("{} is a whole number")
def is_whole_number(_builder: Builder, _type: Type, value: Node) -> bool:
    """True if every lane of a float is certainly a whole number."""
    pending, seen = [value], set[int]()
    while pending:
        node = pending.pop()
        if node.id in seen:
            continue
        seen.add(node.id)
        if len(seen) > _MOST:
            return False
        if node.op == "constant":
            number = uniform_lane(node)
            if number is None or number != int(number):
                return False
        elif builtin_of(node) in _KEEPING or node.op in _MOVING:
            pending += node.operands
        elif builtin_of(node) not in _ROUNDED:
            return False
    return True


LARGEST_EXPONENT = 100
"""The largest exponent of powers of two that rules combine.

Neither these nor their reciprocals come near the subnormal numbers.
"""
LARGEST_DIVISOR = 512.0
"""The largest divisor among whole numbers to whose quotients a half is added.

Where float64 has no halves beside them any more, it has no quotients by these either that are
closer to a whole number than to the next float64.
"""


# --- quotients -----------------------------------------------------------------------------------


@computed
def _reciprocal(builder: Builder, _type: Type, divisor: Node) -> Node | None:
    """The reciprocal of a power of two, which has an exact one."""
    number = uniform_lane(divisor)
    if number is None:
        return None
    fraction, exponent = math.frexp(abs(number))
    if fraction != 0.5 or abs(exponent) > LARGEST_EXPONENT:
        return None
    return builder.constant(divisor.type, 1 / number)


@condition(f"{{}} is a whole number in 2..{LARGEST_DIVISOR:g}")
def _is_small_divisor(_builder: Builder, _type: Type, divisor: Node) -> bool:
    """True if quotients by a constant are apart from whole numbers where they should be.

    With a quarter more, no error of 2.5 ulp reaches a whole number where the dividend is below 2^22
    / 5. From 2^23 on, float32 has neither quarters nor halves, and the sum is rounded to the
    dividend: nothing changes there.
    """
    number = uniform_lane(divisor)
    return number is not None and number == int(number) and 1 < number <= LARGEST_DIVISOR


# --- equal lanes ---------------------------------------------------------------------------------


def _equal_lane(builder: Builder, node: Node) -> Node | None:
    """The scalar that fills every lane of ``node``, if one does."""
    if isinstance(node.type, Scalar):
        return node
    if node.op == "splat":
        return node.operands[0]
    value, kind = uniform_lane(node), scalar_kind(node.type)
    if value is None or kind is None:
        return None
    return build.constant(builder.graph, Scalar(kind), value)


@computed
def _filled(builder: Builder, type_: Type, name: str, operands: tuple[Node, ...]) -> Node | None:
    """The operation of the scalars, in every lane, where all operands have equal lanes."""
    found = [_equal_lane(builder, each) for each in operands]
    scalars = [lane for lane in found if lane is not None]
    if len(scalars) < len(found) or not isinstance(type_, Vector):
        return None
    return builder.make("splat", type_, (builder.call(name, Scalar(type_.kind), *scalars),))


@computed
def _with_scalar(
    builder: Builder, type_: Type, name: str, operands: tuple[Node, ...]
) -> Node | None:
    """The operation with each vector of equal lanes as a scalar; one vector has to be left."""
    changed = []
    for each in operands:
        lane = _equal_lane(builder, each) if isinstance(each.type, Vector) else None
        changed.append(each if lane is None else lane)
    if tuple(changed) == operands or not any(isinstance(o.type, Vector) for o in changed):
        return None
    return builder.call(name, type_, *changed)


# --- matrices ------------------------------------------------------------------------------------


@condition("{} is the identity")
def _is_identity(_builder: Builder, _type: Type, matrix: Node) -> bool:
    return all(
        column.op == "constant" and column.data == tuple(map(float, unit))
        for column, unit in zip(matrix.operands, _units(len(matrix.operands)), strict=True)
    )


def _units(size: int) -> list[tuple[int, ...]]:
    """The columns of the identity."""
    return [tuple(int(row == column) for row in range(size)) for column in range(size)]


_ROUNDING = function("floor", "ceil", "round", "trunc", "fract")
_LINEAR = function("add", "sub", "mul", "div")
_PRODUCT = function("dot", "cross")
_WHOLE = Variable("n", MAY_BE_WHOLE)
_MATRIX = Variable("m", frozenset({HEADS["matrix"]}))
_EQUAL_LANES = Several("xs", some=CONSTANT | {HEADS["splat"]})

ARITHMETIC = (
    Rule("zero added", either(x + 0), x, "Adding zero changes nothing."),
    Rule("negation added", x + -y, x - y,
         "Adding what is negated is subtracting it.", where=is_whole(y)),
    Rule("common factor", either(x * a) + either(x * b), (a + b) * x,
         "The sum a * x + b * x is (a + b) * x, which is one product less.",
         where=(gives_float(), is_whole(x), is_whole(a), is_whole(b)), of_calls=True),
    Rule("zero subtracted", x - 0, x, "Subtracting zero changes nothing."),
    Rule("subtracted from zero", 0 - x, -x,
         "Zero minus a value is its negation.", where=is_signed(x)),
    Rule("subtracted from itself", x - x, 0,
         "A value minus itself is zero.", where=is_no_matrix(x)),
    Rule("times zero", either(x * 0), 0,
         "Zero times any finite value is zero.", where=is_no_matrix(x)),
    Rule("times one", either(x * 1), x,
         "A product with one is the other factor.", where=is_no_matrix(x)),
    Rule("times minus one", either(x * -1), -x,
         "A product with minus one is the other factor, negated.", where=is_no_matrix(x)),
    Rule("magnitude squared", abs_(x) * abs_(x), x * x,
         "The square of a magnitude is the square of the value."),
    Rule("divided by one", x / 1, x, "Dividing by one changes nothing.", where=is_no_matrix(x)),
    Rule("rounded quotient", _ROUNDING(x / c), _ROUNDING(x * _reciprocal(c)),
         "A product with a power of two is exact on every device, but a"
         " quotient may be less than the whole number that it is: x mod 2.0 would be 2."),
    Rule("quotient of whole numbers", floor(_WHOLE / c), floor((_WHOLE + 0.25) / c),
         "The quotient of a whole number, rounded down, is that of a"
         " quarter more, but a rounded one may be less than the whole number that it is: floor(x)"
         " mod 3.0 would be 3.",
         where=(gives_float(), _is_small_divisor(c), is_whole_number(_WHOLE))),
    Rule("zero divided", 0 / x, 0,
         "Zero divided by anything is zero: so is 0 / 0 by definition.", where=gives_float()),
    Rule("equal lanes", _LINEAR(_EQUAL_LANES), _filled(_LINEAR, _EQUAL_LANES),
         "Arithmetic with equal lanes in all operands is that of scalars, once.",
         where=(gives_vector(), are_no_matrices(_EQUAL_LANES)), of_calls=True),
    Rule("scalar operand", _LINEAR(_EQUAL_LANES), _with_scalar(_LINEAR, _EQUAL_LANES),
         "A vector of equal lanes is the scalar, which arithmetic takes as well.",
         where=(gives_vector(), are_no_matrices(_EQUAL_LANES)), of_calls=True),
    Rule("negated twice", NEG(NEG(x)), x, "The negation of a negation is the value."),
    Rule("to the power of one", pow_(x, 1), max_(x, 0),
         "The power of one is the value, but zero for negative values."),
    Rule("to the power of zero", pow_(x, 0), 1,
         "Everything to the power of zero is one, by definition."),
    Rule("squared", pow_(x, 2), max_(x, 0) * max_(x, 0),
         "The power of two is a product, but zero for negative values."),
    Rule("root as a power", pow_(x, 0.5), sqrt(x),
         "The power of a half is the root, which is zero for negative values."),
    Rule("root of a square", sqrt(x * x), abs_(x),
         "The root of a value times itself is its magnitude."),
    Rule("one to a power", pow_(1, x), 1, "One to any power is one."),
    Rule("mixed with weight zero", mix(x, y, 0), x,
         "With weight zero, only the first value counts."),
    Rule("mixed with weight one", mix(x, y, 1), y,
         "With weight one, only the second value counts."),
    # No weight is so large that the mixture loses the value by rounding.
    Rule("mixed with itself", mix(x, x, a), x,
         "A mixture of a value and itself is that value.", where=(a >= -1024, a <= 1024)),
    Rule("mixed from zero to one", mix(0, 1, x), x,
         "Between zero and one, the mixture is the weight."),
    Rule("product of zeros", either(_PRODUCT(0, x)), 0,
         "With a vector of zeros, every dot product and every cross is zero."),
    Rule("zero moved", x * 0, 0, "A matrix of finite numbers leaves zero where it is.",
         where=(is_matrix(x), gives_vector())),
    Rule("identity moves", either(_MATRIX * x), x, "The identity matrix changes nothing.",
         where=(is_whole(x), _is_identity(_MATRIX))),
    Rule("transposed twice", transpose(transpose(x)), x,
         "The transpose of a transpose is the matrix."),
    Rule("transposed around a factor", transpose(transpose(x) * a), x * a,
         "Two transposes cancel, with a scalar factor between them.", where=is_scalar(a)),
)  # fmt: skip
