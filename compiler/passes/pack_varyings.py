"""Packs the values that cross between two stages into ``vec4`` slots (varying packing).

``split_stages`` calls it for each pair of stages. A value is never split, so that the stage that
reads it finds it in one slot: the widest values are placed first, each into the first slot that
has room.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from heapq import heappop, heappush
from itertools import count
from operator import itemgetter

from ...support.frozen import record
from ..ir.leaves import Attribute
from ..ir.node import Node
from ..ir.operations import CROSS
from ..ir.program import Field, Varying
from ..ir.shader import Notes
from ..ir.stages import Domain, InterpolationMode
from ..ir.types import Scalar, ScalarKind, Vector, scalar_kind, width, with_width

SLOT_LANES = 4


@record
class _Slot:
    kind: ScalarKind
    mode: InterpolationMode
    values: list[Node]

    @property
    def lanes(self) -> int:
        return sum(width(value.type) for value in self.values)


class _Slots:
    """All slots by location, and which of them still have room."""

    def __init__(self) -> None:
        self.all: list[_Slot] = []
        self._free: dict[tuple[ScalarKind, InterpolationMode, int], list[int]] = {}
        """Heaps of the locations where just so many lanes are free."""

    def add(self, value: Node, kind: ScalarKind, mode: InterpolationMode) -> None:
        """Put a value into the first slot that has room for it, or into a new one."""
        needed = width(value.type)
        heaps = [self._free.get((kind, mode, free)) for free in range(needed, SLOT_LANES)]
        heap = min(filter(None, heaps), key=itemgetter(0), default=None)
        if heap is None:
            location = len(self.all)
            self.all.append(_Slot(kind, mode, []))
        else:
            location = heappop(heap)
        slot = self.all[location]
        slot.values.append(value)
        heappush(self._free.setdefault((kind, mode, SLOT_LANES - slot.lanes), []), location)


def pack_varyings(
    nodes: Sequence[Node],
    notes: Notes,
    origin: Domain,
    taken: Collection[str] = (),
    first: int = 0,
) -> tuple[Varying, ...]:
    """Slots for all values that cross from ``origin`` into a stage, whose nodes are given in order.

    ``taken`` are the names of slots further on in the pipeline, and ``first`` is the location of
    the first slot.
    """
    crossed = {
        (n.operands[0], CROSS.data(n).mode): n
        for n in nodes
        if n.op == "cross" and CROSS.data(n).origin == origin
    }
    crossings = list(crossed.values())
    users = users_of(nodes, notes)
    by_width = sorted(crossings, key=lambda node: (-width(node.type), node.id))
    slots = _Slots()
    for node in by_width:
        value = node.operands[0]
        kind = scalar_kind(value.type)
        mode = CROSS.data(node).mode
        assert kind is not None and isinstance(value.type, Scalar | Vector)
        slots.add(value, kind, mode)
    names = {node.operands[0].id: name_of(node, notes, users) for node in crossings}
    varyings: dict[str, Varying] = {}
    names_taken = set(taken)
    for location, slot in enumerate(slots.all):
        shown = "_".join(dict.fromkeys(names[value.id] for value in slot.values))
        name = _apart(shown, names_taken)
        names_taken.add(name)
        varyings[name] = _varying(name, first + location, slot)
    return tuple(varyings.values())


def _varying(name: str, location: int, slot: _Slot) -> Varying:
    type_ = with_width(slot.kind, slot.lanes)
    return Varying(Field(name, type_, location, slot.mode), tuple(slot.values))


def _apart(name: str, taken: Collection[str]) -> str:
    """The name itself, or with the first number that tells it from the others."""
    numbered = (f"{name}_{number}" for number in count(2))
    return name if name not in taken else next(n for n in numbered if n not in taken)


def users_of(nodes: Sequence[Node], notes: Notes) -> Mapping[int, str]:
    """The name of the value that each node is a part of, by the node's id.

    ``nodes`` are in order, operands before users.
    """
    users: dict[int, str] = {}
    for node in reversed(nodes):
        within = notes.names.get(node.id) or users.get(node.id)
        if within is not None:
            for operand in node.operands:
                users.setdefault(operand.id, within)
    return users


def name_of(node: Node, notes: Notes, users: Mapping[int, str]) -> str:
    """The name of a value that crosses: its own, or that of its attribute, or of its use."""
    value = node.operands[0]
    named = notes.names.get(value.id) or notes.names.get(node.id)
    if named is None and isinstance(value.data, Attribute):
        named = value.data.name
    return named or users.get(node.id, "varying")
