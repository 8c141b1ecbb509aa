"""Statements: the computation of a stage or a function, in order, with branches and loops.

``Scheduler`` makes them of a graph, and ``emit`` prints them. All else of a program is in
``program.py``.
"""

from __future__ import annotations

from ...support.frozen import frozen
from .expansion import EmittedStrips
from .node import FoldOperator, Formal, Node


@frozen
class Let:
    """``name = value``, once."""

    name: str
    node: Node
    doc: str = ""

    @property
    def regions(self) -> tuple[Region, ...]:
        """The blocks of the statement itself: none."""
        return ()


@frozen
class Branch:
    """``node`` (a select) computed by a branch, so that only one side is evaluated."""

    name: str
    node: Node
    then: Region
    otherwise: Region
    """The sides' values are ``node.operands[1]`` and ``[2]``."""

    @property
    def regions(self) -> tuple[Region, ...]:
        """The blocks in it."""
        return self.then, self.otherwise


@frozen
class Connective:
    """``node`` (an ``and`` or ``or`` of bools) computed by a branch.

    The right operand is evaluated only where the left one does not decide.
    """

    name: str
    node: Node
    right: Region
    """The right operand is ``node.operands[1]``."""

    @property
    def regions(self) -> tuple[Region, ...]:
        """The block in it."""
        return (self.right,)


@frozen
class Loop:
    """``node`` (an opened fold) computed by a loop over ``0 <= index < min(count, bound)``."""

    name: str
    node: Node
    count: Node
    bound: int
    start: Node
    index: Formal
    operator: FoldOperator
    body: Region
    value: Node
    """The value that each iteration adds (multiplies, …), in terms of ``index``."""

    @property
    def regions(self) -> tuple[Region, ...]:
        """The block in it."""
        return (self.body,)


@frozen
class State:
    """A variable of an ``Iterate``, with its value after an iteration."""

    name: str
    formal: Formal
    start: Node
    next: Node
    kept: bool = False
    """True if the new value has to wait until the other states have got theirs."""


@frozen
class Iterate:
    """``node`` computed by a loop that takes its states from one turn to the next."""

    node: Node
    count: Node
    bound: int
    index: Formal
    states: tuple[State, ...]
    """The states in the order in which an iteration sets them.

    ``positions`` are those in ``node``.
    """
    positions: tuple[int, ...]
    head: Region
    """The statements that compute whether to go on."""
    going: Node
    body: Region

    @property
    def regions(self) -> tuple[Region, ...]:
        """The parts of the block in it, before and behind the decision to go on."""
        return self.head, self.body


Statement = Let | Branch | Connective | Loop | Iterate


@frozen
class Region:
    """Statements in order; each may use the names bound before it, here or further out."""

    statements: tuple[Statement, ...]


@frozen
class EmittedGroup:
    """Strips that a stage emits, with the statements for each of them, and for each vertex."""

    strips: EmittedStrips
    strip: Formal
    """The number of a strip, where there are several."""
    vertex: Formal
    """The number of a vertex in its strip."""
    count: Node
    """The number of strips: a constant, or a value that is the same for all of them."""
    head: Region
    """The statements for each strip: they compute whether it is emitted."""
    emitted: Node
    entered: Region
    """The statements for a strip that is emitted, before its vertices."""
    body: Region
    """The statements for each vertex."""
    delivered: tuple[Node, ...]
    """The value of each of the stage's results at a vertex."""

    @property
    def regions(self) -> tuple[Region, ...]:
        """The blocks in it."""
        return self.head, self.entered, self.body


@frozen
class EmittedPart:
    """Groups one after the other that only the primitives have for which a condition holds."""

    condition: Node
    region: Region
    """The statements that the groups share."""
    groups: tuple[EmittedGroup, ...]

    @property
    def regions(self) -> tuple[Region, ...]:
        """The blocks in it."""
        return (self.region, *(region for group in self.groups for region in group.regions))
