"""Projects of hosts, in folders of their own, and the commands that their pages give."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from burnish.commands.new import contents

from .scene import COMMON

HOSTS = COMMON.parent
GLUE = re.compile(r"-- glue\b.*?\n(.*?)\n[^\n]*-- end of glue", re.DOTALL)
ENGINE = re.compile(r"# -- an engine for frames -*\n(.*?)\n# -- ", re.DOTALL)
"""What implements the functions that frames call, where a binding does not bring it."""


def project(host: str, folder: Path) -> Path:
    """The project of a host in a new folder, as `burnish new` writes it."""
    for path, content in contents(host, host).items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(content)
    return folder


def commands(folder: Path) -> list[str]:
    """The commands of a project's page: those that build it, and the one that draws."""
    page = (folder / "README.md").read_text(encoding="utf-8")
    return [block.strip() for block in re.findall(r"```sh\n(.*?)```", page, re.DOTALL)]


def glue(text: str, comments: Sequence[str]) -> list[int]:
    """The number of lines between each pair of marks of glue, without comments and empty ones.

    A second pair is what frames need besides.
    """
    return [count(part, comments) for part in GLUE.findall(text)]


def count(part: str, comments: Sequence[str]) -> int:
    """The number of lines that are no comments, and not empty."""
    lines = (line.strip() for line in part.splitlines())
    return len([line for line in lines if line and not line.startswith(tuple(comments))])
