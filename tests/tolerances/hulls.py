"""Bounds of several routes together: what any of them may draw, as golden folders have them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from burnish.compiler.reference.picture import Expected
from burnish.targets.conformance.compare import ends_of
from burnish.targets.conformance.trials import Trial
from burnish.targets.runner.routes import Route
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, eq=False, slots=True)
class Hull:
    """The bounds of one case."""

    low: Floats
    """The smallest value of each lane of all targets, (targets, height, width, 4)."""
    high: Floats
    covered: Bools
    undecided: Bools
    """Pixels that are not compared: some route leaves them undecided, or only some cover them."""

    @classmethod
    def of(cls, expected: Expected) -> Hull:
        """The bounds of one route."""
        _, low, high = ends_of(expected)
        return cls(low, high, expected.covered, expected.undecided)

    def joined(self, other: Hull) -> Hull:
        """The bounds of both."""
        apart = self.covered != other.covered
        return Hull(
            np.minimum(self.low, other.low), np.maximum(self.high, other.high),
            self.covered | other.covered, self.undecided | other.undecided | apart,
        )  # fmt: skip

    def leaves(self, drawn: Sequence[Floats]) -> bool:
        """True if a lane of a compared pixel is outside; NaN is, where anything is known."""
        values = np.stack(drawn)
        inside = (self.low <= values) & (values <= self.high)
        anything = np.isneginf(self.low) & np.isposinf(self.high)
        outside = ~(inside | anything).all(axis=(0, -1))
        return bool((outside & ~self.undecided).any())


def hulls_of(
    trial: Trial, routes: Iterable[Route], runner: Runner, toolchain: Toolchain
) -> Mapping[str, Hull]:
    """The guaranteed bounds of some routes together, for each case."""
    found: dict[str, Hull] = {}
    for route in routes:
        for answer in trial.answers(route, runner.device(route), runner, toolchain):
            hull = Hull.of(answer.within(answer.questions[-1]).expected)
            known = found.get(answer.case)
            found[answer.case] = hull if known is None else known.joined(hull)
    return found
