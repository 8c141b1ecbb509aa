"""Nodes that are a line of mathematics, and choices."""

from __future__ import annotations

from ..expressions import Binary, Call, Choice, Expression, Name, Number, Unary, binary, flat, splat
from ..networks import Application, Row
from ..values import LANES, as_float
from .application import Written, builtin

_NEUTRAL = {"+": 0.0, "-": 0.0, "*": 1.0, "/": 1.0}
"""What leaves the other operand as it is; on the left only where operands may be exchanged."""


def _infix(operator: str) -> Row:
    return lambda node: _operation(node, operator, *node.inputs("in1", "in2"))


def _operation(node: Application, operator: str, left: Expression, right: Expression) -> Expression:
    """An operation, without an operand that changes nothing."""
    neutral = _NEUTRAL[operator]
    if splat(right) == neutral and node.input_type("in1") == node.type:
        return left
    if operator in "+*" and splat(left) == neutral and node.input_type("in2") == node.type:
        return right
    if node.type.startswith("matrix") and node.input_type("in2") == "float" and operator in "+-":
        side = int(node.type[-1])
        right = Call(f"mat{side}", (Call(f"vec{side}", (right,)),) * side)
    if node.type == "integer":
        return Binary(operator, left, right)
    return binary(operator, left, right)


def _multiply(node: Application) -> Expression:
    left, right = node.inputs("in1", "in2")
    if node.type.startswith("matrix") and node.input_type("in2") == node.type:
        left, right = right, left
    return _operation(node, "*", left, right)


def _divide(node: Application) -> Expression:
    left, right = node.inputs("in1", "in2")
    if node.type.startswith("matrix") and node.input_type("in2") == node.type:
        return Binary("*", Call("inverse", (right,)), left)
    return _operation(node, "/", left, right)


def _modulo(node: Application) -> Expression:
    left, right = node.inputs("in1", "in2")
    if node.type == "integer":
        return Binary("-", left, Binary("*", right, Binary("/", left, right)))
    return binary("mod", left, right)


def _mix(node: Application) -> Expression:
    background, foreground, amount = node.inputs("bg", "fg", "mix")
    return Call("mix", (as_float(background), foreground, amount))


def _invert(node: Application) -> Expression:
    return binary("-", *node.inputs("amount", "in"))


def _remap(node: Application) -> Expression:
    """MaterialX divides last, which matters to the last bit."""
    value, low, high, to_low, to_high = node.inputs("in", "inlow", "inhigh", "outlow", "outhigh")
    scaled = _unless(1.0, "*", _unless(0.0, "-", value, low), _unless(0.0, "-", to_high, to_low))
    scaled = _unless(1.0, "/", scaled, _unless(0.0, "-", high, low))
    return scaled if splat(to_low) == 0 else binary("+", to_low, scaled)


def _unless(neutral: float, operator: str, left: Expression, right: Expression) -> Expression:
    return left if splat(right) == neutral else binary(operator, left, right)


def _comparison(operator: str) -> Row:
    def row(node: Application) -> Expression:
        left, right = node.inputs("value1", "value2")
        if node.input_type("value1") == "boolean":
            condition: Expression = _equal_truths(left, right)
        else:
            condition = _compared(operator, left, right)
        if node.type == "boolean" and "in1" not in _defined(node):
            return condition
        if condition in (Name("true"), Name("false")):
            return node.input("in1" if condition == Name("true") else "in2")
        positive, negative = node.inputs("in1", "in2")
        if node.type != "integer":
            positive, negative = as_float(positive), as_float(negative)
        return Choice(condition, positive, negative)

    return row


def _compared(operator: str, left: Expression, right: Expression) -> Expression:
    """A comparison; of whole numbers that are known, its value."""
    if _whole(left) is not None and _whole(right) is not None:
        return binary(operator, Number(float(_whole(left) or 0)), Number(float(_whole(right) or 0)))
    return binary(operator, left, right)


def _whole(expression: Expression) -> int | None:
    text = flat(expression)
    return (
        int(text)
        if text.removeprefix("-").isdigit() and not isinstance(expression, Number)
        else None
    )


def _equal_truths(left: Expression, right: Expression) -> Expression:
    if left in (Name("true"), Name("false")) and right in (Name("true"), Name("false")):
        return Name("true" if left == right else "false")
    for one, other in ((left, right), (right, left)):
        if one == Name("true"):
            return other
        if one == Name("false"):
            return Unary("not", other)
    return Binary("==", left, right)


def _defined(node: Application) -> frozenset[str]:
    assert node.node.definition is not None
    return frozenset(node.node.definition.inputs)


def _minimum_of_two(name: str) -> Row:
    def row(node: Application) -> Expression:
        left, right = node.inputs("in1", "in2")
        return Call(name, (as_float(left) if isinstance(right, Number) else left, right))

    return row


def _clamp(node: Application) -> Expression:
    value, low, high = node.inputs("in", "low", "high")
    if node.type != "integer" and splat(low) == 0 and splat(high) == 1:
        return Call("saturate", (as_float(value),))
    return Call("clamp", (as_float(value), low, high))


def _transform_by_matrix(node: Application) -> Expression:
    value, matrix = node.inputs("in", "mat")
    lanes = LANES[node.type]
    if int(node.input_type("mat")[-1]) == lanes:
        return Binary("*", matrix, value)
    lifted = Call(f"vec{lanes + 1}", (value, Number(1.0)))
    lane_names = "xyz"[:lanes]
    return Name(f"({flat(Binary('*', matrix, lifted))}).{lane_names}")


def _round_integer(name: str) -> Row:
    def row(node: Application) -> Expression:
        rounded = Call(name, (as_float(node.input("in")),))
        return Call("int", (rounded,)) if node.type == "integer" else rounded

    return row


_TWO = ("in1", "in2")
_COMPARED = ("value1", "value2")

ROWS: dict[str, Row] = {
    "add": Written("+", _TWO, _infix("+")),
    "subtract": Written("-", _TWO, _infix("-")),
    "multiply": Written("*", _TWO, _multiply),
    "divide": Written("/", _TWO, _divide),
    "modulo": Written("mod", _TWO, _modulo),
    "invert": _invert,
    "remap": _remap,
    "mix": Written("mix", ("bg", "fg", "mix"), _mix),
    "clamp": Written("clamp", ("in", "low", "high"), _clamp, {"saturate": ("in",)}),
    "min": Written("min", _TWO, _minimum_of_two("min")),
    "max": Written("max", _TWO, _minimum_of_two("max")),
    "power": builtin("pow", "in1", "in2"),
    "fract": builtin("fract", "in"),
    "absval": builtin("abs", "in"),
    "floor": Written("floor", ("in",), _round_integer("floor")),
    "ceil": Written("ceil", ("in",), _round_integer("ceil")),
    "round": Written("round", ("in",), _round_integer("round")),
    "sin": builtin("sin", "in"),
    "cos": builtin("cos", "in"),
    "tan": builtin("tan", "in"),
    "asin": builtin("asin", "in"),
    "acos": builtin("acos", "in"),
    "atan2": builtin("atan2", "iny", "inx"),
    "sqrt": builtin("sqrt", "in"),
    "ln": builtin("log", "in"),
    "exp": builtin("exp", "in"),
    "sign": builtin("sign", "in"),
    "normalize": builtin("normalize", "in"),
    "magnitude": builtin("length", "in"),
    "distance": builtin("distance", "in1", "in2"),
    "dotproduct": builtin("dot", "in1", "in2"),
    "crossproduct": builtin("cross", "in1", "in2"),
    "transpose": builtin("transpose", "in"),
    "determinant": builtin("determinant", "in"),
    "invertmatrix": builtin("inverse", "in"),
    "transformmatrix": _transform_by_matrix,
    "ifgreater": Written(">", _COMPARED, _comparison(">")),
    "ifgreatereq": Written(">=", _COMPARED, _comparison(">=")),
    "ifequal": Written("==", _COMPARED, _comparison("==")),
    "and": Written("and", _TWO, lambda node: Binary("and", *node.inputs("in1", "in2"))),
    "or": Written("or", _TWO, lambda node: Binary("or", *node.inputs("in1", "in2"))),
    "not": Written("not", ("in",), lambda node: Unary("not", node.input("in"))),
    "dot": lambda node: node.input("in"),
    "constant": lambda node: node.input("value"),
}
