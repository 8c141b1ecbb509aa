"""Where in Burnish text a value comes from, for every value that an emitted text computes."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from functools import cached_property

from .diagnostics.source import Span
from .ir.node import Node, reachable
from .ir.shader import Shader


def located(shader: Shader, origins: Mapping[int, Node]) -> dict[int, Span]:
    """The place of what each line computes."""
    places = _Places(shader)
    found = ((line, places.of(node)) for line, node in origins.items())
    return {line: span for line, span in found if span is not None}


class _Places:
    """Places of nodes: their own, or of the nearest value that they are computed from."""

    def __init__(self, shader: Shader) -> None:
        self._shader = shader
        self._spans = shader.notes.spans
        self._leaves: dict[Hashable, Span] = {
            **{info.parameter: info.span for info in shader.parameters},
            **{info.resource: info.span for info in shader.resources},
            **{info.attribute: info.span for info in shader.attributes},
        }

    def of(self, root: Node) -> Span | None:
        """Passes that take values apart or join them make some that nobody wrote."""
        seen = {root.id}
        front = [root]
        while front:
            for node in front:
                span = self._spans.get(node.id) or self._leaves.get(node.data)
                if span is not None:
                    return span
            inner = {operand.id: operand for node in front for operand in node.operands}
            front = [node for id_, node in inner.items() if id_ not in seen]
            seen |= inner.keys()
        return self._users.get(root.id)

    @cached_property
    def _users(self) -> dict[int, Span]:
        """Places of the users of values that have none, such as what the pipeline supplies."""
        found: dict[int, Span] = {}
        for node in reachable(self._shader.roots):
            if (span := self._spans.get(node.id)) is not None:
                for operand in node.operands:
                    found.setdefault(operand.id, span)
        return found
