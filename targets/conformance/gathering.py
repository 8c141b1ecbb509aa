"""Gathers the rows of a conformance run, which end in any order, in the order of the subjects.

``conform.py`` starts work in threads, and so does ``burnish conform`` if it has several processes.
The main thread waits for it in a ``Gathering``. ``burnish conform`` prints each row as soon as it
is known, and may end a run early.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from queue import SimpleQueue

from .rows import Row

Progressed = Callable[[int, int], None]
"""Called with the number of finished rows and the number of all rows."""
NextRow = Callable[[Row], None]
"""Called with each row as soon as it and all rows before it are known."""
Work = Future[Sequence[Row]]
"""Work of a thread, which makes some rows that follow each other."""


class Gathering:
    """The rows of one run, as far as they are known."""

    def __init__(
        self, progressed: Progressed | None = None, next_row: NextRow | None = None
    ) -> None:
        """The functions are called while ``wait_for`` waits."""
        self._progressed, self._next_row = progressed, next_row
        self._found: dict[int, Sequence[Row]] = {}
        # A handler of signals may interrupt any operation of the main thread: of Python's queues,
        # this is the only one to which something can be added even then.
        self._ended: SimpleQueue[Work | None] = SimpleQueue()

    @property
    def rows(self) -> list[Row]:
        """The rows that are known, in the order of the works, whatever has become of the run."""
        return [row for number in sorted(self._found) for row in self._found[number]]

    def end(self) -> None:
        """Ask for the end of the run; a handler of signals may call it at any moment."""
        self._ended.put(None)

    def wait_for(self, works: Sequence[Work], total: int) -> None:
        """Gather the rows of all works, ``total`` in number, or until the run shall end.

        Raises the error of the first work that fails.
        """
        numbers = {work: number for number, work in enumerate(works)}
        passed_on = 0
        for work in works:
            work.add_done_callback(self._ended.put)
        while len(self._found) < len(works):
            ended = self._ended.get()
            if ended is None:
                return
            self._found[numbers[ended]] = ended.result()
            if self._progressed is not None:
                self._progressed(sum(map(len, self._found.values())), total)
            while passed_on in self._found:
                if self._next_row is not None:
                    for row in self._found[passed_on]:
                        self._next_row(row)
                passed_on += 1
