"""Printing diagnostics and remarks to people; every command uses this."""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import IO, TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Diagnostic, Severity

FAILED = 1
"""The exit code for errors in the input."""


def wants_color(stream: IO[Any] | None) -> bool:
    """Whether to use colours: on a terminal, unless its user has set ``NO_COLOR``.

    ``None`` is a stream that was closed before the program began.
    """
    return stream is not None and stream.isatty() and not os.environ.get("NO_COLOR")


def show(diagnostics: Iterable[Diagnostic]) -> None:
    """Print each diagnostic once to standard error, and how many there were."""
    found = tuple(
        {(one.rule.code, one.message, str(one.span)): one for one in diagnostics}.values()
    )
    if not found:
        return
    from ..compiler.diagnostics.render import render_all

    text = render_all(found, color=wants_color(sys.stderr))
    click.echo(f"{text}\n\n{_counted(found)}", err=True, color=True)


def remark(severity: Severity, text: str) -> None:
    """Print a message that belongs to no place in a file to standard error."""
    from ..compiler.diagnostics.display import harmless
    from ..compiler.diagnostics.style import Style

    word = Style(wants_color(sys.stderr)).severity(severity, severity)
    lines = map(harmless, text.splitlines())
    click.echo(f"{word}: " + "\n".join(lines), err=True, color=True)


def _counted(diagnostics: Sequence[Diagnostic]) -> str:
    counts = Counter(found.severity for found in diagnostics)
    return ", ".join(f"{n} {word}{'s' if n > 1 else ''}" for word, n in counts.items())
