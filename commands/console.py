"""Prints texts for people: lines of output, diagnostics and remarks; every command uses this.

Names of files, texts of sources and messages of other programs come from anywhere, and a terminal
obeys some characters instead of showing them. So commands print by the functions of this module,
which escape such characters, and data by ``terminal.print_output``.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ..support.frozen import frozen
from .answering import collector
from .terminal import wants_color

if TYPE_CHECKING:
    from click import ClickException

    from ..compiler.diagnostics.diagnostic import Diagnostic, Severity


@frozen
class Styled:
    """A piece of a line that is highlighted, if there are colours."""

    text: str
    color: str | None = None
    """One of click's names."""
    is_bold: bool = False


def say(*pieces: str | Styled) -> None:
    """Print a line to standard output, made of pieces of text that follow each other."""
    import click

    if (collected := collector()) is not None:
        collected.say("".join(p.text if isinstance(p, Styled) else p for p in pieces))
        return
    shown = map(_shown, pieces)
    click.echo("".join(shown), color=wants_color(sys.stdout))


def _shown(piece: str | Styled) -> str:
    import click

    from ..compiler.diagnostics.display import harmless

    if isinstance(piece, Styled):
        return click.style(harmless(piece.text), fg=piece.color, bold=piece.is_bold or None)
    return harmless(piece)


def say_finding(diagnostic: Diagnostic) -> None:
    """Print a diagnostic to standard output, without what its code means in general."""
    import click

    from ..compiler.diagnostics.render import render

    if (collected := collector()) is not None:
        collected.say(render(diagnostic, color=False, explain=False))
        return
    color = wants_color(sys.stdout)
    click.echo(render(diagnostic, color=color, explain=False), color=color)


def show(diagnostics: Iterable[Diagnostic]) -> None:
    """Print each diagnostic once to standard error, and the number of diagnostics."""
    if (collected := collector()) is not None:
        collected.diagnose(diagnostics)
        return
    print_rendered(rendered(diagnostics))


def print_rendered(text: str) -> None:
    """Print the result of ``rendered`` to standard error."""
    if text:
        import click  # Most compiles have nothing to say, and do without.

        click.echo(text, err=True, nl=False, color=True)


def rendered(diagnostics: Iterable[Diagnostic]) -> str:
    """The text that ``show`` prints; empty if there are no diagnostics."""
    found = distinct(diagnostics)
    if not found:
        return ""
    from ..compiler.diagnostics.render import render_all

    text = render_all(found, color=wants_color(sys.stderr))
    return f"{text}\n\n{_counted(found)}\n"


def distinct(diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Diagnostics without those that say the same of the same place as one before."""
    found = {(one.rule.code, one.message, str(one.span)): one for one in diagnostics}
    return tuple(found.values())


def show_misuse(error: ClickException) -> None:
    """Print click's message about a command line to standard error.

    The message quotes words, which may be names of files that a shell has filled in.
    """
    from io import StringIO

    import click

    from ..compiler.diagnostics.display import harmless_lines, harmless_message

    said = StringIO()
    error.show(said)
    shown, message = said.getvalue(), error.format_message()
    context = error.ctx if isinstance(error, click.UsageError) else None
    # If a command line has no words at all, the message is the help, which quotes nothing. Neither
    # does one about an option that is missing, and it has a line for each value.
    is_own = isinstance(error, click.MissingParameter)
    if not is_own and (context is None or message != context.get_help()):
        shown = shown.replace(message, harmless_message(message))
    click.echo(harmless_lines(shown), err=True, nl=False)


def remark(severity: Severity, text: str) -> None:
    """Print a message that belongs to no place in a file to standard error; any further lines of it
    are indented."""
    if (collected := collector()) is not None:
        collected.remark(severity, text)
        return
    import click

    from ..compiler.diagnostics.display import harmless_message
    from ..compiler.diagnostics.style import Style

    word = Style(wants_color(sys.stderr)).severity(severity, severity)
    click.echo(f"{word}: {harmless_message(text)}", err=True, color=True)


def _counted(diagnostics: Sequence[Diagnostic]) -> str:
    counts = Counter(found.severity for found in diagnostics)
    return ", ".join(f"{n} {word}{'s' if n > 1 else ''}" for word, n in counts.items())
