"""Checks what stands in a loop: the number of inner loops, crossings from vertices, and reads.

``loops.py`` asks before it makes a loop. Other rules ask here as well what a loop computes anew.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator

from ....stdlib.builtins import BUILTINS
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir.node import Formal, Node, binders, bodies_of, reachable
from ...ir.operations import LOOPS, joins_group
from ...syntax import ast
from ..state.context import Context
from .turns import Turns

DEEPEST = 48
"""The largest number of loops inside of each other.

Tint takes 127 nested statements, of which each loop is two, and there may be branches as well.
Besides, every loop closes and opens all that stands in it.
"""
CROSSING_TURNS = 16
"""A fold whose terms cross from the vertices one by one is written out, up to so many."""
LARGEST_WRITTEN_OUT = 4096
"""The largest number of operations of such an unrolled fold.

Folds in folds multiply, and there are far fewer varyings than that.
"""

_VARYING = frozenset({"cross", "attribute", "input", "texture"})


def too_deep(ctx: Context, e: ast.Fold | ast.Iterate, around: int) -> bool:
    """True if a loop is nested too deeply, in other loops or by those in it; reported."""
    if around < DEEPEST:
        return False
    ctx.report.add(rules.LOOPS_TOO_NESTED, e.span, most=DEEPEST)
    return True


def loops_within(bodies: Iterable[Node], formals: set[Formal]) -> int:
    """The number of loops nested in one another in a loop over ``formals``, which is not counted.

    Those of called functions are included. A loop stands in the innermost one on whose variables it
    depends: a value that does not change in a loop is computed before it.
    """
    deepest = 0
    seen: set[tuple[Node, tuple[int, ...]]] = set()
    pending: list[tuple[Node, tuple[int, ...]]] = [(body, ()) for body in bodies]
    while pending:
        place = node, around = pending.pop()
        outer = _loops_around(node, around, formals)
        if outer is None or place in seen:
            continue
        seen.add(place)
        depth = outer + (node.op in LOOPS)
        deepest = max(deepest, depth)
        inside = bodies_of(node)
        bound = (depth,) * binders(node) + around
        pending += (
            (operand, bound if position in inside else around)
            for position, operand in enumerate(node.operands)
        )
    return deepest


def _loops_around(node: Node, around: tuple[int, ...], formals: set[Formal]) -> int | None:
    """The number of inner loops around a node; ``None`` if it does not change in the outer one.

    ``around`` has the number for each variable that is bound further out, the innermost first.
    """
    variables = node.free & ((1 << len(around)) - 1)
    if variables:
        innermost = (variables & -variables).bit_length() - 1
        return around[innermost]
    return None if node.variables.isdisjoint(formals) else 0


def changing(
    bodies: Iterable[Node], formals: set[Formal], known: Container[Node] = ()
) -> Iterator[Node]:
    """The nodes that a loop over ``formals`` computes anew in every iteration.

    Inner loops are included, nodes that are ``known`` already are not.
    """
    seen: set[Node] = set()
    pending = list(bodies)
    while pending:
        node = pending.pop()
        if node in seen or node in known:
            continue
        if node.free or not node.variables.isdisjoint(formals):
            seen.add(node)
            yield node
            pending += node.operands


def may_stand(
    ctx: Context,
    turns: Turns,
    bodies: tuple[Node, ...],
    formals: set[Formal],
    span: Span,
    *,
    waits: bool,
    states: bool = False,
) -> bool:
    """True if everything in a loop has a meaning there; reported if not.

    ``waits`` says that pixels may stop apart.
    """
    inside = list(changing(bodies, formals))
    crossing = next((node for node in inside if node.op == "cross"), None)
    if crossing is not None and (
        states
        or not turns.known
        or turns.bound > CROSSING_TURNS
        or turns.bound * len(inside) > LARGEST_WRITTEN_OUT
    ):
        ctx.report.add(rules.CROSSING_IN_LOOP, ctx.places.within(crossing, span))
        return False
    read = next((node for node in inside if needs_others(node)), None)
    if read is None or not (waits or _varies(turns.count)):
        return True
    _report_read(ctx, read, span)
    return False


def _report_read(ctx: Context, read: Node, span: Span) -> None:
    """Report an operation of neighbours, or of a work group, which may have left the loop."""
    what, hint = f"`{read.data}`", f"compute `{read.data}` in front of the loop"
    others, does = "pixels", "compares neighbouring pixels"
    if read.data in ("sample", "sample_bias"):
        what, hint = "a texture read", ""
    if joins_group(read):
        others, does = "invocations", "joins the invocations of a work group"
        hint += ", or of what the loop gives"
    labels = [Label(span, f"{others} leave this loop after different numbers of iterations")]
    place = ctx.places.within(read, span)
    ctx.report.add(rules.READ_IN_LOOP, place, what=what, does=does, labels=labels, hint=hint)


def needs_others(node: Node) -> bool:
    """True if an operation compares neighbouring pixels, or joins the values of a work group."""
    return node.op in ("call", "native") and BUILTINS[str(node.data)].uniform_control_flow


def _varies(count: Node) -> bool:
    """True if pixels may have different numbers of iterations."""
    nodes = reachable((count,))
    return any(node.op in _VARYING or joins_group(node) for node in nodes)
