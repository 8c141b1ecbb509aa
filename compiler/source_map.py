"""Finds the place in Burnish text that each statement of an emitted text comes from.

``located`` is called for source maps, line directives and ``--validate``, each when it is wanted.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, ItemsView, Iterator, Mapping, ValuesView

from ..support.frozen import cached_property
from .diagnostics.source import Span
from .ir.node import Node, reachable
from .ir.shader import Notes, Shader


def located(shader: Shader, origins: Mapping[int, Node], notes: Notes) -> dict[int, Span]:
    """The place of the value that each emitted line computes, by line number.

    ``origins`` are these values, and ``notes`` are about them.
    """
    places = _Places(shader, notes)
    found = ((line, places.of(node)) for line, node in origins.items())
    return {line: span for line, span in found if span is not None}


class SourceMap(Mapping[int, Span]):
    """Places by line numbers, which are found when somebody first looks into it.

    Most texts are only written, so nobody needs to know where their lines come from.
    """

    def __init__(self, find: Callable[[], dict[int, Span]]) -> None:
        self._find = find

    @cached_property
    def _spans(self) -> dict[int, Span]:
        return self._find()

    def __getitem__(self, line: int) -> Span:
        return self._spans[line]

    def __iter__(self) -> Iterator[int]:
        return iter(self._spans)

    def __len__(self) -> int:
        return len(self._spans)

    def items(self) -> ItemsView[int, Span]:
        """The items of the dictionary itself: ``Mapping`` would look each line up."""
        return self._spans.items()

    def values(self) -> ValuesView[Span]:
        """The values of the dictionary itself, likewise."""
        return self._spans.values()

    def __repr__(self) -> str:
        return repr(self._spans)


class _Places:
    """Looks up places of nodes: a node's own, or that of the nearest value it is computed from."""

    def __init__(self, shader: Shader, notes: Notes) -> None:
        self._shader = shader
        self._spans = notes.spans
        self._leaves: dict[Hashable, Span] = {info.leaf: info.span for info in shader.leaves}

    def of(self, root: Node) -> Span | None:
        """The place of a node, or of an operand if a pass has made the node."""
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
        """The place of one of the users of each value.

        Pipeline inputs have no place of their own.
        """
        found: dict[int, Span] = {}
        for node in reachable(self._shader.roots):
            if (span := self._spans.get(node.id)) is not None:
                for operand in node.operands:
                    found.setdefault(operand.id, span)
        return found
