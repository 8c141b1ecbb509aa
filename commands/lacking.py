"""Reports which routes cannot draw on this machine, for the commands that draw."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from .console import remark
from .terminal import FAILED

if TYPE_CHECKING:
    from ..targets.runner.routes import Route
    from ..targets.runner.runner import Runner


def tell_lacking_tools(routes: Sequence[Route], runner: Runner, *, fatal: bool) -> None:
    """Report routes that cannot draw on this machine, and why; if ``fatal``, end the command."""
    lacking: dict[str, list[str]] = {}
    for route in routes:
        if problem := runner.problem(route):
            lacking.setdefault(problem, []).append(route.name)
    for problem, names in lacking.items():
        remark("error" if fatal else "note", f"nothing is drawn by {', '.join(names)}: {problem}")
    if lacking and fatal:
        click.get_current_context().exit(FAILED)
