"""Formats of render targets and of images, and the values of their texels."""

from __future__ import annotations

from collections.abc import Mapping

from ....ir import build
from ....ir.formats import TARGET_FORMATS
from ....ir.node import Node
from ....ir.types import FLOAT, VEC3, VEC4, Type, width
from ....syntax import ast
from ...checking.unknown_names import unknown
from ...declarations.fitting import fit, typed
from ...state.context import Context
from ...state.evaluation import node_of
from ...state.scope import FAILURE, Failure, Scope

FORMATS: Mapping[str, Type] = {name: format_.type for name, format_ in TARGET_FORMATS.items()}
"""The formats, and the type of the value that is written to a texel."""


def texel_value(
    ctx: Context, format_: ast.Name, written: ast.Expression, scope: Scope
) -> Node | Failure:
    """The value of a texel of a format, of the format's own type; errors are reported."""
    if format_.text not in FORMATS:
        unknown(ctx, "format", format_.text, format_.span, FORMATS)
        return FAILURE
    type_ = FORMATS[format_.text]
    return typed(ctx, written, scope, type_, f"{type_} for {format_.text}")


def cleared_value(
    ctx: Context, format_: str, written: ast.Expression, scope: Scope
) -> Node | Failure:
    """The clear value of a target of a format, in four lanes; a colour without alpha covers all.

    A value that does not fit is reported.
    """
    type_ = FORMATS.get(format_, VEC4)
    node = node_of(ctx, written, scope)
    if isinstance(node, Failure) or (node.type, type_) != (VEC3, VEC4):
        node = fit(ctx, node, type_, f"{type_} for {format_}", written.span)
    if isinstance(node, Failure) or node.type == VEC4:
        return node
    rest = (0.0, 0.0, 0.0, 1.0)[width(node.type) :]
    return build.vector(ctx.tree, (node, *(build.floating(ctx.tree, lane) for lane in rest)))


def cleared_depth(ctx: Context, written: ast.Expression, scope: Scope) -> Node | Failure:
    """The clear value of depths; reported if it is no number."""
    return typed(ctx, written, scope, FLOAT, "float for depths")
