"""Starts programs and threads for tests, and waits for them, but never without a limit.

Every test that starts something uses this module. If a test fails, or its time is up, all that it
started is ended, and so is what these programs have started in turn. ``test_waiting.py`` checks
that no other module of the tests waits on its own.
"""

from __future__ import annotations

import itertools
import os
import select
import signal
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from subprocess import DEVNULL, PIPE
from threading import Thread
from typing import IO, Any, Generic, TypeVar

LIMIT = 90.0
"""Seconds within which everything that tests wait for has to happen. It takes far less."""

MARK = "BURNISH_TEST_PROGRAM"
"""A variable in the environment of a program and of all that it starts, by which these are found
again; also those that have left its process group, as a browser does."""

T = TypeVar("T")
Stream = int | IO[Any] | None
"""A file, ``PIPE`` or ``DEVNULL``, or ``None`` for the tests' own."""
_NUMBERS = itertools.count()


class Program:
    """A program that is running."""

    def __init__(self, process: subprocess.Popen[bytes], mark: str) -> None:
        self._process = process
        self._mark = mark
        self.pid = process.pid

    def family(self) -> Mapping[int, str]:
        """The program and all that it has started, as far as they run: what ``/proc`` tells of
        their command lines and of the files that are mapped into their memory.
        """
        wanted = f"{MARK}={self._mark}\0".encode()
        found = {}
        for folder in Path("/proc").glob("[0-9]*"):
            with suppress(OSError):
                if wanted in (folder / "environ").read_bytes() + b"\0":
                    read = partial(Path.read_text, errors="backslashreplace")
                    texts = (read(folder / name) for name in ("cmdline", "maps"))
                    found[int(folder.name)] = "\n".join(texts)
        return found

    def write(self, data: bytes) -> None:
        """Write to its standard input."""
        assert self._process.stdin is not None
        self._process.stdin.write(data)

    def close_input(self) -> None:
        """Tell it that nothing more will be written."""
        assert self._process.stdin is not None
        self._process.stdin.close()

    def line(self, limit: float = LIMIT) -> bytes:
        """The next line of its standard output, or what it wrote before its output ended."""
        assert self._process.stdout is not None
        stream, end = self._process.stdout.fileno(), time.monotonic() + limit
        line = b""
        while not line.endswith(b"\n"):
            ready, _, _ = select.select([stream], [], [], max(0, end - time.monotonic()))
            assert ready, f"{self._process.args!r} wrote no line within {limit:g} s, only {line!r}"
            letter = os.read(stream, 1)
            if not letter:
                break
            line += letter
        return line

    def signal(self, number: signal.Signals, *, everybody: bool = False) -> None:
        """Send it a signal, or send it to its process group, as a terminal does."""
        (os.killpg if everybody else os.kill)(self.pid, number)

    def runs(self) -> bool:
        """True if the program has not ended yet."""
        return self._process.poll() is None

    def exit_code(self, limit: float = LIMIT) -> int:
        """The exit code of the program, after it has ended."""
        return self._process.wait(timeout=limit)

    def ended(self, data: bytes = b"", limit: float = LIMIT) -> subprocess.CompletedProcess[str]:
        """The whole output of the program, after it was given ``data`` to read and has ended."""
        with_input = data if self._process.stdin is not None else None
        written = self._process.communicate(with_input, timeout=limit)
        output, errors = ((part or b"").decode("utf-8", "surrogateescape") for part in written)
        code = self._process.returncode
        return subprocess.CompletedProcess(self._process.args, code, output, errors)

    def end(self) -> None:
        """Kill whatever is left of it and of all that it has started."""
        with suppress(ProcessLookupError):
            self.signal(signal.SIGKILL, everybody=True)
        until(self._kill_family, f"the end of {self._process.args!r}")
        self._process.wait(timeout=LIMIT)
        for stream in (self._process.stdin, self._process.stdout, self._process.stderr):
            if stream is not None:
                stream.close()

    def _kill_family(self) -> bool:
        family = self.family()
        for pid in family:
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        return not family


@contextmanager
def started(
    command: Sequence[str],
    *,
    cwd: Path | None = None,
    env: Mapping[str, str] | None = None,
    stdin: Stream = DEVNULL,
    stdout: Stream = PIPE,
    stderr: Stream = PIPE,
) -> Iterator[Program]:
    """Start a program; when the block is left, it and all that it has started are ended.

    The options are those of ``subprocess.Popen``. Its standard input is empty unless it is given
    one, and it has no terminal.
    """
    mark = f"{os.getpid()}-{next(_NUMBERS)}"
    process = subprocess.Popen(
        command, bufsize=0, cwd=cwd, env={**(os.environ if env is None else env), MARK: mark},
        stdin=stdin, stdout=stdout, stderr=stderr, start_new_session=True,
    )  # fmt: skip
    program = Program(process, mark)
    try:
        yield program
    finally:
        program.end()


def run(
    command: Sequence[str],
    *,
    text: str = "",
    check: bool = False,
    limit: float = LIMIT,
    cwd: Path | None = None,
    env: Mapping[str, str] | None = None,
    stdout: Stream = PIPE,
) -> subprocess.CompletedProcess[str]:
    """Run a program that reads ``text``, until its end. With ``check`` it has to succeed."""
    stdin = PIPE if text else DEVNULL
    with started(command, cwd=cwd, env=env, stdin=stdin, stdout=stdout) as program:
        done = program.ended(text.encode(), limit)
    assert not check or done.returncode == 0, f"{command} ended with {done}"
    return done


def until(
    condition: Callable[[], object], what: str, limit: float = LIMIT, pause: float = 0.02
) -> None:
    """Wait for something that has to happen soon; look again after each ``pause``."""
    end = time.monotonic() + limit
    while not condition():
        assert time.monotonic() < end, f"still waiting after {limit:g} s: {what}"
        time.sleep(pause)


class Background(Generic[T]):
    """A call that runs in a thread. The thread does not keep the process from ending."""

    def __init__(self, call: Callable[[], T]) -> None:
        self._call = call
        self._results: list[T] = []
        self._errors: list[BaseException] = []
        self._thread = Thread(target=self._work, daemon=True)
        self._thread.start()

    def returned(self, limit: float = LIMIT) -> T:
        """The result of the call; raises the call's exception."""
        self._thread.join(timeout=limit)
        assert not self._thread.is_alive(), f"{self._call} did not return within {limit:g} s"
        for error in self._errors:
            raise error
        (result,) = self._results
        return result

    def _work(self) -> None:
        try:
            self._results.append(self._call())
        except BaseException as error:
            self._errors.append(error)


def at_once(calls: Sequence[Callable[[], T]]) -> list[T]:
    """The results of several calls, each in a thread of its own, in the order of the calls."""
    running = [Background(call) for call in calls]
    return [each.returned() for each in running]
