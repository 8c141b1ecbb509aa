"""``choose(mode, add = a + b, mix = c)``: a value for each member of an enumeration.

``calls`` asks for it where ``choose`` is called with names. Every member needs its value, so
whoever adds one to the enumeration is told of all choices that do not know it yet.
"""

from __future__ import annotations

from collections.abc import Sequence

from ...diagnostics import rules
from ...ir import build
from ...ir.meaning import Enumeration
from ...ir.node import Node
from ...ir.types import BOOL, INT, Opaque
from ...syntax import ast
from ..declarations import enumerations
from ..state.context import Context
from ..state.scope import FAILURE, Failure, Scope
from ..types.coercion import coerce
from .arguments import Head, placed
from .combinations import checked

NAME = "choose"


def chosen(
    ctx: Context, e: ast.Call, arguments: tuple[Node, ...], scope: Scope
) -> Node | Failure | None:
    """The value for the member that the first argument is; ``None`` if it has no place in front."""
    if e.names[0] is not None or any(name is None for name in e.names[1:]):
        return None
    meaning = ctx.meanings.of(arguments[0])
    if meaning is None or meaning.enumeration is None or arguments[0].type != INT:
        ctx.report.add(
            rules.WRONG_TYPE, e.arguments[0].span, expected="a member of an enumeration",
            found=enumerations.shown_type(ctx, arguments[0]),
            hint="values with names are for its members: `choose(mode, add = a, mix = b)`",
        )  # fmt: skip
        return FAILURE
    places = placed(ctx, e, _head(meaning.enumeration))
    if places is None:
        return FAILURE
    order = sorted(range(len(places)), key=places.__getitem__)
    written = [e.arguments[place] for place in order]
    values = _of_one_type(ctx, [arguments[place] for place in order[1:]], written[1:])
    if isinstance(values, Failure):
        return FAILURE
    return _selected(ctx, e, arguments[0], values, written, scope)


def _head(of: Enumeration) -> Head:
    """The form of a choice between the members of an enumeration."""
    listed = "".join(f", {name} = …" for name in of.names)
    return Head(NAME, ("", *of.names), frozenset(), f"{NAME}(of{listed})")


def _of_one_type(
    ctx: Context, values: Sequence[Node], written: Sequence[ast.Expression]
) -> list[Node] | Failure:
    """The values as those of one type, to which constants among them adapt."""
    for value, expression in zip(values, written, strict=True):
        if isinstance(value.type, Opaque):
            ctx.report.add(
                rules.WRONG_TYPE, expression.span, expected="a value", found=value.type,
                hint="choose between what is read of textures and buffers",
            )  # fmt: skip
            return FAILURE
    for type_ in dict.fromkeys(value.type for value in values):
        fitted = [coerce(ctx.tree, value, type_) for value in values]
        if all(fitted):
            return [value for value in fitted if value is not None]
    for value, expression in zip(values, written, strict=True):
        if coerce(ctx.tree, value, values[0].type) is None:
            ctx.report.add(
                rules.BRANCH_TYPES, expression.span, then=values[0].type, otherwise=value.type
            )
            break
    return FAILURE


def _selected(
    ctx: Context,
    e: ast.Call,
    of: Node,
    values: list[Node],
    written: Sequence[ast.Expression],
    scope: Scope,
) -> Node | Failure:
    """The choice, as one between the first value and all others, and so on.

    A number that no member has gets the last value.
    """
    found: Node | Failure = values[-1]
    for number in reversed(range(len(values) - 1)):
        if isinstance(found, Failure):
            break
        is_it = ctx.tree.node("call", BOOL, (of, build.constant(ctx.tree, INT, number)), "eq")
        node = ctx.tree.node("select", found.type, (is_it, values[number], found))
        sides = (written[0], written[number + 1], written[number + 2])
        found = checked(ctx, node, NAME, e.span, sides, scope)
    return found
