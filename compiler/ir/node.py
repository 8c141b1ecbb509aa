"""The graph's one node type, and the interning that makes equal expressions one node.

Nodes are pure values. A node is made by a ``Graph``, which returns the existing node where an
equal one is there already (hash-consing), so identity is equality. Ids grow in creation order and
operands always exist before their users, so sorting by id is a topological order; nothing here or
in the passes recurses over the graph.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from operator import attrgetter
from typing import Literal

from ...frozen import frozen
from .types import Type

Op = Literal[
    "constant",  # data: scalar, or tuple of lanes
    "parameter",  # data: Parameter, a member of a uniform block
    "resource",  # data: Resource, a texture with its sampler state
    "attribute",  # data: Attribute, a vertex input
    "input",  # data: name of a value the pipeline supplies, such as front_facing
    "call",  # data: name of a builtin, with Burnish's meaning
    "native",  # data: name of a builtin, as the hardware does it
    "vector",  # lanes of the operands, joined
    "splat",  # one scalar in every lane
    "matrix",  # columns
    "struct",  # one operand for each member
    "array",  # the elements
    "swizzle",  # data: tuple of lane numbers
    "as",  # data: Meaning, or None for bare numbers; the operand itself. Gone after semantics
    "called",  # data: Callee; (value, *arguments), the value itself. Gone after semantics
    "index",  # (aggregate, integer)
    "member",  # data: member name of a struct
    "select",  # (condition, then, otherwise); data: "branch" where both must not be computed
    "interpolate",  # data: mode; the operand lives in the vertex domain
    "fold",  # data: Folding; (count, start, body); the body's bound 0 is the index
    "iterate",  # data: Iterating; (count, *starts, going, *nexts); bound 0: the turn, then states
    "apply",  # data: Formals once opened; (body, *arguments); the body's bound i is argument i
    "bound",  # data: de Bruijn index
    "formal",  # data: Formal, a binder that has been opened
]


@frozen(eq=False)
class Formal:
    """The variable of an opened binder; every opening makes a new one (compared by identity)."""

    name: str


Formals = tuple[Formal, ...]


BINDING = frozenset({"fold", "iterate", "apply"})
"""Operations with bodies, in which they bind variables."""

FoldOperator = Literal["add", "mul", "min", "max", "and", "or"]


@frozen
class Folding:
    """How a fold combines its terms, and how many there can be at most."""

    operator: FoldOperator
    bound: int
    index: Formal | None = None
    """The body's variable, once the fold has been opened."""


@frozen
class Iterating:
    """A loop that takes its states from one turn to the next, while ``going``, up to the last turn.

    With one state the node has that state's type; with several, that of ``states_type``, whose
    members are the states.
    """

    bound: int
    """How many turns there can be at most."""
    states: int
    formals: Formals | None = None
    """The turn's number and the states, once the loop has been opened."""


class Node:
    """One value. Compare with ``is``; build only through ``Graph``."""

    __slots__ = ("data", "free", "id", "op", "operands", "type", "variables")

    def __init__(
        self, op: Op, type_: Type, operands: tuple[Node, ...], data: Hashable, id_: int
    ) -> None:
        self.op: Op = op
        self.type = type_
        self.operands = operands
        self.data = data
        self.id = id_
        self.free, self.variables = _free(op, operands, data)
        """In ``free``, bit i is set when the binder i levels out (de Bruijn) occurs free;
        ``variables`` are the formals of binders further out."""

    def __repr__(self) -> str:
        inner = ", ".join(f"%{operand.id}" for operand in self.operands)
        data = "" if self.data is None else f"[{self.data}]"
        return f"%{self.id} = {self.op}{data}({inner}) : {self.type}"


def binders(node: Node) -> int:
    """How many de Bruijn variables ``node`` binds in its body; none once it has been opened."""
    return _binders(node.op, node.operands, node.data) if node.op in BINDING else 0


def _binders(op: Op, operands: tuple[Node, ...], data: Hashable) -> int:
    if isinstance(data, Folding):
        return 1 if data.index is None else 0
    if isinstance(data, Iterating):
        return 1 + data.states if data.formals is None else 0
    return len(operands) - 1 if op == "apply" and data is None else 0


def bodies_of(node: Node) -> range:
    """The positions of the operands in which a binding node's variables are bound."""
    return _bodies(node.op, node.data) if node.op in BINDING else _NOWHERE


_NOWHERE = range(0)


def _bodies(op: Op, data: Hashable) -> range:
    if op == "fold":
        return range(2, 3)
    if isinstance(data, Iterating):
        return range(1 + data.states, 2 + 2 * data.states)
    return range(1)


def formals_of(node: Node) -> Formals:
    """The variables of an opened binder."""
    return _formals(node.op, node.data) if node.op in BINDING else ()


def _formals(op: Op, data: Hashable) -> Formals:
    if isinstance(data, Folding):
        return () if data.index is None else (data.index,)
    if isinstance(data, Iterating):
        return data.formals or ()
    return data if op == "apply" and isinstance(data, tuple) else ()


class Graph:
    """Interns nodes."""

    def __init__(self) -> None:
        self._interned: dict[Hashable, Node] = {}

    def __len__(self) -> int:
        return len(self._interned)

    def copy(self) -> Graph:
        """A graph with the same nodes, to which others can be added."""
        graph = Graph()
        graph._interned = dict(self._interned)
        return graph

    def node(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """The one node that is this operation of these operands."""
        # A constant's 0.0 and -0.0, 1 and 1.0 and True compare equal but are different values.
        # Nodes hash and compare by identity, so operands go into the key as they are.
        key = (op, type_, repr(data) if op == "constant" else data, operands)
        found = self._interned.get(key)
        if found is None:
            found = Node(op, type_, operands, data, len(self._interned))
            self._interned[key] = found
        return found


_NONE: frozenset[Formal] = frozenset()


def _free(op: Op, operands: tuple[Node, ...], data: Hashable) -> tuple[int, frozenset[Formal]]:
    """The variables of binders further out: by de Bruijn index, and opened."""
    if op == "bound":
        assert isinstance(data, int)
        return 1 << data, _NONE
    if op == "formal":
        assert isinstance(data, Formal)
        return 0, frozenset((data,))
    free, variables = 0, _NONE
    if op in BINDING:
        inside = _bodies(op, data)
        bound, formals = _binders(op, operands, data), _formals(op, data)
        for position in inside:
            free |= operands[position].free >> bound
            variables = variables | operands[position].variables.difference(formals)
        operands = operands[: inside.start] + operands[inside.stop :]
    for operand in operands:
        free |= operand.free
        theirs = operand.variables
        if theirs and theirs is not variables:
            variables = variables | theirs if variables else theirs
    return free, variables


def bare(node: Node) -> Node:
    """The value under what was said of its meaning, and of whose value it is."""
    while node.op in ("as", "called"):
        node = node.operands[0]
    return node


def reachable(roots: Iterable[Node]) -> list[Node]:
    """All nodes that ``roots`` need, operands before users."""
    seen = set(roots)
    found = list(seen)
    for node in found:  # It grows on the way.
        for operand in node.operands:
            if operand not in seen:
                seen.add(operand)
                found.append(operand)
    found.sort(key=AGE)
    return found


AGE: Callable[[Node], int] = attrgetter("id")
"""To sort nodes by: operands before users."""
