"""Packs the varyings between the stages of a chain, from the last stage to the first.

``split_stages`` tells it of each stage in turn, once it is known what the stage has to compute.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set

from ...support.frozen import changed
from ..ir.node import AGE, Node
from ..ir.operations import CROSS
from ..ir.program import Interface, Varying, leaving
from ..ir.shader import Notes, Result
from ..ir.stages import CAPTURE, StageRow
from .pack_varyings import pack_varyings


class Interfaces:
    """The varyings between the stages that are known so far."""

    def __init__(self, notes: Notes, results: Iterable[Result]) -> None:
        """``results`` are all results of the stages besides the varyings."""
        self._notes = notes
        self._captured = {result.name for result in results if result.kind == CAPTURE}
        self.all: tuple[Interface, ...] = ()
        """The interfaces in pipeline order."""
        self._onward: Sequence[Node] = ()
        """The values of the stage behind, if some of those that it reads are handed on to it."""
        self._placed_onward: frozenset[Node] = frozenset()
        """The values in ``_onward`` that are for positions that have to be invariant."""

    def leaving(self, row: StageRow) -> tuple[Varying, ...]:
        """The varyings that a stage computes for the next one, not those it only hands on."""
        return leaving(self.all, row)

    def enter(
        self,
        row: StageRow,
        before: StageRow,
        nodes: Sequence[Node],
        placing: frozenset[Node],
    ) -> None:
        """Packs the varyings from the stage ``before`` into this one, which computes ``nodes``.

        Those in ``placing`` are for positions that have to be invariant. Where this stage hands its
        vertices on, values of the vertices that the next stage reads go through it. They have
        locations behind those of the values that this stage itself delivers to the next.
        """
        taken = {field.name for face in self.all for field in face.fields} | self._captured
        first = len(self.leaving(row)) if row.hands_on else 0
        reading = sorted({*nodes, *self._onward}, key=AGE) if row.hands_on else nodes
        packed = pack_varyings(reading, self._notes, before.domain, taken, first)
        placed = placing | self._placed_onward if row.hands_on else placing
        needed = {node.operands[0] for node in placed if _crosses_from(node, before)}
        varyings = tuple(_marked(varying, needed) for varying in packed)
        faces = [Interface(before.domain, row.domain, varyings)]
        if row.hands_on:
            read = {n.operands[0] for n in self._onward if _crosses_from(n, before)}
            onward = tuple(v for v in varyings if not read.isdisjoint(v.values))
            behind = self.all[0].destination
            faces.append(Interface(before.domain, behind, onward, through=row.domain))
        self.all = (*faces, *self.all)
        self._onward = nodes if before.hands_on else ()
        self._placed_onward = placing if before.hands_on else frozenset()


def _marked(varying: Varying, needed: Set[Node]) -> Varying:
    """A varying that says whether invariant positions need some value in it."""
    is_needed = not needed.isdisjoint(varying.values)
    return changed(varying, field=changed(varying.field, invariant=is_needed))


def _crosses_from(node: Node, row: StageRow) -> bool:
    return node.op == "cross" and CROSS.data(node).origin == row.domain
