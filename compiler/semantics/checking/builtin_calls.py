"""Calls of builtins, and operators, which are builtins as well."""

from __future__ import annotations

from collections.abc import Sequence

from ....stdlib.builtins.facts import LARGEST_FLOAT
from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir.node import Node
from ...ir.operations import OF_GROUPS
from ...ir.types import FLOAT, INT, VEC3
from ...syntax import ast
from ...syntax.quoting import shortened
from ..hints.cosines import OF_COSINES, warn_of_length
from ..hints.meant_numbers import CHECKED, warn_of_bytes, warn_of_order
from ..state.context import Context
from ..state.scope import Failure, Scope
from ..types import overloads
from ..types.coercion import coerce
from .combinations import checked, members_refused
from .operands import no_signature


def builtin_call(
    ctx: Context,
    name: str,
    operands: Sequence[Node],
    span: Span,
    shown: str,
    written: tuple[ast.Expression, ...] = (),
    scope: Scope | None = None,
) -> Node | Failure:
    """A call of builtin ``name``, its operands coerced to the signature that fits.

    ``written`` and ``scope``, where they are known, are for messages about the operands.
    """
    found = overloads.resolve(name, tuple(map(overloads.operand, operands)))
    if found is None:
        refused = members_refused(ctx, name, operands, shown, span, written, scope)
        return refused or no_signature(ctx, name, operands, span, shown, written)
    fitted: list[Node] = []
    for operand, type_ in zip(operands, found.operands, strict=True):
        # Arithmetic between scalars and vectors exists as such; elsewhere a scalar broadcasts.
        lane = coerce(ctx.tree, operand, type_, broadcast=True)
        if lane is None:  # A negative literal is no `uint`.
            return no_signature(ctx, name, operands, span, shown, written)
        if lane.type == VEC3 and operand.type == INT and written:
            warn_of_bytes(ctx, written[len(fitted)].span)
        fitted.append(lane)
    node = ctx.tree.node("call", found.result, tuple(fitted), name)
    ctx.progress.joins_groups |= name in OF_GROUPS
    if name in OF_COSINES:
        warn_of_length(ctx, node, span)
    if name in CHECKED:
        warn_of_order(ctx, name, operands, span, written)
    largest = ctx.constants.largest(node)
    if largest is not None and largest > LARGEST_FLOAT:
        error = ctx.report.finding(
            rules.NUMBER_TOO_LARGE, span, text=shortened(span.text), type=FLOAT,
            hint=f"it comes to {largest:.3g}",
        )  # fmt: skip
        ctx.deferred.add(node, error, *fitted)
    return checked(ctx, node, shown, span, written, scope)
