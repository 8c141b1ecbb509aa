"""Starts every program that Burnish needs: compilers, drivers, and workers of its own.

Each runs in surroundings without the current folder (``surroundings.py``), within limits of memory,
time and space (``limits.py``), in a process group of its own, so that Ctrl-C is for Burnish alone,
and is ended together with it (``lifeline.py``).
"""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from subprocess import DEVNULL, PIPE
from threading import Lock
from typing import IO

from .lifeline import Lifeline
from .limits import Limits, limit
from .surroundings import NEUTRAL, QUIET, environment

Stream = int | IO[bytes]
"""``PIPE``, ``DEVNULL`` or a file."""


class Child:
    """A program that was started."""

    def __init__(
        self,
        command: Sequence[str],
        limits: Limits,
        *,
        stdin: Stream = DEVNULL,
        stderr: Stream = PIPE,
        folder: Path | None = None,
        variables: Mapping[str, str] = QUIET,
        seconds: int | None = None,
        group: bool = False,
    ) -> None:
        """Start a program by its absolute path; its standard output is a pipe. Raises ``OSError``.

        The program runs in ``folder``, which has to be a private one, and may take so many
        ``seconds`` of a processor's time. A program whose own children would stay behind is ended
        as a ``group``.
        """
        if not os.path.isabs(command[0]):  # noqa: PTH117 - it is no Path
            raise FileNotFoundError(f"{command[0]} is no absolute path")
        self._group = group and os.name == "posix"
        self._lifeline = Lifeline()
        try:
            self.process = subprocess.Popen(
                command, stdin=stdin, stdout=PIPE, stderr=stderr, cwd=folder or NEUTRAL,
                env={**environment(), **variables}, pass_fds=self._lifeline.passed,
                process_group=0 if os.name == "posix" else None,
            )  # fmt: skip
            self._lifeline.tie(self.process.pid, group=self._group)
            limit(self.process.pid, limits, seconds)
        except OSError:
            self._lifeline.cut()
            raise
        finally:
            self._lifeline.let_go()

    @property
    def pid(self) -> int:
        """The number (PID) of the process."""
        return self.process.pid

    def kill(self) -> None:
        """Kill the program, and the rest of its group; it may have ended already."""
        if self._group and self.process.poll() is None:
            with suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)
        self.process.kill()
        self._lifeline.cut()

    def bury(self) -> None:
        """Kill the program if it runs, wait for its end, and close the pipes."""
        self.kill()
        self.process.wait()
        for stream in (self.process.stdin, self.process.stdout, self.process.stderr):
            # A reader that has died has left something in our buffer.
            with suppress(BrokenPipeError):
                if stream is not None:
                    stream.close()


class Family:
    """The child processes of one owner, who may end all of them from any thread."""

    def __init__(self) -> None:
        self._living: set[Child] = set()
        self._lock = Lock()
        self._closed = False

    def adopt(self, child: Child) -> None:
        """Add a child that was just started; end it if the family was closed meanwhile."""
        with self._lock:
            self._living.add(child)
            if self._closed:
                child.kill()

    def dismiss(self, child: Child) -> None:
        """Remove a child that has ended."""
        with self._lock:
            self._living.discard(child)

    def close(self) -> None:
        """End all children. Callers that wait for one of them are told that it was killed."""
        with self._lock:
            self._closed = True
            for child in self._living:
                child.kill()
