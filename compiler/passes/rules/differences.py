"""The simplification rule for differences between neighbouring pixels: ``ddx`` and ``ddy``."""

from __future__ import annotations

from ...ir.node import Node
from ...ir.operations import CROSS
from ...ir.types import Type
from .builder import Builder
from .rule import Rule
from .terms import condition, function
from .vocabulary import x

_VARYING = frozenset({"input", "attribute", "formal", "bound"})
"""Operations that may have another value for the next pixel, besides interpolated varyings."""


@condition("{} is the same for all pixels of a triangle")
def _is_steady(builder: Builder, _type: Type, value: Node) -> bool:
    """True if a value is the same for all pixels of a triangle.

    Each node is looked at once, however many differences are taken of values that need it.
    """
    steady = builder.steady
    pending = [value]
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
    return steady[value]


DIFFERENCES = (
    Rule("difference of what is steady", function("ddx", "ddy")(x), 0,
         "Constants, parameters and flat values are the same at the next pixel.",
         where=_is_steady(x)),
)  # fmt: skip
