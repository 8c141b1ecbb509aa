"""Decides if a stream gets colours, and escapes characters that it cannot show or would obey.

Nothing here imports click, because it is also used before click is loaded.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import IO, Any, NoReturn

FAILED = 1
"""The exit code for errors in the input."""
BY_SIGNAL = 128
"""The exit code, plus the signal's number, that shells expect of a program that a signal has
ended."""
INTERRUPTED = BY_SIGNAL + 2
"""The exit code after Ctrl-C."""
_asked: list[int] = []
"""The signals that have asked the process to end; empty after Ctrl-C."""


def wants_color(stream: IO[Any] | None) -> bool:
    """True if colours are to be used: on a terminal, unless its user has set ``NO_COLOR``.

    ``None`` is a stream that was closed before the program began.
    """
    return stream is not None and stream.isatty() and not os.environ.get("NO_COLOR")


def asked_to_end(number: int, _frame: object) -> NoReturn:
    """Treat a signal like Ctrl-C."""
    remember_signal(number)
    raise KeyboardInterrupt


def remember_signal(number: int) -> None:
    """Let the exit code say that this signal has ended the process, unless another came before."""
    _asked.append(number)


def interrupted() -> int:
    """The exit code after a ``KeyboardInterrupt``.

    Some libraries raise another exception in its place, so the exception itself cannot tell its
    cause.
    """
    return BY_SIGNAL + _asked[0] if _asked else INTERRUPTED


def show_everything() -> None:
    r"""Let characters that a terminal cannot show be escaped, as in ``\u2192``."""
    from io import TextIOWrapper

    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def print_output(text: str) -> None:
    """Write data to standard output, such as a shader or JSON, in UTF-8 whatever the encoding is.

    A file or a pipe gets every byte. A terminal would obey control characters, which names and
    comments may contain, so they are escaped for it. Texts for people only are printed by
    ``console.say``.
    """
    if sys.stdout is None:
        return
    if sys.stdout.isatty():
        from ..compiler.diagnostics.display import harmless_lines

        text = harmless_lines(text)
    sys.stdout.flush()
    sys.stdout.buffer.write(text.encode("utf-8", "surrogateescape"))
    sys.stdout.flush()


def flushed(code: int) -> int:
    """Flush the streams before Python does, which would show a traceback.

    Returns the exit code, which is ``code`` if there was nothing to complain about.
    """
    for stream in (sys.stdout, sys.stderr):
        try:
            if stream is not None:
                stream.flush()
        except OSError as error:
            _drop(stream)
            if not code and not isinstance(error, BrokenPipeError):
                complain(f"error: cannot write to standard output: {error.strerror}")
            code = code or FAILED
    return code


def _drop(stream: IO[Any]) -> None:
    """Discard the rest of the output. Python still flushes its buffers."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def complain(message: str) -> None:
    """Print a message to standard error, if that is possible."""
    from ..compiler.diagnostics.display import harmless_message

    try:
        print(harmless_message(message), file=sys.stderr)
    except OSError:
        return  # Nobody can be told.
