"""The least evaluator that small graphs over parameters need; it knows nothing of storage."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import Any

from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Folding, Node
from burnish.compiler.ir.operations import MEMBER, SWIZZLE
from burnish.compiler.ir.types import Struct

from .memory import Value

NATIVE: Mapping[str, Callable[[Any, Any], Any]] = {
    "add": operator.add,
    "mul": operator.mul,
    "div": operator.floordiv,
    "mod": operator.mod,
    "eq": operator.eq,
    "ne": operator.ne,
}

Environment = tuple[Value, ...]
"""Bound variables, the innermost first."""


def evaluate(node: Node, parameters: Mapping[str, Value], bound: Environment = ()) -> Value:
    """The value of ``node``; ``parameters`` have the form that its parameter nodes have."""
    if isinstance(node.data, Parameter):
        return parameters[node.data.name]
    if node.op == "bound" and isinstance(node.data, int):
        return bound[node.data]
    if isinstance(node.data, Folding):
        return _fold(node, node.data, parameters, bound)
    if node.op == "apply":
        arguments = tuple(evaluate(each, parameters, bound) for each in node.operands[1:])
        return evaluate(node.operands[0], parameters, arguments + bound)
    return PLAIN[node.op](node, [evaluate(each, parameters, bound) for each in node.operands])


def _fold(
    node: Node, folding: Folding, parameters: Mapping[str, Value], bound: Environment
) -> Value:
    count, start, body = node.operands
    total = evaluate(start, parameters, bound)
    for turn in range(min(evaluate(count, parameters, bound), folding.bound)):
        term = evaluate(body, parameters, (turn, *bound))
        total = NATIVE[folding.operator](total, term)
    return total


def _member(node: Node, operands: list[Value]) -> Value:
    struct = node.operands[0].type
    assert isinstance(struct, Struct)
    return operands[0][[name for name, _ in struct.members].index(MEMBER.data(node))]


def _swizzle(node: Node, operands: list[Value]) -> Value:
    lanes = tuple(operands[0][lane] for lane in SWIZZLE.data(node))
    return lanes if len(lanes) > 1 else lanes[0]


def _vector(_node: Node, operands: list[Value]) -> Value:
    parts = (part if isinstance(part, tuple) else (part,) for part in operands)
    return tuple(lane for part in parts for lane in part)


PLAIN: Mapping[str, Callable[[Node, list[Value]], Value]] = {
    "constant": lambda node, _operands: node.data,
    "index": lambda _node, operands: operands[0][operands[1]],
    "member": _member,
    "swizzle": _swizzle,
    "vector": _vector,
    "matrix": lambda _node, operands: tuple(operands),
    "select": lambda _node, operands: operands[1] if operands[0] else operands[2],
    "native": lambda node, operands: NATIVE[MEMBER.data(node)](*operands),
}
"""The functions that compute each operation from the values of its operands."""
