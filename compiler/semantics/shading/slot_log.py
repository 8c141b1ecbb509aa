"""A log of what is done for each slot while equations are checked.

``transcribing.py`` makes transcripts of it. A slot's own steps are those between the first question
for its value and the answer, without those of the slots that it is the first to read. So the tables
and the values of slots of that elaboration are dictionaries that tell the log what is done to them.
"""

from __future__ import annotations

from typing import Any

from ....support.frozen import fresh, frozen, record
from ...diagnostics.source import Span
from ...ir.node import Node
from ..state.context import Context
from ..state.places import Places
from ..state.scope import Failure, Instance, Way

Around = tuple[Instance | None, ...]


@frozen(eq=False)
class SlotRead:
    """A slot that was read, and its value."""

    of_surface: bool
    """True if it is a slot of the surface that the light shines on which is checked."""
    name: str
    level: int
    value: Node | Failure


@frozen(eq=False)
class Noted:
    """A note on a node, in one of the tables; a place has none."""

    table: int | None
    node: Node
    noted: Any


@record
class Frame:
    """A slot between the first question for its value and the answer."""

    of_surface: bool
    name: str
    level: int
    unproven: int
    """The number of checks before it that depended on a variable's value."""
    done: list[Node | SlotRead | Noted] = fresh(factory=list)
    is_kept: bool = False
    """True once the slot has its value: what is noted then depends on who keeps it."""
    is_converted: bool = False
    """True if a conversion has chosen among the transforms in scope."""
    is_proven: bool = False
    """True if no check depended on a variable's value."""


class Log:
    """What is done for each slot, in order."""

    def __init__(self, ctx: Context) -> None:
        self._ctx = ctx
        self._seen = 0
        self._open: list[Frame] = []
        self.frames: list[Frame] = []
        """The slots whose values are known, each behind those that it was the first to read."""
        self.is_clear = True
        """False if something was made of which it is not clear for which slot."""

    def asked(self, of_surface: bool, name: str, level: int) -> None:
        """Begin the steps of a slot that has no value yet."""
        self._catch_up()
        self._open.append(Frame(of_surface, name, level, self._ctx.progress.unproven))

    def kept(self) -> None:
        """End the steps of the slot that was asked for last: it has its value."""
        self._catch_up()
        if self._open:
            self._open[-1].is_kept = True

    def answered(self, read: SlotRead) -> None:
        """Note that a slot was read."""
        self._catch_up()
        if self._open and self._open[-1].is_kept:
            frame = self._open.pop()
            same = (frame.of_surface, frame.name, frame.level)
            self.is_clear = self.is_clear and same == (read.of_surface, read.name, read.level)
            frame.is_proven = frame.unproven == self._ctx.progress.unproven
            self.frames.append(frame)
        if self._open:
            self._open[-1].done.append(read)

    def converted(self) -> None:
        """Note that a transform is looked for."""
        if self._open:
            self._open[-1].is_converted = True

    def noted(self, table: int | None, id_: int, noted: Any) -> None:
        """Note what was noted about a node."""
        self._catch_up()
        if self._open and not self._open[-1].is_kept:
            self._open[-1].done.append(Noted(table, self._ctx.tree.nodes[id_], noted))

    def _catch_up(self) -> None:
        """Give the nodes that were made since the last time to the slot that is being checked."""
        nodes = self._ctx.tree.nodes
        made = nodes[self._seen :]
        self._seen = len(nodes)
        if self._open:
            self.is_clear = self.is_clear and not (made and self._open[-1].is_kept)
            self._open[-1].done += made


class LoggedTable(dict[int, Any]):
    """One of the tables of notes."""

    def __init__(self, log: Log, number: int) -> None:
        super().__init__()
        self._log, self._number = log, number

    def setdefault(self, id_: int, noted: Any = None, /) -> Any:
        """Keep a note unless there is one."""
        self._log.noted(self._number, id_, noted)
        return super().setdefault(id_, noted)


class LoggedPlaces(Places):
    """The places of nodes, which are told apart from other notes, as all of them count."""

    def __init__(self, log: Log, spans: dict[int, Span]) -> None:
        super().__init__(spans)
        self._log = log

    def note(self, node: Node, span: Span) -> None:
        """Note the place; the log gets it once, and not as a note in the table, too."""
        self._log.noted(None, node.id, span)
        if dict.setdefault(self._first, node.id, span) is not span:
            self._further.setdefault(node.id, []).append(span)

    def follow(self, old: Node, new: Node) -> None:
        """Note all further places of a node for its copy."""
        for span in self._further.get(old.id, ()):
            self._log.noted(None, new.id, span)
        super().follow(old, new)


class LoggedWays(dict[Around, tuple[Way, ...]]):
    """The transforms in scope."""

    def __init__(self, log: Log) -> None:
        super().__init__()
        self._log = log

    def __getitem__(self, around: Around) -> tuple[Way, ...]:
        """The transforms around an expression, which a conversion is looking for."""
        self._log.converted()
        return super().__getitem__(around)


class LoggedValues(dict[tuple[str, int], Node | Failure]):
    """The values of slots."""

    def __init__(self, log: Log, instance: Instance) -> None:
        super().__init__(instance.values)
        self._log = log
        self._of_surface = instance.surface is None

    def __contains__(self, key: object) -> bool:
        """True if a slot has a value; otherwise it gets one now."""
        is_known = super().__contains__(key)
        if not is_known:
            assert isinstance(key, tuple)
            self._log.asked(self._of_surface, *key)
        return is_known

    def __setitem__(self, key: tuple[str, int], value: Node | Failure) -> None:
        super().__setitem__(key, value)
        self._log.kept()

    def __getitem__(self, key: tuple[str, int]) -> Node | Failure:
        value = super().__getitem__(key)
        self._log.answered(SlotRead(self._of_surface, *key, value))
        return value
