"""Judges what a route has made of a case: every lane has to lie within the reference's bounds.

Whatever is compared has the form of pictures, so that there is one comparison. Render targets are
pictures anyway; elements of buffers and captured vertices are the pixels of a single row, and each
part of them that is written is a target. The module that knows a content makes pictures of it:
``contents.py`` those of single shaders, and ``frames.py`` those of frames.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.reference.picture import Expected, formats
from .bounds import Bounds
from .compare import Comparison, Level, compare
from .rows import CaseResult

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

FLOATS = "rgba32f"
"""The format that holds every float that is compared, where it is not a declared format of a render
target that is compared."""


@dataclass(frozen=True, slots=True)
class Stored:
    """The place of a part of each element, or vertex, in the buffer that holds all of them."""

    buffer: str
    """The name of the buffer; empty for captured vertices, which lie in one of their own."""
    offset: int
    """The offset in an element, in bytes. The lanes follow each other, four bytes each."""
    stride: int
    """Bytes from one element to the next."""
    type: str
    """The type of a lane, as NumPy spells it: ``<f4``, ``<i4`` or ``<u4``."""


@dataclass(frozen=True, slots=True)
class Shown:
    """What one of several pictures of a case shows."""

    name: str
    lanes: int
    """The lanes that it has; a picture has room for four."""
    stored: Stored | None = None
    """The place of its numbers, if it is no picture of a render target."""


@dataclass(frozen=True, slots=True)
class CasePictures:
    """All pictures of a case, as far as the reference knows them."""

    shown: Sequence[Shown]
    expected: Expected
    """A target for each of them."""

    @classmethod
    def of_formats(
        cls, names: Sequence[str], stored: Sequence[str], expected: Expected
    ) -> CasePictures:
        """Pictures with these names and formats: values are clamped as a device's are."""
        targets = map(formats.clamped, stored, expected.targets)
        return cls(
            [Shown(name, formats.lanes_of(each)) for name, each in zip(names, stored, strict=True)],
            replace(expected, targets=tuple(targets)),
        )


@dataclass(frozen=True, slots=True)
class Compared:
    """The answer of a route for a case, beside what the reference says of it."""

    got: Sequence[Floats]
    """The targets that the route has drawn, each of shape (height, width, 4)."""
    expected: Expected
    """The bounds of the emitted program, for one device."""
    meant: Sequence[Floats]
    """The targets as the source means them."""
    steps: Sequence[Floats]
    """The distances between neighbouring numbers of each target's format."""
    possible: Callable[[], Expected]
    """Computes the bounds of the source itself, which few comparisons need."""

    @classmethod
    def of(
        cls,
        got: Sequence[Floats],
        expected: Expected,
        meant: Expected,
        names: Sequence[str],
        possible: Callable[[], Expected],
    ) -> Compared:
        """The pictures to compare, for targets of these formats.

        A text has no promises any more, nor what was written as ``unguarded``: the source knows
        where nothing is defined.
        """
        pairs = list(zip(names, meant.targets, strict=True))
        return cls(
            got,
            replace(expected, undecided=expected.undecided | meant.undecided),
            [formats.clamped(name, values) for name, values in pairs],
            [formats.step(name, values) for name, values in pairs],
            possible,
        )

    def comparison(self, level: Level) -> Comparison:
        """The comparison; ``level`` says which bounds ``expected`` has."""
        parts = self.got, self.expected, self.meant, self.steps, level
        found = compare(*parts)
        # In float64, too, numbers that cancel may tip a decision.
        return compare(*parts, self.possible()) if found.changed else found


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer of a route for one case, which waits to be judged."""

    case: str
    questions: Sequence[Bounds]
    """The bounds with which it is compared: the next ones only if it leaves the ones before."""
    within: Callable[[Bounds], Compared]
    """Puts the answer beside what the reference says by these bounds."""

    def judged(self) -> CaseResult:
        """The verdict: by the first bounds that the answer does not leave, or by the last ones."""
        found = []
        for bounds in self.questions:
            compared = self.within(bounds)
            found.append(compared.comparison(bounds.level))
            if not found[-1].wrong:
                break
        return CaseResult(self.case, summed_up(found), tuple(compared.got), compared.expected)


def summed_up(found: Sequence[Comparison]) -> Comparison:
    """The last comparison, with the tightness of the first one."""
    first, last = found[0], found[-1]
    if first is last:
        return first
    # Pixels that left the first bounds are proven by the last ones only.
    proven = max(last.proven, first.proven - first.wrong)
    return replace(
        last, proven=proven, wide=first.wide + first.proven - proven, bite=first.bite,
        beyond=None if last.wrong else first.worst,
    )  # fmt: skip


def row_of(lanes: Sequence[NDArray[Any]], width: int) -> Floats:
    """Up to four lanes of elements, or of vertices, as a picture of one row.

    Missing lanes and missing elements are zero.
    """
    whole = np.zeros((1, width, 4))
    for number, lane in enumerate(lanes):
        whole[0, : len(lane), number] = lane
    return whole


def all_covered(
    values: Sequence[Floats],
    low: Sequence[Floats],
    high: Sequence[Floats],
    undecided: Bools | None = None,
) -> Expected:
    """The expected picture of something that has a value everywhere; by default a decided one."""
    covered = np.ones(values[0].shape[:2], np.bool_)
    return Expected(
        tuple(values), covered, ~covered if undecided is None else undecided, tuple(low),
        tuple(high), covered.astype(np.int64),
    )  # fmt: skip
