"""The graph's one node type, and the interning that makes equal expressions one node.

Nodes are pure values. A node is made by a ``Graph``, which returns the existing node where an
equal one is there already (hash-consing), so identity is equality. Ids grow in creation order and
operands always exist before their users, so sorting by id is a topological order; nothing here or
in the passes recurses over the graph.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
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
    "swizzle",  # data: tuple of lane numbers
    "index",  # (aggregate, integer)
    "member",  # data: member name of a struct
    "select",  # (condition, then, otherwise); data: "branch" where both must not be computed
    "interpolate",  # data: mode; the operand lives in the vertex domain
    "fold",  # data: Folding; (count, start, body); the body's bound 0 is the index
    "apply",  # data: Formals once opened; (body, *arguments); the body's bound i is argument i
    "bound",  # data: de Bruijn index
    "formal",  # data: Formal, a binder that has been opened
]


@frozen(eq=False)
class Formal:
    """The variable of an opened binder; every opening makes a new one (compared by identity)."""

    name: str


Formals = tuple[Formal, ...]


@frozen
class Folding:
    """How a fold combines its terms, and how many there can be at most."""

    operator: Literal["add", "mul"]
    bound: int
    index: Formal | None = None
    """The body's variable, once the fold has been opened."""


class Node:
    """One value. Compare with ``is``; build only through ``Graph``."""

    __slots__ = ("data", "free", "id", "op", "operands", "type")

    def __init__(
        self, op: Op, type_: Type, operands: tuple[Node, ...], data: Hashable, id_: int, free: int
    ) -> None:
        self.op: Op = op
        self.type = type_
        self.operands = operands
        self.data = data
        self.id = id_
        self.free = free
        """Bit i is set when the binder i levels out (de Bruijn) occurs free."""

    def __repr__(self) -> str:
        inner = ", ".join(f"%{operand.id}" for operand in self.operands)
        data = "" if self.data is None else f"[{self.data}]"
        return f"%{self.id} = {self.op}{data}({inner}) : {self.type}"


def binders(node: Node) -> int:
    """How many de Bruijn variables ``node`` binds in its body; none once it has been opened."""
    return _binders(node.op, node.operands, node.data)


def _binders(op: Op, operands: tuple[Node, ...], data: Hashable) -> int:
    if op == "fold":
        assert isinstance(data, Folding)
        return 1 if data.index is None else 0
    return len(operands) - 1 if op == "apply" and data is None else 0


def body_of(node: Node) -> Node | None:
    """The operand in which a binding node's variables are bound."""
    if node.op == "fold":
        return node.operands[2]
    return node.operands[0] if node.op == "apply" else None


class Graph:
    """Interns nodes."""

    def __init__(self) -> None:
        self._interned: dict[Hashable, Node] = {}

    def __len__(self) -> int:
        return len(self._interned)

    def node(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """The one node that is this operation of these operands."""
        # A constant's 0.0 and -0.0, 1 and 1.0 and True compare equal but are different values.
        # Nodes hash and compare by identity, so operands go into the key as they are.
        key = (op, type_, repr(data) if op == "constant" else data, operands)
        found = self._interned.get(key)
        if found is None:
            found = Node(op, type_, operands, data, len(self._interned), _free(op, operands, data))
            self._interned[key] = found
        return found


def _free(op: Op, operands: tuple[Node, ...], data: Hashable) -> int:
    if op == "bound":
        assert isinstance(data, int)
        return 1 << data
    free = 0
    for operand in operands:
        free |= operand.free
    if not free or op not in ("fold", "apply"):
        return free
    bound, body = _binders(op, operands, data), 2 if op == "fold" else 0
    free = operands[body].free >> bound
    for i, operand in enumerate(operands):
        if i != body:
            free |= operand.free
    return free


def reachable(roots: Iterable[Node]) -> list[Node]:
    """All nodes that ``roots`` need, operands before users."""
    seen = {root.id: root for root in roots}
    pending = list(seen.values())
    while pending:
        for operand in pending.pop().operands:
            if operand.id not in seen:
                seen[operand.id] = operand
                pending.append(operand)
    return [seen[id_] for id_ in sorted(seen)]
