"""``burnish check``: reports the mistakes of a file, and writes nothing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from .console import show
from .options import file_argument, format_option, pass_option, rig_option, search_option
from .terminal import FAILED, print_output

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Diagnostic


@click.command()
@file_argument
@rig_option
@pass_option
@search_option
@format_option
def check(
    file: Path,
    rig: str | None,
    pass_: str | None,
    search_path: tuple[Path, ...],
    form: str,
) -> None:
    """Report what is wrong with FILE, and write nothing.

    Everything that FILE declares is checked, even if nothing uses it. Of the files that it imports,
    what it uses is checked. Without --rig, each material must be correct with one of FILE's rigs.

    The exit code is 1 if there are errors; warnings alone do not fail.

    \b
    Example:
        burnish check plastic.burnish
        burnish check plastic.burnish --format json
    """
    from ..api import entry_points as api

    found = api.check(file, rig=rig, pass_=pass_, search_path=search_path)
    if form == "json":
        print_output(_json(found))
    else:
        show(found)
    if any(diagnostic.severity == "error" for diagnostic in found):
        click.get_current_context().exit(FAILED)


def _json(diagnostics: Sequence[Diagnostic]) -> str:
    import json

    from ..compiler.diagnostics.serialise import serialise

    return json.dumps([serialise(diagnostic) for diagnostic in diagnostics], indent=2) + "\n"
