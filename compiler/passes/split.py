"""Splits a shader into its stages and packs what crosses between them.

Varyings are exactly the values that cross. Whole values are packed into vec4 slots, first fit by
decreasing width, so that a reader still finds each value in one place.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..ir.leaves import InterpolationMode
from ..ir.node import Node
from ..ir.program import Field, Varying
from ..ir.types import ScalarKind, Scalar, Vector, scalar_kind, width, with_width
from ..semantics.shader import Notes

SLOT_LANES = 4


@dataclass(slots=True)
class _Slot:
    kind: ScalarKind
    mode: InterpolationMode
    values: list[Node]

    @property
    def lanes(self) -> int:
        return sum(width(value.type) for value in self.values)

    def takes(self, value: Node, kind: ScalarKind, mode: InterpolationMode) -> bool:
        fits = self.lanes + width(value.type) <= SLOT_LANES
        return fits and (self.kind, self.mode) == (kind, mode)


def crossings(nodes: Iterable[Node]) -> list[Node]:
    """The ``interpolate`` nodes among those of the fragment stage."""
    return [node for node in nodes if node.op == "interpolate"]


def pack(crossing: Iterable[Node], notes: Notes) -> tuple[Varying, ...]:
    """Slots for all values that cross."""
    unique = list({node.operands[0].id: node for node in crossing}.values())
    by_width = sorted(unique, key=lambda node: (-width(node.type), node.id))
    slots: list[_Slot] = []
    for node in by_width:
        (value,) = node.operands
        kind = scalar_kind(value.type)
        mode: InterpolationMode = "flat" if node.data == "flat" else "perspective"
        assert kind is not None and isinstance(value.type, Scalar | Vector)
        slot = next((slot for slot in slots if slot.takes(value, kind, mode)), None)
        if slot is None:
            slots.append(_Slot(kind, mode, [value]))
        else:
            slot.values.append(value)
    names = {node.operands[0].id: _name(node, notes) for node in unique}
    return tuple(_varying(i, slot, names) for i, slot in enumerate(slots))


def _varying(location: int, slot: _Slot, names: dict[int, str]) -> Varying:
    name = "_".join(dict.fromkeys(names[value.id] for value in slot.values))
    type_ = with_width(slot.kind, slot.lanes)
    return Varying(Field(name, type_, location, slot.mode), tuple(slot.values))


def _name(node: Node, notes: Notes) -> str:
    (value,) = node.operands
    named = notes.names.get(value.id) or notes.names.get(node.id)
    if named is None and value.op == "attribute":
        named = str(getattr(value.data, "name", ""))
    return named or "varying"
