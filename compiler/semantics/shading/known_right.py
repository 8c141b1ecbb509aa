"""Remembers which declarations of a file were right, so that an edit costs what it changes.

An editor asks for the mistakes of a file at each edit, and most of its declarations are as they
were. ``unused.py`` tries none again that was right before, if its key is the same (``keys.py``).
Only outcomes of checks without any error are kept, and of these only those that found nothing.

Nothing is remembered while graphs are verified or shown (``is_watched``), as in tests.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable, Iterable

from ....support.frozen import frozen
from ....support.locks import lock

MOST_KEPT = 65_536
"""The largest number of outcomes, and of the places in them, that are kept: some 200 bytes each."""

Place = tuple[str, int]
"""A declaration of a file: its name, and its number among those of this name."""


@frozen
class Outcome:
    """The traces that the check of a right declaration leaves in the check of its file."""

    reached: frozenset[Place]
    """The declarations of the file that it was the first to check, by using them."""
    nodes: int
    """The number of nodes of its trees."""
    length: int
    """The number of characters that were tried for it."""

    @property
    def size(self) -> int:
        """The share of the outcome in ``MOST_KEPT``."""
        return 1 + len(self.reached)


class KnownRight:
    """Outcomes by the keys of declarations, those that were used last. Threads may share it."""

    def __init__(self, most: int = MOST_KEPT) -> None:
        self._most = most
        self._size = 0
        self._kept: OrderedDict[Hashable, Outcome] = OrderedDict()
        self._library: object = None
        self._lock = lock()

    def find(self, key: Hashable, library: object) -> Outcome | None:
        """The outcome of a declaration that was right with this library, if it is remembered."""
        with self._lock:
            if library is not self._library or key not in self._kept:
                return None
            self._kept.move_to_end(key)
            return self._kept[key]

    def keep(self, outcomes: Iterable[tuple[Hashable, Outcome]], library: object) -> None:
        """Remember outcomes; those with a library whose files have changed are forgotten."""
        with self._lock:
            if library is not self._library:
                self._kept.clear()
                self._library, self._size = library, 0
            for key, outcome in outcomes:
                before = self._kept.pop(key, None)
                self._kept[key] = outcome
                self._size += outcome.size - (0 if before is None else before.size)
            while self._size > self._most:
                _key, oldest = self._kept.popitem(last=False)
                self._size -= oldest.size


class NothingKnown(KnownRight):
    """Remembers nothing, for whoever watches passes."""

    def keep(self, outcomes: Iterable[tuple[Hashable, Outcome]], library: object) -> None:
        """Keep nothing."""


KNOWN_RIGHT = KnownRight()
"""The outcomes of this process."""
NOTHING_KNOWN = NothingKnown()
