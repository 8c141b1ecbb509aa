"""Decides whether a stream gets colours, and writes out characters that it cannot show.

Nothing here imports click, because it is also used before click is loaded.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import IO, Any

FAILED = 1
"""The exit code for errors in the input."""
INTERRUPTED = 130
"""The exit code that shells expect of a program that Ctrl-C ended."""


def wants_color(stream: IO[Any] | None) -> bool:
    """Whether to use colours: on a terminal, unless its user has set ``NO_COLOR``.

    ``None`` is a stream that was closed before the program began.
    """
    return stream is not None and stream.isatty() and not os.environ.get("NO_COLOR")


def show_everything() -> None:
    """Have characters that a terminal cannot show written out, as in ``\\u2192``."""
    from io import TextIOWrapper

    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def show_nothing() -> None:
    """Drop what is left of the output: its reader has left, and Python would complain at its end.

    The stream itself has to stay usable, as Python writes out what it still holds.
    """
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            os.dup2(nowhere, stream.fileno())
