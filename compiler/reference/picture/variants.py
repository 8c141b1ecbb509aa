"""The ways in which a device may draw a picture, within the precision that an API grants it.

The reference evaluates all variants at once, as a leading axis of arrays. The radius of a pixel is
how much they differ from the exact variant.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace

import numpy as np

from .scene import Floats, Ints


@dataclass(frozen=True, slots=True)
class Variants:
    """The ways to do a read; arrays have one element for each variant."""

    across: Floats
    """By how many texels a linear filter is shifted to the right."""
    down: Floats
    inward: Floats
    """By how many texels it is shifted towards the next slice of a 3D texture."""
    corner: Ints
    """What is read beyond the corner of a cube: -1 is the mean of the three texels around it;
    another number is one of them."""
    row: Ints
    """The row of the quad for derivatives along x. -1: for textures the upper one, for pixels their
    own."""
    column: Ints
    """The column of the quad for derivatives along y. -1: for textures the left one, for pixels
    their own."""
    level: Floats
    """The error of the level of detail."""
    nudge: Floats
    """The error of interpolated values, relative to the largest corner."""
    checkered: Ints
    """If 1, the error has the opposite sign in every other pixel and lane."""
    rounding: Floats
    """The error of operations, relative to their results."""
    period: Ints
    """After how many calls the errors of less accurate functions, or of reads, change their sign.
    0: these have no error."""
    kind: Ints
    """What a variant changes. 0: nothing; 1 and 2: the place across and down; 3: derivatives; 4:
    the level; 5 and 6: interpolated values, all with the same sign and checkered; 7: results of
    operations; 8 to 10: results of functions, with three periods; 11: the place inwards; 12:
    corners; 13: means of two levels."""
    order: Floats
    """The order of the norm by which derivatives have a length: 2. Any order from 1 (the sum) to
    infinity (the largest lane) is allowed."""

    mixed: Floats
    """The error of a mean of single texels of two levels."""
    opposite: Ints
    """The distance to the variant with the opposite error."""

    def __len__(self) -> int:
        return len(self.across)

    def at(self, turn: int) -> Variants:
        """The variants for the read with this number: each its own, or the opposite one.

        Devices round the place of each read separately, so the errors of two reads need not cancel
        out.
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
"""Only the exact way."""


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
    """The exact way and, where the device's bits matter, the ways with the largest errors.

    Bits are ``None`` where they do not matter. ``volumes`` and ``cubes`` say what is read, and
    ``reads`` how often.
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
"""The fields that are not exact."""
_Change = tuple[int, _How]
"""A kind, and the fields that are not exact."""

_NEVER = 1 << 30
_PERIODS = (_NEVER, 1, 2)
"""All with the same sign; every other call with the opposite one; two calls each."""


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
    """One way and its opposite, with the same sign for all reads, or a different one for some."""
    for period in _PERIODS[: min(reads, len(_PERIODS))]:
        yield kind, {**one, "period": period, "opposite": 1}
        yield kind, {**other, "period": period, "opposite": -1}


def _changed(kind: int, how: _How) -> Variants:
    new = {name: np.array([value]) for name, value in how.items()}
    return replace(EXACT, kind=np.array([kind]), **new)
