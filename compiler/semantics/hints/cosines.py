"""Warns where the cosine of an angle is meant, and a vector of unknown length is multiplied.

The dot product of two directions is the cosine of the angle between them. With a vector in place of
one it is that many times larger, which ``pow(dot(normal, v), 32)`` and ``acos`` make wrong results
of: the type rules cannot object, as ``dot`` takes all vectors.
"""

from __future__ import annotations

from ....stdlib.builtins.facts import UNIT_SLACK
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir.meaning import ARROWS
from ...ir.node import Node, bare
from ...syntax.rewriting import rewritten
from ..state.context import Context

OF_COSINES = ("pow", "acos", "asin")
"""The builtins whose first operand is a cosine if it is a dot product with a direction."""

_HINT = "`normalize(v)` is the direction of a vector"

_KEEP = ("max", "abs", "saturate")
"""The builtins that stand around a cosine."""

_STEPS = ("add", "sub", "mul", "div", "neg", "max", "min")
"""The builtins by which a vector is scaled, or made of others."""

_MEASURES = ("length", "distance", "dot", "sqrt", "inversesqrt", "cross", "refract")
"""The builtins that take, or set, the length of what they get."""


def warn_of_length(ctx: Context, call: Node, span: Span) -> None:
    """Warn if the first operand of a call is a dot product of a direction and a longer vector."""
    cosine = _within(call.operands[0])
    if cosine.op != "call" or cosine.data != "dot":
        return
    longer = [each for each in cosine.operands if _is_vector(ctx, each)]
    if len(longer) != 1 or not any(_is_unit(ctx, each) for each in cosine.operands):
        return
    fact = ctx.ranges.of(cosine)
    if max(fact.hi, -fact.lo) <= 1 + 2 * UNIT_SLACK:
        return
    place = ctx.places.within(longer[0], span)
    is_known = place != span
    hint = rewritten(place, "normalize({text})", "`{}` is its direction") if is_known else _HINT
    labels = [Label(place, "this is a vector of any length")] if is_known else []
    ctx.report.add(rules.COSINE_OF_VECTOR, span, function=call.data, labels=labels, hint=hint)


def _is_vector(ctx: Context, node: Node) -> bool:
    """True if a value is declared, or computed, as a vector, and nothing cares for its length."""
    meaning = ctx.meanings.of(node)
    return meaning is not None and meaning.kind == "vector" and not _is_measured(ctx, node)


def _is_measured(ctx: Context, node: Node) -> bool:
    """True if a length or a product takes part in a vector, which may well be of length one then.

    So it is with ``v / length(v)``, and with reflections and roots written out by hand.
    """
    pending, seen = [node], set[Node]()
    while pending:
        top = bare(pending.pop())
        if top.data in _MEASURES and top.op == "call":
            return True
        if top in seen or not _is_arithmetic(ctx, top):
            continue
        seen.add(top)
        pending += top.operands
    return False


def _is_arithmetic(ctx: Context, node: Node) -> bool:
    """True for numbers and vectors that are made of others; lengths of points say nothing."""
    meaning = ctx.meanings.of(node)
    is_arithmetic = node.op in ("splat", "select") or (node.op == "call" and node.data in _STEPS)
    return is_arithmetic and (meaning is None or meaning.kind in ARROWS)


def _is_unit(ctx: Context, node: Node) -> bool:
    meaning = ctx.meanings.of(node)
    is_direction = meaning is not None and meaning.kind == "direction"
    return is_direction or ctx.ranges.of(node).unit


def _within(node: Node) -> Node:
    """The value inside of the calls that only limit it."""
    inner = bare(node)
    while inner.op == "call" and inner.data in _KEEP:
        longest = [each for each in map(bare, inner.operands) if each.op != "constant"]
        if len(longest) != 1:
            break
        inner = longest[0]
    return inner
