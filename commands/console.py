"""What all commands share about talking to people."""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Sequence
from typing import IO, TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Diagnostic

FAILED = 1
"""Exit code for errors in the input."""


def wants_color(stream: IO[Any]) -> bool:
    """Whether colours make sense there: on a terminal whose user did not set ``NO_COLOR``."""
    return stream.isatty() and not os.environ.get("NO_COLOR")


def show(diagnostics: Sequence[Diagnostic]) -> None:
    """Print diagnostics to standard error, and how many there were."""
    if not diagnostics:
        return
    from ..compiler.diagnostics.render import render_all

    text = render_all(diagnostics, color=wants_color(sys.stderr))
    click.echo(f"{text}\n\n{_counted(diagnostics)}", err=True, color=True)


def _counted(diagnostics: Sequence[Diagnostic]) -> str:
    counts = Counter(found.severity for found in diagnostics)
    return ", ".join(f"{n} {word}{'s' if n > 1 else ''}" for word, n in counts.items())
