"""Prints diagnostics and remarks for people; every command uses this."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from .terminal import wants_color

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Diagnostic, Severity


def show(diagnostics: Iterable[Diagnostic]) -> None:
    """Print each diagnostic once to standard error, and how many there were."""
    print_rendered(rendered(diagnostics))


def print_rendered(text: str) -> None:
    """Print what ``rendered`` has given to standard error."""
    if text:
        import click  # Most compiles have nothing to say, and do without.

        click.echo(text, err=True, nl=False, color=True)


def rendered(diagnostics: Iterable[Diagnostic]) -> str:
    """What ``show`` prints: empty where there is nothing to say."""
    found = tuple(
        {(one.rule.code, one.message, str(one.span)): one for one in diagnostics}.values()
    )
    if not found:
        return ""
    from ..compiler.diagnostics.render import render_all

    text = render_all(found, color=wants_color(sys.stderr))
    return f"{text}\n\n{_counted(found)}\n"


def remark(severity: Severity, text: str) -> None:
    """Print a message that belongs to no place in a file to standard error."""
    import click

    from ..compiler.diagnostics.display import harmless
    from ..compiler.diagnostics.style import Style

    word = Style(wants_color(sys.stderr)).severity(severity, severity)
    lines = map(harmless, text.splitlines())
    click.echo(f"{word}: " + "\n".join(lines), err=True, color=True)


def _counted(diagnostics: Sequence[Diagnostic]) -> str:
    counts = Counter(found.severity for found in diagnostics)
    return ", ".join(f"{n} {word}{'s' if n > 1 else ''}" for word, n in counts.items())
