"""Locks that are free in a copy of the process.

``os.fork`` copies one thread only. A lock that another thread holds just then stays held in the
copy, and whoever wants it there waits for ever. So a process that forks takes the locks of this
module first, when no thread is in the middle of what they protect.
"""

from __future__ import annotations

import os
from threading import Lock, RLock
from typing import Any, TypeVar

L = TypeVar("L", bound=Any)


def lock() -> Lock:
    """A lock that is never held in a copy of the process, for as long as the process lives."""
    return _free_in_copies(Lock())


def reentrant_lock() -> RLock:
    """Such a lock, which the thread that holds it may take again."""
    return _free_in_copies(RLock())


def _free_in_copies(made: L) -> L:
    """The lock, for a process that may fork.

    Locks are taken in the opposite order of that in which they were made. So a thread that holds
    one may wait only for locks that were made before it.
    """
    if hasattr(os, "register_at_fork"):  # Windows never copies a process.
        os.register_at_fork(
            before=made.acquire, after_in_parent=made.release, after_in_child=made.release
        )
    return made
