"""Turns the graph of a stage or function into statements: their regions and their order.

``split_stages`` makes a ``Scheduler`` for each stage and function. Every node is computed once, in
the innermost region that encloses all of its uses; a value that does not depend on a loop's
variables is computed before the loop. A value that is shared, or that the user named, becomes a
``Let``. All other values are printed in place. Where a stage emits vertices, the loops over strips
and over their vertices are such regions, too.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from ...support.frozen import fresh, record
from ..ir.node import Formal, Node, bodies_of, formals_of
from ..ir.operations import BRANCH, FOLD, ITERATE, LEAVES, LOOPS, PARTS, joins_group
from ..ir.shader import Notes
from ..ir.statements import (
    Branch,
    Connective,
    EmittedGroup,
    EmittedPart,
    Iterate,
    Let,
    Loop,
    Region,
    State,
    Statement,
)
from ..ir.types import TextureType
from ..ir.walks import in_order_of_use, operands_of
from .choices import Choices, chooses, has_to_branch, short_circuits
from .naming import Naming
from .path_conditions import DEEPEST
from .uniformity import compares

if TYPE_CHECKING:
    from .emit_strips import GroupValues

INLINE_DEPTH = 7
"""Expressions nest at most so deeply before a part of them gets a name of its own."""
INLINE_SIZE = 12
"""Operations in one printed expression."""


_COUNTED = frozenset({"formal", "constant"})
"""Variables of loops, and values that are known from the start."""
NAMED_COST = (0, 0)
"""The size and depth of a named value, or of a leaf, in an expression: its name costs nothing."""


@record
class _Block:
    """A region under construction."""

    parent: _Block | None
    loop: frozenset[Formal] = frozenset()
    """The variables, where this is the body of a loop."""
    depth: int = 0
    uniform: bool = True
    """True if all pixels of a draw take the same branches to this region."""
    skipped: bool = False
    """True if the region may be skipped at run time. No computation then moves out of it."""
    statements: list[Statement] = fresh(factory=list)

    @property
    def region(self) -> Region:
        """The finished region, once all of its statements are known."""
        return Region(tuple(self.statements))


@record
class _Strips:
    """The blocks of a group of strips, from outside to inside."""

    values: GroupValues
    part: _Block
    strip: _Block
    entered: _Block
    vertex: _Block

    @property
    def group(self) -> EmittedGroup:
        """The finished group, once all statements of its blocks are known."""
        values = self.values
        return EmittedGroup(
            values.strips, values.strip, values.vertex, values.count, self.strip.region,
            values.emitted, self.entered.region, self.vertex.region, values.delivered,
        )  # fmt: skip


class Scheduler:
    """Schedules one body: a stage's entry point or a function."""

    def __init__(
        self,
        roots: Sequence[Node],
        notes: Notes,
        naming: Naming,
        together: frozenset[int],
        groups: Sequence[GroupValues] = (),
    ) -> None:
        """``together`` are the nodes that all pixels have to reach (``uniformity.py``).

        ``groups`` are those of the strips that a body emits.
        """
        self._notes = notes
        self._naming = naming
        self._top = _Block(None)
        self._roots = [(root, self._top) for root in roots]
        self._strips: list[_Strips] = []
        for group in groups:
            self._add(group)
        self._home: dict[int, _Block] = {}
        self._uses: dict[int, int] = {}
        self._loops: dict[int, tuple[_Block, _Block]] = {}
        """The loop's header and body blocks; a fold has one block for both."""
        self._sides: dict[int, tuple[_Block, ...]] = {}
        """For each choice that becomes a branch, the blocks of the operands behind the first."""
        self._flat: set[int] = set()
        """Branches of which both sides are computed before, since they would nest too deeply."""
        self._size: dict[int, tuple[int, int]] = {}
        self._apart: set[int] = set()
        """Nodes that are computed before the loop or choice that uses them: they need names."""
        self._coordinates: set[int] = set()
        """Operands of texture reads and derivatives.

        One in which a ``?:``, ``&&`` or ``||`` would be printed has a name in every language, where
        it is easier to read. glslang needs this name: it makes blocks for each of these operations,
        and they come between the read and the operation that joins texture and sampler for it,
        which SPIR-V wants in one block. This is no row of a profile, because statements are the
        same for all profiles: it is one of the two exceptions that the architecture page names.
        """
        self._choosing: set[int] = set()
        """Expressions with such an operation printed in them."""
        self._together = together
        nodes = in_order_of_use([root for root, _ in self._roots])
        self._naming.learn(reversed(nodes))
        self._order = [node for node in nodes if node.op not in LEAVES]
        self._choices = Choices(self._order, together)

    def _add(self, group: GroupValues) -> None:
        """Make the blocks of a group. Groups with the same condition share one."""
        before = self._strips[-1] if self._strips else None
        if before is not None and before.values.condition is group.condition:
            part = before.part
        else:
            part = _conditional(self._top, group.condition)
            self._roots.append((group.condition, self._top))
        several = group.strips.strips > 1
        strip = _Block(part, frozenset([group.strip] if several else []), part.depth + 1)
        entered = _conditional(strip, group.emitted)
        vertex = _Block(entered, frozenset([group.vertex]), entered.depth + 1)
        self._strips.append(_Strips(group, part, strip, entered, vertex))
        self._roots += [(group.count, part), (group.emitted, strip)]
        self._roots += [(value, vertex) for value in group.delivered]

    def schedule(self) -> Region:
        """The statements that compute the roots."""
        self._place()
        self._results = self._region_results()
        # Operands come before users, so the body of a loop or a branch is filled before it.
        for node in self._order:
            statement = self._statement(node)
            if statement is not None:
                self._home[node.id].statements.append(statement)
        return self._top.region

    @property
    def emitted(self) -> tuple[EmittedPart, ...]:
        """The groups of strips, once ``schedule`` has filled their blocks."""
        parts = (list(part) for _, part in groupby(self._strips, lambda each: id(each.part)))
        return tuple(
            EmittedPart(
                part[0].values.condition, part[0].part.region, tuple(each.group for each in part)
            )
            for part in parts
        )

    # --- placing ---------------------------------------------------------------------------------

    def _place(self) -> None:
        """Users first, give every node the region that encloses its uses."""
        # The first uses are those of the roots, in the regions whose statements take them.
        homes: dict[int, list[_Block]] = {}
        for root, block in self._roots:
            homes.setdefault(root.id, []).append(block)
            self._uses[root.id] = self._uses.get(root.id, 0) + 1
        # Nodes that some pixels would skip if they were printed in place: sides of choices.
        optional: set[int] = set()
        for node in reversed(self._order):
            # All users have been placed by now, so the regions of all uses are known. The node is
            # computed in the innermost region around them, or further out (loop-invariant code).
            home = _enclosing(homes[node.id])
            self._home[node.id] = self._lifted(node, home)
            # Outside of the region that uses it, the node cannot be printed in place.
            lifted = self._home[node.id] is not home
            if lifted or (node.id in optional and node.id in self._together):
                self._apart.add(node.id)
            home = self._home[node.id]
            # The blocks of a loop or a branch must exist before its operands are placed into them.
            choosing = chooses(node)
            opens = choosing or node.op in LOOPS
            if opens:
                self._open_blocks(node, home)
            # Texture reads and derivatives need coordinates without choices in them.
            if compares(node) or _reads_texture(node):
                self._coordinates.update([operand.id for operand in node.operands])
            elif node.id in self._coordinates and is_access(node):
                # An access gets no name itself, so the choice is in its operands.
                self._coordinates.update([operand.id for operand in node.operands])
            # A part without a name is printed as an access to its whole, which then needs the name
            # and has all uses of the part.
            stands_for_whole = self._stands_for_whole(node)
            if stands_for_whole and node.id in self._apart:
                self._apart.add(node.operands[0].id)
            uses = self._uses[node.id] if stands_for_whole else 1
            in_place = node.id not in self._sides
            # Hand the regions of the uses on to the operands, which come later in this walk.
            for position, operand in enumerate(operands_of(node)):
                if operand.op in LEAVES:
                    continue
                region = self._region_of(node, position, home) if opens else home
                homes.setdefault(operand.id, []).append(region)
                self._uses[operand.id] = self._uses.get(operand.id, 0) + uses
                # A `?:` evaluates one of its sides, and `&&` and `||` the right one if need be.
                if in_place and (node.id in optional or (choosing and position > 0)):
                    optional.add(operand.id)

    def _open_blocks(self, node: Node, home: _Block) -> None:
        """The blocks of a loop, or of a choice that becomes a branch."""
        if node.op in LOOPS:
            # Values that depend on the variables cannot leave the header (``_lifted``). A loop with
            # states decides in the header and computes its next states in the body, so the body
            # lies within the header and may use its values.
            variables = frozenset(formals_of(node))
            head = _Block(home, variables, home.depth + 1, home.uniform)
            tail = head
            if node.op == "iterate":
                tail = _Block(head, depth=head.depth + 1, uniform=home.uniform)
            self._loops[node.id] = head, tail
        elif chooses(node) and self._branches(node, home):
            uniform = home.uniform and self._choices.is_uniform(node)
            if home.depth >= DEEPEST and node.data != BRANCH:
                self._flat.add(node.id)
            skipped = node.data == BRANCH
            self._sides[node.id] = tuple(
                _Block(home, depth=home.depth + 1, uniform=uniform, skipped=skipped)
                for _ in node.operands[1:]
            )

    def _branches(self, choice: Node, home: _Block) -> bool:
        """True if a choice in a region becomes a branch."""
        if has_to_branch(choice):
            return True
        uniform = home.uniform and self._choices.is_uniform(choice)
        return home.depth < DEEPEST and self._choices.is_worth_branching(choice, uniform=uniform)

    def _stands_for_whole(self, node: Node) -> bool:
        """True if a use of ``node`` counts as one of the value that it is a part of.

        The user named that value, and not the part.
        """
        names = self._notes.names
        return is_part(node) and node.id not in names and node.operands[0].id in names

    def _region_of(self, user: Node, position: int, home: _Block) -> _Block:
        """The region in which ``user``, whose own region is ``home``, needs one of its operands."""
        if user.op in LOOPS and position in (inside := bodies_of(user)):
            # A fold has one block for its body; a loop with states has its condition in the header.
            head, tail = self._loops[user.id]
            return head if position == inside.start else tail
        if user.id in self._sides and position > 0 and user.id not in self._flat:
            return self._sides[user.id][position - 1]
        return home

    def _lifted(self, node: Node, home: _Block) -> _Block:
        """Lifts a value's region out of loops that the value does not depend on.

        Values that all pixels have to reach are also lifted out of branches that some pixels do not
        take. A step from the variable of an outer loop is no shorter with a name.
        """
        together = node.id in self._together
        if node.id not in self._notes.names and all(o.op in _COUNTED for o in node.operands):
            return home
        # Walk outwards as far as the value means the same; ``best`` is the outermost region where
        # this saves work, so that a value does not leave a branch for nothing.
        block, best = home, home
        while block.parent is not None:
            if not block.loop.isdisjoint(node.variables):
                break
            if block.skipped and not together:
                break
            if block.loop or (together and not block.uniform):
                best = block.parent
            block = block.parent
        return best

    def _region_results(self) -> set[int]:
        """Values that a statement of their own region takes, where a name would only repeat it."""
        found = {root.id for root, _ in self._roots}
        for node in self._order:
            if node.op in LOOPS:
                found.update(node.operands[i].id for i in bodies_of(node))
            elif node.id in self._sides:
                found.update(side.id for side in node.operands[1:])
        return found

    # --- printing order --------------------------------------------------------------------------

    def _statement(self, node: Node) -> Statement | None:
        """The statement that computes a node; ``None`` where it is printed in place."""
        inside = node.op in LOOPS or node.id in self._sides
        if not inside and not self._bound(node):
            return None
        self._size[node.id] = NAMED_COST
        if node.op == "fold":
            return self._loop(node)
        if node.op == "iterate":
            return self._iterate(node)
        if inside:
            return self._connective(node) if short_circuits(node) else self._branch(node)
        return Let(self._naming.name(node), node, self._notes.docs.get(node.id, ""))

    def _branch(self, node: Node) -> Branch:
        then, otherwise = self._sides[node.id]
        return Branch(self._naming.name(node), node, then.region, otherwise.region)

    def _connective(self, node: Node) -> Connective:
        (right,) = self._sides[node.id]
        return Connective(self._naming.name(node), node, right.region)

    def _loop(self, node: Node) -> Loop:
        data = FOLD.data(node)
        count, start, value = node.operands
        name, body = self._naming.name(node), self._loops[node.id][0].region
        return Loop(name, node, count, data.bound, start, data.index, data.operator, body, value)

    def _iterate(self, node: Node) -> Iterate:
        data = ITERATE.data(node)
        index, *formals = data.variables
        count, states = data.states, node.operands[1 : 1 + data.states]
        whole = self._naming.name(node)
        names = [whole] if count == 1 else [formal.name for formal in formals]
        head, tail = self._loops[node.id]
        nexts = node.operands[2 + count :]
        # States are assigned one by one, although all next values are of the states before.
        order = _order_of_states(nexts, formals)
        return Iterate(
            node, node.operands[0], data.bound, index,
            tuple(State(names[k], formals[k], states[k], nexts[k], kept) for k, kept in order),
            tuple(k for k, _ in order), head.region, node.operands[1 + count], tail.region,
        )  # fmt: skip

    def _bound(self, node: Node) -> bool:
        """True if a node gets a statement of its own."""
        access = is_access(node)
        size, depth = self._measure(node, 0 if access else 1)
        if access or self._is_part_of_bound(node):
            return False
        if node.op == "array" or joins_group(node):
            # Later uses may be no place for a barrier.
            return True
        # A name is needed for a value that is used twice, or outside of the region of its user.
        if self._uses[node.id] > 1 or node.id in self._apart:
            return True
        if node.id in self._coordinates and node.id in self._choosing:
            return True
        if node.id in self._results:
            return False
        # Everything else only makes the text readable: names of the user stay, long expressions are
        # cut.
        named = node.id in self._notes.names and size > 1
        return named or size > INLINE_SIZE or depth > INLINE_DEPTH

    def _is_part_of_bound(self, node: Node) -> bool:
        """True if a node without a name of the user's is a part of a value that has a statement."""
        unnamed = node.id not in self._notes.names
        return unnamed and is_part(node) and self._size.get(node.operands[0].id) == NAMED_COST

    def _measure(self, node: Node, own: int) -> tuple[int, int]:
        """Operations and nesting of a node printed in place."""
        # An operand with a statement counts as a leaf (``NAMED_COST``): only its name is printed
        # here.
        size, depth = own, 0
        choosing = chooses(node)
        for operand in operands_of(node):
            part = self._size.get(operand.id, NAMED_COST)
            size += part[0]
            depth = max(depth, part[1])
            choosing = choosing or (operand.id in self._choosing and part != NAMED_COST)
        depth += own
        self._size[node.id] = (size, depth)
        if choosing:
            self._choosing.add(node.id)
        return size, depth


def _reads_texture(node: Node) -> bool:
    return bool(node.operands) and isinstance(node.operands[0].type, TextureType)


def is_part(node: Node) -> bool:
    """Lanes, members and columns: no work where the whole is at hand."""
    if node.op == "index":
        return node.operands[1].op == "constant"
    return node.op in PARTS


def is_access(node: Node) -> bool:
    """True for parts of values that are at hand anyway; naming them would only add lines."""
    if node.op in PARTS:
        whole = node.operands[0]
        return whole.op in LEAVES or whole.op == "iterate" or is_access(whole)
    return node.op in ("cross", "splat")


def _order_of_states(nexts: Sequence[Node], formals: Sequence[Formal]) -> list[tuple[int, bool]]:
    """The order in which states are set, and for each if its old value has to be kept.

    All values of a turn are computed from the states before it. So a state is set after the states
    whose next values read its old value. If states need each other, the old value of one is kept.
    """
    remaining = list(range(len(nexts)))
    # For each state, the number of next values that still have to read its old value.
    needed = Counter(formal for value in nexts for formal in value.variables)
    order: list[tuple[int, bool]] = []
    while remaining:
        # A state may be set once no other one that is still to be set reads its old value.
        free = [k for k in remaining if needed[formals[k]] == (formals[k] in nexts[k].variables)]
        k = free[0] if free else remaining[0]
        remaining.remove(k)
        needed.subtract(nexts[k].variables)
        order.append((k, not free))
    return order


def _conditional(parent: _Block, condition: Node) -> _Block:
    """A block that is done only where a condition holds."""
    return _Block(parent, depth=parent.depth + 1, skipped=condition.op != "constant")


def _enclosing(blocks: list[_Block]) -> _Block:
    """The innermost region around all of ``blocks``."""
    common = blocks[0]
    for block in blocks[1:]:
        other = block
        # Go outwards from the deeper of the two until both are the same region.
        while common is not other:
            if common.depth >= other.depth:
                assert common.parent is not None
                common = common.parent
            else:
                assert other.parent is not None
                other = other.parent
    return common
