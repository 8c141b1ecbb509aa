"""From a graph to statements: what is computed where, in which order, under which name.

Every node is computed once, in the innermost region that encloses all of its uses; what does not
depend on a loop's index is computed before the loop. Values that are shared or that the user named
become a ``Let``; everything else is printed in place.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from ..ir.node import Folding, Formal, Node
from ..ir.program import Branch, Let, Loop, Region, Statement
from ..ir.types import Texture
from ..semantics.shader import Notes
from ..trampoline import Step, run
from .cost import cost_of
from .guard import BRANCH
from .naming import Naming
from .paths import DEEPEST
from .uniformity import compares, needing_uniform_flow

LEAVES = frozenset({"constant", "parameter", "resource", "attribute", "formal", "input", "bound"})
BRANCH_COST = 32
"""A select whose sides cost less than this is cheaper than a branch."""
INLINE_DEPTH = 7
"""Expressions nest at most so deeply before a part of them gets a name of its own."""
INLINE_SIZE = 12
"""Operations in one printed expression."""


BOUND = (0, 0)
"""Size and depth, where it is used, of a value that has a name."""


@dataclass(eq=False, slots=True)
class _Block:
    """A region under construction."""

    parent: _Block | None
    owner: Node | None = None
    """The fold or select whose part this is."""
    loop: Formal | None = None
    """The index, where this is the body of a loop."""
    depth: int = 0
    nodes: list[Node] = field(default_factory=list)


class Scheduler:
    """Schedules one body: a stage's entry point or a function."""

    def __init__(self, roots: Sequence[Node], notes: Notes, naming: Naming) -> None:
        self._roots = list(roots)
        self._notes = notes
        self._naming = naming
        self._top = _Block(None)
        self._home: dict[int, _Block] = {}
        self._uses: dict[int, int] = {}
        self._loops: dict[int, _Block] = {}
        self._sides: dict[int, tuple[_Block, _Block]] = {}
        self._depends: dict[int, frozenset[Formal]] = {}
        self._size: dict[int, tuple[int, int]] = {}
        self._apart: set[int] = set()
        """What is computed before the loop, branch or `?:` that uses it, and so needs a name."""
        self._coordinates: set[int] = set()
        """Where textures are read. One that chooses has a name: glslang's SPIR-V joins texture and
        sampler before it computes the coordinate, and a ``?:`` would part join and read."""
        self._choosing: set[int] = set()
        """Expressions with a ``?:`` printed in them."""
        self._together = needing_uniform_flow(self._roots)
        """What all pixels have to reach, branches or not."""
        self._order = in_order_of_use(self._roots)
        self._naming.learn(reversed(self._order))

    def schedule(self) -> Region:
        """The statements that compute the roots."""
        self._depends = free_formals(self._order)
        branching = self._branching()
        self._place(branching)
        self._results = self._region_results()
        for node in self._order:
            self._home[node.id].nodes.append(node)
        return run(self._emit(self._top))

    # --- placing ---------------------------------------------------------------------------------

    def _place(self, branching: set[int]) -> None:
        """Users first, give every node the region that encloses its uses."""
        homes: dict[int, list[_Block]] = {root.id: [self._top] for root in self._roots}
        for root in self._roots:
            self._uses[root.id] = self._uses.get(root.id, 0) + 1
        # A `?:` evaluates one of its sides: what stands in them is computed for some pixels only.
        optional: set[int] = set()
        for node in reversed(self._order):
            home = _enclosing(homes[node.id])
            self._home[node.id] = self._lifted(node, home)
            lifted = self._home[node.id] is not home
            if lifted or (node.id in optional and node.id in self._together):
                self._apart.add(node.id)
            home = self._home[node.id]
            if node.op == "fold":
                assert isinstance(node.data, Folding)
                body = _Block(home, node, node.data.index, home.depth + 1)
                self._loops[node.id] = body
            elif node.id in branching and (home.depth < DEEPEST or node.data == BRANCH):
                self._sides[node.id] = (
                    _Block(home, node, None, home.depth + 1),
                    _Block(home, node, None, home.depth + 1),
                )
            if compares(node) or _reads_texture(node):
                self._coordinates.update(operand.id for operand in node.operands)
            for position, operand in enumerate(operands_of(node)):
                region = self._region_of(node, position, home)
                homes.setdefault(operand.id, []).append(region)
                self._uses[operand.id] = self._uses.get(operand.id, 0) + 1
                if node.id in optional or (node.op == "select" and position > 0):
                    optional.add(operand.id)

    def _region_of(self, user: Node, position: int, home: _Block) -> _Block:
        if user.op == "fold" and position == 2:
            return self._loops[user.id]
        if user.id in self._sides and position > 0:
            return self._sides[user.id][position - 1]
        return home

    def _lifted(self, node: Node, home: _Block) -> _Block:
        """Out of loops that a value does not depend on; reads with implicit level to the top."""
        uniform = node.id in self._together
        block, best = home, home
        while block.parent is not None:
            if block.loop is not None and block.loop in self._depends[node.id]:
                break
            if block.owner is not None and block.owner.data == BRANCH and not uniform:
                break
            if block.loop is not None or uniform:
                best = block.parent
            block = block.parent
        return best

    def _region_results(self) -> set[int]:
        """Values that a statement of their own region takes, where a name would only repeat it."""
        found = {root.id for root in self._roots}
        for node in self._order:
            if node.op == "fold":
                found.add(node.operands[2].id)
            elif node.id in self._sides:
                found.update(side.id for side in node.operands[1:])
        return found

    def _branching(self) -> set[int]:
        """Selects with a side that is worth skipping, and used by nothing else."""
        users: dict[int, set[tuple[int, int]]] = {}
        for node in self._order:
            for position, operand in enumerate(operands_of(node)):
                users.setdefault(operand.id, set()).add((node.id, position))
        return {
            node.id
            for node in self._order
            if node.op == "select" and (node.data is not None or self._dear_side(node, users))
        }

    def _dear_side(self, select: Node, users: dict[int, set[tuple[int, int]]]) -> bool:
        return any(self._exclusive_cost(select, side, users) >= BRANCH_COST for side in (1, 2))

    def _exclusive_cost(
        self, select: Node, side: int, users: dict[int, set[tuple[int, int]]]
    ) -> int:
        """The cost of what only one side of a select needs; bounded, as more does not matter."""
        total, inside, pending = 0, set(), [select.operands[side]]
        while pending and total < BRANCH_COST:
            node = pending.pop()
            outside = {u for u in users[node.id] if u[0] not in inside and u != (select.id, side)}
            if outside or node.id in inside:
                continue
            if node.id in self._together:
                continue
            inside.add(node.id)
            total += cost_of(node)
            pending.extend(operands_of(node))
        return total

    # --- printing order --------------------------------------------------------------------------

    def _emit(self, block: _Block) -> Step[Region]:
        statements: list[Statement] = []
        for node in block.nodes:
            statement = yield self._statement(node)
            if statement is not None:
                statements.append(statement)
        return Region(tuple(statements))

    def _statement(self, node: Node) -> Step[Statement | None]:
        if node.op == "fold":
            loop: Loop = yield self._loop(node)
            return loop
        if node.id in self._sides:
            first, second = self._sides[node.id]
            then = yield self._emit(first)
            otherwise = yield self._emit(second)
            self._size[node.id] = BOUND
            return Branch(self._naming.name(node), node, then, otherwise)
        if not self._bound(node):
            return None
        self._size[node.id] = BOUND
        return Let(self._naming.name(node), node, self._notes.docs.get(node.id, ""))

    def _loop(self, node: Node) -> Step[Loop]:
        assert isinstance(node.data, Folding) and node.data.index is not None
        count, start, value = node.operands
        name = self._naming.name(node)
        body = yield self._emit(self._loops[node.id])
        self._size[node.id] = BOUND
        return Loop(
            name, node, count, node.data.bound, start, node.data.index, node.data.operator,
            body, value,
        )  # fmt: skip

    def _bound(self, node: Node) -> bool:
        """Whether a node gets a statement of its own."""
        size, depth = self._measure(node)
        if node.op in LEAVES or is_access(node):
            return False
        if self._uses[node.id] > 1 or node.id in self._apart:
            return True
        if node.id in self._coordinates and node.id in self._choosing:
            return True
        if node.id in self._results:
            return False
        named = node.id in self._notes.names and size > 1
        return named or size > INLINE_SIZE or depth > INLINE_DEPTH

    def _measure(self, node: Node) -> tuple[int, int]:
        """Operations and nesting of a node printed in place."""
        parts = [self._size[operand.id] for operand in operands_of(node)]
        own = 0 if node.op in LEAVES or is_access(node) else 1
        size = own + sum(part for part, _ in parts)
        depth = own + max((deep for _, deep in parts), default=0)
        self._size[node.id] = (size, depth)
        if node.op == "select" or any(
            operand.id in self._choosing and self._size[operand.id] != BOUND
            for operand in operands_of(node)
        ):
            self._choosing.add(node.id)
        return size, depth


def operands_of(node: Node) -> tuple[Node, ...]:
    """The operands that a body computes itself: not a called function's body, nor what is behind a
    crossing, which the vertex stage computed."""
    if node.op == "apply":
        return node.operands[1:]
    return () if node.op == "interpolate" else node.operands


def visible(roots: Iterable[Node], *, into_bodies: bool = False) -> list[Node]:
    """All nodes that a stage computes for ``roots``, operands before users.

    The bodies of functions that are called belong to it ``into_bodies``.
    """
    seen: dict[int, Node] = {}
    pending = list(roots)
    while pending:
        node = pending.pop()
        if node.id not in seen:
            seen[node.id] = node
            pending.extend(operands_of(node))
            if into_bodies and node.op == "apply":
                pending.append(node.operands[0])
    return [seen[id_] for id_ in sorted(seen)]


def free_formals(nodes: Iterable[Node]) -> dict[int, frozenset[Formal]]:
    """The variables that each node depends on; operands come before users."""
    free: dict[int, frozenset[Formal]] = {}
    for node in nodes:
        found: frozenset[Formal] = frozenset()
        if isinstance(node.data, Formal):
            found = frozenset({node.data})
        for operand in operands_of(node):
            found |= free[operand.id]
        if isinstance(node.data, Folding) and node.data.index is not None:
            found -= {node.data.index}
        free[node.id] = found
    return free


def in_order_of_use(roots: Iterable[Node]) -> list[Node]:
    """The same nodes, each as late as its first use allows: how a person would write them down."""
    order: dict[int, Node] = {}
    pending: list[tuple[Node, bool]] = [(root, False) for root in reversed(list(roots))]
    while pending:
        node, ready = pending.pop()
        if ready:
            order.setdefault(node.id, node)
        elif node.id not in order:
            pending.append((node, True))
            pending.extend((operand, False) for operand in reversed(operands_of(node)))
    return list(order.values())


def _reads_texture(node: Node) -> bool:
    return bool(node.operands) and isinstance(node.operands[0].type, Texture)


def is_access(node: Node) -> bool:
    """Reads of parts of what is at hand anyway; naming them would only add lines."""
    if node.op in ("swizzle", "member", "index"):
        return node.operands[0].op in LEAVES or is_access(node.operands[0])
    return node.op in ("interpolate", "splat")


def _enclosing(blocks: list[_Block]) -> _Block:
    """The innermost region around all of ``blocks``."""
    common = blocks[0]
    for block in blocks[1:]:
        other = block
        while common is not other:
            if common.depth >= other.depth:
                assert common.parent is not None
                common = common.parent
            else:
                assert other.parent is not None
                other = other.parent
    return common


def called_functions(roots: Iterable[Node]) -> list[Node]:
    """One call of each function that ``roots`` need, callees before callers."""
    calls = [node for node in visible(roots, into_bodies=True) if node.op == "apply"]
    return list({call.operands[0].id: call for call in reversed(calls)}.values())[::-1]
