"""Images that a kernel writes: which results are images, their sizes, and the values of texels.

``kernels.py`` asks, for each result of a kernel, which of the two kinds it is.
"""

from __future__ import annotations

from collections.abc import Sequence

from ...diagnostics import rules
from ...ir.node import Node
from ...ir.shader import RenderTarget, Result
from ...ir.stages import COMPUTE, IMAGE
from ...ir.types import INT, IVEC2, Type
from ...syntax import ast
from ..state.context import Context
from ..state.scope import Failure, Scope
from ..types.typenames import IMAGE_TYPE
from .formats import texel_value


def is_image(member: ast.Result | ast.Scatter) -> bool:
    """Whether a result is an image; else it is a buffer, as all is that is scattered to."""
    return member.type.name.text == IMAGE_TYPE


def extent_type(member: ast.Result) -> Type:
    """What stands in brackets: the size of an image, or the number of a buffer's elements."""
    return IVEC2 if is_image(member) else INT


def extent_words(member: ast.Result) -> str:
    """What messages call that."""
    return "size" if is_image(member) else "number of elements"


def image_result(ctx: Context, member: ast.Result, scope: Scope) -> Result | None:
    """An image with the value of one of its texels; ``None`` after reporting what is wrong."""
    if len(member.type.arguments) != 1:
        ctx.report.add(rules.NO_FORMAT, member.type.name.span, name=member.name.text)
        return None
    (format_,) = member.type.arguments
    value = texel_value(ctx, format_, member.value, scope)
    if isinstance(value, Failure):
        return None
    ctx.notes.names.setdefault(value.id, member.name.text)
    state = RenderTarget(format_.text)
    return Result(IMAGE, COMPUTE, value, member.name.text, member.doc, state)


def mixed(ctx: Context, members: Sequence[ast.Result | ast.Scatter]) -> bool:
    """Whether a kernel writes both images and buffers, which is reported."""
    others = [member for member in members if is_image(member) != is_image(members[0])]
    for member in others:
        kinds = ("an image", "a buffer") if is_image(member) else ("a buffer", "an image")
        ctx.report.add(
            rules.MIXED_RESULTS, member.type.span, name=member.name.text, kind=kinds[0],
            first=kinds[1],
        )  # fmt: skip
    return bool(others)


def reads_only_sizes(node: Node) -> bool:
    """Whether an operation does not read a texture, but for its size, which the host knows."""
    has_texture = any(operand.op == "resource" for operand in node.operands)
    return not has_texture or node.data == "texture_size"
