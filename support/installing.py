"""Renders the command that installs parts of Burnish, for messages about what is missing."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable

IMPLIED = {"render": ("run", "scenes", "view", "wgpu")}
"""The extras that others include, with those others."""
_SAFE = "/\\:._-+~"
"""What a path may have besides letters and digits without quotes around it."""


def install_command(extras: Iterable[str]) -> str:
    """The command that installs these extras for the Python that runs now.

    Messages of commands, of drivers and of ``burnish doctor`` show it. An extra that another one
    includes is left out.
    """
    wanted = set(extras)
    least = sorted(extra for extra in wanted if wanted.isdisjoint(IMPLIED.get(extra, ())))
    return f"{_quoted(sys.executable or 'python')} -m pip install 'burnish[{','.join(least)}]'"


def _quoted(path: str) -> str:
    """A path as a shell takes it; the one of Windows has other quotes, and needs a ``&``."""
    if all(letter.isalnum() or letter in _SAFE for letter in path):
        return path
    if os.name == "nt":
        return f'& "{path}"'
    from shlex import quote

    return quote(path)
