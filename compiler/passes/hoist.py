"""Moves work that depends on parameters only from the shader to the host.

Such a value is the same for every pixel until the host changes the parameters' group. So the host
evaluates it once, in float64, rounds it once, and keeps it in the group's derived block. Only the
group ``frame`` may be combined with another one. A value that reads two of the other groups stays
in the shader, because hosts update these at different times.

A value is moved if it pays: if it saves the shader at least as much as it costs to read the result
from a block (``LOAD``, for each row of it). What saves less stays in the shader, which then reads
the parameters instead; so a host has little to compute, and each of its values is worth it. What is
computed from another moved value counts from there on.

What depends on one element of an array, such as one lamp in a sum over all lamps, is moved too. The
host computes it for each element and puts the results into a table beside the array, which the
shader reads at the same position (``derived_tables.py``).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Sequence
from functools import lru_cache

from ...stdlib.builtins import BUILTINS
from ...support.frozen import frozen
from ..ir.leaves import Parameter
from ..ir.node import Graph, Node, Roots
from ..ir.operations import BINDING, PARAMETER, builtin_of, joins_group
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.types import Array, Matrix, Scalar, Type, Vector
from .cost import LOAD, cost_of
from .derived_tables import Table, numbered
from .elements import is_element
from .invariant_results import InvariantResults
from .naming import Naming

COMMON_GROUP = "frame"
"""Every other group is updated at least as often, so it may go with any of them."""

_NOT_HOISTED = BINDING | {"cross", "struct", "array"}
"""Loops stay in the shader, and so do arrays that are put together."""

ROW = 16
"""Bytes of a row of a block: a vector, or a column of a matrix."""

ROOM = 12 * 1024
"""The size limit of the tables of a group, in bytes.

Blocks hold 16 KiB on some devices, and single values need some of them, too. A value without room
stays in the shader.
"""

CHEAP = frozenset({"neg", "not"})
"""Operand modifiers: free in hardware, so a stored value would only cost memory."""


@frozen
class Derived:
    """A parameter that the host computes from others."""

    parameter: Parameter
    expression: Node
    """The value, over ``parameter`` leaves and constants only.

    For a table, it is the structure for the element whose number is the one free variable,
    ``bound`` 0.
    """


@frozen(eq=False)
class _Reads:
    """The sources of a value: parameters, and elements of arrays at one position."""

    groups: frozenset[str]
    position: Node | None = None
    array: Node | None = None
    """The shortest of the arrays."""

    def joined(self, other: _Reads) -> _Reads | None:
        """The reads of a value that is computed from two; ``None`` if they are at two positions."""
        if other is self or not other.groups:
            return self
        if not self.groups:
            return other
        if self.position and other.position and self.position is not other.position:
            return None
        arrays = [array for array in (self.array, other.array) if array is not None]
        shortest = min(arrays, key=_length, default=None)
        return _Reads(self.groups | other.groups, self.position or other.position, shortest)

    @property
    def owner(self) -> str | None:
        """The finest group, if there is one."""
        return _owner(self.groups)


@lru_cache(maxsize=256)
def _owner(groups: frozenset[str]) -> str | None:
    narrow = groups - {COMMON_GROUP}
    if not groups or len(narrow) > 1:
        return None
    return next(iter(narrow)) if narrow else COMMON_GROUP


_NOTHING = _Reads(frozenset())


def _length(array: Node) -> int:
    assert isinstance(array.type, Array)
    return array.type.count


def _price(type_: Type) -> int:
    """The cost of reading a value of this type from a block: of each row that it takes there."""
    return LOAD * _rows(type_)


def _rows(type_: Type) -> int:
    return type_.columns if isinstance(type_, Matrix) else 1


def _pays(root: Node, stored: Container[int]) -> bool:
    """True if a stored value saves the shader at least what it costs to read it.

    ``stored`` are values that nothing is saved by: they are stored anyway, or the shader computes
    them to know which element it reads.
    """
    least = _price(root.type)
    saved, pending, seen = 0, [root], {root.id}
    while pending and saved < least:
        node = pending.pop()
        saved += 0 if node.data in CHEAP else cost_of(node)
        for operand in node.operands:
            if operand.id not in seen and operand.id not in stored:
                seen.add(operand.id)
                pending.append(operand)
    return saved >= least


def _compares_pixels(node: Node) -> bool:
    """True if an operation depends on neighbours, which may be at other positions of an array."""
    builtin = builtin_of(node)
    return builtin is not None and BUILTINS[builtin].compares_pixels


def hoist(
    graph: Graph,
    roots: Roots,
    notes: Notes,
    ranges: Ranges,
    taken: Iterable[str],
    apart: InvariantResults,
) -> tuple[Roots, tuple[Derived, ...]]:
    """The roots with the largest hoistable values replaced by derived parameters.

    ``taken`` are the names of declared parameters.
    """
    hoisting = _Hoisting(graph, notes, ranges, taken)
    if not hoisting.choose(roots, [roots[number] for number in apart.placing]):
        return roots, ()
    rewritten = rewrite(graph, roots, hoisting.rule, notes.follow)
    read = {node.data for node in rewritten.nodes if node.op == "parameter"}
    return rewritten, tuple(d for d in hoisting.derived() if d.parameter in read)


class _Hoisting:
    def __init__(self, graph: Graph, notes: Notes, ranges: Ranges, taken: Iterable[str]) -> None:
        self._graph = graph
        self._ranges = ranges
        self._reads: dict[int, _Reads | None] = {}
        self._groups: dict[str, _Reads] = {}
        """The reads of a parameter by itself, by its group."""
        self._positions: set[int] = set()
        """Indices: a shader clamps them itself, whatever a host has put into its memory."""
        self._taken = set(taken)
        self._naming = Naming(notes)
        self._moved: dict[int, Node] = {}
        """The rebuilt indices: values from which they are computed may be hoisted."""
        self._single: dict[int, Derived] = {}
        """The derived values, by the id of the value."""
        self._members: dict[int, tuple[Table, str, Node]] = {}
        """The values in tables: the table, the member, and the position of the element."""
        self._tables: dict[tuple[int, str], Table] = {}
        """The tables, by the array's id and the group that owns the values."""
        self._filled: Counter[str] = Counter()
        """The largest possible size of the tables of each group, in bytes."""

    def choose(self, roots: Roots, placing: Sequence[Node]) -> bool:
        """Find the hoistable nodes that some user which is not hoistable needs, if any.

        What the results ``placing`` need, which have to be invariant, is chosen first, and by
        itself: what is stored anyway for other results must have no say in them.
        """
        nodes = roots.nodes
        for node in nodes:
            self._reads[node.id] = self._reads_of(node)
            if node.op == "index":
                self._positions.add(node.operands[1].id)
        chosen: list[Node] = []
        stored = set(self._positions)
        chosen += self._needed(Roots(placing))
        stored.update([node.id for node in chosen])
        for node in self._needed(roots):
            if node.id not in stored and _pays(node, stored):
                chosen.append(node)
                stored.add(node.id)
        if chosen:
            self._naming.learn(reversed(nodes))
        for node in chosen:
            self._place(node)
        return bool(self._single or self._members)

    def _needed(self, roots: Roots) -> list[Node]:
        """The values that a host may compute and the shader needs, operands before users.

        A value that does not pay by itself is computed by the shader, which so needs its operands.
        """
        needed = {root.id for root in roots}
        found: list[Node] = []
        for node in reversed(roots.nodes):
            if not self._hoistable(node):
                needed.update([operand.id for operand in node.operands])
            elif node.id in needed:
                if _pays(node, self._positions):
                    found.append(node)
                else:
                    needed.update([operand.id for operand in node.operands])
        return found[::-1]

    def rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        """Replace a chosen node; inside hoisted values nothing changes."""
        if node.id in self._positions:
            self._moved[node.id] = graph.node(node.op, node.type, operands, node.data)
        if node.id in self._single:
            parameter = self._single[node.id].parameter
            return graph.node("parameter", node.type, (), parameter)
        if node.id in self._members:
            table, name, position = self._members[node.id]
            return table.read(graph, self._moved[position.id], name)
        return None

    def derived(self) -> list[Derived]:
        """All values that the host may have to compute."""
        tables = self._tables.values()
        return [
            *self._single.values(),
            *(Derived(t.parameter, t.element(self._graph)) for t in tables),
        ]

    # --- candidates -------------------------------------------------------------------------------

    def _reads_of(self, node: Node) -> _Reads | None:
        """The sources of a value; ``None`` if it reads anything else."""
        if node.op == "parameter":
            return self._of_group(PARAMETER.data(node).group)
        if node.op == "constant":
            return _NOTHING
        if not node.operands or node.op in _NOT_HOISTED or joins_group(node):
            return None
        found = self._joined(node.operands)
        if found is None and is_element(node):
            array, position = node.operands
            whole = self._reads[array.id]
            return None if whole is None else _Reads(whole.groups, position, array)
        if found is not None and found.position is not None and _compares_pixels(node):
            return None
        return found

    def _joined(self, operands: Iterable[Node]) -> _Reads | None:
        found = _NOTHING
        for operand in operands:
            theirs = self._reads[operand.id]
            if theirs is None:
                return None
            if theirs is not found and theirs is not _NOTHING:
                joined = found.joined(theirs)
                if joined is None:
                    return None
                found = joined
        return found

    def _of_group(self, group: str) -> _Reads:
        if group not in self._groups:
            self._groups[group] = _Reads(frozenset({group}))
        return self._groups[group]

    def _hoistable(self, node: Node) -> bool:
        reads = self._reads[node.id]
        if reads is None or reads.owner is None or node.id in self._positions:
            return False
        return isinstance(node.type, Scalar | Vector | Matrix)

    # --- where it goes ---------------------------------------------------------------------------

    def _place(self, node: Node) -> None:
        """Gives a chosen value its place, by the user's name or one after its operands."""
        reads, name, fact = self._reads[node.id], self._naming.name(node), self._ranges.of(node)
        assert reads is not None and reads.owner is not None
        if reads.position is None:
            own = Parameter(self._free(name), node.type, reads.owner, fact=fact, derived=True)
            self._single[node.id] = Derived(own, node)
        elif self._has_room(reads, node):
            table = self._table(reads, reads.owner)
            member = table.add(self._graph, node, reads.position, name, fact)
            self._members[node.id] = table, member, reads.position

    def _has_room(self, reads: _Reads, node: Node) -> bool:
        """True if the tables of a group can hold one more value for each element.

        If so, the value is counted.
        """
        assert reads.array is not None and reads.owner is not None
        size = ROW * _rows(node.type) * _length(reads.array)
        if self._filled[reads.owner] + size > ROOM:
            return False
        self._filled[reads.owner] += size
        return True

    def _table(self, reads: _Reads, group: str) -> Table:
        assert reads.array is not None
        key = reads.array.id, group
        if key not in self._tables:
            table = Table(reads.array, group)
            table.name = self._free(table.name)
            self._tables[key] = table
        return self._tables[key]

    def _free(self, wanted: str) -> str:
        name = numbered(wanted, self._taken)
        self._taken.add(name)
        return name
