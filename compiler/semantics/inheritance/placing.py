"""The record in which a member belongs, with the line to write there."""

from __future__ import annotations

from ....stdlib.builtins.foreign_words import HIDDEN, OF_PASSES
from ...diagnostics.fixes import Hint, fix_it
from ...syntax import ast
from ...syntax.quoting import spanned


def in_place(kind: str, member: ast.Member) -> Hint:
    """About a member that belongs in a pass and stands in a record of another ``kind``.

    Empty for members that belong elsewhere.
    """
    where = ast.kind_of(member)
    if where.records != ("pass",):
        return ""
    said = f"`{where.word}` belongs in a pass, {OF_PASSES.format(spanned(member.span))}"
    if kind != "material" or not isinstance(member, ast.Discard):
        return said
    slot = f"{HIDDEN} = {member.condition.span.text}"
    hidden = f"a material says it by `{HIDDEN} = {spanned(member.condition.span)}`"
    return fix_it(f"{hidden}; {said}", (member.span, slot))
