"""Structures and arrays made from their parts: ``Layer(#fff, 0.5)``, ``[a, b, c]``."""

from __future__ import annotations

from collections.abc import Sequence

from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...ir.node import Node
from ...ir.types import Array, Opaque, TextureType, Type
from ...syntax import ast
from ...syntax.quoting import counted
from ..declarations.contracts import as_declared
from ..declarations.written_types import MOST_ELEMENTS, struct_of
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import FAILURE, Failure, Scope, Value
from ..types.coercion import coerce
from ..types.typenames import Declared
from .combinations import checked


def structure(ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], e: ast.Call) -> Value:
    """A structure from its members, in the order of their declaration or by their names."""
    declared = struct_of(ctx, symbol)
    if declared is None:
        return FAILURE
    members = declared.members
    numbers: Sequence[int] = range(len(arguments))
    if e.names:
        found = _placed(ctx, symbol, declared, e)
        if found is None:
            return FAILURE
        numbers = found
    elif len(arguments) != len(members):
        ctx.report.add(
            rules.MEMBER_COUNT, e.span, name=symbol.name, found=counted(len(arguments), "value"),
            members=", ".join(f"{name}: {member.text}" for name, member in members),
            labels=[Label(symbol.declaration.name.span, "declared here")],
        )  # fmt: skip
        return FAILURE
    parts: dict[int, Node] = {}
    failed = False
    for number, given, written in zip(numbers, arguments, e.arguments, strict=True):
        name, member = members[number]
        wanted = changed(member, text=f"{member.text} for `{name}`")
        part = as_declared(ctx, given, wanted, written)
        if isinstance(part, Failure):
            failed = True
        else:
            parts[number] = part
    if failed:
        return FAILURE
    values = tuple([parts[number] for number in range(len(members))])
    return ctx.tree.node("struct", declared.type, values)


def _placed(ctx: Context, symbol: Symbol, declared: Declared, e: ast.Call) -> list[int] | None:
    """The number of the member for each value of a call with names."""
    from .arguments import Head, placed

    names = tuple([name for name, _ in declared.members])
    listed = ", ".join(f"{name}: {member.text}" for name, member in declared.members)
    label = Label(symbol.declaration.name.span, "declared here")
    head = Head(symbol.name, names, frozenset(), f"{symbol.name}({listed})", (label,))
    return placed(ctx, e, head)


def array(ctx: Context, e: ast.Array, elements: Sequence[Node], scope: Scope) -> Value:
    """``[a, b, c]``: elements of one type, to which constants among them adapt."""
    if len(elements) > MOST_ELEMENTS:
        ctx.report.add(rules.BAD_COUNT, e.span, count=len(elements))
        return FAILURE
    for element, written in zip(elements, e.elements, strict=True):
        if isinstance(element.type, Opaque):
            what = "textures" if isinstance(element.type, TextureType) else "buffers"
            ctx.report.add(
                rules.WRONG_TYPE, written.span, expected="a value", found=element.type,
                hint=f"{what} cannot be elements: gather what is read of them",
            )  # fmt: skip
            return FAILURE
    types: dict[Type, None] = dict.fromkeys(element.type for element in elements)
    for type_ in types:
        fitted = [coerce(ctx.tree, element, type_) for element in elements]
        if all(fitted):
            parts = tuple(part for part in fitted if part is not None)
            whole = ctx.tree.node("array", Array(type_, len(parts)), parts)
            return checked(ctx, whole, "[…]", e.span, e.elements, scope)
    _report_odd(ctx, e, elements)
    return FAILURE


def _report_odd(ctx: Context, e: ast.Array, elements: Sequence[Node]) -> None:
    """Say which element is not like the first."""
    first = elements[0]
    for element, written in zip(elements, e.elements, strict=True):
        if coerce(ctx.tree, element, first.type) is None:
            ctx.report.add(
                rules.ELEMENTS_DIFFER, written.span, first=first.type, found=element.type,
                labels=[Label(e.elements[0].span, f"this is `{first.type}`")],
            )  # fmt: skip
            return
