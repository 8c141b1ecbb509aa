"""Processes that judge subjects and help each other, without processes: only their times.

A process begins with the next subject as soon as it has ended one. If there is none, it helps with
the first part that somebody has offered and nobody has begun; who has offered parts begins with the
last one, as ``commands/helping.py`` has it.
"""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field

Phase = float | tuple[float, ...]
"""The time that one process needs; or the times of parts that several processes can do at once."""
Work = Sequence[Phase]
"""A subject: its phases follow each other."""


def whole(work: Work) -> float:
    """The time that a subject takes if one process does it."""
    return sum(sum(phase) if isinstance(phase, tuple) else phase for phase in work)


def shortest(work: Work) -> float:
    """The time that a subject takes however many processes help."""
    return sum(max(phase) if isinstance(phase, tuple) else phase for phase in work)


@dataclass(eq=False, slots=True)
class _Judged:
    """A subject with which a process has begun."""

    phases: deque[Phase]
    process: int
    offered: deque[float] = field(default_factory=deque)
    """The parts with which nobody has begun."""
    helping: int = 0
    """The number of parts on which others work."""
    waits: bool = False
    """True while its process waits for others."""


class Simulation:
    """One run."""

    def __init__(self, works: Sequence[Work], order: Sequence[int], processes: int) -> None:
        self._waiting = deque(works[number] for number in order)
        self._judged: list[_Judged] = []
        self._idle: list[int] = []
        self._now = 0.0
        self._count = 0
        self._events: list[tuple[float, int, int, _Judged | None]] = []
        """When a process ends something, in turn; and the subject if it was a part for another."""
        self._own: dict[int, _Judged] = {}
        """The subject of each process that has one."""
        for process in range(processes):
            self._after(0.0, process, None)

    def end(self) -> float:
        """The time at which the last process ends."""
        while self._events:
            self._now, _, process, helped = heapq.heappop(self._events)
            if helped is not None:
                self._helped(helped)
            if process in self._own:
                self._go_on(self._own[process])
            else:
                self._begin(process)
        return self._now

    def _after(self, time: float, process: int, helped: _Judged | None) -> None:
        self._count += 1
        heapq.heappush(self._events, (self._now + time, self._count, process, helped))

    def _begin(self, process: int) -> None:
        """Give a process something to do that has nothing."""
        if self._waiting:
            own = _Judged(deque(self._waiting.popleft()), process)
            self._own[process] = own
            self._judged.append(own)
            self._go_on(own)
            return
        offering = next((each for each in self._judged if each.offered), None)
        if offering is None:
            self._idle.append(process)
            return
        offering.helping += 1
        self._after(offering.offered.popleft(), process, offering)

    def _go_on(self, own: _Judged) -> None:
        """Have a process do the next thing for its own subject."""
        own.waits = False
        if own.offered:
            self._after(own.offered.pop(), own.process, None)
        elif own.helping:
            own.waits = True
        elif not own.phases:
            del self._own[own.process]
            self._judged.remove(own)
            self._begin(own.process)
        else:
            phase = own.phases.popleft()
            if not isinstance(phase, tuple):
                self._after(phase, own.process, None)
                return
            own.offered = deque(phase)
            idle, self._idle = self._idle, []
            for process in idle:
                self._begin(process)
            self._go_on(own)

    def _helped(self, own: _Judged) -> None:
        own.helping -= 1
        if own.waits and not own.helping:
            self._go_on(own)
