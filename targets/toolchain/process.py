"""Runs one external program with limits, and reports how it ended."""

from __future__ import annotations

import os
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from threading import Thread
from typing import IO, Literal

from .children import Child, Family
from .limits import COMPILERS, Limits, exhausted, in_words

Ending = Literal["ended", "crashed", "timeout"]

RUST_PANIC = 101
"""The exit code of a Rust program that panicked. No other tool here uses it."""
BY_SIGNAL = 128
"""The number above which an exit code means that a signal killed the program's child, as of
clang."""
PART = 1 << 16
"""The number of bytes that are read at once from a program's output."""
SPARE = 5
"""The seconds of processor time that a program may have beyond its time limit."""
END_LIMIT = 10.0
"""The seconds to wait for the end of a pipe whose program was killed."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """The end of a program, and its output."""

    ending: Ending
    code: int
    """The exit code: negative for a signal, 0 if the program never ended by itself."""
    output: bytes
    """The program's standard output."""
    log: str
    """The program's standard output, followed by its standard error, as text."""


def run(
    arguments: Sequence[str],
    *,
    time_limit: float,
    stdin: bytes = b"",
    folder: Path | None = None,
    limits: Limits = COMPILERS,
    family: Family | None = None,
) -> Outcome:
    """Run a program to its end, or kill it after ``time_limit`` seconds.

    A program that cannot be started counts as crashed: the tool is broken, not the shader.
    ``folder`` is a private one; without it, the program runs where nothing is. The owner of the
    ``family`` may end the program meanwhile, from another thread.
    """
    name = arguments[0]
    seconds = int(time_limit) + SPARE
    try:
        with _input(stdin) as file:
            child = Child(arguments, limits, stdin=file, folder=folder, seconds=seconds, group=True)
    except OSError as error:
        return Outcome("crashed", 0, b"", f"{name}: could not be started: {error}")
    family = family or Family()
    family.adopt(child)
    try:
        return _outcome(name, child, limits, time_limit)
    finally:
        child.bury()
        family.dismiss(child)


@contextmanager
def _input(data: bytes) -> Iterator[int | IO[bytes]]:
    """The standard input of a program: a file, so that nobody has to wait until it is read."""
    if not data:
        yield subprocess.DEVNULL
        return
    with tempfile.TemporaryFile() as file:
        file.write(data)
        file.seek(0)
        yield file


def _outcome(name: str, child: Child, limits: Limits, time_limit: float) -> Outcome:
    """Read a program's output until it ends, its time is up, or the output is too long."""
    deadline = time.monotonic() + time_limit
    readers = [_Reader(child, stream, limits.output) for stream in _outputs(child)]
    for reader in readers:
        reader.join(max(0.0, deadline - time.monotonic()))
    code = _exit_code(child, deadline)
    child.kill()
    for reader in readers:
        reader.join(END_LIMIT)
    output = bytes(readers[0].read)
    log = (output + readers[1].read).decode(errors="replace")
    if any(reader.was_too_much for reader in readers):
        reason = f"stopped, after it had written more than {in_words(limits.output)}"
        return Outcome("crashed", 0, b"", f"{name}: {reason}\n")
    if code is None:
        return Outcome("timeout", 0, b"", f"{name}: no answer within {time_limit:g} s")
    if crashed(code):
        reason = exhausted(log, limits) or f"{log}{name}: {how_it_crashed(code)}"
        return Outcome("crashed", code, output, f"{reason}\n")
    return Outcome("ended", code, output, log)


def _outputs(child: Child) -> tuple[IO[bytes], IO[bytes]]:
    out, errors = child.process.stdout, child.process.stderr
    assert out is not None and errors is not None
    return out, errors


def _exit_code(child: Child, deadline: float) -> int | None:
    """The exit code; ``None`` if the time is up."""
    try:
        return child.process.wait(max(0.0, deadline - time.monotonic()))
    except subprocess.TimeoutExpired:
        return None


class _Reader(Thread):
    """Reads one of a program's outputs, and kills the program if the output is too long."""

    def __init__(self, child: Child, stream: IO[bytes], most: int) -> None:
        super().__init__(daemon=True)
        self.read = bytearray()
        self.was_too_much = False
        self._child, self._stream, self._most = child, stream, most
        self.start()

    def run(self) -> None:
        while part := os.read(self._stream.fileno(), PART):
            self.read += part
            if len(self.read) > self._most:
                self.was_too_much = True
                self._child.kill()
                return


def crashed(code: int) -> bool:
    """True if an exit code means that the program crashed instead of answering."""
    return code < 0 or code == RUST_PANIC or code > BY_SIGNAL


def how_it_crashed(code: int) -> str:
    """An exit code in words; negative ones are signals."""
    if code >= 0:
        return f"ended with exit code {code}"
    name = signal.strsignal(-code)
    return f"killed by signal {-code}{f' ({name})' if name else ''}"
