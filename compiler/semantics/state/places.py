"""The places where values are written. A named value is one node, with a place for each use."""

from __future__ import annotations

from collections.abc import Iterator

from ...diagnostics.source import Span
from ...ir.node import Node


class Places:
    """All places of each node; ``spans`` has the first, which the other phases show."""

    def __init__(self, spans: dict[int, Span]) -> None:
        self._first = spans
        self._further: dict[int, list[Span]] = {}

    def note(self, node: Node, span: Span) -> None:
        """Notes that a node is the value of the text at ``span``."""
        if self._first.setdefault(node.id, span) is not span:
            self._further.setdefault(node.id, []).append(span)

    def follow(self, old: Node, new: Node) -> None:
        """A node that replaces another one stands where that does."""
        self._further.setdefault(new.id, []).extend(self._further.get(old.id, ()))

    def first(self, node: Node) -> Span | None:
        """The first place where a node is written; ``None`` if none is known."""
        return self._first.get(node.id)

    def every(self) -> Iterator[tuple[int, Span]]:
        """The number of each node with each of its places."""
        yield from self._first.items()
        yield from ((node, span) for node, spans in self._further.items() for span in spans)

    def within(self, node: Node, around: Span) -> Span:
        """The place inside of ``around`` where a node is written.

        It is the first place if the node is not written there, as the value of a slot or of a
        function's body that is read there; and ``around`` if none is known.
        """
        first = self._first.get(node.id)
        if first is None:
            return around
        known = (first, *self._further.get(node.id, ()))
        return next((span for span in known if _contains(around, span)), first)


def _contains(around: Span, span: Span) -> bool:
    return around.source is span.source and around.start <= span.start and span.end <= around.end
