"""The simplification rule for differences between neighbouring pixels: ``ddx`` and ``ddy``."""

from __future__ import annotations

from ...ir.operations import CROSS
from .rule import ANY, Builder, Rule, Site, constant

_VARYING = frozenset({"input", "attribute", "formal", "bound"})
"""What may be different for the next pixel, besides what is interpolated."""


def _is_steady(b: Builder, at: Site) -> bool:
    """Whether a value is the same for all pixels of a triangle.

    Each node is looked at once, however many differences are taken of what needs it.
    """
    (root,) = at.operands
    steady = b.steady
    pending = [root]
    while pending:
        node = pending[-1]
        if node in steady:
            pending.pop()
        elif node.op == "cross" or node.op in _VARYING:
            steady[node] = node.op == "cross" and CROSS.data(node).mode == "flat"
        elif missing := [operand for operand in node.operands if operand not in steady]:
            pending += missing
        else:
            steady[node] = all(steady[operand] for operand in node.operands)
    return steady[root]


DIFFERENCES = (
    Rule("difference of what is steady",
         "Constants, parameters and flat values are the same at the next pixel.",
         ("ddx", "ddy"), (ANY,), constant(0), _is_steady),
)  # fmt: skip
