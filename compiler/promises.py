"""The promises of a shader: vectors of which the host says that they are not zero.

``nonzero(v)`` makes one. The reflection lists them for hosts, and ``burnish render`` names those
that the reference found broken.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..stdlib.builtins import BUILTINS
from ..support.frozen import frozen
from .formula import Formulas
from .ir.binding import open_body
from .ir.leaves import Parameter
from .ir.node import Binder, Formal, Node, bodies_of, reachable
from .ir.operations import builtin_of
from .ir.shader import Shader


@frozen
class Promise:
    """One value that is promised not to be zero."""

    node: Node
    """The call of ``nonzero``."""
    value: str
    """The value as a formula with the user's names."""
    parameters: tuple[str, ...]
    """Names of the parameters that the value depends on."""


def promises(shader: Shader) -> Iterator[Promise]:
    """All promises that the results of a shader rest on.

    One in a function that is called repeatedly is a single promise, about the function's arguments.
    """
    bodies = _Bodies(shader)
    formulas = Formulas(shader.notes)
    for node in reachable(shader.roots):
        name = builtin_of(node)
        if name is not None and BUILTINS[name].is_promise:
            yield Promise(node, formulas.computed(bodies.opened(node)), bodies.parameters(node))


class _Bodies:
    """The bodies of functions and loops that contain a promise, and their variables' values."""

    def __init__(self, shader: Shader) -> None:
        self._notes = shader.notes
        self._graph = shader.graph
        self._body: dict[Node, Node | None] = {}
        """The innermost body around a node, the first one if it stands in several.

        A node without bound variables stands in none.
        """
        self._binders: dict[Node, list[Node]] = {}
        """For each body, the calls or loops that have it."""
        pending: list[tuple[Node, Node | None]] = [(root, None) for root in shader.roots]
        while pending:
            node, body = pending.pop()
            if node in self._body:
                continue
            self._body[node] = body if node.free else None
            inside = bodies_of(node)
            for position, operand in enumerate(node.operands):
                if position in inside:
                    self._binders.setdefault(operand, []).append(node)
                pending.append((operand, operand if position in inside else self._body[node]))

    def opened(self, promise: Node) -> Node:
        """The promised value, with named leaves in place of the variables of the bodies around."""
        graph = self._graph
        variables: list[Node] = []
        body = self._body[promise]
        while body is not None:
            binder = self._binders[body][0]
            assert isinstance(binder.data, Binder)
            types = binder.data.types([operand.type for operand in binder.operands])
            names = self._names(binder, body)
            for number, type_ in enumerate(types):
                name = names[number] if number < len(names) else "i"
                variables.append(graph.node("formal", type_, (), Formal(name)))
            body = self._body[binder]
        (value,) = promise.operands
        return open_body(graph, value, variables) if variables else value

    def _names(self, binder: Node, body: Node) -> tuple[str, ...]:
        if binder.op == "apply":
            return tuple(self._notes.arguments.get(body.id, ()))
        return tuple(self._notes.variables.get(binder.id, ()))

    def parameters(self, promise: Node) -> tuple[str, ...]:
        """The parameters that the promised value depends on, also by way of these variables."""
        found = list(promise.operands)
        seen: set[Node] = set()
        pending = [self._body[promise]]
        while pending:
            body = pending.pop()
            if body is None or body in seen:
                continue
            seen.add(body)
            for binder in self._binders[body]:
                found += _sources(binder)
                pending.append(self._body[binder])
        leaves = (leaf.data for leaf in reachable(found))
        names = (leaf.name for leaf in leaves if isinstance(leaf, Parameter))
        return tuple(dict.fromkeys(names))


def _sources(binder: Node) -> tuple[Node, ...]:
    """The values from which the variables of a call or a loop are computed; a fold has none."""
    match binder.op:
        case "apply":
            return binder.operands[1:]
        case "iterate":
            return binder.operands
        case _:
            return ()
