"""Calls the command line: within this process, which is fast, or as a shell does."""

from __future__ import annotations

import sys
from pathlib import Path
from subprocess import CompletedProcess

from click.testing import CliRunner, Result

from burnish.commands.group import burnish

from ..suite.processes import run

PLAIN = "material Plain { color = #ffffff }\n"


def invoke(*arguments: object) -> Result:
    """Run a command in this process; an exception that is not an exit is raised."""
    words = list(map(str, arguments))
    return CliRunner().invoke(burnish, words, catch_exceptions=False, prog_name="burnish")


def shell(*arguments: object, folder: Path) -> CompletedProcess[str]:
    """Run a command in a process of its own."""
    return run([sys.executable, "-m", "burnish", *map(str, arguments)], cwd=folder)


def tree(folder: Path) -> set[str]:
    """The paths of everything below a folder, hidden or not."""
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}
