"""Limits of memory, time and space for the programs that Burnish starts: one row for each kind.

A text of a thousand bytes can make a compiler take all memory of a machine, or write without end.
The kernel enforces these limits, on Linux only: other systems have no way to limit a process that
already runs, and only the time and what is read of a program's output are limited there.

What Burnish itself may take is another table, ``compiler/budget.py``.
"""

from __future__ import annotations

import re
import sys
from contextlib import suppress
from dataclasses import dataclass, replace

from ...compiler.budget import LIMITS, allowed

MB = 10**6
GB = 10**9


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of each process of a program; the processes that it starts have the same limits."""

    memory: int
    """Bytes of memory that it may write to, whether or not it ever does. Address space that is only
    reserved does not count: V8 and other virtual machines reserve terabytes."""
    file: int
    """Bytes of each file that it writes."""
    output: int
    """Bytes of its output that are read before it is stopped."""
    of: str = ""
    """The programs that have these limits, for the manual."""
    draws: bool = False
    """True if the program may take more if ``--budget memory`` allows more to be drawn."""

    def scaled(self) -> Limits:
        """The limits, raised as far as the budget of memory was raised."""
        raised = allowed(_BUDGET) / LIMITS[_BUDGET].most if self.draws else 1
        if raised <= 1:
            return self
        memory, file, output = (
            int(raised * each) for each in (self.memory, self.file, self.output)
        )
        return replace(self, memory=memory, file=file, output=output)


_BUDGET = "memory"
"""The row of the budget for everything that is drawn at the same time."""

COMPILERS = Limits(memory=GB, file=64 * MB, output=64 * MB, of="a compiler")
"""Limits of programs that get one text."""
ASKED = Limits(memory=4 * GB, file=64 * MB, output=MB, of="a program that says its version")
"""Limits of programs that only print their version, browsers among them."""
WORKERS = Limits(
    memory=4 * GB, file=2 * GB, output=2 * GB, draws=True,
    of="a driver, or a process that compiles or judges",
)  # fmt: skip
"""Limits of drivers, of processes that compile or judge, and of the gallery. Pictures may take a
gigabyte, and there are a few copies of them until they have been sent."""
BROWSERS = Limits(
    memory=8 * GB, file=2 * GB, output=2 * GB, draws=True, of="each process of the browser"
)
"""Limits of browsers. A browser's pages map 4 GB at once for objects of JavaScript, and use a small
part of it."""

EVERY_LIMIT = (COMPILERS, ASKED, WORKERS, BROWSERS)
"""All rows of limits."""

_NO_MEMORY = re.compile(
    r"bad_alloc|out of memory|memory allocation of \d+ bytes failed|MemoryError"
    r"|Cannot allocate memory|0x8007000e",
    re.IGNORECASE,
)
"""The messages of programs that are given no more memory."""


def limit(process: int, limits: Limits, seconds: int | None) -> None:
    """Set the limits of a process that was just started, and its processor time if given.

    The caller stops a process that ends late; the processor's time is for the case that the caller
    has died.
    """
    if sys.platform != "linux":
        return
    import resource  # which Windows lacks

    rows = {
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_DATA: limits.memory,
        resource.RLIMIT_FSIZE: limits.file,
    }
    if seconds is not None:
        rows[resource.RLIMIT_CPU] = seconds
    for kind, most in rows.items():
        # The process may have ended already, and the user's own limits may be lower.
        with suppress(ProcessLookupError):
            _, hard = resource.prlimit(process, kind)
            within = most if hard == resource.RLIM_INFINITY else min(most, hard)
            resource.prlimit(process, kind, (within, within))


def exhausted(log: str, limits: Limits) -> str:
    """The message about a program that failed since it got no more memory; else empty.

    The message replaces the program's own ones, which only say where the lack was noticed.
    """
    if not _NO_MEMORY.search(log):
        return ""
    return f"it needs more than {in_words(limits.memory)} of memory, which is all that it may take"


def in_words(size: int) -> str:
    """A number of bytes for people: ``64 MB``."""
    return f"{size / GB:g} GB" if size >= GB else f"{size / MB:g} MB"
