"""``x in S``: from one space to another, by the transforms that are in scope.

The arithmetic is written in ``stdlib/spaces.burnish``; here it is chosen and put together.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

from ...diagnostics import rules
from ...diagnostics.nearest import respelling
from ...diagnostics.source import Span
from ...ir.meaning import ARROWS, GEOMETRY, Meaning
from ...ir.node import Node
from ...ir.types import VEC3, square
from ...library import conversions as library
from ...syntax import ast
from ...syntax.rewriting import declared_space, rewritten
from ..declarations import transform_paths
from ..names.modules import Module
from ..state.context import Context
from ..state.scope import FAILURE, Failure, Scope, Value, Way
from ..types import meaning_rules
from ..types.typenames import HOMOGENEOUS, SPACES
from . import applications, combinations
from .builtin_calls import builtin_call
from .candidates import best
from .operands import listed
from .slots import slot


def convert(ctx: Context, e: ast.Conversion, operands: Sequence[Node], scope: Scope) -> Value:
    """The value of ``x in S``."""
    (node,) = operands
    space = _space(ctx, e.space, scope)
    if space is None:
        return FAILURE
    meaning = ctx.meanings.of(node)
    if meaning is None or meaning.kind not in GEOMETRY:
        ctx.report.add(
            rules.IN_NO_SPACE, e.operand.span, found=meaning or node.type,
            hint=rewritten(
                e.operand.span, "({text} as vector<object>)", f"say what it is: `{{}} in {space}`"
            ),
        )  # fmt: skip
        return FAILURE
    path = transform_paths.path(ctx, meaning, space, scope)
    if path is None:
        _no_way(ctx, e, meaning, space, scope)
        return FAILURE
    return _taken(ctx, node, meaning, path, e.span)


def _space(ctx: Context, name: ast.Name, scope: Scope) -> str | None:
    known = scope.variables.get(name.text)
    if isinstance(known, str):
        return known
    found = scope.module.find(name.text)
    if name.text in SPACES or (found and isinstance(found[0].declaration, ast.Space)):
        return name.text
    declared = (s for s in scope.module.visible() if _is_space(scope.module, s))
    spaces = chain(SPACES, declared)
    hint = respelling(name.text, name.span, spaces) or declared_space(name.text, name.span)
    ctx.report.add(rules.UNKNOWN_NAME, name.span, kind="space", name=name.text, hint=hint)
    return None


def _is_space(module: Module, name: str) -> bool:
    return any(isinstance(symbol.declaration, ast.Space) for symbol in module.known(name))


def _no_way(ctx: Context, e: ast.Conversion, meaning: Meaning, space: str, scope: Scope) -> None:
    there = ", ".join(
        f"`{way.name} : {way.meaning}`" for way in transform_paths.transforms(ctx, scope)
    )
    ctx.report.add(
        rules.NO_CONVERSION, e.span, found=meaning, space=space,
        hint=f"there is {there}" if there else "there is no transform in scope",
    )  # fmt: skip


def _taken(ctx: Context, node: Node, meaning: Meaning, path: list[Way], span: Span) -> Value:
    """A value carried along a path; a direction is one in the end, too."""
    for way in path:
        matrix = slot(ctx, way.instance, way.name, span)
        if isinstance(matrix, Failure):
            return FAILURE
        matrix = ctx.meanings.ascribed(matrix, way.meaning)
        step = _step(ctx, node, meaning.kind, matrix, way, span)
        if isinstance(step, Failure):
            return FAILURE
        node = step
    if path and meaning.kind == "direction":
        return builtin_call(ctx, "normalize", (node,), span, "normalize")
    return node


def _step(
    ctx: Context, node: Node, kind: str, matrix: Node, way: Way, span: Span
) -> Node | Failure:
    if kind == "normal":
        name = "upright_back" if way.back else "upright"
        turned = _library(ctx, name, (matrix, node), span)
        if isinstance(turned, Failure):
            return FAILURE
        return ctx.meanings.ascribed(turned, Meaning("normal", way.ends[1:]))
    if way.back:
        inverse = builtin_call(ctx, "inverse", (matrix,), span, "inverse")
        assert isinstance(inverse, Node)
        matrix = inverse
    carried: Node | Failure = _library(ctx, "moved", (matrix, node), span)
    return carried


def _library(ctx: Context, name: str, arguments: tuple[Node, ...], span: Span) -> Node | Failure:
    """A function of ``spaces.burnish``."""
    found = best(ctx, library().find(name), arguments)
    assert len(found) == 1, f"{name} does not take {listed(ctx, arguments)}"
    (symbol,) = found
    result: Node | Failure = applications.library_call(ctx, symbol, arguments, span)
    return result


# --- transform * point ---------------------------------------------------------------------------


def moves(ctx: Context, left: Node, right: Node) -> bool:
    """True if ``left * right`` is a transform that moves a point or vector of three lanes."""
    by, what = ctx.meanings.of(left), ctx.meanings.of(right)
    return (
        left.type == square(4) and right.type == VEC3
        and by is not None and by.kind == "transform"
        and what is not None and what.kind in GEOMETRY
    )  # fmt: skip


def moved(ctx: Context, left: Node, right: Node, e: ast.Binary, scope: Scope) -> Value:
    """The value of ``transform * point`` or ``transform * vector``."""
    by, what = ctx.meanings.of(left), ctx.meanings.of(right)
    assert by is not None and what is not None
    found = meaning_rules.moved(by, what)
    if isinstance(found, meaning_rules.Clash):
        written = (e.left, e.right)
        return combinations.complain(ctx, found, [by, what], e.operator, e.span, written, scope)
    if found.kind in ARROWS and HOMOGENEOUS in by.spaces:
        ctx.report.add(
            rules.NO_CONVERSION, e.span, found=what, space=by.spaces[1],
            hint="only points go into clip space",
        )  # fmt: skip
        return FAILURE
    result: Value = _library(ctx, "moved", (left, right), e.span)
    return result
