"""Persistent child processes that answer one line of JSON with one line of JSON.

DXC and Tint run in them, since starting these takes long and they may crash. If a child dies or
hangs, only the current request fails: the next request starts a new child.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from queue import LifoQueue
from threading import Event, Timer
from typing import IO, Any

from .process import Ending, how_it_crashed

LOG_TAIL = 20_000
"""How many bytes of a dead child's output are kept."""

END_LIMIT = 10.0
"""How many seconds a child may go on after it has closed its output."""


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer to one request."""

    ending: Ending
    reply: Mapping[str, Any]
    """The child's answer; empty unless the ending is ``ended``."""
    log: str
    """Why there is no answer."""


class Worker:
    """One child process, which the first request starts."""

    def __init__(self, command: Callable[[], Sequence[str]]) -> None:
        self._find_command = command
        self._command: Sequence[str] = ()
        self._child: subprocess.Popen[bytes] | None = None
        self._errors: IO[bytes] | None = None

    def ask(self, request: Mapping[str, Any], time_limit: float) -> Answer:
        """Send one request and wait at most ``time_limit`` seconds for its answer."""
        timed_out = Event()
        try:
            child = self._child or self._start()
        except OSError as error:
            return Answer("crashed", {}, f"{self._command[0]}: could not be started: {error}")

        def give_up() -> None:
            timed_out.set()
            child.kill()

        timer = Timer(time_limit, give_up)
        timer.daemon = True
        try:
            timer.start()  # Here, too, Ctrl-C may come, and a timer would keep the process waiting.
            line = _exchange(child, json.dumps(request).encode() + b"\n")
        finally:
            timer.cancel()
        if line.endswith(b"\n") and not timed_out.is_set():
            return Answer("ended", json.loads(line), "")
        return self._post_mortem(f"no answer within {time_limit:g} s" if timed_out.is_set() else "")

    def close(self) -> None:
        """End the child process, if there is one."""
        if self._child is not None:
            self._bury(self._child)

    def _start(self) -> subprocess.Popen[bytes]:
        self._command = self._find_command()
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed in _bury
        self._child = subprocess.Popen(
            self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors
        )
        return self._child

    def _post_mortem(self, timeout: str) -> Answer:
        assert self._child is not None and self._errors is not None
        try:
            code = self._child.wait(END_LIMIT)
        except subprocess.TimeoutExpired:
            self._child.kill()
            code = self._child.wait()
        self._errors.seek(0)
        said = self._errors.read()[-LOG_TAIL:].decode(errors="replace")
        self._bury(self._child)
        reason = timeout or how_it_crashed(code)
        ending: Ending = "timeout" if timeout else "crashed"
        return Answer(ending, {}, f"{said}{self._command[0]}: {reason}\n")

    def _bury(self, child: subprocess.Popen[bytes]) -> None:
        child.kill()
        child.wait()
        for stream in (child.stdin, child.stdout, self._errors):
            if stream is not None:
                _close(stream)
        self._child = None


def _exchange(child: subprocess.Popen[bytes], request: bytes) -> bytes:
    """The child's answer to a request: a whole line, or less if the child died."""
    assert child.stdin is not None and child.stdout is not None
    try:
        child.stdin.write(request)
        child.stdin.flush()
    except BrokenPipeError:
        return b""
    return child.stdout.readline()


def _close(stream: IO[bytes]) -> None:
    """Close a stream, even if a dead reader has left something in its buffer."""
    try:
        stream.close()
    except BrokenPipeError:
        return


class Pool:
    """A few workers of one kind, which threads borrow."""

    def __init__(self, size: int, make: Callable[[], Worker]) -> None:
        self._workers = [make() for _ in range(size)]
        self._idle: LifoQueue[Worker] = LifoQueue()
        for worker in self._workers:
            self._idle.put(worker)

    @contextmanager
    def borrow(self) -> Iterator[Worker]:
        """Lend a worker, the most recently used one first; waits if all are lent."""
        worker = self._idle.get()
        try:
            yield worker
        finally:
            self._idle.put(worker)

    def close(self) -> None:
        """End the processes of all workers."""
        for worker in self._workers:
            worker.close()
