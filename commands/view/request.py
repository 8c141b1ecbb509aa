"""The requests to ``burnish view``: those of its command line, and of each page."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple


class ViewRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    file: Path
    """A file or a folder."""
    mesh: str
    floor: bool
    """True if the mesh of a material stands on a floor."""
    scene: Path | None
    variant: str | None
    """The variant of the scene which is shown."""
    environment: str
    """The light from all around: a word or a file."""
    eye: tuple[float, float, float] | None
    look_at: tuple[float, float, float] | None
    turn: tuple[float, float]
    """The angles by which the camera turns, in radians: to the right and upwards."""
    instances: int
    exposure: float
    """The stops by which the picture is brightened at first."""
    tone: str
    """The name of the tone mapping at first."""
    values: tuple[tuple[str, str], ...]
    material: str | None
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]
    hoist: bool
    plain: bool
    """True if comments of files have no say."""
    named: frozenset[str] = frozenset()
    """The names of the options that the command line has."""
    wished: tuple[tuple[str, str], ...] = ()
    """The values that the comment of the file asks for."""


class Choice(NamedTuple):
    """A page's choice of what it shows.

    The command line decides about everything that the page leaves open, or else the file's first
    entry.
    """

    file: str | None = None
    """The name of one of a folder's files."""
    subject: str | None = None
    rig: str | None = None
    pass_: str | None = None
    mesh: str | None = None
    profile: str = "wgsl:webgpu"
    """The profile of the texts that the browser can draw."""
    pictures: tuple[tuple[str, str], ...] = ()
    """For textures, by name, the pictures that somebody has given, by the words of ``Pictures``."""
