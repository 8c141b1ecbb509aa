"""Simplification rules for sums, products, powers and other arithmetic."""

from __future__ import annotations

import math
from collections.abc import Callable

from ...ir import build
from ...ir.node import Node
from ...ir.types import Matrix, Scalar, Vector, scalar_kind
from .rule import (
    ANY,
    CONSTANT,
    Builder,
    Rule,
    Site,
    are_same,
    builtin,
    constant,
    inner,
    is_float,
    is_numeric,
    lanes,
    made,
    operand,
    uniform_lane,
)
from .whole_numbers import MAY_BE_WHOLE, is_whole

LARGEST_EXPONENT = 100
"""Of powers of two: neither these nor their reciprocals come near the subnormal numbers."""
LARGEST_DIVISOR = 512.0
"""Of whole numbers that a half is added to. Where float64 has no halves beside them any more, it
has no quotients by these either that are closer to a whole number than to the next float64."""


def _negated(b: Builder, at: Site) -> Node:
    return b.call("neg", at.type, b.fitted(at.operands[1], at.type))


def _is_whole_negation(_b: Builder, at: Site) -> bool:
    return at.operands[1].type == at.type


def _is_signed(_b: Builder, at: Site) -> bool:
    return scalar_kind(at.type) != "uint"


def _is_no_matrix_and_same(b: Builder, at: Site) -> bool:
    return are_same(b, at) and not isinstance(at.type, Matrix)


# --- a factor that two products share ------------------------------------------------------------


def _factored(b: Builder, at: Site) -> Node | None:
    """The factor has the type of the sum: no scalar part of a product is parted from it."""
    left, right = at.operands
    if at.op != "call" or not is_float(b, at) or _has_matrix(left) or _has_matrix(right):
        return None
    common = [o for o in left.operands if o in right.operands and o.type == at.type]
    if not common:
        return None
    rests = [_other(product, common[0]) for product in (left, right)]
    if not all(rest.type == at.type for rest in rests):
        return None
    return b.call("mul", at.type, b.call("add", at.type, *rests), common[0])


def _other(product: Node, factor: Node) -> Node:
    left, right = product.operands
    return right if left is factor else left


def _has_matrix(node: Node) -> bool:
    return any(isinstance(each.type, Matrix) for each in node.operands)


# --- equal lanes ---------------------------------------------------------------------------------


def _is_vector_call(b: Builder, at: Site) -> bool:
    return at.op == "call" and isinstance(at.type, Vector) and is_numeric(b, at)


def _equal_lane(b: Builder, node: Node) -> Node | None:
    """The scalar that fills every lane of ``node``, if one does."""
    if isinstance(node.type, Scalar):
        return node
    if node.op == "splat":
        return node.operands[0]
    value, kind = uniform_lane(node), scalar_kind(node.type)
    if value is None or kind is None:
        return None
    return build.constant(b.graph, Scalar(kind), value)


def _of_scalars(b: Builder, at: Site) -> Node | None:
    """The operation of the scalars, in every lane, where all operands have equal lanes."""
    found = [_equal_lane(b, each) for each in at.operands]
    scalars = [lane for lane in found if lane is not None]
    if len(scalars) < len(found) or not isinstance(at.type, Vector):
        return None
    return b.make("splat", at.type, (b.call(str(at.data), Scalar(at.type.kind), *scalars),))


def _with_scalar(b: Builder, at: Site) -> Node | None:
    """The operation with each vector of equal lanes as a scalar; one vector has to be left."""
    changed = []
    for each in at.operands:
        lane = _equal_lane(b, each) if isinstance(each.type, Vector) else None
        changed.append(each if lane is None else lane)
    if tuple(changed) == at.operands or not any(isinstance(o.type, Vector) for o in changed):
        return None
    return b.call(str(at.data), at.type, *changed)


_EQUAL_LANES = made("splat", "constant")


def _is_transposed_product(_b: Builder, at: Site) -> bool:
    return isinstance(at.operands[0].operands[1].type, Scalar)


def _untransposed(b: Builder, at: Site) -> Node:
    matrix, factor = at.operands[0].operands
    return b.call("mul", at.type, matrix.operands[0], factor)


def _is_moved(_b: Builder, at: Site) -> bool:
    """Whether a matrix is multiplied by a vector."""
    return isinstance(at.operands[0].type, Matrix) and isinstance(at.type, Vector)


def _is_moved_by_identity(_b: Builder, at: Site) -> bool:
    matrix, moved = at.operands
    return moved.type == at.type and all(
        column.op == "constant" and column.data == tuple(map(float, unit))
        for column, unit in zip(matrix.operands, _units(len(matrix.operands)), strict=True)
    )


def _units(size: int) -> list[tuple[int, ...]]:
    """The columns of the identity."""
    return [tuple(int(row == column) for row in range(size)) for column in range(size)]


# --- powers and mixtures -------------------------------------------------------------------------


def _has_exponent(exponent: float) -> Callable[[Builder, Site], bool]:
    return lambda _b, at: uniform_lane(at.operands[1]) == exponent


def _squared(b: Builder, at: Site) -> Node:
    base = b.call("max", at.type, at.operands[0], b.constant(at.type, 0))
    return b.call("mul", at.type, base, base)


def _ends_are_same(b: Builder, at: Site) -> bool:
    """Whether both ends are one value, which no weight is so large as to lose by rounding."""
    first, last, weight = at.operands
    return first is last and b.ranges.of(weight).within(-1024.0, 1024.0)


def _is_square(_b: Builder, at: Site) -> bool:
    left, right = at.operands[0].operands
    return left is right


def _of_exact_quotient(b: Builder, at: Site) -> Node | None:
    """The rounding of a product, in place of that of a quotient by a power of two."""
    (quotient,) = at.operands
    value, divisor = quotient.operands
    number = uniform_lane(divisor)
    if number is None:
        return None
    fraction, exponent = math.frexp(abs(number))
    if fraction != 0.5 or abs(exponent) > LARGEST_EXPONENT:
        return None
    reciprocal = b.constant(divisor.type, 1 / number)
    return b.call(str(at.data), at.type, b.call("mul", at.type, value, reciprocal))


def _of_middle(b: Builder, at: Site) -> Node | None:
    """The quotient of a quarter more, which is away from whole numbers.

    No error of 2.5 ulp reaches them where ``value`` is below 2^22 / 5. From 2^23 on, float32 has
    neither quarters nor halves, and the sum is rounded to ``value``: nothing changes there.
    """
    (quotient,) = at.operands
    value, divisor = quotient.operands
    number = uniform_lane(divisor)
    if number is None or number != int(number) or not 1 < number <= LARGEST_DIVISOR:
        return None
    if not is_whole(value):
        return None
    middle = b.call("add", value.type, value, b.constant(value.type, 0.25))
    return b.call("floor", at.type, b.make(quotient.op, quotient.type, (middle, divisor), "div"))


ARITHMETIC = (
    Rule("zero added", "Adding zero changes nothing.",
         ("add",), (lanes(0), ANY), operand(1), either=True),
    Rule("negation added", "Adding what is negated is subtracting it.",
         ("add",), (ANY, builtin("neg")),
         lambda b, at: b.call("sub", at.type, at.operands[0], at.operands[1].operands[0]),
         _is_whole_negation),
    Rule("common factor", "The sum a * x + b * x is (a + b) * x, which is one product less.",
         ("add",), (builtin("mul"), builtin("mul")), _factored),
    Rule("zero subtracted", "Subtracting zero changes nothing.",
         ("sub",), (ANY, lanes(0)), operand(0)),
    Rule("subtracted from zero", "Zero minus a value is its negation.",
         ("sub",), (lanes(0), ANY), _negated, _is_signed),
    Rule("subtracted from itself", "A value minus itself is zero.",
         ("sub",), (ANY, ANY), constant(0), _is_no_matrix_and_same),
    Rule("times zero", "Zero times any finite value is zero.",
         ("mul",), (lanes(0), ANY), constant(0), is_numeric, either=True),
    Rule("times one", "A product with one is the other factor.",
         ("mul",), (lanes(1), ANY), operand(1), is_numeric, either=True),
    Rule("times minus one", "A product with minus one is the other factor, negated.",
         ("mul",), (lanes(-1), ANY), _negated, is_numeric, either=True),
    Rule("magnitude squared", "The square of a magnitude is the square of the value.",
         ("mul",), (builtin("abs"), builtin("abs")),
         lambda b, at: b.call("mul", at.type, *at.operands[0].operands * 2), are_same),
    Rule("divided by one", "Dividing by one changes nothing.",
         ("div",), (ANY, lanes(1)), operand(0), is_numeric),
    Rule("rounded quotient", "A product with a power of two is exact on every device, but a"
         " quotient may be less than the whole number that it is: x mod 2.0 would be 2.",
         ("floor", "ceil", "round", "trunc", "fract"), (builtin("div", parts=(ANY, CONSTANT)),),
         _of_exact_quotient),
    Rule("quotient of whole numbers", "The quotient of a whole number, rounded down, is that of a"
         " quarter more, but a rounded one may be less than the whole number that it is: floor(x)"
         " mod 3.0 would be 3.",
         ("floor",), (builtin("div", parts=(MAY_BE_WHOLE, CONSTANT)),), _of_middle, is_float),
    Rule("zero divided", "Zero divided by anything is zero: so is 0 / 0 by definition.",
         ("div",), (lanes(0), ANY), constant(0), is_float),
    Rule("equal lanes", "Arithmetic with equal lanes in all operands is that of scalars, once.",
         ("add", "sub", "mul", "div"), ANY, _of_scalars, _is_vector_call, some=_EQUAL_LANES),
    Rule("scalar operand", "A vector of equal lanes is the scalar, which arithmetic takes as well.",
         ("add", "sub", "mul", "div"), ANY, _with_scalar, _is_vector_call, some=_EQUAL_LANES),
    Rule("negated twice", "The negation of a negation is the value.",
         ("neg",), (builtin("neg"),), inner),
    Rule("to the power of one", "The power of one is the value, but zero for negative values.",
         ("pow",), (ANY, lanes(1)),
         lambda b, at: b.call("max", at.type, at.operands[0], b.constant(at.type, 0))),
    Rule("to the power of zero", "Everything to the power of zero is one, by definition.",
         ("pow",), (ANY, lanes(0)), constant(1)),
    Rule("squared", "The power of two is a product, but zero for negative values.",
         ("pow",), (ANY, CONSTANT), _squared, _has_exponent(2)),
    Rule("root as a power", "The power of a half is the root, which is zero for negative values.",
         ("pow",), (ANY, CONSTANT), lambda b, at: b.call("sqrt", at.type, at.operands[0]),
         _has_exponent(0.5)),
    Rule("root of a square", "The root of a value times itself is its magnitude.",
         ("sqrt",), (builtin("mul"),),
         lambda b, at: b.call("abs", at.type, at.operands[0].operands[0]), _is_square),
    Rule("one to a power", "One to any power is one.",
         ("pow",), (lanes(1), ANY), constant(1)),
    Rule("mixed with weight zero", "With weight zero, only the first value counts.",
         ("mix",), (ANY, ANY, lanes(0)), operand(0)),
    Rule("mixed with weight one", "With weight one, only the second value counts.",
         ("mix",), (ANY, ANY, lanes(1)), operand(1)),
    Rule("mixed with itself", "A mixture of a value and itself is that value.",
         ("mix",), (ANY, ANY, ANY), operand(0), _ends_are_same),
    Rule("mixed from zero to one", "Between zero and one, the mixture is the weight.",
         ("mix",), (lanes(0), lanes(1), ANY), operand(2)),
    Rule("product of zeros", "With a vector of zeros, every dot product and every cross is zero.",
         ("dot", "cross"), (lanes(0), ANY), constant(0), either=True),
    Rule("zero moved", "A matrix of finite numbers leaves zero where it is.",
         ("mul",), (ANY, lanes(0)), constant(0), _is_moved),
    Rule("identity moves", "The identity matrix changes nothing.",
         ("mul",), (made("matrix"), ANY), operand(1), _is_moved_by_identity, either=True),
    Rule("transposed twice", "The transpose of a transpose is the matrix.",
         ("transpose",), (builtin("transpose"),), inner),
    Rule("transposed around a factor", "Two transposes cancel, with a scalar factor between them.",
         ("transpose",), (builtin("mul", parts=(builtin("transpose"), ANY)),),
         _untransposed, _is_transposed_product),
)  # fmt: skip
