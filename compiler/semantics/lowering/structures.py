"""Calls whose results are structures: no function of a text delivers one.

Semantics lets calls of large functions share a body (``signatures.py``), also where this puts a
structure together. ``outlining`` asks this module to take such calls apart, before it looks for
functions. A body is written out in the place of its calls, as long as all copies together are no
longer than texts can be. Any other becomes a function for each member of its result. What members
have in common is then computed by each of them, and once more by each that calls them, so that the
work multiplies with the depth of such calls: written out, a text would be too long to be one.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from ...ir import build
from ...ir.binding import open_body
from ...ir.node import Graph, Node, bare, reachable
from ...ir.operations import MEMBER
from ...ir.shader import Notes
from ...ir.types import Struct

LARGEST_COPIES = 1 << 16
"""The largest number of operations of a body's copies, all together."""


class Structures:
    """Takes calls apart whose results are structures, in one graph."""

    def __init__(self, graph: Graph, notes: Notes) -> None:
        self._graph = graph
        self._notes = notes
        self._sizes: dict[Node | None, int] = {}
        """The numbers of operations of bodies, with those of bodies that are written out there."""
        self._by_member: set[Node | None] = set()
        """The bodies that become a function for each member."""
        self._opened: dict[Node, Node] = {}
        """The bodies with the arguments of calls in them, by the call."""
        self._done: dict[Node, Node] = {}

    def taken_apart(self, roots: list[Node]) -> list[Node]:
        """The roots without calls that deliver structures."""
        calls = [node for node in reachable(roots) if _delivers_structure(node)]
        if not calls:
            return roots
        self._choose(calls)
        return [self._rebuilt(root) for root in roots]

    def _choose(self, calls: Iterable[Node]) -> None:
        """Decide what becomes of each body; callees come before their callers."""
        for body, count in Counter(call.operands[0] for call in calls).items():
            if body not in self._sizes:
                self._sizes[body] = sum(map(self._size, _inside(body)))
                if count > 1 and count * self._sizes[body] > LARGEST_COPIES:
                    self._by_member.add(body)

    def _size(self, node: Node) -> int:
        """The number of operations that a node comes to.

        That of a call of large functions is the limit: what contains it is no small copy either.
        """
        body = node.operands[0] if _delivers_structure(node) else None
        return LARGEST_COPIES if body in self._by_member else self._sizes.get(body, 1)

    def _is_written_out(self, node: Node) -> bool:
        return _delivers_structure(node) and node.operands[0] not in self._by_member

    def _rebuilt(self, root: Node) -> Node:
        done, pending = self._done, [root]
        while pending:
            node = pending[-1]
            if node in done:
                pending.pop()
            elif missing := [need for need in self._needs(node) if need not in done]:
                pending += reversed(missing)
            else:
                done[node] = made = self._made(node)
                if made is not node:
                    self._notes.follow(node, made)
        return done[root]

    def _needs(self, node: Node) -> tuple[Node, ...]:
        """The nodes that have to be rebuilt before this one can be."""
        if not self._is_written_out(node):
            return node.operands
        body, *arguments = node.operands
        if not all(argument in self._done for argument in arguments):
            return tuple(arguments)
        if node not in self._opened:
            # Calls in the body are still as they were, and their own bodies are not copied. So a
            # chain of functions is walked over once, however long it is.
            given = [self._done[argument] for argument in arguments]
            self._opened[node] = open_body(self._graph, body, given, self._notes.follow)
            self._notes.forget_function(self._opened[node])
        return (self._opened[node],)

    def _made(self, node: Node) -> Node:
        """The new form of a node, once all that it needs has been rebuilt."""
        if self._is_written_out(node):
            return self._done[self._opened[node]]
        operands = tuple([self._done[operand] for operand in node.operands])
        if _delivers_structure(node):
            return self._functions(node, operands[0], operands[1:])
        if node.op == "member" and bare(operands[0]).op == "struct":
            return build.member(self._graph, bare(operands[0]), MEMBER.data(node))
        if operands == node.operands:
            return node
        return self._graph.node(node.op, node.type, operands, node.data)

    def _functions(self, call: Node, body: Node, arguments: tuple[Node, ...]) -> Node:
        """A structure of the results of a function for each of its members."""
        function, leaves = call.operands[0], []
        names = build.named_parts(self._notes.functions.get(function.id, ""), call.type)
        for (name, _), part in zip(names, build.flattened(self._graph, bare(body)), strict=True):
            if not part.free:
                leaves.append(part)
                continue
            self._notes.functions.setdefault(part.id, name)
            self._notes.arguments.setdefault(part.id, self._notes.arguments[function.id])
            leaves.append(build.apply(self._graph, part, arguments))
        return build.assembled(self._graph, call.type, iter(leaves))


def _delivers_structure(node: Node) -> bool:
    return node.op == "apply" and isinstance(node.type, Struct)


def _inside(body: Node) -> list[Node]:
    """The nodes that change with the arguments of a body, without those in bodies that it calls."""
    seen = {body}
    found = [body]
    for node in found:  # The list grows on the way.
        for operand in node.operands[1:] if node.op == "apply" else node.operands:
            if operand.free and operand not in seen:
                seen.add(operand)
                found.append(operand)
    return found
