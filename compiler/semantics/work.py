"""Limits of computation while compiling.

All elaborations of one compile share a ``Work``: each value that has to be known has a limit of its
own, and so have all of them together, since a file can have any number of them.
"""

from __future__ import annotations

from collections.abc import Hashable

from ...support.frozen import fresh, record

MOST_OPERATIONS = 500_000
"""Operations that are computed for one value, and each turn of a loop is one: about two seconds."""
MOST_TOGETHER = 1_000_000
"""The limit of operations for all values of a compile.

A value that is written in one place counts once: it is computed again for each material, say, that
the compiler makes of it.
"""
MOST_NODES = 500_000
"""The largest number of nodes in the trees of all materials, kernels and frames.

They take about twenty seconds. Each counts with all that it inherits and calls.
"""


@record
class Work:
    """The computation so far, by the places where values are written."""

    nodes: int = 0
    """The number of nodes of all trees so far."""
    is_told: bool = False
    """True if it has been reported that these are too many."""
    left: int = MOST_TOGETHER
    counted: set[Hashable] = fresh(factory=set)
    steps: int = 0
    """The steps of all frames so far."""
    refused: dict[Hashable, str] = fresh(factory=dict)
    """The places of values that take too long, with the limit that they exceed."""

    @property
    def is_spent(self) -> bool:
        """True if there are so many nodes that nothing more may be elaborated."""
        return self.nodes > MOST_NODES

    def allowed(self, place: Hashable) -> int:
        """The number of operations that the value at a place may take."""
        return MOST_OPERATIONS if place in self.counted else min(MOST_OPERATIONS, self.left)

    def took(self, place: Hashable, operations: int) -> None:
        """Note how many it took, or took before it was given up."""
        if place not in self.counted:
            self.counted.add(place)
            self.left -= operations

    def refuse(self, place: Hashable, allowed: int) -> None:
        """Note that the value at a place takes more than it may."""
        one, all_ = f"{MOST_OPERATIONS} operations", f"{MOST_TOGETHER} operations"
        self.refused[place] = (
            one if allowed == MOST_OPERATIONS else f"{all_} together with others before it"
        )
