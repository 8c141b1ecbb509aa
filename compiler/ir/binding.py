"""Opens and closes binders (the locally nameless representation).

While a body is built or optimised, its variables are ``formal`` leaves, each an object of its own.
When it is finished, they are ``bound`` leaves with de Bruijn indices, so that equal bodies are one
node. Semantics closes the bodies that it builds, and the pass ``open_binders`` opens them again.

Source: Charguéraud, *The Locally Nameless Representation*, 2012.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import repeat

from .node import Formal, Graph, Node, binders, bodies_of
from .operations import BINDING, BOUND, FORMAL
from .types import Type

Moved = Callable[[Node, Node], None]
"""Told of every node that was rebuilt: ``(old, new)``."""

Leaf = Callable[[Node, int], Node | None]
"""A function from a leaf and the number of binders around it to its replacement, if any."""


def close(graph: Graph, body: Node, formals: Sequence[Formal], moved: Moved | None = None) -> Node:
    """``body`` with ``formals`` turned into bound variables 0, 1, … of one new binder.

    A formal that occurs nowhere leaves an unused index; ``body`` has no free bound variables.
    """
    position = {formal: i for i, formal in enumerate(formals)}

    def leaf(node: Node, depth: int) -> Node | None:
        number = position.get(FORMAL.data(node)) if node.op == "formal" else None
        return None if number is None else graph.node("bound", node.type, (), depth + number)

    wanted = frozenset(formals)
    return _transform(
        graph, body, leaf, lambda node, _: not node.variables.isdisjoint(wanted), moved
    )


def open_body(
    graph: Graph, body: Node, arguments: Sequence[Node], moved: Moved | None = None
) -> Node:
    """``body`` with its binder's variables replaced by ``arguments``.

    The arguments may use variables of the binders around ``body``. Variables of binders further out
    stay, one binder nearer.
    """

    def leaf(node: Node, depth: int) -> Node | None:
        if node.op != "bound" or BOUND.data(node) < depth:
            return None
        position = BOUND.data(node) - depth
        if position < len(arguments):
            return lifted(graph, arguments[position], depth)
        return graph.node("bound", node.type, (), BOUND.data(node) - len(arguments))

    return _transform(graph, body, leaf, lambda node, depth: node.free >> depth != 0, moved)


def is_opened(graph: Graph, body: Node, arguments: Sequence[Node], value: Node) -> bool:
    """True if ``value`` is what ``open_body`` makes of these, which is not made for that."""
    pending = [(body, 0, value)]
    seen = set(pending)
    for place in pending:  # The list grows on the way.
        node, depth, other = place
        if node.free >> depth == 0:
            if node is not other:
                return False
        elif node.op == "bound":
            position = BOUND.data(node) - depth
            if position >= len(arguments):
                wanted = graph.node("bound", node.type, (), BOUND.data(node) - len(arguments))
            else:
                wanted = lifted(graph, arguments[position], depth)
            if wanted is not other:
                return False
        else:
            if node.op != other.op or node.type != other.type or node.data != other.data:
                return False
            if len(node.operands) != len(other.operands):
                return False
            for (part, deeper), operand in zip(_parts(node, depth), other.operands, strict=True):
                found = part, deeper, operand
                if found not in seen:
                    seen.add(found)
                    pending.append(found)
    return True


def lifted(graph: Graph, root: Node, binders_: int) -> Node:
    """A node as it is under further binders: variables of those around it are that much further."""
    if not root.free or not binders_:
        return root

    def leaf(node: Node, depth: int) -> Node | None:
        if node.op != "bound" or BOUND.data(node) < depth:
            return None
        return graph.node("bound", node.type, (), BOUND.data(node) + binders_)

    return _transform(graph, root, leaf, lambda node, depth: node.free >> depth != 0, None)


def freed(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """The roots with formals for the bound variables of binders further out, the same in all."""
    variables: dict[tuple[int, Type], Node] = {}

    def leaf(node: Node, depth: int) -> Node | None:
        if node.op != "bound" or BOUND.data(node) < depth:
            return None
        key = position, _ = BOUND.data(node) - depth, node.type
        if key not in variables:
            variables[key] = graph.node("formal", node.type, (), Formal(str(position)))
        return variables[key]

    done: dict[tuple[Node, int], Node] = {}
    return [
        _transform(graph, root, leaf, lambda node, depth: node.free >> depth != 0, None, done)
        for root in roots
    ]


def substitute(
    graph: Graph, root: Node, replacements: Mapping[Formal, Node], moved: Moved | None = None
) -> Node:
    """``root`` with formals replaced; for graphs whose binders are all open."""
    wanted = frozenset(replacements)

    def leaf(node: Node, _depth: int) -> Node | None:
        return replacements.get(FORMAL.data(node)) if node.op == "formal" else None

    return _transform(
        graph, root, leaf, lambda node, _: not node.variables.isdisjoint(wanted), moved
    )


def _transform(
    graph: Graph,
    root: Node,
    leaf: Leaf,
    affected: Callable[[Node, int], bool],
    moved: Moved | None,
    done: dict[tuple[Node, int], Node] | None = None,
) -> Node:
    """Rebuild ``root`` with leaves replaced, counting binders on the way; without recursion.

    Operands that are not ``affected`` stay, and nothing below them is looked at. ``done`` has what
    was rebuilt in the same way before, for other roots.
    """
    if not affected(root, 0):
        return root
    done = {} if done is None else done
    pending: list[tuple[Node, int]] = [(root, 0)]
    while pending:
        place = node, depth = pending[-1]
        if place in done:
            pending.pop()
            continue
        operands: list[Node] = []
        height = len(pending)
        parts: Iterable[tuple[Node, int]] = zip(node.operands, repeat(depth), strict=False)
        for part in _parts(node, depth) if node.op in BINDING else parts:
            new = done.get(part)
            if new is None:
                if affected(*part):
                    pending.append(part)
                    continue
                done[part] = new = part[0]
            operands.append(new)
        if len(pending) > height:
            continue
        pending.pop()
        replaced = leaf(node, depth) if not operands else None
        done[place] = replaced or graph.node(node.op, node.type, tuple(operands), node.data)
        if moved is not None and operands:
            moved(node, done[place])
    return done[root, 0]


def _parts(node: Node, depth: int) -> list[tuple[Node, int]]:
    """The operands of a binder, each with the number of closed binders around it."""
    inside = bodies_of(node)
    deeper = depth + binders(node)
    return [(operand, deeper if i in inside else depth) for i, operand in enumerate(node.operands)]
