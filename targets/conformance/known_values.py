"""Values that several threads need and that take long to make: each is made once."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from threading import Lock
from typing import Generic, TypeVar

T = TypeVar("T")
Fits = Callable[[T], bool]


class Known(Generic[T]):
    """Values by key; trials keep here what the reference computes for all routes."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._values: dict[Hashable, _Once[T]] = {}

    def value(self, key: Hashable, make: Callable[[], T]) -> T:
        """The value of a key; the first thread that asks for it makes it."""
        with self._lock:
            once = self._values.setdefault(key, _Once())
        return once.value(make)

    def shared(self, shared: Hashable, own: Hashable, make: Callable[[], T], fits: Fits[T]) -> T:
        """The value of a shared key if it fits the caller; else that of the caller's own key."""
        found = self.value(("shared", shared), make)
        return found if fits(found) else self.value(("own", own), make)


class _Once(Generic[T]):
    """A value that the first thread to ask for it makes; others wait until it is there."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._values: list[T] = []

    def value(self, make: Callable[[], T]) -> T:
        """The value; if ``make`` raises an error, the next thread tries again."""
        with self._lock:
            if not self._values:
                self._values.append(make())
            return self._values[0]
