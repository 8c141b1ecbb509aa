"""Writes the one text of a command to the file, or the standard output, that ``-o`` names."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import click

from .terminal import print_output

STDOUT = "-"


def insist_on_another_file(file: Path, output: str) -> None:
    """Raise ``BadParameter`` if the output would overwrite the file that is read."""
    with suppress(OSError):
        if output != STDOUT and file.samefile(output):
            raise click.BadParameter("it is FILE itself", param_hint="--output")


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
