"""Writes the one text of a command to the file, or the standard output, that ``-o`` names."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import click

from .terminal import print_output

STDOUT = "-"
_HEAD = 4096
"""The bytes at the start of a file in which the command that has written it names itself."""


def insist_on_another_file(file: Path, output: str) -> None:
    """Raise ``BadParameter`` if the output would overwrite the file that is read."""
    with suppress(OSError):
        if output != STDOUT and file.samefile(output):
            raise click.BadParameter("it is FILE itself", param_hint="--output")


def insist_on_own(output: str, mark: str, command: str) -> None:
    """Raise ``CompileError`` if a file is in the way that the command has not written.

    ``mark`` stands in the first lines of all that it writes. An empty file is in nobody's way.
    """
    path = Path(output)
    if output == STDOUT or not path.is_file():
        return
    with path.open("rb") as file:
        head = file.read(_HEAD)
    if head and mark.encode() not in head:
        from ..compiler.diagnostics import rules
        from ..compiler.diagnostics.diagnostic import CompileError, Report

        report = Report()
        report.add(
            rules.FOREIGN_OUTPUT, None, path=path,
            reason=f"`{command}` has not written it",
            hint="Nothing was written. Choose another file, or delete this one first.",
        )  # fmt: skip
        raise CompileError(report.diagnostics)


def deliver(output: str, text: str) -> None:
    """Print a text, or write it whole. Raises ``CompileError`` if the file cannot be written."""
    if output == STDOUT:
        print_output(text)
        return
    from .output import unwritable, write_file

    path = Path(output)
    try:
        write_file(path, text.encode())
    except OSError as error:
        raise unwritable(path, error.strerror or str(error)) from error
