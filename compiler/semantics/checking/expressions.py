"""The rules for literals, names and operators, and the table of the rules of all expressions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ....stdlib.builtins.facts import LARGEST_FLOAT
from ...diagnostics import rules
from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.source import Span
from ...ir import build
from ...ir.meaning import ANGLE, RGB, RGBA
from ...ir.node import Node, bare
from ...ir.types import (
    BOOL,
    FLOAT,
    INT,
    UINT,
    Array,
    Matrix,
    RuntimeArray,
    TextureType,
    Vector,
)
from ...srgb import linear
from ...syntax import ast
from ...syntax.quoting import shortened, spanned
from ...units import value_of
from ..declarations import contracts
from ..declarations.fitting import fit
from ..declarations.written_types import declared_type
from ..hints import advice
from ..state.context import Context, OpenRule, Rule, Rules
from ..state.evaluation import plain
from ..state.scope import FAILURE, Corners, Failure, Scope, Value
from ..types.coercion import is_negated_literal
from . import aggregates, buffers, calls, choices, conversions, corners, lookup, loops
from .builtin_calls import builtin_call
from .members import member_of

OPERATORS: Mapping[str, str] = {
    "+": "add", "-": "sub", "*": "mul", "/": "div", "mod": "mod",
    "==": "eq", "!=": "ne", "<": "lt", "<=": "le", ">": "gt", ">=": "ge",
    "&": "bit_and", "|": "bit_or", "^": "bit_xor", "<<": "shift_left", ">>": "shift_right",
    "and": "and", "or": "or",
}  # fmt: skip
PREFIXES: Mapping[str, str] = {"-": "neg", "~": "bit_not", "not": "not"}
LOWEST = str(2**31)
"""An `int` only with a minus in front."""


# --- literals ------------------------------------------------------------------------------------

_TOO_LARGE = 2.0**128 - 2.0**103
"""The least number that is too large.

Numbers below it are rounded to the largest float32, such as ``3.40282347e38``, which C headers
have.
"""


def _number(ctx: Context, e: ast.Number, _operands: Sequence[Node], _scope: Scope) -> Value:
    if e.kind in ("int", "uint"):
        limit, type_ = (2**31 - 1, INT) if e.kind == "int" else (2**32 - 1, UINT)
        whole = _whole(e.text)
        if whole > limit:
            hint: Hint = ""
            if whole < 2**32:
                place = Span(e.span.source, e.span.end, e.span.end)
                hint = fix_it("write it as a `uint`, with `u` behind it", (place, "u"))
            text = shortened(e.text)
            ctx.report.add(rules.NUMBER_TOO_LARGE, e.span, text=text, type=type_, hint=hint)
            return FAILURE
        return build.constant(ctx.tree, type_, whole)
    value = value_of(e.text, e.unit)
    if value >= _TOO_LARGE:
        ctx.report.add(rules.NUMBER_TOO_LARGE, e.span, text=shortened(e.text), type=FLOAT)
        return FAILURE
    value = min(value, LARGEST_FLOAT)
    number = build.floating(ctx.tree, value)
    return ctx.meanings.ascribed(number, ANGLE) if e.kind == "angle" else number


def _color(ctx: Context, e: ast.Color, _operands: Sequence[Node], _scope: Scope) -> Value:
    lanes = [linear(channel) for channel in e.channels[:3]]
    lanes += [channel / 255 for channel in e.channels[3:]]
    color = build.constant(ctx.tree, Vector("float", len(lanes)), tuple(lanes))
    return ctx.meanings.ascribed(color, RGB if len(lanes) == 3 else RGBA)


def _boolean(ctx: Context, e: ast.Boolean, _operands: Sequence[Node], _scope: Scope) -> Value:
    return build.constant(ctx.tree, BOOL, e.value)


# --- names ---------------------------------------------------------------------------------------


def _reference(ctx: Context, e: ast.Reference, _operands: Sequence[Node], scope: Scope) -> Value:
    return lookup.value(ctx, e.name, e.span, scope)


def _field(ctx: Context, e: ast.Field, operands: Sequence[Value], _scope: Scope) -> Value:
    return member_of(ctx, operands[0], e)


def _index(ctx: Context, e: ast.Index, operands: Sequence[Value], scope: Scope) -> Value:
    whole, number = operands
    if isinstance(whole, Corners):
        return corners.numbered(ctx, whole, plain(ctx, number, e.index), e.index.span)
    operand, position = plain(ctx, whole, e.operand), plain(ctx, number, e.index)
    if isinstance(operand, Failure) or isinstance(position, Failure):
        return FAILURE
    return _element(ctx, e, operand, position, scope)


def _element(ctx: Context, e: ast.Index, operand: Node, index: Node, scope: Scope) -> Value:
    operands = operand, index
    if isinstance(operand.type, TextureType):
        ctx.report.add(rules.NOT_INDEXABLE, e.span, type=operand.type, hint=advice.READ)
        return FAILURE
    position = fit(ctx, index, INT, "int", e.index.span)
    if isinstance(position, Failure):
        return FAILURE
    known = ctx.constants.known_integer(position)
    match operand.type:
        case RuntimeArray():
            element = buffers.element(ctx, operand, position)
            if known is not None and known < 0:
                hint = _from_end(e, -known)
                _not_there(ctx, e, (operand, position, element), known, hint, scope)
            return element
        case Array(count=count) | Vector(size=count) | Matrix(columns=count):
            pass
        case _:
            ctx.report.add(rules.NOT_INDEXABLE, e.span, type=operand.type)
            return FAILURE
    if known is not None and 0 <= known < count:
        part = build.part(ctx.tree, operand, known)
        ctx.deferred.unread(part, operands)
        return part
    zero, last = (build.constant(ctx.tree, INT, n) for n in (0, count - 1))
    clamped = ctx.tree.node("call", INT, (position, zero, last), "clamp")
    part = build.index(ctx.tree, operand, clamped)
    if known is not None:
        highest = str(count - 1)
        hint = fix_it(f"counted from 0, the last one is `[{highest}]`", (e.index.span, highest))
        _not_there(ctx, e, (operand, position, part), known, hint, scope)
    return part


def _from_end(e: ast.Index, number: int) -> Hint:
    """The hint for an element of a buffer that is counted from the end, as in some languages."""
    shown, written = (
        f"{buffer}.count - {number}" for buffer in (spanned(e.operand.span), e.operand.span.text)
    )
    said = f"elements are counted from 0; from the end, this one is `[{shown}]`"
    return fix_it(said, (e.index.span, written))


def _not_there(
    ctx: Context, e: ast.Index, read: tuple[Node, Node, Node], known: int, hint: Hint, scope: Scope
) -> None:
    """Note that an index is known to be out of bounds; ``read`` is by what which part is read."""
    from .given_values import finding

    operand, position, part = read
    found = finding(ctx, rules.OUT_OF_BOUNDS, e.index, scope, hint, index=known, type=operand.type)
    ctx.deferred.add(part, found, position)


# --- operators -----------------------------------------------------------------------------------


def _is_lowest(e: ast.Unary) -> bool:
    """True if this is the one number that can only be written with its sign."""
    number = e.operand
    lowest = isinstance(number, ast.Number) and number.kind == "int" and number.text == LOWEST
    return lowest and e.operator == "-"


def _whole(text: str) -> int:
    """The value of a whole literal, or some number that is too large where it is too large.

    No type has more than ten digits, and Python refuses to read thousands of them.
    """
    if text[:2] in ("0x", "0X"):
        return int(text, 16)
    return int(text.lstrip("0")[:11] or "0")


def _unary(ctx: Context, e: ast.Unary, operands: Sequence[Node], scope: Scope) -> Value:
    if not operands:
        return build.constant(ctx.tree, INT, -int(LOWEST))
    (operand,) = operands
    name = PREFIXES[e.operator]
    if name == "neg" and is_negated_literal(operand):
        return bare(operand).operands[0]
    return builtin_call(ctx, name, (operand,), e.span, e.operator, (e.operand,), scope)


def _binary(ctx: Context, e: ast.Binary, operands: Sequence[Node], scope: Scope) -> Value:
    left, right = operands
    if e.operator == "*" and conversions.moves(ctx, left, right):
        return conversions.moved(ctx, left, right, e, scope)
    written = (e.left, e.right)
    value = builtin_call(
        ctx, OPERATORS[e.operator], (left, right), e.span, e.operator, written, scope
    )
    if e.operator in ("/", "mod") and isinstance(value, Node) and ctx.constants.is_zero(right):
        from .given_values import finding

        found = finding(ctx, rules.ZERO_DIVISOR, e.right, scope)
        ctx.deferred.add(value, found, right)
    return value


def _at_rate(ctx: Context, e: ast.AtRate, operands: Sequence[Node], _scope: Scope) -> Value:
    (operand,) = operands
    if e.rate.text != "vertex":
        ctx.report.add(rules.UNKNOWN_RATE, e.rate.span, name=e.rate.text)
        return FAILURE
    ctx.progress.unproven += bool(operand.variables)
    return ctx.crossings.interpolated(operand, e.span)


def _ascription(ctx: Context, e: ast.Ascription, operands: Sequence[Value], scope: Scope) -> Value:
    declared = declared_type(ctx, e.type, scope.module, scope.variables)
    if declared is None:
        return FAILURE
    operand = plain(ctx, operands[0], e.operand, declared)
    if isinstance(operand, Failure):
        return FAILURE
    fitted = fit(ctx, operand, declared.type, declared.text, e.operand.span)
    if isinstance(fitted, Failure):
        return FAILURE
    if declared.meaning is not None and declared.meaning.kind == "direction":
        return contracts.contracted(ctx, fitted, declared, e.span, e.operand)
    return ctx.meanings.ascribed(fitted, declared.meaning)


# --- the table -----------------------------------------------------------------------------------


def _none(_e: ast.Expression, _scope: Scope) -> tuple[ast.Expression, ...]:
    return ()


def _operand(
    e: ast.Field | ast.AtRate | ast.Conversion | ast.Ascription, _scope: Scope
) -> tuple[ast.Expression, ...]:
    return (e.operand,)


def _signed(e: ast.Unary, _scope: Scope) -> tuple[ast.Expression, ...]:
    return () if _is_lowest(e) else (e.operand,)


def _sides(e: ast.Binary, _scope: Scope) -> tuple[ast.Expression, ...]:
    return (e.left, e.right)


def _place(e: ast.Index, _scope: Scope) -> tuple[ast.Expression, ...]:
    return (e.operand, e.index)


def _elements(e: ast.Array, _scope: Scope) -> tuple[ast.Expression, ...]:
    return e.elements


RULES: Rules = {
    ast.Number: Rule(_none, _number),
    ast.Color: Rule(_none, _color),
    ast.Boolean: Rule(_none, _boolean),
    ast.Reference: Rule(_none, _reference),
    ast.Field: OpenRule(_operand, _field),
    ast.Index: OpenRule(_place, _index),
    ast.Unary: Rule(_signed, _unary),
    ast.Binary: Rule(_sides, _binary),
    ast.Conditional: OpenRule(choices.operands_of_choice, choices.choice),
    ast.AtRate: Rule(_operand, _at_rate),
    ast.Conversion: Rule(_operand, conversions.convert),
    ast.Ascription: OpenRule(_operand, _ascription),
    ast.Array: Rule(_elements, aggregates.array),
    ast.Fold: Rule(loops.bounds_of_fold, loops.fold),
    ast.FoldOver: Rule(loops.no_operands, loops.fold_over),
    ast.Iterate: Rule(loops.bounds_of_iterate, loops.iterate),
    ast.Call: OpenRule(calls.operands_of_call, calls.call),
    ast.With: OpenRule(calls.operands_of_with, calls.replaced),
}
"""The rule of each kind of expression."""
