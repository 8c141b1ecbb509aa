"""Values where a type is wanted: adapted to it, or a report of why they cannot be."""

from __future__ import annotations

from ...diagnostics import rules
from ...diagnostics.fixes import Hint
from ...diagnostics.source import Span
from ...ir.node import Node
from ...ir.types import Type, scalar_kind
from ...syntax import ast
from ..hints import advice
from ..hints.meant_numbers import warn_of_bytes
from ..state.context import Context
from ..state.evaluation import node_of
from ..state.scope import FAILURE, Failure, Scope
from ..types.coercion import coerce
from ..types.typenames import Declared
from .enumerations import shown_type


def typed(
    ctx: Context, expression: ast.Expression, scope: Scope, wanted: Type, declared: str
) -> Node | Failure:
    """The value of ``expression`` as a ``wanted``; ``declared`` is how messages call that."""
    node = node_of(ctx, expression, scope, Declared(wanted, declared))
    return fit(ctx, node, wanted, declared, expression.span)


def fit(
    ctx: Context, node: Node | Failure, wanted: Type, declared: str, span: Span
) -> Node | Failure:
    """``node`` as a ``wanted``, or a report at ``span``."""
    if isinstance(node, Failure):
        return FAILURE
    if declared == "rgb" or declared.startswith("rgb "):
        warn_of_bytes(ctx, span)
    fitted = coerce(ctx.tree, node, wanted)
    if fitted is None and ctx.deferred.is_wrong(node):
        return FAILURE
    if fitted is None:
        ctx.report.add(
            rules.WRONG_TYPE, span, expected=declared, found=shown_type(ctx, node),
            hint=_way_to_fit(ctx, node, wanted, declared, span),
            labels=advice.where_cut(ctx, (node,), span) if scalar_kind(wanted) == "float" else (),
            caption=f"this is `{shown_type(ctx, node)}`",
        )  # fmt: skip
        return FAILURE
    return fitted


def _way_to_fit(ctx: Context, node: Node, wanted: Type, declared: str, span: Span) -> Hint:
    cut = advice.cut_quotient(ctx, (node,), (span,)) if scalar_kind(wanted) == "float" else ""
    return cut or advice.fitting_type(node.type, wanted, declared, span)
