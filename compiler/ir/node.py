"""The one node type of the graph, and the interning that makes equal expressions one node.

Nodes are pure values. Only a ``Graph`` makes them, and it returns an existing node if there is an
equal one (hash-consing), so identity is equality. Ids grow in the order of creation, and operands
exist before their users, so the order of ids is a topological order. Nothing here or in the passes
recurses over the graph.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from operator import attrgetter
from typing import Literal, get_args

from ...support.frozen import frozen
from .types import INT, Type

Op = Literal[
    "constant", "parameter", "texture", "buffer", "attribute", "argument", "input", "bound",
    "formal",
    "call", "native",
    "vector", "splat", "matrix", "struct", "array",
    "swizzle", "index", "member",
    "select", "cross",
    "fold", "iterate", "apply",
    "as", "called",
]  # fmt: skip
"""The operations of nodes; ``operations.py`` has a row for each, with all there is to say of it."""


@frozen(eq=False)
class Formal:
    """The variable of an opened binder; every opening makes a new one (compared by identity)."""

    name: str


Formals = tuple[Formal, ...]


class Binder:
    """Data of an operation that binds variables in some of its operands, its bodies.

    A *closed* binder has no ``formals``: its variables are ``bound`` leaves, numbered by de Bruijn.
    An *opened* one names its variables: they are the ``formal`` leaves of these formals.
    """

    __slots__ = ()

    formals: Formals | None

    def __str__(self) -> str:
        """The properties as nodes print them, and the names of the variables: ``add 8 [i]``."""
        names = ", ".join(formal.name for formal in self.variables)
        return " ".join(filter(None, (self.properties, f"[{names}]" if names else "")))

    @property
    def properties(self) -> str:
        """Everything but the variables, in a few words."""
        return ""

    @property
    def variables(self) -> Formals:
        """The variables of an opened binder, in order; none while it is closed."""
        return self.formals or ()

    @property
    def count(self) -> int:
        """The number of variables that it binds."""
        raise NotImplementedError

    @property
    def bodies(self) -> range:
        """The positions of the operands in which it binds them."""
        raise NotImplementedError

    def types(self, operands: Sequence[Type]) -> list[Type]:
        """The types of the variables, from those of all operands."""
        raise NotImplementedError


FoldOperator = Literal["add", "mul", "min", "max", "and", "or"]


@frozen
class Folding(Binder):
    """A fold's operator, and its largest number of iterations.

    It binds one variable, the number of the iteration.
    """

    operator: FoldOperator
    bound: int
    formals: Formals | None = None

    @property
    def properties(self) -> str:
        """The operator and the largest number of turns."""
        return f"{self.operator} {self.bound}"

    @property
    def index(self) -> Formal:
        """The number of the turn, once the fold has been opened."""
        (index,) = self.variables
        return index

    @property
    def count(self) -> int:
        """The number of the turn only."""
        return 1

    @property
    def bodies(self) -> range:
        """The last of (count, start, body)."""
        return range(2, 3)

    def types(self, operands: Sequence[Type]) -> list[Type]:  # noqa: ARG002 - always the same
        """The number of the turn."""
        return [INT]


@frozen
class Iterating(Binder):
    """A loop that takes its states from one turn to the next, while ``going``, up to the last turn.

    With one state the node has that state's type; with several, that of ``states_type``, whose
    members are the states. It binds the number of the turn, and the states.
    """

    bound: int
    """The largest number of iterations."""
    states: int
    formals: Formals | None = None

    @property
    def properties(self) -> str:
        """The largest number of turns."""
        return f"{self.bound}"

    @property
    def count(self) -> int:
        """The number of the turn, and each state."""
        return 1 + self.states

    @property
    def bodies(self) -> range:
        """The positions of ``going`` and the ``nexts`` in (count, *starts, going, *nexts)."""
        return range(1 + self.states, 2 + 2 * self.states)

    def types(self, operands: Sequence[Type]) -> list[Type]:
        """The types of the iteration's number, and of the states."""
        return [INT, *operands[1 : 1 + self.states]]


@frozen
class Applying(Binder):
    """A call of a function with so many arguments, which its variables stand for in its body."""

    arguments: int
    formals: Formals | None = None

    @property
    def count(self) -> int:
        """One for each argument."""
        return self.arguments

    @property
    def bodies(self) -> range:
        """The first of (body, *arguments)."""
        return range(1)

    def types(self, operands: Sequence[Type]) -> list[Type]:
        """The types of the arguments."""
        return list(operands[1:])


HEADS: Mapping[Op, str] = {op: f".{op}" for op in get_args(Op) if op not in ("call", "native")}
"""The heads of nodes that are no builtins, but for constants that rules look for."""

SPECIAL: Mapping[tuple[bool, Hashable], str] = {
    (isinstance(value, bool), value): f".constant {value}" for value in (0, 1, -1, False, True)
}
"""The heads of constants with one of these in each lane: by whether it is a bool, and by value."""


def constant_head(data: Hashable) -> str:
    """The head of a constant: numbers that rules look for stand in it."""
    lane = data[0] if isinstance(data, tuple) else data
    if isinstance(data, tuple) and data.count(lane) != len(data):
        return HEADS["constant"]
    return SPECIAL.get((isinstance(lane, bool), lane), HEADS["constant"])


_VARIABLES: frozenset[Op] = frozenset(("bound", "formal", "fold", "iterate", "apply"))
"""Variables, and the operations that bind them."""
_NONE: frozenset[Formal] = frozenset()


class Node:
    """One value. Compare with ``is``; build only through ``Graph``."""

    __slots__ = ("data", "free", "head", "id", "op", "operands", "type", "variables")

    def __init__(
        self, op: Op, type_: Type, operands: tuple[Node, ...], data: Hashable, id_: int
    ) -> None:
        self.op: Op = op
        self.type = type_
        self.operands = operands
        self.data = data
        self.id = id_
        self.head: Hashable = constant_head(data) if op == "constant" else HEADS.get(op, data)
        """The kind of value by which rules are looked up.

        This is the name of its builtin, or of its operation with a dot before it.
        """
        free: int = 0
        variables = _NONE
        if op in _VARIABLES:
            free, variables = _free(op, operands, data)
        else:  # most nodes, so written out here
            for operand in operands:
                free |= operand.free
                if (theirs := operand.variables) and theirs is not variables:
                    variables = variables | theirs if variables else theirs
        self.free: int = free
        self.variables: frozenset[Formal] = variables
        """The formals of binders further out that occur in it.

        In ``free``, bit i is set when the binder i levels out (de Bruijn) occurs free.
        """

    def __repr__(self) -> str:
        """The node in one line, as in ``%113 = native div(%18, %2) : float``."""
        inner = ", ".join(f"%{operand.id}" for operand in self.operands)
        return f"%{self.id} = {self._words()}{f'({inner})' if inner else ''} : {self.type}"

    def _words(self) -> str:
        match self.op, self.data:
            case (("call" | "constant"), data):
                return f"{data}"
            case "swizzle", (*lanes,):
                return (
                    f"swizzle .{''.join('xyzw'[lane] for lane in lanes if isinstance(lane, int))}"
                )
            case op, None:
                return op
            case op, data:
                return f"{op} {getattr(data, 'name', data)}".rstrip()


def binders(node: Node) -> int:
    """The number of de Bruijn variables that ``node`` binds in its body; 0 once it is opened."""
    data = node.data
    return data.count if isinstance(data, Binder) and data.formals is None else 0


def bodies_of(node: Node) -> range:
    """The positions of the operands in which a binding node's variables are bound."""
    return node.data.bodies if isinstance(node.data, Binder) else _NOWHERE


_NOWHERE = range(0)


def formals_of(node: Node) -> Formals:
    """The variables of an opened binder."""
    return node.data.variables if isinstance(node.data, Binder) else ()


def key_of(op: Op, type_: Type, operands: tuple[Node, ...], data: Hashable) -> Hashable:
    """The key under which equal nodes are interned (hash-consing)."""
    # A constant's 0.0 and -0.0, 1 and 1.0 and True compare equal but are different values.
    # Nodes hash and compare by identity, so operands go into the key as they are.
    return (op, type_, repr(data) if op == "constant" else data, operands)


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
        key = key_of(op, type_, operands, data)
        found = self._interned.get(key)
        if found is None:
            found = Node(op, type_, operands, data, len(self._interned))
            self._interned[key] = found
        return found


def _free(op: Op, operands: tuple[Node, ...], data: Hashable) -> tuple[int, frozenset[Formal]]:
    """The variables of binders further out: by de Bruijn index, and opened."""
    if not operands:
        if isinstance(data, Formal):
            return 0, frozenset((data,))
        return (1 << data if op == "bound" and isinstance(data, int) else 0), _NONE
    free, variables = 0, _NONE
    if isinstance(data, Binder):
        inside, formals = data.bodies, data.variables
        bound = 0 if formals else data.count
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
    """The value under its ascriptions and call-site annotations."""
    while node.op in ("as", "called"):
        node = node.operands[0]
    return node


class Roots(tuple[Node, ...]):
    """The values that passes start from, with facts of all nodes that these need.

    A fact is worked out when it is first asked for. A pass that changes nothing returns the roots
    that it was given, so that the next one finds the same facts.
    """

    _nodes: list[Node] | None = None
    _ops: frozenset[Op] | None = None

    @property
    def nodes(self) -> list[Node]:
        """All nodes that are needed, operands before users; nobody may change this list."""
        if self._nodes is None:
            self._nodes = _reachable(self)
        return self._nodes

    @property
    def ops(self) -> frozenset[Op]:
        """The operations of these nodes: a pass that is about others has nothing to do."""
        if self._ops is None:
            self._ops = frozenset([node.op for node in self.nodes])
        return self._ops


def reachable(roots: Iterable[Node]) -> list[Node]:
    """All nodes that ``roots`` need, operands before users."""
    return roots.nodes if isinstance(roots, Roots) else _reachable(roots)


def _reachable(roots: Iterable[Node]) -> list[Node]:
    seen = set(roots)
    found = list(seen)
    for node in found:  # The list grows on the way.
        for operand in node.operands:
            if operand not in seen:
                seen.add(operand)
                found.append(operand)
    found.sort(key=AGE)
    return found


AGE: Callable[[Node], int] = attrgetter("id")
"""To sort nodes by: operands before users."""
