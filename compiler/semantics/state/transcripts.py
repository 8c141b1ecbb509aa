"""Transcripts: how slots of the library got their values, so that others get them without checks.

Most of what a material consists of is the library's: where its vertices are, in which spaces, what
its lights send. ``shading/transcribing.py`` checks these equations once in a process, and writes
down each step. ``checking/replay.py`` takes the same steps in the tree of another elaboration.
"""

from __future__ import annotations

from collections.abc import (
    Callable,
    Hashable,
    Iterable,
    Iterator,
    Mapping,
    MutableMapping,
    Sequence,
)
from operator import itemgetter
from typing import Any, TypeAlias

from ....support.frozen import fresh, frozen, record
from ...diagnostics.source import Span
from ...ir.meaning import Meaning
from ...ir.node import Graph, Node, Op
from ...ir.types import Type
from ...syntax import ast
from ..inheritance.records import Definition
from ..names.modules import Symbol
from ..types.typenames import Declared
from .places import Places
from .scope import OUTERMOST, Instance


@record
class Replay:
    """An elaboration in which steps are taken, and the values that they have come to so far."""

    graph: Graph
    places: Places
    tables: tuple[MutableMapping[int, Any], ...]
    """The notes about nodes (``Notes``)."""
    keep_meaning: Callable[[Node, Meaning | None], None]
    read: Callable[[Reading], Node]
    """Gives the value of a slot."""
    values: list[Node] = fresh(factory=list)
    """The values of the steps that make or read some; further steps have their numbers."""


@frozen(eq=False)
class Making:
    """A step that makes a node."""

    op: Op
    type: Type
    operands: Callable[[list[Node]], tuple[Node, ...]]
    """Takes the operands from the values so far."""
    data: Hashable
    meaning: Meaning | None

    def take(self, replay: Replay) -> None:
        """Make the same node of the operands as they are there."""
        values = replay.values
        node = replay.graph.node(self.op, self.type, self.operands(values), self.data)
        replay.keep_meaning(node, self.meaning)
        values.append(node)


def taking(operands: Sequence[int]) -> Callable[[list[Node]], tuple[Node, ...]]:
    """A function that takes values by their numbers."""
    if len(operands) > 1:
        return itemgetter(*operands)
    return _one_or_none(*operands)


def _one_or_none(number: int | None = None) -> Callable[[list[Node]], tuple[Node, ...]]:
    if number is None:
        return lambda _values: ()
    return lambda values: (values[number],)


@frozen(eq=False)
class Reading:
    """A step that reads a slot, which may be the first to ask for its value."""

    definition: Definition
    """The definition that was read."""
    name: str
    level: int
    """The level that is asked for, counted from the first record of the library.

    Of a surface that a light shines on, it is counted from the user's own record.
    """
    of_surface: bool
    """True if it is a slot of the surface that a light shines on."""

    def take(self, replay: Replay) -> None:
        """Read the slot there."""
        replay.values.append(replay.read(self))


@frozen(eq=False)
class Taking:
    """A step that takes an operand of an earlier value, as of what crosses to the fragments."""

    value: int
    position: int

    def take(self, replay: Replay) -> None:
        """Take the same operand there."""
        replay.values.append(replay.values[self.value].operands[self.position])


@frozen(eq=False)
class Placing:
    """A step that notes where a value is written."""

    value: int
    span: Span

    def take(self, replay: Replay) -> None:
        """Note the same place there."""
        replay.places.note(replay.values[self.value], self.span)


@frozen(eq=False)
class Noting:
    """A step that notes something else about a value, unless something is noted already."""

    table: int
    value: int
    noted: Any

    def take(self, replay: Replay) -> None:
        """Note the same there."""
        replay.tables[self.table].setdefault(replay.values[self.value].id, self.noted)


Step: TypeAlias = Making | Reading | Taking | Placing | Noting
Ways: TypeAlias = tuple[tuple[int, str, Meaning], ...]
"""The transforms in scope: the number of the instance that has it, its name, and its meaning.

The instance itself is number 0, the surface is 1, and the pass is 2.
"""


@frozen(eq=False)
class Transcript:
    """All steps to the value of a slot."""

    definition: Definition
    typing: Definition | None
    """The definition with the type that holds for the slot."""
    steps: tuple[Step, ...]
    readings: tuple[Reading, ...]
    """Those of the steps that read slots."""
    value: int
    """The number of the slot's value."""
    calls: tuple[tuple[Symbol, tuple[int, ...], bool, int], ...]
    """Functions that were called: with which arguments, whether for the surface, and the value."""
    at_vertex: tuple[tuple[int, int], ...]
    """Values, each with what it is in the vertex stage."""
    inputs: frozenset[str]
    """The names of the pipeline's own values among these."""
    ways: Ways | None
    """The transforms in scope, if a conversion chose among them."""
    unmade: int
    """The number of nodes that checking makes and no step does, as nothing needs them."""
    structures: tuple[tuple[Symbol, Declared | None], ...]
    """The structures of the library that its values may be of, each with its type."""


Key: TypeAlias = tuple[str, int]
"""A slot, and the level at which it is defined, counted from the first record of the library."""


@frozen
class LibraryPart:
    """The library's part of an instance: equal parts have the same transcripts."""

    chain: tuple[Symbol, ...]
    """Records of the library, each of which extends the next one."""
    is_element: bool
    """True for one light of an array of them."""


Kept: TypeAlias = Mapping[Key, Transcript]


class Transcripts:
    """The transcripts that an elaboration can use, and for which of its slots they hold."""

    def __init__(self) -> None:
        self.kept: Callable[[LibraryPart], Kept] = _nothing
        """Gives the transcripts for the library's part of an instance."""
        self.fitting: dict[tuple[Instance, str, int, Instance | None], Transcript | None] = {}
        """Which transcript holds for a slot under a pass, as far as anybody has asked."""
        self._of: dict[Instance, tuple[Kept, int]] = {}

    def of(self, instance: Instance) -> tuple[Kept, int]:
        """The transcripts of an instance, and the level of the first record of the library."""
        found = self._of.get(instance)
        if found is None:
            chain = instance.record.chain
            first = len(chain) - sum(1 for _ in _of_library(chain))
            part = _part_of(chain[first:], instance)
            found = self._of[instance] = {} if part is None else self.kept(part), first
        return found


def level_in(level: int, first: int) -> int:
    """A level of a chain whose library records begin at ``first``."""
    return level if level == OUTERMOST else level + first


def _of_library(chain: Iterable[Symbol]) -> Iterator[Symbol]:
    """The last records of a chain, behind the last one that is not the library's."""
    for symbol in reversed(tuple(chain)):
        if not symbol.module.is_standard:
            return
        yield symbol


def _part_of(chain: tuple[Symbol, ...], instance: Instance) -> LibraryPart | None:
    """The library's part of an instance; ``None`` if there are no transcripts for such ones."""
    declared = chain[-1].declaration if chain else None
    if not isinstance(declared, ast.Record) or declared.kind not in _KINDS:
        return None
    leaves = [leaf for leaf in instance.leaves.values() if leaf.op == "member"]
    return LibraryPart(chain, bool(leaves)) if all(map(_is_of_array, leaves)) else None


def _is_of_array(member: Node) -> bool:
    """True for a member of an element of an array; there are none of a buffer's elements."""
    element = member.operands[0]
    return element.op == "index" and element.operands[0].op == "parameter"


_KINDS = ("material", "light")
"""The kinds of records whose equations have transcripts."""


def _nothing(_part: LibraryPart) -> Kept:
    return {}
