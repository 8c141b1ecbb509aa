"""Ends programs when the process that has started them ends, in whatever way, even by SIGKILL.

A lifeline is a pipe to which nothing is ever written. The started program holds its reading end,
without knowing of it, and this process its writing end. When the writing end is closed, which the
kernel does when this process ends, the kernel sends SIGKILL to the program. The program needs no
code for that, and may hang. ``PR_SET_PDEATHSIG`` would do so already at the end of the thread that
has started the program, and would spare what the program has started in turn; this can end a whole
process group.

Only Linux has this; see ``F_SETSIG`` in fcntl(2).
"""

from __future__ import annotations

import os
import signal
import sys
from typing import IO


class Lifeline:
    """The pipe of one program that is about to be started."""

    def __init__(self) -> None:
        self.passed: tuple[int, ...] = ()
        """The file descriptors that the program has to inherit."""
        self._held: IO[bytes] | None = None
        if sys.platform == "linux":
            reading, writing = os.pipe()
            self.passed = (reading,)
            self._held = open(writing, "wb", buffering=0)  # noqa: PTH123, SIM115 - for close

    def tie(self, process: int, *, group: bool) -> None:
        """Let the end of this process kill a started one, or the whole group that it leads."""
        if sys.platform == "linux":
            import fcntl

            (reading,) = self.passed
            fcntl.fcntl(reading, fcntl.F_SETSIG, signal.SIGKILL)
            fcntl.fcntl(reading, fcntl.F_SETOWN, -process if group else process)
            fcntl.fcntl(reading, fcntl.F_SETFL, os.O_ASYNC)

    def let_go(self) -> None:
        """Close our copy of the reading end, which the program has inherited, or could not."""
        for each in self.passed:
            os.close(each)
        self.passed = ()

    def cut(self) -> None:
        """Close the writing end."""
        if self._held is not None:
            self._held.close()
