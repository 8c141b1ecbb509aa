"""Opens every binder: the de Bruijn indices inside bodies become ``formal`` leaves.

This is the first pass. Semantics leaves bodies closed, so that equal bodies are one node. All later
passes treat an opened body like any other part of the graph.

Applies of the same body share the opened body and its formals, and later become calls of one
function. Each loop has its own variables. A structure or array can be an argument of a function
only if, in every call, it comes unchanged from a uniform block or a storage buffer. Otherwise each
of its parts becomes an argument.
"""

from __future__ import annotations

from ...support.frozen import changed
from ..ir import build
from ..ir.binding import open_body
from ..ir.node import (
    Binder,
    Formal,
    Formals,
    Graph,
    Node,
    Roots,
    binders,
    bodies_of,
)
from ..ir.operations import BINDING
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.types import Array, Struct, Type


def open_binders(graph: Graph, roots: Roots, notes: Notes) -> Roots:
    """The roots with every fold, loop and apply opened."""
    opener = _Opener(graph, notes, _taken_apart(roots))
    return rewrite(graph, roots, opener.rule, notes.follow, BINDING)


def _taken_apart(roots: Roots) -> set[tuple[int, int]]:
    """The arguments, by body and position, of which each part has to be an argument."""
    return {
        (node.operands[0].id, position)
        for node in (roots.nodes if "apply" in roots.ops else ())
        if node.op == "apply"
        for position, argument in enumerate(node.operands[1:])
        if isinstance(argument.type, Struct | Array) and not _is_stored(argument)
    }


def _is_stored(node: Node) -> bool:
    """True if an aggregate is read from a block or a buffer as it is stored there."""
    while node.op in ("member", "index"):
        node = node.operands[0]
    return node.op in ("parameter", "buffer")


class _Opener:
    def __init__(self, graph: Graph, notes: Notes, apart: set[tuple[int, int]]) -> None:
        self._graph = graph
        self._notes = notes
        self._apart = apart
        self._functions: dict[int, tuple[Node, Formals]] = {}

    def rule(self, _graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        """Open ``node`` if it binds; its body has been opened inside already."""
        if not binders(node):
            return None
        if node.op == "apply":
            return self._apply(node, operands)
        data = node.data
        assert isinstance(data, Binder)
        types = tuple(data.types([operand.type for operand in operands]))
        formals = tuple(map(Formal, self._names(node, len(types))))
        variables = self._variables(formals, types)
        opened = list(operands)
        for position in bodies_of(node):
            opened[position] = self._open(node.operands[position], operands[position], variables)
        return self._graph.node(node.op, node.type, tuple(opened), changed(data, formals=formals))

    def _apply(self, node: Node, operands: tuple[Node, ...]) -> Node:
        body, arguments = node.operands[0], operands[1:]
        apart = [(body.id, position) in self._apart for position in range(len(arguments))]
        if body.id not in self._functions:
            self._functions[body.id] = self._function(node, operands[0], apart)
        opened, formals = self._functions[body.id]
        given: list[Node] = []
        for argument, split in zip(arguments, apart, strict=True):
            given += build.flattened(self._graph, argument) if split else (argument,)
        return build.apply(self._graph, opened, tuple(given), formals)

    def _function(self, node: Node, body: Node, apart: list[bool]) -> tuple[Node, Formals]:
        names = self._names(node, len(apart))
        values: list[Node] = []
        formals: list[Formal] = []
        for name, argument, split in zip(names, node.operands[1:], apart, strict=True):
            type_ = argument.type
            parts = tuple(build.named_parts(name, type_)) if split else ((name, type_),)
            own = tuple(Formal(part) for part, _ in parts)
            leaves = self._variables(own, tuple(inner for _, inner in parts))
            whole = build.assembled(self._graph, type_, iter(leaves)) if split else leaves[0]
            values.append(whole)
            formals += own
        return self._open(node.operands[0], body, tuple(values)), tuple(formals)

    def _variables(self, formals: Formals, types: tuple[Type, ...]) -> tuple[Node, ...]:
        return tuple(
            self._graph.node("formal", type_, (), formal)
            for type_, formal in zip(types, formals, strict=True)
        )

    def _open(self, original: Node, body: Node, variables: tuple[Node, ...]) -> Node:
        opened = open_body(self._graph, body, variables, self._notes.follow)
        self._notes.follow(original, opened)
        return opened

    def _names(self, node: Node, count: int) -> tuple[str, ...]:
        notes = self._notes
        of_body = node.op == "apply"
        known = (
            notes.arguments.get(node.operands[0].id, ())
            if of_body
            else notes.variables.get(node.id, ())
        )
        return tuple(known[i] if i < len(known) else "i" for i in range(count))
