"""What each kind of expression means: literals, names and operators; the others have own files."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import isinf, radians
from typing import TYPE_CHECKING, Any

from ...diagnostics import rules
from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.source import Span
from ...ir import build
from ...ir.meaning import ANGLE, RGB, RGBA
from ...ir.node import Node
from ...ir.types import (
    BOOL,
    FLOAT,
    INT,
    UINT,
    Array,
    Matrix,
    Scalar,
    Struct,
    Texture,
    Vector,
    width,
)
from ...syntax import ast
from ...trampoline import Reply, Step
from ..declarations import contracts
from ..declarations.written_types import declared_type
from ..hints import advice
from ..state.scope import FAILURE, Failure, Scope, Value
from ..types.coercion import coerce
from . import aggregates, calls, combinations, conversions, lookup, loops

if TYPE_CHECKING:
    from ..state.context import Lowering

OPERATORS: Mapping[str, str] = {
    "+": "add", "-": "sub", "*": "mul", "/": "div", "mod": "mod",
    "==": "eq", "!=": "ne", "<": "lt", "<=": "le", ">": "gt", ">=": "ge",
    "&": "bit_and", "|": "bit_or", "^": "bit_xor", "<<": "shift_left", ">>": "shift_right",
    "and": "and", "or": "or",
}  # fmt: skip
PREFIXES: Mapping[str, str] = {"-": "neg", "~": "bit_not", "not": "not"}
SWIZZLES: Mapping[str, Mapping[str, int]] = {
    letters: {letter: i for i, letter in enumerate(letters)} for letters in ("xyzw", "rgba")
}
LOWEST = str(2**31)
"""An `int` only with a minus in front."""


# --- literals ------------------------------------------------------------------------------------


def _number(low: Lowering, e: ast.Number, _scope: Scope) -> Value:
    if e.kind in ("int", "uint"):
        limit, type_ = (2**31 - 1, INT) if e.kind == "int" else (2**32 - 1, UINT)
        whole = int(e.text, 16 if e.text[:2] in ("0x", "0X") else 10)
        if whole > limit:
            hint: Hint = ""
            if whole < 2**32:
                place = Span(e.span.source, e.span.end, e.span.end)
                hint = fix_it("write it as a `uint`, with `u` behind it", (place, "u"))
            low.report.add(rules.NUMBER_TOO_LARGE, e.span, text=e.text, type=type_, hint=hint)
            return FAILURE
        return build.constant(low.graph, type_, whole)
    value = float(e.text)
    if isinf(value) or value > 3.4028234663852886e38:
        low.report.add(rules.NUMBER_TOO_LARGE, e.span, text=e.text, type=FLOAT)
        return FAILURE
    number = build.floating(low.graph, radians(value) if e.unit == "deg" else value)
    return low.meanings.ascribed(number, ANGLE) if e.unit else number


def linear(channel: int) -> float:
    """An 8-bit sRGB channel as linear light in 0..1 (IEC 61966-2-1)."""
    value = channel / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def _color(low: Lowering, e: ast.Color, _scope: Scope) -> Value:
    lanes = [linear(channel) for channel in e.channels[:3]]
    lanes += [channel / 255 for channel in e.channels[3:]]
    color = build.constant(low.graph, Vector("float", len(lanes)), tuple(lanes))
    return low.meanings.ascribed(color, RGB if len(lanes) == 3 else RGBA)


def _boolean(low: Lowering, e: ast.Boolean, _scope: Scope) -> Value:
    return build.constant(low.graph, BOOL, e.value)


# --- names ---------------------------------------------------------------------------------------


def _reference(low: Lowering, e: ast.Reference, scope: Scope) -> Reply[Value]:
    return lookup.value(low, e.name, e.span, scope)


def _field(low: Lowering, e: ast.Field, scope: Scope) -> Step[Value]:
    value: Value = yield low.expression(e.operand, scope)
    result: Value = yield low.part(value, e)
    return result


def component(low: Lowering, node: Node, e: ast.Field) -> Node | Failure:
    name = e.name
    if isinstance(node.type, Struct):
        members = dict(node.type.members)
        if name.text in members:
            return build.member(low.graph, node, name.text)
        lookup.unknown(low, "member", name.text, name.span, members)
        return FAILURE
    if isinstance(node.type, Vector | Scalar):
        lanes = _swizzle_lanes(name.text, width(node.type))
        if lanes is not None:
            whole = build.swizzle(low.graph, node, lanes)
            is_color = low.meanings.of(node) == RGB and name.text == "rgb"
            return whole if is_color or whole is not node else low.meanings.ascribed(node, None)
    low.report.add(
        rules.NO_MEMBER, name.span, name=name.text, type=node.type,
        hint=advice.missing_member(node.type, name.text, e.span),
    )  # fmt: skip
    return FAILURE


def _swizzle_lanes(text: str, lanes: int) -> tuple[int, ...] | None:
    for letters in SWIZZLES.values():
        found = tuple(letters.get(letter, 4) for letter in text)
        if len(found) <= 4 and all(lane < lanes for lane in found):
            return found
    return None


def _index(low: Lowering, e: ast.Index, scope: Scope) -> Step[Value]:
    operand = yield low.node(e.operand, scope)
    if isinstance(operand, Node) and isinstance(operand.type, Texture):
        low.report.add(rules.NOT_INDEXABLE, e.span, type=operand.type, hint=advice.READ)
        return FAILURE
    position = yield low.typed(e.index, scope, INT, "int")
    if isinstance(operand, Failure) or isinstance(position, Failure):
        return FAILURE
    match operand.type:
        case Array(count=count) | Vector(size=count) | Matrix(size=count):
            pass
        case _:
            low.report.add(rules.NOT_INDEXABLE, e.span, type=operand.type)
            return FAILURE
    known = low.constants.known_integer(position)
    if known is not None:
        if not 0 <= known < count:
            highest = str(count - 1)
            hint = fix_it(f"counted from 0, the last one is `[{highest}]`", (e.index.span, highest))
            low.report.add(
                rules.OUT_OF_BOUNDS, e.index.span, index=known, type=operand.type, hint=hint
            )
            return FAILURE
        return build.part(low.graph, operand, known)
    zero, last = (build.constant(low.graph, INT, n) for n in (0, count - 1))
    clamped = low.graph.node("call", INT, (position, zero, last), "clamp")
    return build.index(low.graph, operand, clamped)


# --- operators -----------------------------------------------------------------------------------


def _is_lowest(number: ast.Number) -> bool:
    return number.kind == "int" and number.text == LOWEST


def _unary(low: Lowering, e: ast.Unary, scope: Scope) -> Step[Value]:
    if e.operator == "-" and isinstance(e.operand, ast.Number) and _is_lowest(e.operand):
        return build.constant(low.graph, INT, -int(LOWEST))
    operand = yield low.node(e.operand, scope)
    if isinstance(operand, Failure):
        return FAILURE
    name = PREFIXES[e.operator]
    return low.builtin(name, (operand,), e.span, e.operator, (e.operand,), scope)


def _binary(low: Lowering, e: ast.Binary, scope: Scope) -> Step[Value]:
    left = yield low.node(e.left, scope)
    right = yield low.node(e.right, scope)
    if isinstance(left, Failure) or isinstance(right, Failure):
        return FAILURE
    if e.operator in ("/", "mod") and low.constants.is_zero(right):
        low.report.add(rules.ZERO_DIVISOR, e.right.span)
        return FAILURE
    if e.operator == "*" and conversions.moves(low, left, right):
        result: Value = yield conversions.moved(low, left, right, e, scope)
        return result
    written = (e.left, e.right)
    return low.builtin(OPERATORS[e.operator], (left, right), e.span, e.operator, written, scope)


def _conditional(low: Lowering, e: ast.Conditional, scope: Scope) -> Step[Value]:
    condition = yield low.typed(e.condition, scope, BOOL, "bool")
    then = yield low.node(e.then, scope)
    otherwise = yield low.node(e.otherwise, scope)
    if any(isinstance(part, Failure) for part in (condition, then, otherwise)):
        return FAILURE
    if isinstance(then.type, Texture):
        low.report.add(
            rules.WRONG_TYPE, e.then.span, expected="a value", found=then.type,
            hint="choose between what is read, not between textures",
        )  # fmt: skip
        return FAILURE
    common = coerce(low.graph, then, otherwise.type)
    if common is not None:
        then = common
    else:
        otherwise = coerce(low.graph, otherwise, then.type)
        if otherwise is None:
            wrong = yield low.node(e.otherwise, scope)
            low.report.add(
                rules.BRANCH_TYPES, e.otherwise.span, then=then.type, otherwise=wrong.type
            )
            return FAILURE
    node = low.graph.node("select", then.type, (condition, then, otherwise))
    sides = (e.condition, e.then, e.otherwise)
    return combinations.checked(low, node, "if", e.span, sides, scope)


def _at_rate(low: Lowering, e: ast.AtRate, scope: Scope) -> Step[Value]:
    operand = yield low.node(e.operand, scope)
    if e.rate.text != "vertex":
        low.report.add(rules.UNKNOWN_RATE, e.rate.span, name=e.rate.text)
        return FAILURE
    if isinstance(operand, Failure):
        return FAILURE
    return low.stages.interpolated(operand, e.span)


def _ascription(low: Lowering, e: ast.Ascription, scope: Scope) -> Step[Value]:
    operand = yield low.node(e.operand, scope)
    declared = declared_type(low, e.type, scope.module, scope.variables)
    if isinstance(operand, Failure) or declared is None:
        return FAILURE
    fitted = low.fit(operand, declared.type, declared.text, e.operand.span)
    if isinstance(fitted, Failure):
        return FAILURE
    if declared.meaning is not None and declared.meaning.kind == "direction":
        return contracts.contracted(low, fitted, declared, e.span, e.operand)
    return low.meanings.ascribed(fitted, declared.meaning)


LOWER: Mapping[type, Callable[[Lowering, Any, Scope], Reply[Value]]] = {
    ast.Number: _number,
    ast.Color: _color,
    ast.Boolean: _boolean,
    ast.Reference: _reference,
    ast.Field: _field,
    ast.Index: _index,
    ast.Unary: _unary,
    ast.Binary: _binary,
    ast.Conditional: _conditional,
    ast.AtRate: _at_rate,
    ast.Conversion: conversions.convert,
    ast.Ascription: _ascription,
    ast.Array: aggregates.array,
    ast.Fold: loops.fold,
    ast.Iterate: loops.iterate,
    ast.Call: calls.call,
    ast.With: calls.replaced,
}
"""How each kind of expression is lowered."""
