"""Values as what was declared: whether the meaning is the one wanted, and the contract is kept."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, TypeGuard

from ....stdlib.builtins.facts import UNIT
from ...diagnostics import rules
from ...diagnostics.fixes import Hint, either
from ...diagnostics.source import Span
from ...ir.meaning import ANGLE, GEOMETRY, Meaning
from ...ir.node import Node, bare
from ...ir.types import Vector
from ...syntax import ast
from ..hints.rewriting import rewritten
from ..state.scope import FAILURE, Failure, LightVariable, Scope
from ..types.coercion import coerce
from ..types.meaning_rules import fits, weakened
from ..types.typenames import Declared
from . import transform_paths
from .written_types import declared_type

if TYPE_CHECKING:
    from ..state.context import Lowering


def meant(
    low: Lowering,
    node: Node,
    declared: Declared,
    span: Span,
    written: ast.Expression | None = None,
    scope: Scope | None = None,
) -> Node | Failure:
    """``node``, whose type fits already, with the declared meaning; or a report at ``span``."""
    found = low.meanings.of(node)
    if not fits(found, declared.meaning):
        assert found is not None
        low.report.add(
            rules.WRONG_MEANING, span, expected=declared.text, found=found,
            caption=f"this is `{found}`", hint=_way_out(low, found, declared, written, scope),
        )  # fmt: skip
        return FAILURE
    if declared.meaning == ANGLE and found is None and (number := _bare_number(written)):
        angles = (f"{number}deg", f"{number}rad")
        hint = either(f"`{angles[0]}` or `{angles[1]}`?", span, *angles)
        low.report.add(rules.BARE_ANGLE, span, text=number, hint=hint)
        return FAILURE
    return contracted(low, node, declared, span, written)


def is_apart(node: Node | Failure, low: Lowering, declared: Declared) -> TypeGuard[Node]:
    """Whether a value of another type means another kind of the same thing: both are geometry."""
    if isinstance(node, Failure) or coerce(low.graph, node, declared.type) is not None:
        return False
    found, wanted = low.meanings.of(node), declared.meaning
    if found is None or wanted is None or fits(found, wanted):
        return False
    return found.kind in GEOMETRY and wanted.kind in GEOMETRY


def contracted(
    low: Lowering, node: Node, declared: Declared, span: Span, written: ast.Expression | None
) -> Node | Failure:
    """``node`` with the declared meaning, provided that it keeps the declared contract."""
    if needs_unit(declared) and not is_unit(low, node):
        found = low.meanings.of(node) or node.type
        normalized = "normalize({text})"
        low.report.add(
            rules.NOT_UNIT, span, expected=declared.text, found=found,
            caption=f"this is `{found}`, of any length",
            hint=f"write `{normalized.format(text='…')}`" if written is None
            else rewritten(written.span, normalized),
        )  # fmt: skip
        return FAILURE
    return low.meanings.ascribed(node, declared.meaning)


def needs_unit(declared: Declared) -> bool:
    """Whether a value has to be proven to have length one."""
    return declared.fact.unit and isinstance(declared.type, Vector)


def is_unit(low: Lowering, node: Node) -> bool:
    """Whether range analysis, or the value itself, proves that a vector has length one."""
    for choice in _choices(node):
        if low.ranges.of(choice).unit:
            continue
        if not low.constants.is_unit(choice):
            return False
        low.ranges.assume(choice, UNIT)
    return True


def _choices(root: Node) -> Iterator[Node]:
    """What a value may be: itself, or what a choice chooses between."""
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
    """A number without a unit, as it is written; empty for anything else, and for zero."""
    sign = ""
    while isinstance(written, ast.Unary) and written.operator == "-":
        written, sign = written.operand, "" if sign else "-"
    if not isinstance(written, ast.Number) or written.unit or float(written.text) == 0:
        return ""
    return sign + written.text


def _way_out(
    low: Lowering,
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
            if transform_paths.is_offered(low, found, wanted.spaces[0], scope):
                return instead(f"{{operand}} in {wanted.spaces[0]}", "write `{}`")
            return instead(f"({{text}} as {wanted})", "if it is meant, write `{}`")
        if len(places) == 2:
            return "a vector leads from one point to another: `b - a`"
    if found.kind in GEOMETRY or wanted.kind in GEOMETRY:
        return instead(f"{declared.type}({{text}})", "`{}` is what it is made of, as bare numbers")
    return ""


def adapts(low: Lowering, argument: Node, declared: Declared, *, broadcast: bool) -> bool | None:
    """Whether an argument has to change to be what is declared; ``None`` where it cannot."""
    found = low.meanings.of(argument)
    fitted = coerce(low.graph, argument, declared.type, broadcast=broadcast)
    if fitted is None or not fits(found, declared.meaning):
        return None
    if needs_unit(declared) and not is_unit(low, fitted):
        return None
    return fitted is not argument or (found is None) != (declared.meaning is None)


def assumed(low: Lowering, variable: Node, declared: Declared) -> Node:
    """A variable of which nothing is known but how it was declared."""
    if needs_unit(declared):
        low.ranges.assume(variable, UNIT)
    return low.meanings.ascribed(variable, declared.meaning)


def light_variable(
    low: Lowering, light: LightVariable, name: str, variable: Node, sample: Node
) -> Node:
    """A slot of ``light`` in a term: what all lights of the rig have to keep to."""
    if variable.id not in low.variables:
        declared, typing = None, light.record.typing(name)
        if typing is not None and typing.member.type is not None:
            declared = declared_type(low, typing.member.type, typing.owner.module)
        meaning = weakened(low.meanings.of(sample))
        untyped = Declared(sample.type, str(meaning or sample.type), meaning=meaning)
        low.variables[variable.id] = declared or untyped
    return assumed(low, variable, low.variables[variable.id])
