"""Expressions over parameters as a list of steps, operands before users.

A list and not a tree, because a tree repeats what is shared (exponentially, in the worst case) and
nests as deeply as the expression does; a host evaluates the list in one loop.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..documents.steps import STEPS, StepRow
from ..ir.host import KEYS, PLAIN
from ..ir.leaves import Parameter, Texture
from ..ir.node import Folding, Node
from ..ir.walks import in_order_of_use


def steps(value: Node) -> tuple[StepRow, ...]:
    """The steps that compute ``value``, which is the last of them.

    Their order follows from the value alone, and not from what else the material computes: equal
    values have equal steps, so that a host recognises blocks that it can share.

    Raises ``ValueError`` for an operation that no host computes.
    """
    nodes = in_order_of_use([value], of_all=True)
    numbers = {node.id: number for number, node in enumerate(nodes)}
    return tuple(_step(node, numbers) for node in nodes)


def _step(node: Node, numbers: Mapping[int, int]) -> StepRow:
    if node.op not in STEPS:
        raise ValueError(f"a host cannot compute {node.op}")
    return STEPS[node.op](
        op=node.op,
        type=str(node.type),
        args=tuple([numbers[operand.id] for operand in node.operands]),
        **_data(node),
    )


def _data(node: Node) -> dict[str, Any]:
    """The fields of a step besides its arguments."""
    if node.op in PLAIN:
        return {}
    if isinstance(node.data, Folding):
        return {"operator": node.data.operator, "bound": node.data.bound}
    if isinstance(node.data, Parameter | Texture):
        return {KEYS[node.op]: node.data.name}
    return {KEYS[node.op]: node.data}
