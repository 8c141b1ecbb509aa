"""Names for values that get a statement: the user's where there is one, else what is computed."""

from __future__ import annotations

from ..ir.leaves import Attribute, Parameter
from ..ir.node import Node
from ..semantics.shader import Notes

OPERATIONS = {
    "add": "sum", "sub": "difference", "mul": "product", "div": "quotient", "mod": "remainder",
    "neg": "negated", "dot": "cosine", "inversesqrt": "inverse_length", "sample": "texel",
    "select": "chosen", "vector": "joined", "splat": "filled", "fold": "total", "apply": "result",
    "lt": "below", "le": "at_most", "gt": "above", "ge": "at_least", "eq": "equal", "ne": "differs",
    "and": "both", "or": "either", "not": "unless", "swizzle": "lanes", "index": "element",
    "saturate": "clamped", "max": "at_least", "min": "at_most",
}  # fmt: skip
"""What a value without a user's name is called after, by its operation."""


class Naming:
    """Suggested names of one stage; a ``Namer`` makes them legal and unique."""

    def __init__(self, notes: Notes) -> None:
        self._notes = notes

    def name(self, node: Node) -> str:
        """The suggestion for ``node``."""
        named = self._notes.names.get(node.id)
        if named is not None:
            return named
        if node.op in ("native", "call"):
            return self._operation(node, str(node.data))
        if node.op == "apply":
            return self._notes.functions.get(node.operands[0].id, OPERATIONS["apply"])
        return OPERATIONS.get(node.op, node.op)

    def _operation(self, node: Node, name: str) -> str:
        if name == "dot":
            left, right = (self.short(operand) for operand in node.operands)
            if left and right:
                return f"{left}_dot_{right}" if left != right else f"{left}_squared"
        if name == "sample":
            return self.short(node.operands[0]) or OPERATIONS["sample"]
        return OPERATIONS.get(name, name)

    def short(self, node: Node) -> str:
        """What a value is called, if it is called anything."""
        if node.id in self._notes.names:
            return self._notes.names[node.id]
        if isinstance(node.data, Parameter | Attribute):
            return node.data.name.replace(".", "_")
        if node.op in ("formal", "resource"):
            return str(getattr(node.data, "name", ""))
        return ""
