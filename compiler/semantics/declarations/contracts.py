"""Checks values against declarations: the meaning has to be the wanted one, contracts are kept."""

from __future__ import annotations

from collections.abc import Iterator
from enum import IntEnum
from typing import TypeGuard

from ....stdlib.builtins.facts import UNIT
from ...diagnostics import rules
from ...diagnostics.fixes import Hint, either
from ...diagnostics.source import Span
from ...ir.meaning import ANGLE, GEOMETRY, Meaning
from ...ir.node import Node, bare
from ...ir.types import Array, Type, Vector, scalar_kind
from ...syntax import ast
from ...syntax.rewriting import rewritten
from ..state.context import Context
from ..state.scope import FAILURE, Failure, LightVariable, Scope
from ..types.coercion import coerce
from ..types.meaning_rules import fits, is_enum, weakened
from ..types.typenames import Declared
from . import enumerations, transform_paths
from .fitting import fit
from .written_types import declared_type


def as_declared(
    ctx: Context,
    node: Node | Failure,
    declared: Declared,
    written: ast.Expression,
    scope: Scope | None = None,
) -> Node | Failure:
    """The value of ``written`` with its declared type, meaning and contract."""
    if isinstance(node, Node) and is_enum(declared.meaning) and not _is_same(ctx, node, declared):
        return _wrong(ctx, node, declared, written.span, written)
    if _is_apart(node, ctx, declared):
        return meant(ctx, node, declared, written.span, written, scope)
    fitted = fit(ctx, node, declared.type, declared.text, written.span)
    if isinstance(fitted, Failure):
        return FAILURE
    return meant(ctx, fitted, declared, written.span, written, scope)


def meant(
    ctx: Context,
    node: Node,
    declared: Declared,
    span: Span,
    written: ast.Expression | None = None,
    scope: Scope | None = None,
) -> Node | Failure:
    """``node``, whose type fits already, with the declared meaning; or a report at ``span``."""
    found = ctx.meanings.of(node)
    if not fits(found, declared.meaning):
        if is_enum(found) or is_enum(declared.meaning):
            return _wrong(ctx, node, declared, span, written)
        assert found is not None
        ctx.report.add(
            rules.WRONG_MEANING, span, expected=declared.text, found=found,
            caption=f"this is `{found}`", hint=_way_out(ctx, found, declared, written, scope),
        )  # fmt: skip
        return FAILURE
    if declared.meaning == ANGLE and found is None and (number := _bare_number(written)):
        angles = (f"{number}deg", f"{number}rad")
        hint = either(f"`{angles[0]}` or `{angles[1]}`?", span, *angles)
        ctx.report.add(rules.BARE_ANGLE, span, text=number, hint=hint)
        return FAILURE
    return contracted(ctx, node, declared, span, written)


def _is_same(ctx: Context, node: Node, declared: Declared) -> bool:
    return node.type == declared.type and ctx.meanings.of(node) == declared.meaning


def _wrong(
    ctx: Context, node: Node, declared: Declared, span: Span, written: ast.Expression | None
) -> Failure:
    """Reports a member of an enumeration where something else is wanted, or the other way round."""
    found = ctx.meanings.of(node)
    shown = found if is_enum(found) else node.type
    ctx.report.add(
        rules.WRONG_MEANING, span, expected=declared.text, found=shown,
        caption=f"this is `{shown}`",
        hint=enumerations.way_out(found, declared.meaning, written),
    )  # fmt: skip
    return FAILURE


def _is_apart(node: Node | Failure, ctx: Context, declared: Declared) -> TypeGuard[Node]:
    """True if both are geometric, but not of one type (a point and a clip space point, say).

    Then the meaning that does not fit is reported, and not the type.
    """
    if isinstance(node, Failure) or coerce(ctx.tree, node, declared.type) is not None:
        return False
    found, wanted = ctx.meanings.of(node), declared.meaning
    if found is None or wanted is None or fits(found, wanted):
        return False
    return found.kind in GEOMETRY and wanted.kind in GEOMETRY


def contracted(
    ctx: Context, node: Node, declared: Declared, span: Span, written: ast.Expression | None
) -> Node | Failure:
    """``node`` with the declared meaning, provided that it keeps the declared contract."""
    if needs_unit(declared) and not is_unit(ctx, node):
        found = ctx.meanings.of(node) or node.type
        normalized = "normalize({text})"
        ctx.report.add(
            rules.NOT_UNIT, span, expected=declared.text, found=found,
            caption=f"this is `{found}`, of any length",
            hint=f"write `{normalized.format(text='…')}`" if written is None
            else rewritten(written.span, normalized),
        )  # fmt: skip
        return FAILURE
    return ctx.meanings.ascribed(node, declared.meaning)


def needs_unit(declared: Declared) -> bool:
    """True if a value has to be proven to have length one."""
    return declared.fact.unit and isinstance(declared.type, Vector)


def is_unit(ctx: Context, node: Node) -> bool:
    """True if range analysis, or the value itself, proves that a vector has length one."""
    for choice in _choices(node):
        if ctx.ranges.of(choice).unit:
            continue
        if not ctx.constants.is_unit(choice):
            ctx.progress.unproven += bool(choice.variables)
            return False
        ctx.ranges.assume(choice, UNIT)
    return True


def _choices(root: Node) -> Iterator[Node]:
    """Yields the possible values of a node: itself, or the sides of a choice."""
    pending, seen = [root], {root.id}
    while pending:
        node = pending.pop()
        if bare(node).op != "select":
            yield node
            continue
        sides = [side for side in bare(node).operands[1:] if side.id not in seen]
        seen.update(side.id for side in sides)
        pending += sides


def _bare_number(written: ast.Expression | None) -> str:
    """A number that is no angle, in decimal; empty for anything else, and for zero."""
    sign = ""
    while isinstance(written, ast.Unary) and written.operator == "-":
        written, sign = written.operand, "" if sign else "-"
    if not isinstance(written, ast.Number) or written.kind in ("angle", "uint"):
        return ""
    text = written.text
    if text[:2] in ("0x", "0X"):
        text = str(int(text, 16))
    return sign + text if float(text) else ""


def _way_out(
    ctx: Context,
    found: Meaning,
    declared: Declared,
    written: ast.Expression | None,
    scope: Scope | None,
) -> Hint:
    wanted = declared.meaning
    assert wanted is not None

    def instead(pattern: str, said: str) -> Hint:
        shown = said.format(pattern.format(text="…", operand="…"))
        return shown if written is None else rewritten(written.span, pattern, said)

    if found.kind in GEOMETRY and wanted.kind in GEOMETRY:
        places = {found.kind == "point", wanted.kind == "point"}
        if len(places) == 1 and scope is not None:
            if transform_paths.is_offered(ctx, found, wanted.spaces[0], scope):
                return instead(f"{{operand}} in {wanted.spaces[0]}", "write `{}`")
            return instead(f"({{text}} as {wanted})", "if it is meant, write `{}`")
        if len(places) == 2:
            return "a vector leads from one point to another: `b - a`"
    if found.kind in GEOMETRY or wanted.kind in GEOMETRY:
        return instead(f"{declared.type}({{text}})", "`{}` is what it is made of, as bare numbers")
    return ""


class Change(IntEnum):
    """The change of an argument for a function to take it, from least to most."""

    NONE = 0
    ALIKE = 1
    """Another meaning that says as much: a normal as a direction, which has length one, too."""
    WEAKENED = 2
    """Another meaning that it has as well: a direction as a vector."""
    MEANT = 3
    """A meaning for bare numbers, or none any more."""
    TO_FLOAT = 4
    """A whole number as a float."""
    TO_UINT = 5
    SPREAD = 6
    """One number in all lanes."""
    SPREAD_TO_FLOAT = 7
    SPREAD_TO_UINT = 8


def change(ctx: Context, argument: Node, declared: Declared, *, broadcast: bool) -> Change | None:
    """The change of an argument to a declared type and meaning; ``None`` if it is impossible."""
    found = ctx.meanings.of(argument)
    fitted = coerce(ctx.tree, argument, declared.type, broadcast=broadcast)
    if fitted is None or not fits(found, declared.meaning):
        return None
    if needs_unit(declared) and not is_unit(ctx, fitted):
        return None
    if argument.type != declared.type:
        return _of_type(argument.type, declared.type)
    if found == declared.meaning:
        return Change.NONE
    if found is None or declared.meaning is None:
        return Change.MEANT
    return Change.ALIKE if needs_unit(declared) else Change.WEAKENED


def _of_type(found: Type, wanted: Type) -> Change:
    """The change of a literal that adapts from one type to another."""
    while isinstance(found, Array) and isinstance(wanted, Array):
        found, wanted = found.element, wanted.element
    kind = scalar_kind(wanted)
    same, spread = scalar_kind(found) == kind, isinstance(wanted, Vector)
    if same:
        return Change.SPREAD
    if kind == "uint":
        return Change.SPREAD_TO_UINT if spread else Change.TO_UINT
    return Change.SPREAD_TO_FLOAT if spread else Change.TO_FLOAT


def assumed(ctx: Context, variable: Node, declared: Declared) -> Node:
    """A variable of which nothing is known but how it was declared."""
    if needs_unit(declared):
        ctx.ranges.assume(variable, UNIT)
    return ctx.meanings.ascribed(variable, declared.meaning)


def light_variable(
    ctx: Context, light: LightVariable, name: str, variable: Node, sample: Node
) -> Node:
    """A slot of ``light`` in a term, with the type that all lights of the rig have to keep."""
    if variable.id not in ctx.lights.types:
        declared, typing = None, light.record.typing(name)
        if typing is not None and typing.member.type is not None:
            declared = declared_type(ctx, typing.member.type, typing.owner.module)
        meaning = weakened(ctx.meanings.of(sample))
        untyped = Declared(sample.type, str(meaning or sample.type), meaning=meaning)
        ctx.lights.types[variable.id] = declared or untyped
    return assumed(ctx, variable, ctx.lights.types[variable.id])
