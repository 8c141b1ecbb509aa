"""Runs work whose calls nest deeper than Python allows by itself.

A chain of thousands of nodes in an imported document is followed by calls within calls. Python ends
such work with a ``RecursionError`` at a depth of 1000, and the stack of the main thread, which has
8 MB, would not hold many more. So the work runs in a thread with a stack of its own; the system
only provides memory of a stack that is written to.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import TypeVar

Result = TypeVar("Result")

_STACK = 512 << 20
"""The bytes of the stack."""
CALLS = 200_000
"""The most calls within calls. They take less than half of the stack."""


def with_depth(work: Callable[[], Result]) -> Result:
    """Call ``work`` in a thread with a large stack; gives its result, or raises what it raises.

    Work that nests deeper still ends with a ``RecursionError``.
    """
    found: Future[Result] = Future()

    def run() -> None:
        try:
            found.set_result(work())
        except BaseException as error:  # The caller raises it again.
            found.set_exception(error)

    with _room():
        thread = threading.Thread(target=run, name="deep", daemon=True)
        thread.start()
        return found.result()


@contextmanager
def _room() -> Iterator[None]:
    """While it lasts, calls nest deeper, and new threads have large stacks."""
    calls, size = sys.getrecursionlimit(), threading.stack_size(_STACK)
    sys.setrecursionlimit(CALLS)
    try:
        yield
    finally:
        threading.stack_size(size)
        sys.setrecursionlimit(calls)
