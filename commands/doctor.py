"""``burnish doctor``: which of the external tools are there."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from .console import FAILED, wants_color

if TYPE_CHECKING:
    from ..targets.toolchain.tools import ToolState


@click.command()
def doctor() -> None:
    """Look for the tools that `--validate` and the tests use.

    Compiling needs none of them. For each that is missing the command that installs it is shown;
    the exit code is 1 if one is.

    \b
    Example:
        burnish doctor
        burnish compile plastic.burnish --validate -o build/
    """
    from concurrent.futures import ThreadPoolExecutor

    from ..targets.toolchain.tools import TOOLS, inspect

    with ThreadPoolExecutor() as threads:
        states = list(threads.map(inspect, TOOLS))
    color = wants_color(sys.stdout)
    for state in states:
        click.echo(_described(state), color=color)
    if any(state.problem for state in states):
        click.get_current_context().exit(FAILED)


def _described(state: ToolState) -> str:
    tool = state.tool
    if state.problem is None:
        mark = click.style("ok     ", fg="green")
        return f"{mark}  {tool.name:<11}  {state.version:<8}  {state.paths[0]}"
    what = "unusable" if state.paths else "missing"
    mark = click.style(f"{what:<7}", fg="red")
    return f"{mark}  {tool.name:<11}  {tool.purpose}\n         install it with: {tool.install}"
