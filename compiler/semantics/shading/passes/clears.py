"""The values to which a pass clears its targets and its depths, before anything is drawn.

``elaborate.py`` asks for it for every pass. Each value is inherited by itself: the nearest record
that has it counts. Hosts clear by it where a pass is drawn alone, and so do the steps of frames
that say nothing else (``semantics/frames/steps.py``).
"""

from __future__ import annotations

from collections.abc import Iterator

from .....support.frozen import frozen
from ....diagnostics import rules
from ....syntax import ast
from ...checking.unknown_names import unknown
from ...inheritance.records import Record
from ...names.duplicates import check_once
from ...state.context import Context
from ...state.scope import Scope
from .formats import cleared_depth, cleared_value

DEPTH = "depth"
"""The name of depths among the targets of a pass."""


@frozen(eq=False)
class Clears:
    """The values of targets and depths at first."""

    targets: dict[str, tuple[float, ...]]
    """The values in four lanes, by the names of the targets."""
    depth: float | None = None


def clears_of(ctx: Context, drawn: Record) -> Clears:
    """The clear values of a pass; errors are reported, and left out."""
    formats = {target.name.text: target.format.text for target, *_ in drawn.every(ast.Target)}
    found: dict[str, tuple[float, ...]] = {}
    depth: float | None = None
    for name, value, scope in _written(ctx, drawn):
        if name.text in formats:
            node = cleared_value(ctx, formats[name.text], value, scope)
            lanes = ctx.constants.value(node, value.span)
            if isinstance(lanes, tuple):
                found[name.text] = tuple(float(lane) for lane in lanes if isinstance(lane, float))
        elif name.text == DEPTH:
            depth = _depth(ctx, value, scope)
        else:
            known = [*formats, DEPTH]
            unknown(ctx, f"target of `{drawn.name}`", name.text, name.span, known)
    return Clears(found, depth)


def _written(ctx: Context, drawn: Record) -> Iterator[tuple[ast.Name, ast.Expression, Scope]]:
    """Yields all clear values that are written, those of ancestors first."""
    for member, owner, _ in drawn.every(ast.Clear):
        check_once(ctx.report, (value.name for value in member.values))
        for value in member.values:
            assert value.value is not None
            yield value.name, value.value, Scope(owner.module)


def _depth(ctx: Context, written: ast.Expression, scope: Scope) -> float | None:
    number = ctx.constants.number(cleared_depth(ctx, written, scope), written.span)
    if number is not None and not 0.0 <= number <= 1.0:
        ctx.report.add(rules.NO_DEPTH, written.span, depth=f"{number:g}")
        return None
    return number
