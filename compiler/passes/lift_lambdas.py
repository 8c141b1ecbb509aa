"""Lambda lifting: gives every function's body the values around it as arguments.

Before this pass a body may read any value of the shader around it. Afterwards it reads its
parameters, uniforms and constants only, so that it can be printed as a function. A value that does
not depend on the body's own variables is computed once by the caller and passed. Lanes and members
of a passed value cost nothing, so the body takes them itself.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..ir import build
from ..ir.node import Formal, Formals, Graph, Node, Roots, formals_of
from ..ir.operations import GLOBALS
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.types import Matrix, Scalar, Vector
from ..ir.walks import operands_of, visible
from .naming import Naming
from .schedule import is_part


def lift_lambdas(graph: Graph, roots: Roots, notes: Notes) -> Roots:
    """The roots with every applied body closed but for uniforms."""
    return rewrite(graph, roots, _Lifting(notes).rule, notes.follow, ("apply",))


class _Lifting:
    def __init__(self, notes: Notes) -> None:
        self._notes = notes
        self._naming = Naming(notes)
        self._lifted: dict[int, tuple[Node, Formals, tuple[Node, ...]]] = {}

    def rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        """Pass the captured values along; callees inside the body have been closed already."""
        body, *arguments = operands
        own = formals_of(node)
        needed = [a for a, formal in zip(arguments, own, strict=True) if _reads(body, formal)]
        if body.id not in self._lifted:
            self._lifted[body.id] = self._close(graph, body, own)
        closed, formals, captured = self._lifted[body.id]
        return build.apply(graph, closed, (*needed, *captured), formals)

    def _close(
        self, graph: Graph, body: Node, formals: Formals
    ) -> tuple[Node, Formals, tuple[Node, ...]]:
        # Bodies of the functions that it calls have been closed: nothing in them changes.
        nodes = visible((body,))
        captured = self._captured(body, formals, nodes)
        extra = tuple(Formal(self._naming.name(node)) for node in captured)
        replaced = {
            node.id: graph.node("formal", node.type, (), formal)
            for node, formal in zip(captured, extra, strict=True)
        }

        def rule(_graph: Graph, node: Node, _operands: tuple[Node, ...]) -> Node | None:
            return replaced.get(node.id)

        (closed,) = rewrite(graph, (body,), rule, self._notes.follow, nodes=nodes)
        needed = tuple(formal for formal in formals if _reads(body, formal))
        return closed, needed + extra, captured

    def _captured(self, body: Node, formals: Formals, nodes: list[Node]) -> tuple[Node, ...]:
        """The largest parts of a body that depend on none of its variables and are not at hand.

        They may depend on those of a loop around the call.
        """
        own = set(formals).union(*map(formals_of, nodes))
        found: dict[int, Node] = {}
        for part in _independent(body, nodes, own):
            source = self._source(part)
            if not _global(source):
                found[source.id] = source
        return tuple(found.values())

    def _source(self, node: Node) -> Node:
        """The value that ``node`` is made from at no cost.

        The search ends at a value that the user named. Members of a loop's states or of an element
        are passed themselves: their whole is no value.
        """
        while node.id not in self._notes.names and _is_free(node):
            whole = node.operands[0]
            if not (isinstance(whole.type, Scalar | Vector | Matrix) or _global(whole)):
                break
            node = whole
        return node


def _independent(body: Node, nodes: Iterable[Node], own: set[Formal]) -> Iterator[Node]:
    """The largest values among ``nodes`` that depend on none of ``own``."""
    if body.variables.isdisjoint(own):
        yield body
    for node in nodes:
        if node.variables.isdisjoint(own):
            continue
        for operand in operands_of(node):
            # An array is put together where it is indexed, from elements that are passed on.
            parts = operand.operands if operand.op == "array" else (operand,)
            yield from (part for part in parts if part.variables.isdisjoint(own))


def _is_free(node: Node) -> bool:
    """True if hardware does an operation for free on the way to the next one."""
    return is_part(node) or node.op == "splat" or (node.op == "native" and node.data == "neg")


def _reads(body: Node, formal: Formal) -> bool:
    """True if a body needs an argument; passes may have found that it does not."""
    return formal in body.variables


def _global(node: Node) -> bool:
    """True if every function can read a value where it is: uniforms, their parts, constants."""
    while is_part(node):
        node = node.operands[0]
    return node.op in GLOBALS
