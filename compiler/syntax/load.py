"""Reads source files, with a diagnostic for everything that can be wrong with one."""

from __future__ import annotations

import codecs
import errno
import os
import re
import stat
from collections.abc import Callable
from pathlib import Path

from ..diagnostics import rules
from ..diagnostics.diagnostic import Report
from ..diagnostics.file_names import readable, why_unreadable
from ..diagnostics.nearest import nearest
from ..diagnostics.source import Source, Span

SIZE_LIMIT = 1024 * 1024
"""Bytes of one file. The library's longest one has 18 000; to check a million takes seconds."""
TOTAL_LIMIT = 4 * SIZE_LIMIT
"""Bytes of a file with all that it imports."""
PATIENCE = 10
"""The seconds to wait for data from a pipe, which may be nothing for ever."""


def load_source(
    path: str | os.PathLike[str],
    report: Report,
    name: str = "",
    span: Span | None = None,
    seen: Callable[[bytes], None] | None = None,
) -> Source | None:
    """The text of the file at ``path``; None if it cannot be read, and then ``report`` says why.

    ``name`` is the one in messages; by default the path as given. ``span`` is the text that asks
    for the file. ``seen`` is called with the bytes that were read.
    """
    name = readable(name or os.fspath(path))
    content = _content(path, name, span, report)
    if content is None:
        return None
    if seen is not None:
        seen(content)
    return decoded(content, name, report, span)


def decoded(content: bytes, name: str, report: Report, span: Span | None) -> Source | None:
    """The text of a file that has been read; ``None`` if it is no text, which ``report`` says."""
    if b"\0" in content:
        encoded = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
        reason = "it is UTF-16" if encoded else "it contains NUL bytes"
        report.add(rules.NOT_TEXT, span, path=name, reason=reason)
        return None
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        reason = f"byte {error.start} is {content[error.start]:#04x}"
        report.add(rules.NOT_TEXT, span, path=name, reason=reason)
        return None
    return Source(name, re.sub(r"\r(?!\n)", "\n", text))


def check_text(text: str, name: str, report: Report) -> bool:
    """True if a string consists of characters, and not of too many.

    Otherwise ``report`` gets the error.
    """
    if len(text) > SIZE_LIMIT:
        report.add(rules.TOO_LARGE, None, path=name, limit=f"{SIZE_LIMIT} characters")
        return False
    if text.isascii():
        return True
    lone = re.search("[\\ud800-\\udfff]", text)
    if lone is not None:
        reason = f"character {lone.start()} is the lone surrogate U+{ord(lone[0]):04X}"
        report.add(rules.NOT_TEXT, None, path=name, reason=reason)
    return lone is None


def _content(
    path: str | os.PathLike[str], name: str, span: Span | None, report: Report
) -> bytes | None:
    try:
        with open(path, "rb", opener=_without_waiting) as file:
            is_file = stat.S_ISREG(os.fstat(file.fileno()).st_mode)
            content = file.read(SIZE_LIMIT + 1) if is_file else _streamed(file.fileno())
    except FileNotFoundError:
        report.add(rules.MISSING_FILE, span, path=name, hint=_similar(Path(path)))
    except IsADirectoryError:
        report.add(rules.NOT_A_FILE, span, path=name)
    except (OSError, ValueError) as error:
        report.add(rules.UNREADABLE_FILE, span, path=name, reason=why_unreadable(error))
    else:
        if len(content) <= SIZE_LIMIT:
            return content
        report.add(rules.TOO_LARGE, span, path=name, limit=f"{SIZE_LIMIT} bytes")
    return None


def _without_waiting(path: str, flags: int) -> int:
    """Open a file; a pipe is opened even if nobody writes into it yet."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _streamed(file: int) -> bytes:
    """The bytes from a pipe or a device, up to a byte more than there may be.

    Raises ``TimeoutError`` if nothing comes for long.
    """
    from select import POLLIN, poll

    waiting = poll()
    waiting.register(file, POLLIN)
    content = bytearray()
    while len(content) <= SIZE_LIMIT:
        if not waiting.poll(PATIENCE * 1000):
            reason = f"nothing has come out of it for {PATIENCE} seconds"
            raise TimeoutError(errno.ETIMEDOUT, reason)
        chunk = os.read(file, 1 << 16)
        if not chunk:
            break
        content += chunk
    return bytes(content)


def _similar(path: Path) -> str:
    """A hint to use the file in the same folder whose name is most similar."""
    if not path.parent.is_dir():
        return ""
    files = {file.stem: file for file in path.parent.glob("*.burnish")}
    stem = path.stem if path.stem in files else nearest(path.stem, files)
    return f"did you mean `{files[stem]}`?" if stem is not None else ""
