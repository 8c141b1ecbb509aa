"""Values that are assigned to declared slots: they keep the type, and a parameter's range."""

from __future__ import annotations

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...ir.node import Node
from ...syntax import ast
from ..inheritance.records import Record
from ..state.context import Context
from ..state.scope import FAILURE, Failure, Scope
from ..types.coercion import settled
from ..types.typenames import Declared
from .contracts import as_declared
from .parameters import is_within, limits_of, range_text
from .written_types import declared_type


def assigned(
    ctx: Context,
    record: Record,
    name: str,
    value: Node | Failure,
    written: ast.Expression,
    scope: Scope,
    level: int,
) -> Node | Failure:
    """``value`` with the type and meaning that ``record`` declares for ``name``.

    It is written at ``level``.
    """
    typing = record.typing(name)
    if typing is None or typing.member.type is None:
        return value
    wanted = type_of(ctx, record, name)
    if wanted is None:
        return FAILURE
    value = as_declared(ctx, value, wanted, written, scope)
    if isinstance(value, Node):
        _check_range(ctx, record, name, value, written, level)
        if wanted.meaning is None:
            value = settled(ctx.tree, value)
    return value


def type_of(ctx: Context, record: Record, name: str) -> Declared | None:
    """The type that is written for a slot; ``None`` if there is none, or none that is known."""
    typing = record.typing(name)
    if typing is None or typing.member.type is None:
        return None
    return declared_type(ctx, typing.member.type, typing.owner.module)


def _check_range(
    ctx: Context, record: Record, name: str, value: Node, written: ast.Expression, level: int
) -> None:
    """Report a value that is proven to be outside of the range of the parameter it overrides."""
    overridden = (d for d in record.definitions[name] if d.level > level)
    declared = next((d for d in overridden if isinstance(d.member, ast.Param)), None)
    limits = None if declared is None else limits_of(ctx, declared)
    if declared is None or limits is None or not _is_outside(ctx, value, *limits):
        return
    assert isinstance(declared.member, ast.Param)
    ctx.report.add(
        rules.OUT_OF_RANGE, written.span, value="this value",
        range=range_text(declared.member, limits),
        labels=[Label(declared.member.name.span, "the parameter is declared here")],
    )  # fmt: skip


def _is_outside(ctx: Context, value: Node, lo: float, hi: float) -> bool:
    known = ctx.constants.known(value)
    if known is not None:
        return not is_within(known, lo, hi)
    fact = ctx.ranges.of(value)
    return fact.lo > hi or fact.hi < lo
