"""The group of all commands, as click runs it; ``cli.py`` calls it.

Starting fast is a feature, so nothing here loads the compiler.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import Any

import click

from .. import __version__
from .answering import answer, collector, drop
from .terminal import FAILED, INTERRUPTED, complain, interrupted, show_everything

COMMANDS = (
    "compile",
    "build",
    "check",
    "graph",
    "import",
    "export",
    "bind",
    "render",
    "view",
    "conform",
    "same",
    "judge",
    "gallery",
    "corpus",
    "targets",
    "doctor",
    "docs",
    "example",
    "integration",
    "new",
    "explain",
    "schema",
)
"""The commands; each has the name of its module. Only the requested one is loaded; for an unknown
name, all are, because click suggests a command from those it knows."""
FUNCTIONS = {"compile": "compile_", "import": "import_"}
"""The functions of commands whose names mean something else in Python."""
MODULES = {"import": "import_document", "judge": "judge_picture"}
"""The modules of commands whose names other modules have, or are words of Python."""


class _QuietGroup(click.Group):
    """Ends on Ctrl-C without a message, and with one if standard output cannot take any more."""

    def main(self, *arguments: Any, **options: Any) -> Any:
        r"""Run a command line. Characters that a terminal cannot show are escaped: `\u2192`."""
        try:
            show_everything()
            code = self._ended(*arguments, **options)
            if collector() is not None:
                answer(code)
        except OSError as error:
            drop()
            place = "" if error.filename is None else f"`{error.filename}`: "
            complain(f"error: {place}{error.strerror or error}")
            code = FAILED
        sys.exit(code)

    def _ended(self, *arguments: Any, **options: Any) -> int:
        """Run a command line; returns its exit code, after reporting misuse."""
        try:
            return super().main(*arguments, **{**options, "standalone_mode": False}) or 0
        except click.ClickException as error:
            drop()
            from .console import show_misuse

            show_misuse(error)
            return error.exit_code
        except click.Abort:
            drop()
            return INTERRUPTED
        except BaseException:
            drop()
            raise

    def list_commands(self, _context: click.Context) -> list[str]:
        """The names of the commands, as the help lists them."""
        return sorted(COMMANDS)

    def get_command(self, _context: click.Context, name: str) -> click.Command | None:
        """The command of that name, if there is one. Else click suggests one of ``commands``."""
        for wanted in (name,) if name in COMMANDS else COMMANDS:
            module = import_module(f".{MODULES.get(wanted, wanted)}", __package__)
            self.commands[wanted] = getattr(module, FUNCTIONS.get(wanted, wanted))
        return self.commands.get(name)

    def resolve_command(self, context: click.Context, args: list[str]) -> Any:
        """The named command; if a material comes first, the user probably wants to compile it."""
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
            drop()
            context.exit(interrupted())


@click.group(cls=_QuietGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="burnish")
def burnish() -> None:
    """Compile shader graphs: one material in, HLSL, GLSL and WGSL out, all meaning the same.

    \b
    Example:
        burnish compile plastic.burnish -o build/
        burnish compile --help

    Results are kept in a cache folder, named by BURNISH_CACHE, and used again as long as nothing
    that they depend on has changed.
    """
