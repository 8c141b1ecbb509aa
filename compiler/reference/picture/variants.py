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
    level: Floats
    """What is added to the level of detail."""
    nudge: Floats
    """By how much interpolated values are off, relative to the largest of their corners."""
    checkered: Ints
    """1: to the other side in every other pixel and lane."""
    rounding: Floats
    """By how much operations are off, relative to what they give."""
    period: Ints
    """After how many calls the functions that are off by more, or reads, change sides; 0: functions
    are exact, and reads do not."""
    kind: Ints
    """What it varies: 0 nothing; 1, 2, 3, 4 the place across, down, the derivatives, the level;
    5 and 6 what is interpolated, everything alike and checkered; 7 what operations give; 8 to 10
    what functions give, with three periods; 11 the place inwards; 12 corners;
    13 means of levels."""
    order: Floats
    """Of the norm that makes a length of the derivatives: 2; any between the largest lane
    (infinity) and the sum (1) is allowed."""

    mixed: Floats
    """What is added to a mean of single texels of two levels."""
    opposite: Ints
    """By how many variants further on the same is done to the other side."""

    def __len__(self) -> int:
        return len(self.across)

    def at(self, turn: int) -> Variants:
        """How the read with this number is done: each variant's own way, or the opposite one.

        Filters round each place by itself, so what two reads are off by need not cancel out.
        """
        odd = (self.period > 0) & (turn // np.maximum(self.period, 1) % 2 == 1)
        if not (odd & (self.opposite != 0)).any():
            return self
        chosen = np.arange(len(self)) + np.where(odd, self.opposite, 0)
        return Variants(*(getattr(self, field.name)[chosen] for field in fields(self)))


EXACT = Variants(
    *(
        np.array([value])
        for value in (0.0, 0.0, 0.0, -1, -1, -1, 0.0, 0.0, 0, 0.0, 0, 0, 2.0, 0.0, 0)
    )
)
"""The exact way only."""


def variants(
    subtexel_bits: int | None,
    mip_bits: int | None,
    varying_bits: int | None,
    rounding_bits: int | None,
    functions: bool,
    *,
    mixing_bits: int | None = None,
    volumes: bool = False,
    cubes: bool = False,
    reads: int = 1,
) -> Variants:
    """The exact way and, where a device's bits matter, those at their limits.

    Bits are ``None`` where they do not matter; ``volumes`` and ``cubes`` say what is read, and
    ``reads`` how many times.
    """
    changes: list[_Change] = []
    if subtexel_bits is not None:
        changes += _of_filters(2.0**-subtexel_bits, reads, volumes=volumes, cubes=cubes)
    if mip_bits is not None:
        changes += _of_levels(2.0**-mip_bits, reads)
    if mixing_bits is not None:
        step = 2.0**-mixing_bits
        changes += _to_both_sides(13, {"mixed": -step}, {"mixed": step}, reads)
    if varying_bits is not None:
        changes += [(5, {"nudge": 2.0**-varying_bits})]
        changes += [(6, {"nudge": 2.0**-varying_bits, "checkered": 1})]
    if rounding_bits is not None:
        changes += [(7, {"rounding": 2.0**-rounding_bits})]
    if functions:
        changes += [(kind, {"period": period}) for kind, period in enumerate(_PERIODS, start=8)]
    found = [EXACT, *(_changed(kind, how) for kind, how in changes)]
    names = [field.name for field in fields(Variants)]
    return Variants(*(np.concatenate([getattr(one, name) for one in found]) for name in names))


_How = Mapping[str, float]
"""What is not exact."""
_Change = tuple[int, _How]
"""A kind besides."""

_NEVER = 1 << 30
_PERIODS = (_NEVER, 1, 2)
"""Everything to the same side; every other call to the other one; two calls here and two there."""


def _of_filters(step: float, reads: int, *, volumes: bool, cubes: bool) -> Iterator[_Change]:
    for kind, axis in ((1, "across"), (2, "down"), *([(11, "inward")] if volumes else [])):
        yield from _to_both_sides(kind, {axis: -step}, {axis: step}, reads)
    for corner in range(3 if cubes else 0):
        yield 12, {"corner": corner}


def _of_levels(step: float, reads: int) -> Iterator[_Change]:
    for row, column in ((0, 0), (0, 1), (1, 0), (1, 1)):
        yield 3, {"row": row, "column": column}
    below, above = {"level": -step, "order": np.inf}, {"level": step, "order": 1.0}
    yield from _to_both_sides(4, below, above, reads)


def _to_both_sides(kind: int, one: _How, other: _How, reads: int) -> Iterator[_Change]:
    """One way and its opposite, for all reads alike, and for some the other way round."""
    for period in _PERIODS[: min(reads, len(_PERIODS))]:
        yield kind, {**one, "period": period, "opposite": 1}
        yield kind, {**other, "period": period, "opposite": -1}


def _changed(kind: int, how: _How) -> Variants:
    new = {name: np.array([value]) for name, value in how.items()}
    return replace(EXACT, kind=np.array([kind]), **new)
