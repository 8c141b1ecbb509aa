"""What compares neighbouring pixels cannot stand in a loop that some of them have left.

Elsewhere the compiler moves such reads and derivatives to where all pixels come by; out of a loop
on whose turn they depend there is no moving them.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...stdlib.builtins import BUILTINS
from ..diagnostics import rules
from ..diagnostics.diagnostic import Report
from ..ir.node import Node, reachable
from ..ir.types import INT
from .shader import Notes


def check_loops(roots: Iterable[Node], report: Report, notes: Notes) -> None:
    """Report what compares pixels in loops whose turns may differ from pixel to pixel."""
    varying: set[int] = set()
    bodies: list[Node] = []
    for node in reachable(roots):
        if _differs(node) or any(operand.id in varying for operand in node.operands):
            varying.add(node.id)
        if node.op == "fold" and node.operands[0].id in varying:
            bodies.append(node.operands[2])
    for node in reachable(bodies):
        # What depends on no variable is computed before the loop.
        span = notes.spans.get(node.id)
        if node.free and _compares(node) and span is not None:
            row = BUILTINS[str(node.data)]
            what = "a texture read without a level" if row.sampler else f"`{row.name}`"
            hint = (
                "say which level: `name.level(coordinate, 0)`, or `name.grad(coordinate, dx, dy)`"
            )
            report.add(rules.IMPLICIT_IN_LOOP, span, what=what, hint=hint if row.sampler else "")


def _differs(node: Node) -> bool:
    """Whether a value differs between pixels whatever its operands do; variables of lights may."""
    if node.op == "bound":
        return node.type != INT
    return node.op in ("interpolate", "attribute", "input") or _compares(node)


def _compares(node: Node) -> bool:
    return node.op in ("call", "native") and BUILTINS[str(node.data)].uniform_control_flow
