"""Places to look for the files of a tool: one class for each kind of tool.

A row of ``tools.py`` has one of these. Each kind answers two questions: which files are ``inside``
a folder that the installer made, and which are ``outside``, installed by the system. Both return
the paths of all files, or ``None`` if one is missing.
"""

from __future__ import annotations

import os
import platform
import stat
from collections.abc import Iterable
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from .surroundings import which

ROOT = Path("/")
"""The root of the system's files; tests replace it."""

Paths = tuple[Path, ...]


class Place:
    """A kind of place. This base class finds nothing."""

    __slots__ = ()

    def inside(self, folder: Path) -> Paths | None:  # noqa: ARG002 - what there is by default
        """The files in a folder that has the installer's layout."""
        return None

    def outside(self) -> Paths | None:
        """The files at the places where systems have them."""
        return None


@dataclass(frozen=True, slots=True)
class Programs(Place):
    """Programs, all of which are required, in the folder's ``bin`` or on PATH."""

    names: tuple[str, ...]

    def inside(self, folder: Path) -> Paths | None:
        return _all_files(folder / "bin" / name for name in self.names)

    def outside(self) -> Paths | None:
        found = [which(name) for name in self.names]
        return tuple(path for path in found if path) if all(found) else None


@dataclass(frozen=True, slots=True)
class AnyProgram(Place):
    """One program on PATH, which distributions give different names."""

    names: tuple[str, ...]
    """The first name that is found is used."""

    def outside(self) -> Paths | None:
        found = (which(name) for name in self.names)
        return next(((path,) for path in found if path), None)


@dataclass(frozen=True, slots=True)
class FolderFiles(Place):
    """Files that only the installer provides."""

    files: tuple[str, ...]
    """The paths of the files, relative to the installer's folder."""

    def inside(self, folder: Path) -> Paths | None:
        return _all_files(folder / file for file in self.files)


@dataclass(frozen=True, slots=True)
class SystemFiles(Place):
    """Files of the system that are on no search path: drivers, layers and libraries."""

    files: tuple[tuple[str, ...], ...]
    """For each file, where distributions have it, the most likely place first, relative to the root
    of the file system. ``{machine}`` is the processor's name, and ``*`` any part of a name.
    """

    def outside(self) -> Paths | None:
        found = [self._first(places) for places in self.files]
        return tuple(path for path in found if path) if all(found) else None

    @staticmethod
    def _first(places: tuple[str, ...]) -> Path | None:
        patterns = (place.format(machine=platform.machine()) for place in places)
        return next((path for pattern in patterns for path in sorted(ROOT.glob(pattern))), None)


@dataclass(frozen=True, slots=True)
class PythonPackage(Place):
    """A package of the Python that runs Burnish; its path is the folder with all packages."""

    name: str

    def outside(self) -> Paths | None:
        try:
            return (Path(str(distribution(self.name).locate_file(""))),)
        except PackageNotFoundError:
            return None


def libraries(name: str) -> tuple[str, ...]:
    """The paths at which Debian, Fedora and Arch have a shared library, for ``SystemFiles``."""
    return tuple(
        f"{folder}/{name}" for folder in ("usr/lib/{machine}-linux-gnu", "usr/lib64", "usr/lib")
    )


def vulkan_files(name: str) -> tuple[str, ...]:
    """The paths at which systems register a driver or a layer with the Vulkan loader."""
    return tuple(f"{folder}/vulkan/{name}" for folder in ("usr/share", "usr/local/share", "etc"))


def is_trusted(folder: Path) -> bool:
    """True if a folder exists, and only this user and root can put a program into it.

    A folder may be a link, but not one that somebody else could turn to another folder.
    """
    try:
        link, status = folder.lstat(), folder.stat()
    except OSError:
        return False
    owners = {link.st_uid, status.st_uid}
    ours = os.name == "nt" or (
        owners <= {0, os.geteuid()} and not stat.S_IMODE(status.st_mode) & 0o022
    )
    return stat.S_ISDIR(status.st_mode) and ours


def _all_files(paths: Iterable[Path]) -> Paths | None:
    found = tuple(paths)
    return found if all(path.is_file() for path in found) else None
