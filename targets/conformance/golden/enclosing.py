"""Computes what any of several routes may draw: the bounds that a golden folder has.

They are the hull over everything that is left open: the text of each route, the grid to which a
device snaps vertices, and if it interpolates before that. The bounds of the source itself are in
the hull as well. So they hold for a shader that somebody has written after the source, as an engine
or another compiler would: Burnish's texts are rewritten, and need fewer roundings than that.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....compiler.reference.bounds.errors import Errors
from ....stdlib.builtins.accuracy import Platform
from ...runner.routes import Route
from ..bounds import Bounds
from ..compare import LARGEST, largest_of_lanes, says_nothing
from ..judging import CasePictures, Shown
from ..trials import Trial

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, eq=False, slots=True)
class Enclosed:
    """One output of a case, of shape (height, width, lanes)."""

    shown: Shown
    reference: Floats
    lower: Floats
    upper: Floats


@dataclass(frozen=True, eq=False, slots=True)
class Enclosure:
    """Everything that may be drawn for a case."""

    outputs: tuple[Enclosed, ...]
    undecided: Bools
    """The pixels that are not compared, (height, width)."""
    covered: int
    """The pixels that some device covers: those of the object."""
    wide: int
    """Covered pixels that are compared, but whose bounds say nothing."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height."""
        height, width = self.undecided.shape
        return width, height


def enclosed(
    trial: Trial, case: str, routes: Sequence[Route], told: Callable[[float], None]
) -> Enclosure:
    """The hull of what some routes may draw for a case, and of what the source allows.

    ``told`` is called with the part of the work that is done. Raises what drawing by the reference
    raises.
    """
    questions = list(_questions(trial, case, routes))
    meant = trial.meant(case, questions[0][1])
    hull = _Hull.of(meant)
    for number, (profile, bounds) in enumerate(questions):
        hull.add(trial.bounded(case, profile, bounds))
        told((number + 1) / len(questions))
    return hull.enclosure(meant)


def _questions(
    trial: Trial, case: str, routes: Sequence[Route]
) -> Iterator[tuple[str | None, Bounds]]:
    """The profiles whose texts are different, each with all bounds that count for it; and
    ``None``, the source, with those of all routes.

    Of the promises of several APIs the weakest one counts for a text, as for one that two of them
    carry out: an evaluation for each API would take several times as long.
    """
    by_text: dict[Hashable, list[Route]] = {}
    for route in routes:
        by_text.setdefault(trial.text_of(case, route.profile), []).append(route)
    source = trial.text_of(case, None)
    by_text[source] = list(routes)
    for text, drawn in by_text.items():
        profile = None if text == source else drawn[0].profile
        rules = dict.fromkeys(each.rules for route in drawn for each in trial.promised(case, route))
        errors = Errors(_platforms(drawn))
        for each in rules:
            yield profile, Bounds("guaranteed", each, errors)


def _platforms(routes: Iterable[Route]) -> tuple[Platform, ...]:
    """The platforms of all routes, each once."""
    return tuple(dict.fromkeys(each for route in routes for each in route.platforms))


@dataclass(eq=False, slots=True)
class _Hull:
    """The hull of pictures, so far: all targets in one array, (targets, height, width, 4)."""

    lower: Floats
    upper: Floats
    undecided: Bools
    covered: Bools
    """The pixels that are covered in all pictures."""
    uncovered: Bools
    """Those that are covered in none."""

    @classmethod
    def of(cls, meant: CasePictures) -> _Hull:
        """The hull of what is meant alone."""
        values = np.stack(meant.expected.targets)
        covered = meant.expected.covered
        return cls(values, values, meant.expected.undecided, covered, ~covered)

    def add(self, pictures: CasePictures) -> None:
        """Take the pictures of another device into the hull.

        Vertices that are captured may be fewer on some devices: then only the first ones count.
        """
        found = pictures.expected
        width = min(self.undecided.shape[1], found.undecided.shape[1])
        ends = (np.stack(each)[:, :, :width] for each in (found.low, found.high))
        low, high = ends
        self.lower = np.minimum(self.lower[:, :, :width], np.where(np.isnan(low), -np.inf, low))
        self.upper = np.maximum(self.upper[:, :, :width], np.where(np.isnan(high), np.inf, high))
        values = np.stack(found.targets)[:, :, :width]
        undecided = found.undecided[:, :width] | _overflows(values)
        self.undecided = self.undecided[:, :width] | undecided
        self.covered = self.covered[:, :width] & found.covered[:, :width]
        self.uncovered = self.uncovered[:, :width] & ~found.covered[:, :width]

    def enclosure(self, meant: CasePictures) -> Enclosure:
        """The hull with what is meant. Pixels that only some devices cover are undecided."""
        height, width = self.undecided.shape
        values = np.stack(meant.expected.targets)[:, :height, :width]
        undecided = self.undecided | _overflows(values) | ~(self.covered | self.uncovered)
        lower, upper = _known(self.lower, -np.inf), _known(self.upper, np.inf)
        seen = self.covered & ~undecided
        wide = seen & says_nothing(values, lower, upper, seen)
        outputs = (
            Enclosed(shown, *(each[number, ..., : shown.lanes] for each in (values, lower, upper)))
            for number, shown in enumerate(meant.shown)
        )
        covered = int((~self.uncovered).sum())
        return Enclosure(tuple(outputs), undecided, covered, int(wide.sum()))


def _overflows(values: Floats) -> Bools:
    """The pixels with a value that is too large for float32, or no number: any may be drawn."""
    return largest_of_lanes(~(np.abs(values) <= LARGEST))


def _known(ends: Floats, nothing: float) -> Floats:
    """Ends of bounds, where NaN becomes the end that says nothing."""
    return np.where(np.isnan(ends), nothing, ends)
