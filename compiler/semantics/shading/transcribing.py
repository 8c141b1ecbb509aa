"""Checks the equations of library records by themselves, and writes down each step.

``kept_transcripts.py`` asks for the transcripts of records that extend each other, once. They are
checked in an elaboration of their own, in which nothing is the user's: there is no pass, and no
rig. ``checking/replay.py`` takes the same steps elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial

from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...ir.node import Node
from ...ir.operations import INPUT
from ...ir.ranges import Ranges
from ...ir.shader import Notes
from ...ir.types import Struct
from ...syntax import ast
from ..checking.call_marks import Callee
from ..checking.expressions import RULES
from ..checking.lights import light_instance
from ..checking.replay import ways_of
from ..checking.slots import slot
from ..declarations.parameters import leaves_of
from ..inheritance.flattening import Records, root_of
from ..names.modules import Symbol
from ..state.context import Context, Twin
from ..state.crossings import Crossings
from ..state.scope import FAILURE, Failure, Instance
from ..state.transcripts import (
    Kept,
    Key,
    LibraryPart,
    Making,
    Noting,
    Placing,
    Reading,
    Step,
    Taking,
    Transcript,
    taking,
)
from ..types.typenames import Declared
from .instances import instance_of
from .placeholders import stand_in
from .rigs import light_entry
from .slot_log import (
    Frame,
    Log,
    LoggedPlaces,
    LoggedTable,
    LoggedValues,
    LoggedWays,
    Noted,
    SlotRead,
)


def transcribed(part: LibraryPart) -> Kept:
    """The transcripts of the library's equations; none at all if something is reported of them.

    But sums over lights have no value here, as there is no rig, nor has what reads them.
    """
    ctx, instance = _begun(part)
    if instance is None:
        return {}
    ctx.twins[instance] = partial(_twin, part)
    log = _logged(ctx, instance)
    for name, definitions in instance.record.definitions.items():
        slot(ctx, instance, name, definitions[0].member.name.span)
    is_right = all(found.rule is rules.EMPTY_RIG for found in ctx.report.since(0))
    is_plain = not (len(ctx.deferred) or ctx.progress.joins_groups or ctx.progress.reads_view)
    if not (is_right and is_plain and log.is_clear):
        return {}
    transcribe = _Transcribing(ctx, instance)
    found: dict[Key, Transcript] = {}
    for frame in log.frames:
        transcript = transcribe.transcript(frame)
        if transcript is not None:
            found.setdefault((frame.name, transcript.definition.level), transcript)
    return found


def _twin(part: LibraryPart) -> Twin:
    """An instance in another elaboration, which is asked for types only."""
    ctx, instance = _begun(part)
    assert instance is not None
    return ctx, instance


def _begun(part: LibraryPart) -> tuple[Context, Instance | None]:
    """An elaboration with an instance of nothing but library records, if there can be one."""
    ctx = Context(Report(), Records(Report()), RULES)
    instance = _instance(ctx, part)
    if instance is not None:
        stand_in(ctx, instance)
    return ctx, instance


def _instance(ctx: Context, part: LibraryPart) -> Instance | None:
    record, first = ctx.records.of_chain(part.chain), part.chain[-1]
    if not isinstance(first.declaration, ast.Record) or first.declaration.kind != "light":
        return instance_of(ctx, record, leaves_of(ctx, record))
    root = root_of(first.module, "material")
    entry = light_entry(ctx, record, "exactly" if part.is_element else "one")
    if root is None or entry is None:
        return None
    surface = ctx.records.of(root)
    shaded = instance_of(ctx, surface, leaves_of(ctx, surface))
    return light_instance(ctx, entry[0], shaded)[0]


def _logged(ctx: Context, instance: Instance) -> Log:
    """A log of all that is done from now on in an elaboration, and to the slots of an instance."""
    log = Log(ctx)
    ctx.notes = Notes(*(LoggedTable(log, number) for number in range(len(Notes().tables))))
    ctx.places = LoggedPlaces(log, ctx.notes.spans)
    ctx.crossings = Crossings(ctx.tree, ctx.report, ctx.follow, ctx.places)
    ctx.types.ways = LoggedWays(log)
    for each in filter(None, (instance, instance.surface)):
        each.values = LoggedValues(log, each)
    return log


class _Numbers:
    """The numbers of values in a transcript."""

    def __init__(self) -> None:
        self.of: dict[Node, int] = {}
        self._count = 0
        self._whole: dict[Node, tuple[Node, int]] = {}
        """For parts of values that were read, what they are an operand of, and which."""

    def add(self, value: Node | Failure) -> None:
        """Give the next number to a value, unless it has one."""
        if isinstance(value, Node):
            self.of.setdefault(value, self._count)
        self._count += 1

    def read(self, value: Node | Failure) -> None:
        """Give a number to a value that was read, and learn its parts."""
        self.add(value)
        pending = [value] if isinstance(value, Node) else []
        while pending:
            whole = pending.pop()
            for position, part in enumerate(whole.operands):
                if part not in self._whole:
                    self._whole[part] = whole, position
                    pending.append(part)

    def taken(self, part: Node) -> list[Taking]:
        """The steps that take a part of what was read, which gets a number by them."""
        way = []
        while part not in self.of and part in self._whole:
            way.append(part)
            part, _ = self._whole[part]
        steps = []
        for each in reversed(way if part in self.of else []):
            whole, position = self._whole[each]
            steps.append(Taking(self.of[whole], position))
            self.add(each)
        return steps


class _Transcribing:
    """Makes transcripts of what was logged for slots."""

    def __init__(self, ctx: Context, instance: Instance) -> None:
        self._ctx = ctx
        self._instance = instance
        self._plain = Ranges(())

    def transcript(self, frame: Frame) -> Transcript | None:
        """The transcript of a slot; ``None`` if it depends on what steps cannot make again."""
        if frame.of_surface is not (self._instance.surface is None) or not frame.is_proven:
            return None
        definition = self._instance.record.at(frame.name, frame.level)
        value = dict.get(self._instance.values, (frame.name, frame.level), FAILURE)
        is_equation = isinstance(definition.member, ast.Slot) and definition.member.value
        if not is_equation or not isinstance(value, Node):
            return None
        own = {node for node in frame.done if isinstance(node, Node)}
        needed = self._needed(value, own)
        found = _Numbers()
        steps, numbers = list(self._steps(frame, needed, found)), found.of
        made = [step for step in steps if isinstance(step, Making)]
        if len(made) < len(needed) or value not in numbers or self._is_assumed(needed):
            return None
        if any(isinstance(step, Noting) and self._is_called_after(step) for step in steps):
            return None
        return Transcript(
            definition=definition,
            typing=self._instance.record.typing(frame.name),
            steps=tuple(steps),
            readings=tuple(step for step in steps if isinstance(step, Reading)),
            value=numbers[value],
            calls=tuple(self._calls(own, numbers)),
            at_vertex=tuple(self._at_vertex(numbers)),
            inputs=frozenset(INPUT.data(node).name for node in needed if node.op == "input"),
            ways=ways_of(self._ctx, self._instance) if frame.is_converted else None,
            unmade=len(own) - len(made),
            structures=self._structures(needed),
        )

    def _structures(self, nodes: Iterable[Node]) -> tuple[tuple[Symbol, Declared | None], ...]:
        """The structures that are known by now, if any of these values may be of one."""
        if not any(isinstance(node.type, Struct) for node in nodes):
            return ()
        return tuple(self._ctx.types.structs.items())

    def _needed(self, value: Node, own: set[Node]) -> set[Node]:
        """The nodes of a slot that its value needs, or a further check that asks for the same."""
        pending = [value, *(node for *_, node in self._own_calls(own))]
        needed: set[Node] = set()
        while pending:
            node = pending.pop()
            if node in own and node not in needed:
                needed.add(node)
                pending += node.operands
                inner = self._ctx.crossings.vertex.get(node.id)
                pending += () if inner is None else (inner,)
        return needed

    def _steps(self, frame: Frame, needed: set[Node], numbers: _Numbers) -> Iterator[Step]:
        """The steps of a slot, up to one that cannot be made again."""
        for done in frame.done:
            if isinstance(done, Noted):
                number = numbers.of.get(done.node)
                if number is not None and done.table is None:
                    yield Placing(number, done.noted)
                elif number is not None and done.table is not None:
                    yield Noting(done.table, number, done.noted)
            elif isinstance(done, SlotRead):
                yield self._reading(done)
                numbers.read(done.value)
            elif done in needed:
                for operand in done.operands:
                    yield from numbers.taken(operand)
                if not _is_closed(done, numbers.of):
                    return
                operands = taking([numbers.of[operand] for operand in done.operands])
                meaning = self._ctx.meanings.of(done)
                yield Making(done.op, done.type, operands, done.data, meaning)
                numbers.add(done)

    def _reading(self, read: SlotRead) -> Reading:
        of_other = read.of_surface and self._instance.surface is not None
        holder = self._instance.surface if of_other else self._instance
        assert holder is not None
        definition = holder.record.at(read.name, read.level)
        return Reading(definition, read.name, read.level, of_other)

    def _is_assumed(self, nodes: Iterable[Node]) -> bool:
        """True if checks have assumed more of a value than is derived from its operands."""
        return any(self._plain.of(node) != self._ctx.ranges.of(node) for node in nodes)

    def _is_called_after(self, step: Noting) -> bool:
        """True if a note has the name of a light in it: others are called otherwise."""
        prefix = self._instance.prefix
        return bool(prefix) and isinstance(step.noted, str) and step.noted.startswith(prefix)

    def _own_calls(self, own: set[Node]) -> Iterator[tuple[Symbol, list[Node], bool, Node]]:
        for (symbol, arguments, surface), value in self._ctx.applied.items():
            if isinstance(value, Node) and value in own and not value.variables:
                nodes = [self._ctx.tree.nodes[id_] for id_ in arguments]
                yield symbol, nodes, surface is not None, value

    def _calls(
        self, own: set[Node], numbers: dict[Node, int]
    ) -> Iterator[tuple[Symbol, tuple[int, ...], bool, int]]:
        for symbol, arguments, of_surface, value in self._own_calls(own):
            if value in numbers and all(argument in numbers for argument in arguments):
                given = tuple(numbers[argument] for argument in arguments)
                yield symbol, given, of_surface, numbers[value]

    def _at_vertex(self, numbers: dict[Node, int]) -> Iterator[tuple[int, int]]:
        for id_, inner in self._ctx.crossings.vertex.items():
            node = self._ctx.tree.nodes[id_]
            if node in numbers and inner in numbers:
                yield numbers[node], numbers[inner]


def _is_closed(node: Node, numbers: dict[Node, int]) -> bool:
    """True if steps can make a node: of nothing but values that have a number."""
    if node.op == "formal":
        return False  # Each time, it would have to be another one.
    if isinstance(node.data, Callee) and any(isinstance(each, Node) for each in node.data.given):
        return False
    return all(operand in numbers for operand in node.operands)
