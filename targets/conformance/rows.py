"""What a conformance run has found: a row for each material and route."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...compiler.reference.picture import Expected
from ..runner.drivers.draw import Device
from ..runner.routes import Route
from .compare import Comparison

Floats = NDArray[np.float64]

Status = Literal["agrees", "differs", "overflows", "undecided", "failed", "not run"]
STATUSES: tuple[Status, ...] = (
    "agrees", "differs", "overflows", "undecided", "failed", "not run"
)  # fmt: skip
"""``undecided``: so many pixels hang on rounding that agreement of the others proves too little.
``overflows``: a value leaves what float32 holds, where Burnish promises nothing. ``failed``: a
compiler or driver on the route refused. ``not run``: the route lacks its tools, or its profile what
the material needs."""


@dataclass(frozen=True, eq=False, slots=True)
class Result:
    """One case by one route."""

    case: str
    comparison: Comparison
    got: tuple[Floats, ...]
    """Targets, (height, width, 4)."""
    expected: Expected


@dataclass(frozen=True, eq=False, slots=True)
class Row:
    """One material by one route."""

    material: str
    route: Route
    status: Status
    problem: str = ""
    """Why it failed or was not run."""
    device: Device | None = None
    versions: Mapping[str, str] = field(default_factory=dict)
    """Of the tools on the route."""
    results: tuple[Result, ...] = ()

    @property
    def max_difference(self) -> float:
        """The largest distance of a decided pixel from the reference, over all cases."""
        return max((result.comparison.max_difference for result in self.results), default=0.0)

    @property
    def undecided(self) -> int:
        """Pixels that were not compared."""
        return sum(result.comparison.undecided for result in self.results)

    @property
    def covered(self) -> int:
        """Pixels that the reference covers."""
        return sum(result.comparison.covered for result in self.results)
