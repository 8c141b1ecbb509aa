"""Reports operations between values that have no common meaning."""

from __future__ import annotations

from collections.abc import Sequence

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.fixes import FixIt, Hint, fix_it
from ...diagnostics.source import Span
from ...ir.meaning import MAPS, Meaning
from ...ir.node import Node
from ...syntax import ast
from ...syntax.quoting import operand
from ...syntax.rewriting import rewritten
from ..declarations import enumerations, transform_paths
from ..state.context import Context
from ..state.scope import FAILURE, Failure, Scope
from ..types.meaning_rules import Clash, chosen, gathered, is_enum, of_members, side
from ..types.meanings import combined

Written = tuple[ast.Expression, ...]


def checked(
    ctx: Context, node: Node, shown: str, span: Span, written: Written, scope: Scope | None
) -> Node | Failure:
    """A call or a choice, provided that it means something; otherwise a report of both sides."""
    meanings = [ctx.meanings.of(operand) for operand in node.operands]
    if not any(meanings):
        return node
    if node.op == "select":
        operands, meanings, written = node.operands[1:], meanings[1:], written[1:]
        found = chosen((side(operands[0], meanings[0]), side(operands[1], meanings[1])))
    elif node.op == "array":
        found = gathered([side(o, m) for o, m in zip(node.operands, meanings, strict=True)])
    else:
        found = combined(node, meanings)
    if not isinstance(found, Clash):
        ctx.meanings.keep(node, found)
        return node
    return complain(ctx, found, meanings, shown, span, written, scope)


def members_refused(
    ctx: Context,
    name: str,
    operands: Sequence[Node],
    shown: str,
    span: Span,
    written: Written,
    scope: Scope | None,
) -> Failure | None:
    """Reports a builtin whose operands fit no signature, if one is a member of an enumeration."""
    meanings = [ctx.meanings.of(operand) for operand in operands]
    clash = of_members(name, tuple(map(side, operands, meanings)))
    if clash is None:
        return None
    return complain(ctx, clash, meanings, shown, span, written, scope)


def complain(
    ctx: Context,
    clash: Clash,
    meanings: list[Meaning | None],
    shown: str,
    span: Span,
    written: Written,
    scope: Scope | None,
) -> Failure:
    """Report operands that do not belong together, each where it stands."""
    left, right = meanings[clash.left], meanings[clash.right]
    assert left is not None and right is not None
    places = sorted({clash.left, clash.right})
    ctx.report.add(
        clash.rule, span, operator=shown, left=left, right=right,
        labels=[Label(written[i].span, f"this is `{meanings[i]}`") for i in places if written],
        hint=clash.hint or _hint(ctx, clash, meanings, shown, written, scope),
    )  # fmt: skip
    return FAILURE


def _hint(
    ctx: Context,
    clash: Clash,
    meanings: Sequence[Meaning | None],
    shown: str,
    written: Written,
    scope: Scope | None,
) -> Hint:
    left, right = meanings[clash.left], meanings[clash.right]
    assert left is not None and right is not None
    if clash.rule is rules.MEMBER_AND_NUMBER:
        other = next((e for i, e in enumerate(written) if i != clash.left), None)
        return enumerations.way_out(None, left, other)
    if clash.rule is rules.MIXED_ENUMS:
        return enumerations.same_named(left, written[clash.right] if written else None)
    if clash.rule is rules.NO_NUMBER:
        return _of_members(meanings, shown, written)
    if clash.rule is rules.NOT_OF_A_POINT:
        return "subtract the point that it is seen from; `vec3(p)` is its bare coordinates"
    if left.kind in MAPS and right.kind == "normal" and left.spaces[0] == right.spaces[0]:
        return _of_normal(left.spaces[1], written)
    if clash.rule is not rules.MIXED_SPACES or not written or scope is None:
        return ""
    ways = ((left, right.spaces[0], clash.left), (right, left.spaces[0], clash.right))
    offers = [
        rewritten(written[index].span, f"{{operand}} in {space}", "`{}`")
        for meaning, space, index in ways
        if transform_paths.is_offered(ctx, meaning, space, scope)
    ]
    known = " or ".join(offer.text for offer in offers)
    return FixIt(f"write {known}", tuple(fix for o in offers for fix in o.fixes)) if known else ""


def _of_members(meanings: Sequence[Meaning | None], shown: str, written: Written) -> Hint:
    """About members of enumerations where numbers are wanted."""
    first = meanings[0]
    if shown == "choose" and first is not None and first.enumeration is not None and written:
        return enumerations.values_for(first.enumeration, written)
    members = [e.span for e, meaning in zip(written, meanings, strict=False) if is_enum(meaning)]
    return enumerations.number_of(*members) if members else enumerations.number_of(None)


def _of_normal(space: str, written: Written) -> Hint:
    """About a matrix times a normal, which another matrix moves."""
    said = "normals move by the inverse transpose, which `{}` knows"
    if len(written) != 2:
        return said.format(f"… in {space}")
    matrix, normal = (each.span for each in written)
    exact = f"{operand(normal)} in {space}"
    return fix_it(said.format(exact), (matrix.to(normal), exact)) if "…" not in exact else ""
