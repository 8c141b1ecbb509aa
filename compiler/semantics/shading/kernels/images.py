"""Images that a kernel writes: which results are images, their sizes, and the values of texels.

``kernels/kernel.py`` asks, for each result of a kernel, which of the two kinds it is.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from ....diagnostics import rules
from ....ir.node import Node
from ....ir.shader import RenderTarget, Result
from ....ir.stages import COMPUTE, IMAGE
from ....ir.types import INT, IVEC2, Type
from ....syntax import ast
from ...state.context import Context
from ...state.scope import Failure, Scope
from ...types.typenames import IMAGE_TYPE
from ..passes.formats import texel_value

_OTHER_IMAGES = r"[iu]?image_?(\d?d|cube|buffer|rect)\w*|rw_?texture\w*|texture_storage\w*"
"""A pattern of the names of images in other languages, or possible ones, in small letters."""


def is_image(member: ast.Result | ast.Scatter) -> bool:
    """True if a result is an image, or means to be one; otherwise it is a buffer.

    All that is scattered to is a buffer.
    """
    return member.type.name.text == IMAGE_TYPE or is_other_image(member)


def is_other_image(member: ast.Result | ast.Scatter) -> bool:
    """True if the type of a result is an image that does not exist here."""
    word = member.type.name.text
    return word != IMAGE_TYPE and re.fullmatch(_OTHER_IMAGES, word.lower()) is not None


def report_other_image(ctx: Context, member: ast.Result) -> None:
    """Report the type of an image that there is not."""
    name = member.type.name
    hint = (
        f"kernels write `{IMAGE_TYPE}<format>[size]`; each layer of something larger is a result "
        "of its own"
    )
    ctx.report.add(rules.UNKNOWN_NAME, name.span, kind="type", name=name.text, hint=hint)


def extent_type(member: ast.Result) -> Type:
    """The type of the extent in brackets: an image's size, or a buffer's number of elements."""
    return IVEC2 if is_image(member) else INT


def extent_words(member: ast.Result) -> str:
    """The words for that extent in messages."""
    return "size" if is_image(member) else "number of elements"


def image_result(ctx: Context, member: ast.Result, scope: Scope) -> Result | None:
    """An image with the value of one of its texels; ``None`` after reporting an error."""
    if member.type.name.text != IMAGE_TYPE:
        return None  # The missing image has been reported.
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
    """True if a kernel writes both images and buffers, which is reported."""
    others = [member for member in members if is_image(member) != is_image(members[0])]
    for member in others:
        kinds = ("an image", "a buffer") if is_image(member) else ("a buffer", "an image")
        ctx.report.add(
            rules.MIXED_RESULTS, member.type.span, name=member.name.text, kind=kinds[0],
            first=kinds[1],
        )  # fmt: skip
    return bool(others)


def reads_only_sizes(node: Node) -> bool:
    """True if an operation reads nothing of a texture but its size, which the host knows."""
    has_texture = any(operand.op == "texture" for operand in node.operands)
    return not has_texture or node.data == "texture_size"
