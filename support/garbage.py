"""Sets how often Python looks for garbage while Burnish works.

Python counts how many objects are made, and looks through them for circles of dropped ones after
every 700. A compile makes many objects, keeps most of them until it ends, and hardly ever drops a
circle: a quarter of the time of a long compile would go into looking in vain. So the command line
sets ``SELDOM`` for the whole process, and the modules of ``api`` mark the functions that users call
with ``seldom_collected``, which also gives them room on Python's stack.

That is too seldom for a server. A picture of many megabytes is one object for Python, and a circle
that holds it, such as that of an exception and what it was raised in, stays for hours. So whoever
runs for long calls ``settle`` when it has started, and ``sweep`` after each piece of work.
"""

from __future__ import annotations

import gc
from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from .locks import lock
from .stack import with_room

SELDOM = (100_000, 50, 100)
"""The number of new objects after which Python looks through them, and the number of such looks
after which it goes through older ones. The garbage of the meantime takes some 10 MB at most."""

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


def seldom_collected(work: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """``work``, during which Python looks for garbage seldom, and has room for its frames.

    The first call that begins raises the thresholds, and the last one that ends restores them.
    Collection is never turned off, so memory stays bounded however long a compile is; and if the
    host has turned it off, or has set thresholds that are higher still, these stay. Other threads
    only notice that their circles are freed a little later.
    """

    @wraps(work)
    def wrapped(*arguments: Arguments.args, **named: Arguments.kwargs) -> Result:
        _CALLS.begin()
        try:
            return with_room(work, *arguments, **named)
        finally:
            _CALLS.end()

    return wrapped


def settle() -> None:
    """Exempt all present objects, such as modules and the library, which stay until the end.

    Looking through the rest is then a matter of milliseconds.
    """
    gc.collect()
    gc.freeze()


def sweep() -> None:
    """Free all circles of dropped objects."""
    gc.collect()


class _Calls:
    """The calls that are running, in all threads: the thresholds belong to the process."""

    def __init__(self) -> None:
        self._lock = lock()
        self._running = 0
        self._before = SELDOM
        """The host's thresholds, while any call is running."""

    def begin(self) -> None:
        with self._lock:
            if self._running == 0:
                self._before = gc.get_threshold()
                gc.set_threshold(*_raised(self._before))
            self._running += 1

    def end(self) -> None:
        with self._lock:
            self._running -= 1
            # Thresholds that the host has set in the meantime stay.
            if self._running == 0 and gc.get_threshold() == _raised(self._before):
                gc.set_threshold(*self._before)


def _raised(thresholds: tuple[int, int, int]) -> tuple[int, int, int]:
    """Thresholds that are at least ``SELDOM``; a first one of 0 turns collection off."""
    if thresholds[0] == 0:
        return thresholds
    first, second, third = map(max, thresholds, SELDOM)
    return first, second, third


_CALLS = _Calls()
