"""Gathers the rows of a conformance run, which end in any order, in the order of the subjects.

``conform.py`` starts the work in threads and gives it to ``gathered``, which the main thread waits
in. ``burnish conform`` prints each row as soon as it is known, and may end a run early.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from queue import SimpleQueue

from .rows import Row

Done = Callable[[int, int], None]
"""Called with the number of finished rows and the number of all rows."""
Told = Callable[[Row], None]
"""Called with each row as soon as it and all rows before it are known."""
Work = Future[Sequence[Row]]
"""Work of a thread, which makes some rows that follow each other."""


class Stop:
    """Ends one run early, with the rows that are known by then."""

    def __init__(self) -> None:
        # A handler of signals may interrupt any operation of the main thread: of Python's queues,
        # this is the only one to which something can be added even then.
        self._ended: SimpleQueue[Work | None] = SimpleQueue()

    def ask(self) -> None:
        """Ask for the end of the run; a handler of signals may call it at any moment."""
        self._ended.put(None)

    def next_ended(self) -> Work | None:
        """Wait for the next work that has ended; ``None`` if the run shall end."""
        return self._ended.get()

    def watch(self, work: Work) -> None:
        """Let ``next_ended`` return this work when it has ended."""
        work.add_done_callback(self._ended.put)


def gathered(
    works: Sequence[Work],
    total: int,
    *,
    stop: Stop,
    done: Done | None = None,
    told: Told | None = None,
) -> list[Row]:
    """The rows of all works, in the order of the works; those that are known if it is stopped.

    ``total`` is the number of rows of all works. Raises the error of a work that has failed.
    """
    found: dict[int, Sequence[Row]] = {}
    numbers = {work: number for number, work in enumerate(works)}
    passed_on = 0
    for work in works:
        stop.watch(work)
    while len(found) < len(works):
        ended = stop.next_ended()
        if ended is None:
            break
        found[numbers[ended]] = ended.result()
        if done is not None:
            done(sum(map(len, found.values())), total)
        while passed_on in found:
            if told is not None:
                for row in found[passed_on]:
                    told(row)
            passed_on += 1
    return [row for number in sorted(found) for row in found[number]]
