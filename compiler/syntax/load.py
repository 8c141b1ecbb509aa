"""Reads source files, with a diagnostic for everything that can be wrong with one."""

from __future__ import annotations

import codecs
import os
import re
from collections.abc import Callable
from pathlib import Path

from ..diagnostics import rules
from ..diagnostics.diagnostic import Report
from ..diagnostics.nearest import nearest
from ..diagnostics.source import Source

SIZE_LIMIT = 16 * 1024 * 1024


def load_source(
    path: str | os.PathLike[str],
    report: Report,
    name: str = "",
    seen: Callable[[bytes], None] | None = None,
) -> Source | None:
    """The text of the file at ``path``; None if it cannot be read, and then ``report`` says why.

    ``name`` is what messages call it; by default the path as given. ``seen`` is called with the
    bytes that were read.
    """
    name = name or os.fspath(path)
    content = _content(path, name, report)
    if content is None:
        return None
    if seen is not None:
        seen(content)
    if b"\0" in content:
        encoded = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
        reason = "it is UTF-16" if encoded else "it contains NUL bytes"
        report.add(rules.NOT_TEXT, None, path=name, reason=reason)
        return None
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        reason = f"byte {error.start} is {content[error.start]:#04x}"
        report.add(rules.NOT_TEXT, None, path=name, reason=reason)
        return None
    return Source(name, re.sub(r"\r(?!\n)", "\n", text))


def _content(path: str | os.PathLike[str], name: str, report: Report) -> bytes | None:
    try:
        with open(path, "rb") as file:  # noqa: PTH123
            content = file.read(SIZE_LIMIT + 1)
    except FileNotFoundError:
        report.add(rules.MISSING_FILE, None, path=name, hint=_similar(Path(path)))
    except IsADirectoryError:
        report.add(rules.NOT_A_FILE, None, path=name)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        report.add(rules.UNREADABLE_FILE, None, path=name, reason=reason)
    else:
        if len(content) <= SIZE_LIMIT:
            return content
        report.add(rules.TOO_LARGE, None, path=name, limit=f"{SIZE_LIMIT} bytes")
    return None


def _similar(path: Path) -> str:
    """A hint to use the file in the same folder whose name is most similar."""
    if not path.parent.is_dir():
        return ""
    files = {file.stem: file for file in path.parent.glob("*.burnish")}
    stem = path.stem if path.stem in files else nearest(path.stem, files)
    return f"did you mean `{files[stem]}`?" if stem is not None else ""
