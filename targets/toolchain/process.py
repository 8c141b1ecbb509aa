"""Runs one external program with a time limit, and reports how it ended."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

Ending = Literal["ended", "crashed", "timeout"]

RUST_PANIC = 101
"""The exit code of a Rust program that panicked. No other tool here uses it."""

QUIET = {"NO_COLOR": "1", "RUST_BACKTRACE": "0", "LC_ALL": "C.UTF-8"}


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a program ended and what it wrote."""

    ending: Ending
    code: int
    """The exit code: negative for a signal, 0 if the program never ended by itself."""
    output: bytes
    """Its standard output."""
    log: str
    """Its standard output, followed by its standard error, as text."""


def run(
    arguments: Sequence[str],
    *,
    time_limit: float,
    stdin: bytes = b"",
    folder: Path | None = None,
) -> Outcome:
    """Run a program to its end, or kill it after ``time_limit`` seconds.

    A program that cannot be started counts as crashed: the tool is broken, not the shader.
    """
    try:
        ended = subprocess.run(
            arguments,
            input=stdin,
            capture_output=True,
            cwd=folder,
            timeout=time_limit,
            check=False,
            env=os.environ | QUIET,
        )
    except subprocess.TimeoutExpired:
        return Outcome("timeout", 0, b"", f"{arguments[0]}: no answer within {time_limit:g} s")
    except OSError as error:
        return Outcome("crashed", 0, b"", f"{arguments[0]}: could not be started: {error}")
    log = (ended.stdout + ended.stderr).decode(errors="replace")
    if crashed(ended.returncode):
        log += f"{arguments[0]}: {how_it_crashed(ended.returncode)}\n"
        return Outcome("crashed", ended.returncode, ended.stdout, log)
    return Outcome("ended", ended.returncode, ended.stdout, log)


def crashed(code: int) -> bool:
    """Whether an exit code means that the program crashed instead of answering."""
    return code < 0 or code == RUST_PANIC


def how_it_crashed(code: int) -> str:
    """An exit code in words; negative ones are signals."""
    if code >= 0:
        return f"ended with exit code {code}"
    name = signal.strsignal(-code)
    return f"killed by signal {-code}{f' ({name})' if name else ''}"
