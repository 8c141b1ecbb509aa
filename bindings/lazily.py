"""Leaves out guards where a choice around them has been made already.

The reference computes both sides of a choice, so that it replaces a divisor that is zero, and then
chooses again. Languages compute only one side: ``abs(y) < least ? 0 : x / y`` is enough there.
"""

from __future__ import annotations

from ..compiler.tracing import Expression, made


def lazily(value: Expression) -> Expression:
    """An expression without choices that others have made already.

    Only an operand that nothing else needs is simplified, as others would compute it in any case.
    """
    uses = _uses(value)
    if value.op != "where":
        return value
    condition, then, otherwise = value.operands
    if uses[id(otherwise)] > 1 or not otherwise.operands:
        return value
    operands = tuple(
        each.operands[2] if each.op == "where" and each.operands[0] is condition else each
        for each in otherwise.operands
    )
    chosen = made(
        otherwise.op, *operands, kind=otherwise.kind, is_natural=otherwise.is_natural,
        value=otherwise.value,
    )  # fmt: skip
    return made("where", condition, then, chosen, kind=value.kind, is_natural=value.is_natural)


def _uses(value: Expression) -> dict[int, int]:
    """The number of expressions that need each one, by identity."""
    uses: dict[int, int] = {}
    pending = [value]
    while pending:
        each = pending.pop()
        uses[id(each)] = uses.get(id(each), 0) + 1
        if uses[id(each)] == 1:
            pending.extend(each.operands)
    return uses
