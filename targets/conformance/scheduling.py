"""Puts the subjects of a conformance run into the order in which processes begin with them.

``burnish conform`` prints rows in the order of the files, so subjects are best begun in this order.
But a long one that is begun last keeps everybody waiting.
"""

from __future__ import annotations

from collections.abc import Sequence

LONG = 1 / 16
"""The part of a process's share of the whole work from which on a subject is long."""


def begun(costs: Sequence[float], processes: int) -> list[int]:
    """The numbers of subjects in the order in which to begin with them.

    ``costs`` are estimates of what they take. Long ones come first, the longest at the very
    beginning; all others follow in their own order. So the last process ends at most the time of a
    subject that is not long later than the first one, as far as the estimates are right. A single
    process takes as long in any order, so it begins in that of the files.
    """
    if processes == 1:
        return list(range(len(costs)))
    most = LONG * sum(costs) / processes
    long = [number for number, cost in enumerate(costs) if cost > most]
    others = [number for number, cost in enumerate(costs) if cost <= most]
    return sorted(long, key=lambda number: -costs[number]) + others


def saved(costs: Sequence[tuple[float, float]], processes: int) -> float:
    """The part of the whole work for which nobody waits if several processes do it.

    ``costs`` are those of each subject, and the part of them for which other processes can help:
    the rest of a subject is done by one process, one thing after the other.
    """
    whole = sum(cost for cost, _shared in costs)
    alone = max((cost - shared for cost, shared in costs), default=0.0)
    return whole - max(alone, whole / processes)
