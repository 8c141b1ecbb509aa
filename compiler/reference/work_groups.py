"""Defines how the values of a work group are joined: in which order, and with what.

``functions.py`` asks for these definitions by the rows of the builtins. Which invocations make a
group is known to the array library that a kernel is evaluated with (``in_groups.py``).
"""

from __future__ import annotations

from ...stdlib.builtins.row import OfGroup
from .namespace import Binary, Lane, Lanes, WorkGroups


def joined(xp: WorkGroups, join: Binary, row: OfGroup, value: Lanes) -> Lanes:
    """The value of a builtin that joins the invocations' lanes by ``join``, lane by lane."""
    return tuple(_lane(xp, join, row, lane) for lane in value)


def _lane(xp: WorkGroups, join: Binary, row: OfGroup, x: Lane) -> Lane:
    if row.part == "all":
        return xp.all_joined(join, x)
    through = xp.joined_through(join, x)
    return through if row.part == "through" else xp.at_the_one_before(through, 0)
