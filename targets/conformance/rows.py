"""The result of a conformance run: a row for each material and route."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...compiler.reference.picture import Expected
from ..runner.drivers.device import Device
from ..runner.routes import Route
from .compare import Comparison

Floats = NDArray[np.float64]

Status = Literal["agrees", "differs", "proves little", "overflows", "failed", "not run"]
STATUSES: tuple[Status, ...] = (
    "agrees", "differs", "proves little", "overflows", "failed", "not run"
)  # fmt: skip
"""``differs``: a device has a value that no conforming one may have. ``proves little``: nothing
contradicts it, but the bounds of so many pixels are so wide that this says little. ``overflows``:
a value is too large for float32, where Burnish promises nothing. ``failed``: a compiler or driver
of the route refused. ``not run``: the route lacks its tools, or its profile lacks what the material
needs."""

LACKS_MEMORY = "there is not enough memory to draw this"
"""The problem of a row for which a process could not get as much memory as it needed."""


@dataclass(frozen=True, eq=False, slots=True)
class CaseResult:
    """One case drawn by one route."""

    case: str
    comparison: Comparison
    got: tuple[Floats, ...]
    """The drawn targets, each of shape (height, width, 4)."""
    expected: Expected


@dataclass(frozen=True, eq=False, slots=True)
class Row:
    """One material drawn by one route."""

    material: str
    route: Route
    status: Status
    problem: str = ""
    """The reason why it failed, or was not run."""
    device: Device | None = None
    versions: Mapping[str, str] = field(default_factory=dict)
    """The versions of the route's tools."""
    results: tuple[CaseResult, ...] = ()
    reasons: tuple[str, ...] = ()
    """The places in the source where precision is lost, if that is why the row proves little; or
    the operation that causes most of the error of a pixel that differs."""

    @property
    def max_difference(self) -> float:
        """The largest difference of a decided pixel from the reference, over all cases."""
        return max((result.comparison.max_difference for result in self.results), default=0.0)

    @property
    def bite(self) -> float:
        """The largest of the cases' median distances of the bounds, in steps."""
        return max((result.comparison.bite for result in self.results), default=0.0)

    @property
    def covered(self) -> int:
        """Pixels that the reference covers."""
        return sum(result.comparison.covered for result in self.results)

    @property
    def proven(self) -> int:
        """The number of covered pixels whose bounds are narrow enough to prove something."""
        return sum(result.comparison.proven for result in self.results)
