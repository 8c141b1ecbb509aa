"""Formats of render targets and of images: what a texel of each is given."""

from __future__ import annotations

from collections.abc import Mapping

from ...ir.node import Node
from ...ir.types import FLOAT, VEC2, VEC4, Type
from ...syntax import ast
from ..checking.unknown_names import unknown
from ..declarations.fitting import typed
from ..state.context import Context
from ..state.scope import FAILURE, Failure, Scope

FORMATS: Mapping[str, Type] = {
    "r8": FLOAT, "r16f": FLOAT, "r32f": FLOAT,
    "rg8": VEC2, "rg16f": VEC2, "rg32f": VEC2,
    "rgba8": VEC4, "rgba8_srgb": VEC4, "bgra8": VEC4, "bgra8_srgb": VEC4, "rgb10a2": VEC4,
    "rgba16f": VEC4, "rgba32f": VEC4,
}  # fmt: skip
"""The formats, and what is written to a texel of one of them."""


def texel_value(
    ctx: Context, format_: ast.Name, written: ast.Expression, scope: Scope
) -> Node | Failure:
    """What is written to a texel of a format, of the format's own type; else it is reported."""
    if format_.text not in FORMATS:
        unknown(ctx, "format", format_.text, format_.span, FORMATS)
        return FAILURE
    type_ = FORMATS[format_.text]
    return typed(ctx, written, scope, type_, f"{type_} for {format_.text}")
