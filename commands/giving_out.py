"""Writes files beside those that a user has, and never over other contents.

``burnish example`` and ``burnish import`` give files out with it: all that are new, or none.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

import click

from .console import say, show
from .failures import fail
from .terminal import FAILED


def give_out(
    folder: Path, contents: Mapping[str, bytes], refusal: str, advice: str, replace: bool = False
) -> None:
    """Write each content under its path in a folder, and say so; what is there already stays.

    If a file has other contents, the command ends with ``refusal``, which says so of its path,
    and ``advice``, unless ``replace`` is true.
    """
    from ..compiler.diagnostics.diagnostic import CompileError
    from .output import write_tree

    new = {}
    for path, content in contents.items():
        place = folder / path
        if _has(place, content):
            continue
        if os.path.lexists(place) and not replace:
            fail(f"`{place}` {refusal}\n  = help: {advice}")
        new[path] = content
    try:
        write_tree(folder, new)
    except CompileError as error:
        show(error.diagnostics)
        click.get_current_context().exit(FAILED)
    for path in contents:
        say(f"{folder / path}{'' if path in new else ' (was there already)'}")


def _has(place: Path, content: bytes) -> bool:
    """True if a file, which is no link, has exactly this content."""
    return not place.is_symlink() and place.is_file() and place.read_bytes() == content
