"""Choices, ``if … then … else …``: both sides are checked, except in the library.

The library is right, which its own tests show. So a function of it has a side evaluated only if the
side can be taken: a closure whose weight is a constant 0 is left out before anything is made of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ...diagnostics import rules
from ...ir.node import Node
from ...ir.types import BOOL, Opaque, Struct, TextureType, scalar_kind
from ...syntax import ast
from ..declarations.fitting import fit
from ..state.context import Context
from ..state.evaluation import plain
from ..state.scope import FAILURE, Continuation, Failure, Scope, Undecided, Value
from ..types.coercion import coerce, is_constant
from .combinations import checked


def operands_of_choice(e: ast.Conditional, scope: Scope) -> tuple[ast.Expression, ...]:
    """The parts that are evaluated first: only the condition, where a side may be left out."""
    if scope.module.is_standard:
        return (e.condition,)
    return (e.condition, e.then, e.otherwise)


def choice(
    ctx: Context, e: ast.Conditional, operands: Sequence[Value], scope: Scope
) -> Value | Continuation:
    """The value of a choice, or the sides that are still to be evaluated."""
    if any(isinstance(side, Undecided) for side in operands[1:]):
        from .wanted import of_choice

        _, then, otherwise = operands
        return of_choice(then, otherwise, partial(_between, ctx, e, operands[0], scope))
    written = operands_of_choice(e, scope)
    found = [plain(ctx, each, part) for each, part in zip(operands, written, strict=True)]
    nodes = [node for node in found if isinstance(node, Node)]
    if len(nodes) < len(found):
        return FAILURE
    condition = fit(ctx, nodes[0], BOOL, "bool", e.condition.span)
    if isinstance(condition, Failure):
        return FAILURE
    if len(operands) == 1:
        return _of_library(ctx, e, condition, scope)
    _, then, otherwise = nodes
    return _chosen(ctx, e, condition, then, otherwise, scope)


def _between(
    ctx: Context, e: ast.Conditional, condition: Value, scope: Scope, then: Value, otherwise: Value
) -> Value:
    """A choice between sides of which both are decided, or none can be."""
    one, other = plain(ctx, then, e.then), plain(ctx, otherwise, e.otherwise)
    test = fit(ctx, plain(ctx, condition, e.condition), BOOL, "bool", e.condition.span)
    if isinstance(test, Failure) or isinstance(one, Failure) or isinstance(other, Failure):
        return FAILURE
    return _chosen(ctx, e, test, one, other, scope)


def _of_library(ctx: Context, e: ast.Conditional, condition: Node, scope: Scope) -> Continuation:
    """The side that is taken, if that is known and the side alone says what the choice is."""
    holds = ctx.conditions.value(condition)

    def both(sides: Sequence[Node]) -> Value:
        then, otherwise = sides
        return _chosen(ctx, e, condition, then, otherwise, scope)

    def taken(sides: Sequence[Node]) -> Value | Continuation:
        (side,) = sides
        if _is_enough(side):
            ctx.deferred.unread(side, (condition,))
            return side
        if holds:
            return Continuation((e.otherwise,), scope, lambda other: both((side, *other)))
        return Continuation((e.then,), scope, lambda other: both((*other, side)))

    if holds is None:
        return Continuation((e.then, e.otherwise), scope, both)
    return Continuation((e.then if holds else e.otherwise,), scope, taken)


def _is_enough(value: Node) -> bool:
    """True if a side has the type and the meaning of the whole choice, whatever the other one is.

    Constants and integers adapt to the other side.
    """
    if isinstance(value.type, Struct):
        return True
    return scalar_kind(value.type) == "float" and not is_constant(value)


def _chosen(
    ctx: Context,
    e: ast.Conditional,
    condition: Node,
    then: Node,
    otherwise: Node,
    scope: Scope,
) -> Node | Failure:
    if isinstance(then.type, Opaque):
        what = "textures" if isinstance(then.type, TextureType) else "buffers"
        ctx.report.add(
            rules.WRONG_TYPE, e.then.span, expected="a value", found=then.type,
            hint=f"choose between what is read, not between {what}",
        )  # fmt: skip
        return FAILURE
    common = coerce(ctx.tree, then, otherwise.type)
    fitted = otherwise if common is not None else coerce(ctx.tree, otherwise, then.type)
    if fitted is None:
        ctx.report.add(
            rules.BRANCH_TYPES, e.otherwise.span, then=then.type, otherwise=otherwise.type
        )
        return FAILURE
    then = common or then
    node = ctx.tree.node("select", then.type, (condition, then, fitted))
    return checked(ctx, node, "if", e.span, (e.condition, e.then, e.otherwise), scope)
