"""The work groups of a kernel, whose invocations run together, and how they share elements.

Semantics says how large work groups are, by the kernel's own word or by ``USUAL``. The texts
declare it, and a host needs it to know how many work groups it has to run.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

WorkGroup = tuple[int, int, int]
"""The number of invocations side by side along x, y and z."""

USUAL: Mapping[int, WorkGroup] = {1: (64, 1, 1), 2: (8, 8, 1)}
"""The usual work group by the number of dimensions of a kernel's results.

It is a multiple of the invocations that all devices execute at once, and no more than any of them
takes.
"""

WRITTEN_GROUP = "draw"
"""The group of the buffers and images that a kernel writes."""

ScatterOperator = Literal["add", "min", "max", "and", "or"]
"""The operator that joins a scattered value with an element: in any order with one result."""

MOST_INVOCATIONS = 1024
"""The largest work group of any API; a profile's limits say what it has at least."""


def invocations(group: WorkGroup) -> int:
    """The number of invocations of a work group."""
    x, y, z = group
    return x * y * z


def ends(*, signed: bool) -> tuple[int, int]:
    """The least and the greatest number that an element can have which is scattered to."""
    return (-(2**31), 2**31 - 1) if signed else (0, 2**32 - 1)


def neutral(operator: ScatterOperator, *, signed: bool) -> int:
    """The value of an element before anything is scattered to it: joining it changes nothing."""
    lowest, highest = ends(signed=signed)
    ones = -1 if signed else highest
    return {"add": 0, "or": 0, "and": ones, "min": highest, "max": lowest}[operator]
