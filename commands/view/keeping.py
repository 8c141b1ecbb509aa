"""The data that the server of ``burnish view`` keeps in memory, and its limit.

The files of pictures that pages were given are kept, since nobody else has them; and textures and
documents that were made, since they are asked for again. All of it together has one limit.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from threading import Lock
from typing import Any, Generic, TypeVar

from ...compiler.budget import allowed

_SHARE = 4
"""The share of the limit called ``memory`` that kept data may take; the rest is for new data."""

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


class Keeping:
    """All shelves of a server. Threads may share it."""

    def __init__(self) -> None:
        self.lock = Lock()
        self._shelves: list[Shelf[Any, Any]] = []

    @property
    def most(self) -> int:
        """The most bytes that may be kept."""
        return allowed("memory") // _SHARE

    @property
    def size(self) -> int:
        """The bytes that are kept."""
        return sum(shelf.size for shelf in self._shelves)

    def add(self, shelf: Shelf[Any, Any]) -> None:
        """Count the values of another shelf, which is cleared after all that were added before."""
        self._shelves.append(shelf)

    def make_room(self) -> None:
        """Drop values until the limit is met, the least recently used first.

        They are dropped from the first shelf that has any. The caller has the lock.
        """
        for shelf in self._shelves:
            while self.size > self.most and shelf.drop_oldest():
                pass


class Shelf(Generic[Key, Value]):
    """Values of one kind that are kept, by their keys. Threads may share it."""

    def __init__(self, keeping: Keeping, size_of: Callable[[Value], int]) -> None:
        """``size_of`` returns the bytes of a value; its key takes some, too."""
        self._keeping = keeping
        self._size_of = size_of
        self._kept: OrderedDict[Key, tuple[Value, int]] = OrderedDict()
        self.size = 0
        """The bytes of all values on the shelf."""
        keeping.add(self)

    def get(self, key: Key) -> Value | None:
        """The value that is kept under a key. It becomes the last one that is dropped."""
        with self._keeping.lock:
            if key not in self._kept:
                return None
            self._kept.move_to_end(key)
            return self._kept[key][0]

    def put(self, key: Key, value: Value) -> bool:
        """Keep a value, and drop others if there is no room; True if the value is kept.

        A value that is larger than the limit is not kept.
        """
        size = self._size_of(value) + len(repr(key))
        with self._keeping.lock:
            self._drop(key)
            if size > self._keeping.most:
                return False
            self._kept[key] = value, size
            self.size += size
            self._keeping.make_room()
            return key in self._kept

    def forget(self, is_old: Callable[[Key], bool]) -> None:
        """Drop the values of such keys."""
        with self._keeping.lock:
            for key in [key for key in self._kept if is_old(key)]:
                self._drop(key)

    def drop_oldest(self) -> bool:
        """Drop the least recently used value; True if there was any.

        The caller has the lock.
        """
        oldest = next(iter(self._kept), None)
        if oldest is not None:
            self._drop(oldest)
        return oldest is not None

    def _drop(self, key: Key) -> None:
        if key in self._kept:
            self.size -= self._kept.pop(key)[1]
