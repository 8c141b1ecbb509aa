"""Finds names for values that become statements, those of the user wherever there are any.

``schedule``, ``hoist`` and others call it. A value that the user did not name is called after the
named value that it belongs to and its role there: ``to_eye_difference``,
``falloff_inverse_width``.
"""

from __future__ import annotations

from collections.abc import Iterable

from ..ir.leaves import Argument, Attribute, Buffer, Parameter, Texture
from ..ir.node import Formal, Node
from ..ir.operations import OPERATIONS, builtin_of
from ..ir.shader import Notes
from ..ir.types import scalar_kind

NOUNS = {
    "add": "sum", "sub": "difference", "mul": "product", "div": "quotient", "mod": "remainder",
    "neg": "negated", "dot": "cosine", "inversesqrt": "inverse_length", "sample": "texel",
    "lt": "is_below", "le": "is_at_most", "gt": "is_above", "ge": "is_at_least",
    "eq": "is_equal", "ne": "differs", "and": "both", "or": "either", "not": "unless",
    "saturate": "clamped", "max": "at_least", "min": "at_most",
}  # fmt: skip
"""Names for values of which only the builtin is known; other builtins have theirs in their row."""


class Naming:
    """Suggested names of one stage; a ``Namer`` makes them legal and unique."""

    def __init__(self, notes: Notes) -> None:
        self._notes = notes
        self._context: dict[int, str] = {}

    def learn(self, nodes: Iterable[Node]) -> None:
        """Find the named value that each unnamed one is a part of; users come before operands."""
        wholes, names, context = self._notes.wholes, self._notes.names, self._context
        for node in nodes:
            id_ = node.id
            within = wholes.get(id_) or names.get(id_) or context.get(id_)
            if within is not None:
                for operand in node.operands:
                    context.setdefault(operand.id, within)

    def name(self, node: Node) -> str:
        """The suggestion for ``node``."""
        named = self._notes.names.get(node.id)
        if named is not None:
            return named
        own = self._own(node)
        if own is not None:
            return own
        context, role = self._context.get(node.id), self._role(node)
        return f"{context}_{role}" if context else role

    def _own(self, node: Node) -> str | None:
        """A name that describes the value by itself."""
        body = node.operands[0] if node.op == "apply" else node
        if body.id in self._notes.terms:
            return self._notes.functions[body.id]
        if isinstance(node.data, Argument):
            return node.data.name
        builtin = builtin_of(node)
        if builtin == "dot":
            left, right = (self._short(operand) for operand in node.operands)
            if left and right:
                return f"{left}_dot_{right}" if left != right else f"{left}_squared"
        if builtin == "sample":
            return self._short(node.operands[0])
        if node.op == "swizzle":
            (whole,) = node.operands
            return self._notes.names.get(whole.id) or self._own(whole)
        return None

    def _role(self, node: Node) -> str:
        role = self._notes.roles.get(node.id)
        if role is not None:
            return role
        builtin = builtin_of(node)
        if builtin is None:
            return OPERATIONS[node.op].noun or node.op
        if builtin == "dot":
            if node.operands[0] is node.operands[1]:
                return "length_squared"
            if scalar_kind(node.type) != "float":
                return "inner_product"  # a direction has no integers
        return NOUNS.get(builtin, builtin)

    def _short(self, node: Node) -> str | None:
        """The name of a value by itself; ``None`` if it has none."""
        if node.id in self._notes.names:
            return self._notes.names[node.id]
        if isinstance(node.data, Parameter | Attribute | Argument | Texture | Buffer | Formal):
            return node.data.name.replace(".", "_")
        return None
