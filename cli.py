"""The command line: ``burnish COMMAND``, one file in ``commands`` for each command.

Exit codes: 0 all is well, 1 the input has errors, 2 the command line itself makes no sense, 130
interrupted. Starting fast is a feature, so nothing here loads the compiler.
"""

from __future__ import annotations

import sys
from io import TextIOWrapper
from typing import Any

import click

from . import __version__
from .commands.check import check
from .commands.compile import compile_
from .commands.conform import conform
from .commands.console import FAILED
from .commands.doctor import doctor
from .commands.explain import explain
from .commands.graph import graph
from .commands.render import render
from .commands.targets import targets

INTERRUPTED = 130
"""What shells expect of a program that Ctrl-C ended."""


class _QuietGroup(click.Group):
    """Ends on Ctrl-C without a word, and with one where standard output cannot take any more."""

    def main(self, *arguments: Any, **options: Any) -> Any:
        """Run a command line. What a terminal cannot show is written out: `\\u2192`."""
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, TextIOWrapper):
                stream.reconfigure(errors="backslashreplace")
        return super().main(*arguments, **options)

    def resolve_command(self, context: click.Context, args: list[str]) -> Any:
        """The command that is named; a material alone is likely to be compiled."""
        try:
            return super().resolve_command(context, args)
        except click.UsageError as error:
            if not args[0].endswith(".burnish"):
                raise
            likely = f"Did you mean 'burnish compile {args[0]} -o FOLDER'?"
            raise click.UsageError(f"{error.message} {likely}", context) from error

    def invoke(self, context: click.Context) -> Any:
        try:
            return super().invoke(context)
        except KeyboardInterrupt:
            context.exit(INTERRUPTED)
        except BrokenPipeError:
            raise  # A reader that has left, as `head` does; click knows what to do.
        except OSError as error:
            place = "" if error.filename is None else f"`{error.filename}`: "
            click.echo(f"error: {place}{error.strerror or error}", err=True)
            context.exit(FAILED)


@click.group(cls=_QuietGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="burnish")
def main() -> None:
    """Compile shader graphs: one material in, HLSL, GLSL and WGSL out, all meaning the same.

    \b
    Example:
        burnish compile plastic.burnish -o build/
        burnish compile --help
    """


for _command in (compile_, check, graph, render, conform, targets, doctor, explain):
    main.add_command(_command)
