"""The ways in which a device may draw, within the bits that it is granted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace

import numpy as np

from .scene import Floats, Ints


@dataclass(frozen=True, slots=True)
class Variants:
    """How a read may be done; arrays have one element for each variant."""

    across: Floats
    """Texels by which a linear filter is shifted to the right."""
    down: Floats
    inward: Floats
    """Likewise, towards the next slice of a volume."""
    corner: Ints
    """What is read beyond the corner of a cube: -1 the mean of the three texels around it, or the
    one of them with this number."""
    row: Ints
    """Which row of the quad derivatives along x are taken from; -1: the texture's from the upper
    one, a pixel's from its own."""
    column: Ints
    """Likewise along y: the left column, or the pixel's own."""
    surface: Ints
    """1: derivatives of a cube's coordinate are those of the place on its surface; 2: gradients
    that a program gives are taken as such, however far from the surface they lead."""
    level: Floats
    """What is added to the level of detail."""
    nudge: Floats
    """By how much interpolated values are off, relative to the largest of their corners."""
    checkered: Ints
    """1: to the other side in every other pixel and lane."""
    rounding: Floats
    """By how much operations are off, relative to what they give."""
    period: Ints
    """After how many calls the functions that are off by more change sides; 0: they are exact."""
    kind: Ints
    """What it varies: 0 nothing; 1, 2, 3, 4 the place across, down, the derivatives, the level;
    5 and 6 what is interpolated, everything alike and checkered; 7 what operations give; 8 to 10
    what functions give, with three periods; 11 the place inwards; 12 corners."""
    order: Floats
    """Of the norm that makes a length of the derivatives: 2; any between the largest lane
    (infinity) and the sum (1) is allowed."""

    def __len__(self) -> int:
        return len(self.across)


EXACT = Variants(
    *(np.array([value]) for value in (0.0, 0.0, 0.0, -1, -1, -1, 0, 0.0, 0.0, 0, 0.0, 0, 0, 2.0))
)
"""The exact way only."""


def variants(
    subtexel_bits: int | None,
    mip_bits: int | None,
    varying_bits: int | None,
    rounding_bits: int | None,
    functions: bool,
    *,
    volumes: bool = False,
    cubes: bool = False,
    gradients: bool = False,
) -> Variants:
    """The exact way and, where a device's bits matter, those at their limits.

    Bits are ``None`` where they do not matter; ``volumes`` and ``cubes`` say what is read;
    with ``gradients`` the device does not project those that a program gives for a cube.
    """
    changes: list[_Change] = []
    if subtexel_bits is not None:
        changes += _of_filters(2.0**-subtexel_bits, volumes=volumes, cubes=cubes)
    if mip_bits is not None:
        changes += _of_levels(2.0**-mip_bits, cubes=cubes, gradients=gradients)
    if varying_bits is not None:
        changes += [(5, {"nudge": 2.0**-varying_bits})]
        changes += [(6, {"nudge": 2.0**-varying_bits, "checkered": 1})]
    if rounding_bits is not None:
        changes += [(7, {"rounding": 2.0**-rounding_bits})]
    if functions:
        changes += [(kind, {"period": period}) for kind, period in _PERIODS]
    found = [EXACT, *(_changed(kind, how) for kind, how in changes)]
    names = [field.name for field in fields(Variants)]
    return Variants(*(np.concatenate([getattr(one, name) for one in found]) for name in names))


_Change = tuple[int, Mapping[str, float]]
"""A kind, and what is not exact."""

_PERIODS = ((8, 1 << 30), (9, 1), (10, 2))


def _of_filters(step: float, *, volumes: bool, cubes: bool) -> Iterator[_Change]:
    for off in (-step, step):
        yield 1, {"across": off}
        yield 2, {"down": off}
        if volumes:
            yield 11, {"inward": off}
    for corner in range(3 if cubes else 0):
        yield 12, {"corner": corner}


def _of_levels(step: float, *, cubes: bool, gradients: bool) -> Iterator[_Change]:
    for row, column in ((0, 0), (0, 1), (1, 0), (1, 1)):
        yield 3, {"row": row, "column": column}
        if cubes:
            yield 3, {"row": row, "column": column, "surface": 1}
            yield 3, {"row": row, "column": column, "surface": 1, "order": 1.0}
    # Far enough off for the levels between to differ from both ends.
    for level in (-0.5, 0.0, 0.5) if cubes and gradients else ():
        yield 3, {"surface": 2, "level": level}
        yield 3, {"surface": 2, "level": level, "order": 1.0}
    yield 4, {"level": -step, "order": np.inf}
    yield 4, {"level": step, "order": 1.0}


def _changed(kind: int, how: Mapping[str, float]) -> Variants:
    new = {name: np.array([value]) for name, value in how.items()}
    return replace(EXACT, kind=np.array([kind]), **new)
