"""Constructors: ``vec3(x, yz)``, ``float(i)``, ``mat3(c0, c1, c2)``, ``rgb(r, g, b)``."""

from __future__ import annotations

from ...diagnostics import rules
from ...diagnostics.fixes import FixIt, Hint, fix_it
from ...diagnostics.source import Span
from ...ir import build
from ...ir.meaning import MAPS, Meaning
from ...ir.node import Node
from ...ir.types import (
    Matrix,
    Scalar,
    ScalarKind,
    TextureType,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)
from ...syntax import ast
from ...syntax.quoting import spanned
from ...syntax.rewriting import rewritten, together
from ..hints import advice
from ..state.context import Context
from ..state.scope import FAILURE, Failure
from ..types.coercion import coerce, is_constant
from ..types.typenames import NAMED

CONVERSIONS = {"float": "to_float", "int": "to_int", "uint": "to_uint"}


def is_constructor(name: str) -> bool:
    """True if a name is that of a type that can be called."""
    return name in NAMED and not isinstance(NAMED[name].representation, TextureType)


def construct(ctx: Context, name: str, arguments: tuple[Node, ...], e: ast.Call) -> Node | Failure:
    """The value of calling type ``name``."""
    type_ = NAMED[name].representation
    result: Node | Failure | None = None
    match type_:
        case Scalar() if len(arguments) == 1:
            result = _scalar(ctx, type_, arguments[0])
        case Vector():
            result = _vector(ctx, type_, arguments)
        case Matrix():
            result = _matrix(ctx, type_, arguments)
        case _:
            pass
    if result is None and any(map(ctx.deferred.is_wrong, arguments)):
        return FAILURE
    if result is None:
        found = ", ".join(str(argument.type) for argument in arguments)
        hint = _hint(ctx, name, type_, arguments, e.arguments)
        is_float = scalar_kind(type_) == "float"
        ctx.report.add(
            rules.NO_OVERLOAD, e.span, name=name, arguments=found, hint=hint,
            labels=advice.where_cut(ctx, arguments, e.span) if is_float else (),
        )  # fmt: skip
        return FAILURE
    if isinstance(result, Failure):
        return FAILURE
    return ctx.meanings.ascribed(result, _meaning(ctx, name, arguments))


def _meaning(ctx: Context, name: str, arguments: tuple[Node, ...]) -> Meaning | None:
    """The meaning of a type call's result; the types of geometry name no space here."""
    named = NAMED[name]
    source = ctx.meanings.of(arguments[0]) if len(arguments) == 1 else None
    if name == "mat3" and source is not None and source.kind in MAPS:
        return Meaning("basis", source.spaces)
    return Meaning(named.meaning) if named.meaning is not None and not named.spaces else None


def _hint(
    ctx: Context,
    name: str,
    type_: Type,
    arguments: tuple[Node, ...],
    written: tuple[ast.Expression, ...],
) -> Hint:
    sole = arguments[0].type if len(arguments) == 1 else None
    if scalar_kind(type_) == "float" and (
        cut := advice.cut_quotient(ctx, arguments, [expression.span for expression in written])
    ):
        return cut
    match type_:
        case Vector(kind=kind, size=size) if _lanes(arguments) in (1, size) and (
            converted := _in_one_kind(kind, arguments, written)
        ):
            return together("lanes have one kind: write {}", converted)
        case Vector(kind="float", size=size) if isinstance(sole, Vector) and sole.size < size:
            filled = ", 0" * (size - sole.size)
            span, said = written[0].span, "say what the other lanes are: `{}`"
            shown = said.format(f"{name}({spanned(span)}{filled})")
            return fix_it(shown, (Span(span.source, span.end, span.end), filled))
        case Vector(kind=kind, size=size):
            return f"`{name}` takes {size} lanes in all, or one {kind} for every lane"
        case Matrix(columns, rows):
            return f"`{name}` takes {columns} columns, each a vec{rows}, or another matrix"
        case _:
            return f"`{name}` takes one number"


def _lanes(arguments: tuple[Node, ...]) -> int:
    """The number of lanes of all arguments; structures and textures have none."""
    return sum(width(one.type) for one in arguments if scalar_kind(one.type) is not None)


def _in_one_kind(
    kind: ScalarKind, arguments: tuple[Node, ...], written: tuple[ast.Expression, ...]
) -> list[FixIt]:
    """The edits that convert the lanes of a vector that are of another kind."""
    return [
        rewritten(expression.span, f"{with_width(kind, width(node.type))}({{text}})", "`{}`")
        for node, expression in zip(arguments, written, strict=True)
        if scalar_kind(node.type) not in (None, kind) and not _is_whole_literal(node)
    ]


def _is_whole_literal(node: Node) -> bool:
    """True if it is a number of any kind by itself."""
    return scalar_kind(node.type) in ("int", "uint") and is_constant(node)


def _scalar(ctx: Context, type_: Scalar, argument: Node) -> Node | Failure | None:
    if not isinstance(argument.type, Scalar):
        return None
    adapted = coerce(ctx.tree, argument, type_)
    if adapted is not None:
        return adapted
    if type_.kind == "bool":
        zero = build.constant(ctx.tree, argument.type, 0.0 if argument.type.kind == "float" else 0)
        return ctx.tree.node("call", type_, (argument, zero), "ne")
    if argument.type.kind == "bool":
        return _flag(ctx, type_, argument)
    return ctx.tree.node("call", type_, (argument,), CONVERSIONS[type_.kind])


def _flag(ctx: Context, type_: Scalar, argument: Node) -> Node:
    """A bool as one or zero."""
    number = float if type_.kind == "float" else int
    one, zero = (build.constant(ctx.tree, type_, number(n)) for n in (1, 0))
    return ctx.tree.node("select", type_, (argument, one, zero))


def _vector(ctx: Context, type_: Vector, arguments: tuple[Node, ...]) -> Node | Failure | None:
    lanes: list[Node] = []
    for argument in arguments:
        if not isinstance(argument.type, Scalar | Vector):
            return None
        kind = scalar_kind(argument.type)
        if kind == type_.kind:
            lanes.append(argument)
        elif is_constant(argument) and (one := coerce(ctx.tree, argument, Scalar(type_.kind))):
            lanes.append(one)
        elif len(arguments) == 1 and isinstance(argument.type, Vector):
            return _converted(ctx, type_, argument)
        else:
            return None
    total = sum(width(lane.type) for lane in lanes)
    if len(lanes) == 1 and total == 1:
        return build.splat(ctx.tree, lanes[0], type_.size)
    if len(lanes) == 1 and total > type_.size:
        return build.swizzle(ctx.tree, lanes[0], tuple(range(type_.size)))
    return build.vector(ctx.tree, tuple(lanes)) if total == type_.size else None


def _converted(ctx: Context, type_: Vector, argument: Node) -> Node | None:
    """``vec3(ivec3)`` lane by lane."""
    if width(argument.type) != type_.size:
        return None
    if "bool" not in (type_.kind, scalar_kind(argument.type)):
        return ctx.tree.node("call", type_, (argument,), CONVERSIONS[type_.kind])
    lanes = []
    for lane in range(type_.size):
        converted = _scalar(ctx, Scalar(type_.kind), build.swizzle(ctx.tree, argument, (lane,)))
        if not isinstance(converted, Node):
            return None
        lanes.append(converted)
    return build.vector(ctx.tree, tuple(lanes))


def _matrix(ctx: Context, type_: Matrix, arguments: tuple[Node, ...]) -> Node | Failure | None:
    if len(arguments) == type_.columns and all(a.type == type_.column for a in arguments):
        return build.matrix(ctx.tree, arguments)
    if len(arguments) == 1 and isinstance(source := arguments[0].type, Matrix):
        return _resized(ctx, arguments[0], source, type_)
    if len(arguments) == 1 and (diagonal := coerce(ctx.tree, arguments[0], Scalar("float"))):
        return _diagonal(ctx, diagonal, type_)
    return None


def _resized(ctx: Context, argument: Node, source: Matrix, wanted: Matrix) -> Node:
    """The upper left part of a larger matrix; a smaller one continued by the identity."""
    if source == wanted:
        return argument
    zero, one = (build.floating(ctx.tree, number) for number in (0.0, 1.0))
    columns = []
    for i in range(wanted.columns):
        lanes: list[Node] = []
        known = min(source.rows, wanted.rows) if i < source.columns else 0
        if known:
            column = build.part(ctx.tree, argument, i)
            lanes.append(build.swizzle(ctx.tree, column, tuple(range(known))))
        lanes += (one if row == i else zero for row in range(known, wanted.rows))
        columns.append(build.vector(ctx.tree, tuple(lanes)))
    return build.matrix(ctx.tree, tuple(columns))


def _diagonal(ctx: Context, lane: Node, type_: Matrix) -> Node:
    zero = build.floating(ctx.tree, 0.0)
    columns = [
        build.vector(ctx.tree, tuple(lane if i == j else zero for i in range(type_.rows)))
        for j in range(type_.columns)
    ]
    return build.matrix(ctx.tree, tuple(columns))
