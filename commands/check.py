"""``burnish check``: reports the mistakes of files, and writes nothing."""

from __future__ import annotations

from pathlib import Path

import click

from .message_forms import tell
from .options import files_argument, messages_option, pass_option, rig_option, search_option
from .terminal import FAILED


@click.command()
@files_argument
@rig_option
@pass_option
@search_option
@messages_option
def check(
    files: tuple[Path, ...],
    rig: str | None,
    pass_: str | None,
    search_path: tuple[Path, ...],
    form: str,
) -> None:
    """Report what is wrong with each FILE, and write nothing.

    Everything that a FILE declares is checked, even if nothing uses it. Of the files that it
    imports, what it uses is checked. Without --rig, each material must be correct with one of the
    FILE's rigs.

    The exit code is 1 if there are errors; warnings alone do not fail.

    \b
    Example:
        burnish check plastic.burnish
        burnish check materials/*.burnish --format line
        burnish check plastic.burnish --format json
    """
    from ..api import entry_points as api

    found = [
        diagnostic
        for file in files
        for diagnostic in api.check(file, rig=rig, pass_=pass_, search_path=search_path)
    ]
    if not tell(form, "check", found):
        click.get_current_context().exit(FAILED)
