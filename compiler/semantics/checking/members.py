"""The members behind a dot: lanes of vectors, members of structures, slots of records."""

from __future__ import annotations

from collections.abc import Mapping

from ...diagnostics import rules
from ...ir import build
from ...ir.meaning import RGB
from ...ir.node import Node
from ...ir.types import RuntimeArray, Scalar, Struct, Vector, width
from ...syntax import ast
from ..declarations import enumerations
from ..hints import advice
from ..state.context import Context
from ..state.scope import (
    FAILURE,
    Corner,
    Corners,
    Failure,
    Inherited,
    Instance,
    LightVariable,
    Members,
    Undecided,
    Value,
)
from . import buffers, slots
from .unknown_names import unknown

SWIZZLES: Mapping[str, Mapping[str, int]] = {
    letters: {letter: i for i, letter in enumerate(letters)} for letters in ("xyzw", "rgba")
}


def member_of(ctx: Context, value: Value, e: ast.Field) -> Value:
    """``value.name``, as it is written in ``e``."""
    name = e.name
    match value:
        case Failure():
            return FAILURE
        case Node():
            return _component(ctx, value, e)
        case LightVariable():
            return slots.light_slot(ctx, value, name)
        case Members(symbol):
            return enumerations.member(ctx, symbol, name)
        case Corner():
            return slots.corner_slot(ctx, value, name.text, name.span)
        case Corners(word):
            ctx.report.add(rules.WHICH_CORNER, e.span, name=name.text, what=word)
            return FAILURE
        case Inherited(instance, level):
            return slots.inherited(ctx, instance, level, name)
        case Undecided():
            value.report()
            return FAILURE
        case Instance():
            return slots.slot_or_report(ctx, value, name.text, name.span)


def _component(ctx: Context, node: Node, e: ast.Field) -> Node | Failure:
    name = e.name
    if isinstance(node.type, RuntimeArray) and name.text == "count":
        return buffers.count(ctx, node)
    if isinstance(node.type, Struct):
        members = dict(node.type.members)
        if name.text in members:
            member = build.member(ctx.tree, node, name.text)
            ctx.deferred.unread(member, (node,))
            return member
        unknown(ctx, "member", name.text, name.span, members)
        return FAILURE
    if isinstance(node.type, Vector | Scalar):
        lanes = _swizzle_lanes(name.text, width(node.type))
        if lanes is not None:
            whole = build.swizzle(ctx.tree, node, lanes)
            is_color = ctx.meanings.of(node) == RGB and name.text == "rgb"
            return whole if is_color or whole is not node else ctx.meanings.ascribed(node, None)
    meaning = ctx.meanings.of(node)
    if meaning is not None and meaning.enumeration is not None:
        hint = enumerations.compared(meaning.enumeration, e)
        ctx.report.add(rules.NO_MEMBER, name.span, name=name.text, type=meaning, hint=hint)
        return FAILURE
    ctx.report.add(
        rules.NO_MEMBER, name.span, name=name.text, type=node.type,
        hint=advice.missing_member(node.type, name.text, e.span),
    )  # fmt: skip
    return FAILURE


def _swizzle_lanes(text: str, lanes: int) -> tuple[int, ...] | None:
    for letters in SWIZZLES.values():
        found = tuple(letters.get(letter, 4) for letter in text)
        if len(found) <= 4 and all(lane < lanes for lane in found):
            return found
    return None
