"""The lights of a scene: those of a file, or made-up ones.

A material's rig says which lights it takes, each by the values that it reads: one with a place and
a direction is a spot, one with a place only shines all around, and one with a direction only from
far away. ``scene.py`` calls ``shine``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from ...compiler.documents.values import LightRow
from .cameras import Vector
from .instances.host_values import HostValues

LampKind = Literal["directional", "point", "spot"]

Roles = Mapping[str, str]
"""The parameters of a light, each with its role, which is the scene's word for it."""

GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))

_TINTS = ((1.0, 0.95, 0.85), (0.55, 0.75, 1.0), (1.0, 0.6, 0.45), (0.6, 1.0, 0.7))


@dataclass(frozen=True, slots=True)
class Lamp:
    """A light without size."""

    name: str
    kind: LampKind
    color: Vector
    """The colour in linear light: of a directional light, as it arrives; of others, at distance
    one."""
    place: Vector
    direction: Vector
    """The direction in which a directional light, or the axis of a spot, travels; of length one."""
    inner: float = 0.0
    """The angle in radians from a spot's axis at which the spot begins to fade."""
    outer: float = math.pi / 4
    """The angle in radians from a spot's axis at which the spot is dark."""
    reach: float = math.inf
    """The distance at which the light is dark."""

    def value(self, role: str) -> Any:
        """The value of the lamp for a role, which is the scene's word for it."""
        match role:
            case "towards_object":
                return self.direction
            case "reach":
                return 0.0 if math.isinf(self.reach) else self.reach
            case _:
                return getattr(self, role)


_DARK = Lamp("", "spot", (0.0, 0.0, 0.0), (0.0, 1000.0, 0.0), (0.0, -1.0, 0.0))
"""The light for entries of a rig for which a file has none."""


def shine(instance: HostValues, lamps: Sequence[Lamp], roles: Sequence[Roles]) -> None:
    """Set the parameters of all lights of a rig to those of a file, in their order.

    ``roles`` are those of each light of the rig. Lights of the rig that are left over are dark, and
    those of an array are switched off.
    """
    lights = instance.declared.lights
    for row, own, taken in zip(lights, roles, _shared(lights, lamps, roles), strict=True):
        whole = taken + [_DARK] * ((row.capacity or 1) - len(taken))
        _set(instance, row, [_values(own, lamp) for lamp in whole], len(taken))


def left_over(instance: HostValues, lamps: Sequence[Lamp], roles: Sequence[Roles]) -> list[Lamp]:
    """The lights of a file for which the rig has no entry."""
    shared = _shared(instance.declared.lights, lamps, roles)
    used = {id(lamp) for taken in shared for lamp in taken}
    return [lamp for lamp in lamps if id(lamp) not in used]


def _shared(
    lights: Sequence[LightRow], lamps: Sequence[Lamp], roles: Sequence[Roles]
) -> list[list[Lamp]]:
    """The lights of a file that each light of a rig gets: the next ones of its kind."""
    waiting: dict[LampKind, list[Lamp]] = {"directional": [], "point": [], "spot": []}
    for lamp in lamps:
        waiting[lamp.kind].append(lamp)
    shared = []
    for row, own in zip(lights, roles, strict=True):
        kind, capacity = _kind(own), row.capacity or 1
        shared.append(waiting[kind][:capacity])
        waiting[kind] = waiting[kind][capacity:]
    return shared


def make_up(
    instance: HostValues, roles: Sequence[Roles], distance: float, most_of_array: int
) -> None:
    """Set the parameters of all lights of a rig, so that they shine on an object at the origin.

    Lights with a place are at a distance from it. Those of an array have values beyond the number
    that shines, so that this number can be raised later.
    """
    lights = instance.declared.lights
    counts = [_count(row, most_of_array) for row in lights]
    total = sum(counts)
    shining, spare = 0, total
    for row, own, count in zip(lights, roles, counts, strict=True):
        further = (row.capacity or 1) - count
        numbers = (*range(shining, shining + count), *range(spare, spare + further))
        shining, spare = shining + count, spare + further
        lamps = [_made_up(number, total, distance) for number in numbers]
        _set(instance, row, [_values(own, lamp, MADE_UP) for lamp in lamps], count)


MADE_UP = frozenset(("color", "place", "towards_object"))
"""The roles whose values are made up; values of other roles keep their defaults."""


def _kind(roles: Roles) -> LampKind:
    read = set(roles.values())
    if "place" in read:
        return "spot" if "towards_object" in read else "point"
    return "directional"


def _values(roles: Roles, lamp: Lamp, known: frozenset[str] | None = None) -> dict[str, Any]:
    return {
        member: lamp.value(role)
        for member, role in roles.items()
        if known is None or role in known
    }  # fmt: skip


def _set(
    instance: HostValues, row: LightRow, values: Sequence[Mapping[str, Any]], count: int
) -> None:
    """Set a light, or all lights of an array; ``count`` of them are switched on."""
    if values and values[0]:
        instance.set(row.name, values[0] if row.capacity is None else values)
    if row.count is not None:
        instance.set(row.count, count)


def _count(row: LightRow, most_of_array: int) -> int:
    """The number of lights that a row of the reflection stands for."""
    if row.capacity is None:
        return 1
    return row.capacity if row.count is None else min(row.capacity, most_of_array)


def _made_up(number: int, total: int, distance: float) -> Lamp:
    """One of ``total`` lights: the first is at the upper left, the others all around."""
    towards = _direction(number)
    strength = 1.0 if total == 1 else 0.8 if number == 0 else 0.8 / (total - 1)
    color = _scaled(_TINTS[number % len(_TINTS)], strength)
    return Lamp("", "spot", color, _scaled(towards, distance), _scaled(towards, -1.0))


def _direction(number: int) -> Vector:
    """The direction from the object to a light."""
    height = 0.65 - 0.35 * (number % 4) / 4
    angle = math.radians(-40) + GOLDEN_ANGLE * number
    ring = math.sqrt(1 - height * height)
    return ring * math.sin(angle), height, ring * math.cos(angle)


def _scaled(v: Vector, factor: float) -> Vector:
    return v[0] * factor, v[1] * factor, v[2] * factor
