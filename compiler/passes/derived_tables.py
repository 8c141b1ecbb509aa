"""Builds derived tables: arrays of values that the host computes for each element of an array.

``hoist`` makes a ``Table`` for an array of parameters, such as a list of lights, when a shader
computes something from one element and other parameters only.
"""

from __future__ import annotations

from collections.abc import Container
from itertools import count

from ...stdlib.builtins.facts import Fact
from ..ir.build import index, member
from ..ir.leaves import Parameter
from ..ir.node import Graph, Node
from ..ir.rewrite import rewrite
from ..ir.types import Array, Struct
from .elements import array_name


class Table:
    """A structure for each element of ``array``, with the derived values that shaders need of it.

    Members are closed: the number of the element is their free variable, so that a value that two
    loops need alike of each element is one member.
    """

    def __init__(self, array: Node, group: str) -> None:
        assert isinstance(array.type, Array)
        found = array_name(array)
        assert found is not None
        self._array = "".join(letter if letter.isalnum() else "_" for letter in found)
        self._count = array.type.count
        self._group = group
        self._members: dict[Node, str] = {}
        self._facts: list[tuple[str, Fact]] = []
        self.name = f"{self._array}_derived"

    def add(self, graph: Graph, value: Node, position: Node, name: str, fact: Fact) -> str:
        """Has ``value`` computed for each element, and returns its name in the table."""
        number = graph.node("bound", position.type, (), 0)

        def rule(_graph: Graph, node: Node, _operands: tuple[Node, ...]) -> Node | None:
            return number if node is position else None

        (closed,) = rewrite(graph, (value,), rule)
        if closed not in self._members:
            short = name.removeprefix(f"{self._array}_")
            self._members[closed] = numbered(short, self._members.values())
            self._facts.append((self._members[closed], fact))
        return self._members[closed]

    def read(self, graph: Graph, position: Node, name: str) -> Node:
        """A member of the structure for an element; the table has to be whole."""
        table = graph.node("parameter", self.parameter.type, (), self.parameter)
        return member(graph, index(graph, table, position), name)

    def element(self, graph: Graph) -> Node:
        """The structure for one element, whose number is the free variable."""
        return graph.node("struct", self._struct, tuple(self._members))

    @property
    def parameter(self) -> Parameter:
        """The table itself."""
        type_, facts = Array(self._struct, self._count), tuple(self._facts)
        return Parameter(self.name, type_, self._group, member_facts=facts, derived=True)

    @property
    def _struct(self) -> Struct:
        words = (word[:1].upper() + word[1:] for word in self.name.split("_"))
        members = ((name, node.type) for node, name in self._members.items())
        return Struct("".join(words), tuple(members))


def numbered(wanted: str, taken: Container[str]) -> str:
    """The name that is wanted, with the first number that makes it one of its own."""
    if wanted not in taken:
        return wanted
    return next(name for i in count(2) if (name := f"{wanted}_{i}") not in taken)
