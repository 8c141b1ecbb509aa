"""What is asked of ``burnish view``: by its command line, and by each page."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple


class Request(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    file: Path
    """Or a folder."""
    mesh: str
    scene: Path | None
    instances: int
    values: tuple[tuple[str, str], ...]
    material: str | None
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]
    hoist: bool


class Choice(NamedTuple):
    """What one page shows of the file. Where it says nothing, the command line decides, or else
    the file's first one."""

    file: str | None = None
    """The name of one of a folder's files."""
    subject: str | None = None
    rig: str | None = None
    pass_: str | None = None
    mesh: str | None = None
    profile: str = "wgsl:webgpu"
    """The texts that its browser can draw."""
    pictures: tuple[tuple[str, str], ...] = ()
    """For textures, by name, the pictures that somebody has given, by the words of ``Pictures``."""
