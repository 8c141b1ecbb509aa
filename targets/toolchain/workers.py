"""Persistent child processes that answer packets: lines of JSON, and bytes behind them.

DXC and Tint run in them, since starting these takes long and they may crash. If a child dies or
hangs, only the current request fails: the next request starts a new child.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from queue import LifoQueue
from subprocess import PIPE
from threading import Event, Lock, Timer
from typing import IO, Any

from .children import Child
from .limits import COMPILERS, Limits, exhausted, in_words
from .pipe import Packet, receive, send
from .process import Ending, how_it_crashed

LOG_TAIL = 20_000
"""The bytes of a dead child's output that are kept."""

END_LIMIT = 10.0
"""The seconds that a child may go on after it has closed its output."""


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer to one request."""

    ending: Ending
    reply: Mapping[str, Any]
    """The child's answer; empty unless the ending is ``ended``."""
    log: str
    """The reason why there is no answer."""
    data: bytes = b""
    """The bytes that follow the child's answer."""


class Worker:
    """One child process, which the first request starts."""

    def __init__(
        self,
        command: Callable[[], Sequence[str]],
        limits: Limits = COMPILERS,
        *,
        tells_command: bool = True,
    ) -> None:
        """With ``tells_command``, the reason why there is no answer begins with the program: that
        of Burnish's own workers is always the interpreter, which says nothing."""
        self._find_command = command
        self._tells_command = tells_command
        self._limits = limits.scaled()
        self._command: Sequence[str] = ()
        self._child: Child | None = None
        self._errors: IO[bytes] | None = None
        self._closed = False
        self._lock = Lock()
        """Held while a request is answered, and while the child is ended."""

    def ask(self, request: Mapping[str, Any], time_limit: float, data: bytes = b"") -> Answer:
        """Send one request, with the bytes that follow it, and wait at most ``time_limit`` seconds
        for its answer."""
        with self._lock:
            return self._answer(Packet(request, data), time_limit)

    def restart(self) -> None:
        """End the child process, if there is one: the next request starts another."""
        with self._lock:
            self._bury()

    def close(self) -> None:
        """End the child process, if there is one; a request that it works on gets no answer."""
        self._closed = True
        if child := self._child:
            child.kill()
        with self._lock:
            self._bury()

    def _answer(self, request: Packet, time_limit: float) -> Answer:
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
            reply = self._exchange(child, request)
        finally:
            timer.cancel()
        if timed_out.is_set():
            return self._post_mortem("timeout", f"no answer within {time_limit:g} s")
        if isinstance(reply, str):
            return self._post_mortem("crashed", reply)
        return Answer("ended", reply.content, "", reply.data)

    def _exchange(self, child: Child, request: Packet) -> Packet | str:
        """The child's answer to a request; or the reason why there is none, empty if the child has
        ended."""
        stdin, stdout = child.process.stdin, child.process.stdout
        assert stdin is not None and stdout is not None
        try:
            send(request, stdin)
            return receive(stdout, self._limits.output)
        except (BrokenPipeError, EOFError):
            return ""
        except OverflowError:
            return f"stopped, after an answer of more than {in_words(self._limits.output)}"
        except ValueError:
            return "stopped, after an answer that is no JSON"

    def _start(self) -> Child:
        self._command = self._find_command()
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed in _bury
        self._child = Child(self._command, self._limits, stdin=PIPE, stderr=self._errors)
        if self._closed:  # `close` came too early to end this child.
            self._child.kill()
        return self._child

    def _post_mortem(self, ending: Ending, reason: str) -> Answer:
        """The reason why there is no answer; by default, the way in which the child has ended."""
        assert self._child is not None and self._errors is not None
        if reason:
            self._child.kill()
        try:
            code = self._child.process.wait(END_LIMIT)
        except subprocess.TimeoutExpired:
            self._child.kill()
            code = self._child.process.wait()
        size = self._errors.seek(0, os.SEEK_END)
        self._errors.seek(max(0, size - LOG_TAIL))
        said = self._errors.read().decode(errors="replace")
        if size >= self._limits.file:
            reason = f"stopped, after messages of more than {in_words(self._limits.file)}"
        self._bury()
        if not reason and (lacking := exhausted(said, self._limits)):
            return Answer(ending, {}, f"{lacking}\n")
        told = reason or how_it_crashed(code)
        if self._tells_command:
            told = f"{self._command[0]}: {told}"
        return Answer(ending, {}, f"{said}{told}\n")

    def _bury(self) -> None:
        if self._child is not None:
            self._child.bury()
        if self._errors is not None:
            self._errors.close()
        self._child = self._errors = None


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
