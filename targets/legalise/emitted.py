"""The graph that the text of a profile computes, as a shader that the reference can draw.

Conformance compares pictures with it: the accuracy that a specification promises is that of the
operations in a text, and the compiler has replaced many of those that the material was written in.
``CompiledMaterial.emitted`` calls ``emitted`` for the profile of a route, after ``legalise``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...compiler.ir.build import apply
from ...compiler.ir.node import Graph, Node, reachable
from ...compiler.ir.operations import NATIVE
from ...compiler.ir.program import Stage
from ...compiler.ir.shader import Notes, Result, Shader
from ...compiler.ir.stages import EMITTING, VARYING
from ...support.frozen import changed
from .definitions import Definitions
from .legal import Legal


def emitted(legal: Legal) -> Shader:
    """The shader of a program, but with the values of its results as ``legal`` computes them.

    Parameters are read as blocks store them, derived ones are parameters like others, and a builtin
    that the profile lacks is a call of the text's function for it. The graph is a new one, in which
    equal programs have equal nodes with equal numbers. So results that are remembered for the
    program of one profile are found for every other profile with the same program.
    """
    shader = legal.program.shader
    given = [pair for stage in legal.program.stages for pair in _values(shader, stage)]
    writing = _Writing(legal.definitions)
    values = writing.written([value for _, value in given])
    results = tuple(
        changed(result, value=value) for (result, _), value in zip(given, values, strict=True)
    )
    notes = writing.notes(shader.notes)
    return changed(shader, graph=writing.graph, notes=notes, results=results)


def _values(shader: Shader, stage: Stage) -> Iterator[tuple[Result, Node]]:
    """The results of one stage with the values that it computes for them."""
    results = [result for result in shader.results if result.stage == stage.row]
    emitting = [result for result in results if result.kind == EMITTING]
    delivered = [result for result in results if result.kind != EMITTING]
    outputs = [output.value for output in stage.results if output.kind != VARYING]
    yield from zip(emitting, stage.emitting, strict=True)
    for result, value in zip(delivered, outputs, strict=True):
        # Where bits are written, they are those of a number.
        is_number = value.type != result.value.type and result.store and result.store.as_bits
        yield result, value.operands[0] if is_number else value


class _Writing:
    """Copies nodes into a new graph; uses of definitions become calls, as in the text."""

    def __init__(self, definitions: Definitions) -> None:
        self.graph = Graph()
        self._definitions = definitions
        self._program: dict[Node, Node] = {}
        """The copies of the program's nodes."""
        self._bodies: dict[Node, Node] = {}
        """The copies of the definitions' bodies."""

    def written(self, values: Iterable[Node]) -> list[Node]:
        """The copies of some values of the program."""
        values = list(values)
        self._copy(values, self._program)
        return [self._program[value] for value in values]

    def notes(self, given: Notes) -> Notes:
        """The notes of ``given`` about the program's nodes, moved to their copies."""
        notes = Notes()
        notes.take_over(given, {old.id: new.id for old, new in self._program.items()})
        for function in self._definitions.values():
            if function.body in self._bodies:
                notes.functions[self._bodies[function.body].id] = function.name
        return notes

    def _copy(self, roots: Iterable[Node], copies: dict[Node, Node]) -> None:
        for node in reachable(roots):
            if node not in copies:
                operands = tuple([copies[operand] for operand in node.operands])
                copies[node] = self._written(node, operands)

    def _written(self, node: Node, operands: tuple[Node, ...]) -> Node:
        if node.op == "native":
            use = NATIVE.data(node), tuple([operand.type for operand in node.operands])
            if use in self._definitions:
                function = self._definitions[use]
                formals = tuple([formal for formal, _type in function.parameters])
                return apply(self.graph, self._body(function.body), operands, formals)
        return self.graph.node(node.op, node.type, operands, node.data)

    def _body(self, body: Node) -> Node:
        """The copy of a definition's body, which may use other definitions in turn."""
        if body not in self._bodies:
            # Every definition has a graph of its own, so its nodes are told from the others' by
            # being other objects, but not by their numbers.
            copies: dict[Node, Node] = {}
            self._copy((body,), copies)
            self._bodies[body] = copies[body]
        return self._bodies[body]
