"""Takes work that depends on parameters only out of the shader.

Such a value is the same for every pixel that the parameters' group covers, so the host evaluates it
(in float64, rounded once) and keeps it in the group's derived block. Groups that no engine updates
together are incomparable: a value that reads two of them stays in the shader.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...frozen import frozen
from ..ir.leaves import Parameter
from ..ir.node import Graph, Node, reachable
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.types import Matrix, Scalar, Vector
from ..semantics.shader import Notes
from .cost import cost_of
from .naming import Naming

COMMON_GROUP = "frame"
"""Every other group is updated at least as often, so it may go with any of them."""

_NOT_HOISTED = frozenset({"interpolate", "fold", "iterate", "apply", "struct", "array"})
"""Loops stay in the shader, and so do arrays that are put together."""

CHEAP = frozenset({"neg", "not"})
"""Operand modifiers: free in hardware, so a stored value would only cost memory."""


@frozen
class Derived:
    """A parameter that the host computes from others."""

    parameter: Parameter
    expression: Node
    """Over ``parameter`` leaves and constants only."""


def hoist(
    graph: Graph, roots: Iterable[Node], notes: Notes, ranges: Ranges
) -> tuple[list[Node], tuple[Derived, ...]]:
    """The roots with the largest hoistable values replaced by derived parameters."""
    wanted = list(roots)
    hoisting = _Hoisting(notes, ranges)
    nodes = reachable(wanted)
    hoisting.choose(wanted, nodes)
    rewritten = rewrite(graph, wanted, hoisting.rule, notes.follow, nodes=nodes)
    read = {node.data for node in reachable(rewritten) if node.op == "parameter"}
    return rewritten, tuple(d for d in hoisting.derived.values() if d.parameter in read)


class _Hoisting:
    def __init__(self, notes: Notes, ranges: Ranges) -> None:
        self._notes = notes
        self._ranges = ranges
        self._groups: dict[int, frozenset[str] | None] = {}
        self._chosen: set[int] = set()
        self._positions: set[int] = set()
        """Indices: a shader clamps them itself, whatever a host has put into its memory."""
        self._taken: set[str] = set()
        self._naming = Naming(notes)
        self.derived: dict[int, Derived] = {}

    def choose(self, roots: list[Node], nodes: list[Node]) -> None:
        """Find the hoistable nodes that some user which is not hoistable needs."""
        self._naming.learn(reversed(nodes))
        for node in nodes:
            self._groups[node.id] = self._groups_of(node)
            if node.op == "parameter":
                assert isinstance(node.data, Parameter)
                self._taken.add(node.data.name)
            elif node.op == "index":
                self._positions.add(node.operands[1].id)
        needed = {root.id for root in roots}
        for node in nodes:
            if not self._hoistable(node):
                needed.update(operand.id for operand in node.operands)
        self._chosen = {n.id for n in nodes if n.id in needed and self._worth_it(n)}

    def rule(self, graph: Graph, node: Node, _operands: tuple[Node, ...]) -> Node | None:
        """Replace a chosen node by its parameter; inside hoisted values nothing changes."""
        if node.id not in self._chosen:
            return None
        if node.id not in self.derived:
            parameter = self._parameter(node)
            self.derived[node.id] = Derived(parameter, node)
        return graph.node("parameter", node.type, (), self.derived[node.id].parameter)

    def _groups_of(self, node: Node) -> frozenset[str] | None:
        """The groups that a value reads; ``None`` if it reads anything else."""
        if node.op == "parameter":
            assert isinstance(node.data, Parameter)
            return frozenset({node.data.group})
        if node.op == "constant":
            return frozenset()
        if not node.operands or node.op in _NOT_HOISTED:
            return None
        groups: frozenset[str] = frozenset()
        for operand in node.operands:
            theirs = self._groups[operand.id]
            if theirs is None:
                return None
            groups |= theirs
        return groups

    def _owner(self, node: Node) -> str | None:
        groups = self._groups[node.id]
        if not groups:
            return None
        narrow = groups - {COMMON_GROUP}
        if len(narrow) > 1:
            return None
        return next(iter(narrow)) if narrow else COMMON_GROUP

    def _hoistable(self, node: Node) -> bool:
        if node.id in self._positions or self._owner(node) is None:
            return False
        return isinstance(node.type, Scalar | Vector | Matrix)

    def _worth_it(self, node: Node) -> bool:
        """Whether a stored value saves an operation."""
        if not self._hoistable(node):
            return False
        pending = [node]
        while pending:
            part = pending.pop()
            if cost_of(part) and part.data not in CHEAP:
                return True
            if part.op != "parameter":
                pending.extend(part.operands)
        return False

    def _parameter(self, node: Node) -> Parameter:
        group = self._owner(node)
        assert group is not None
        name = self._name(node)
        self._taken.add(name)
        return Parameter(name, node.type, group, self._ranges.of(node), derived=True)

    def _name(self, node: Node) -> str:
        """The user's name for the value, or one that says what it is computed from."""
        base = self._naming.name(node)
        name, number = base, 2
        while name in self._taken:
            name, number = f"{base}_{number}", number + 1
        return name
