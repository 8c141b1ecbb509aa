"""Where the files of a tool are looked for: one class for each kind of tool.

Every kind answers two questions: what is ``inside`` a folder that the installer made, and what is
``outside``, put there by the system. Both give the paths of all the files, or None when one is
missing.
"""

from __future__ import annotations

import platform
import shutil
from collections.abc import Iterable
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

ROOT = Path("/")
"""Below it lie the files of the system; the tests put another in its place."""

Paths = tuple[Path, ...]


class Place:
    """A kind of place. By itself it is nowhere."""

    __slots__ = ()

    def inside(self, folder: Path) -> Paths | None:  # noqa: ARG002 - what there is by default
        """The files in a folder laid out like the one that the installer makes."""
        return None

    def outside(self) -> Paths | None:
        """The files where the system has them."""
        return None


@dataclass(frozen=True, slots=True)
class Programs(Place):
    """Programs, all of which are needed: in the folder's ``bin``, or on PATH."""

    names: tuple[str, ...]

    def inside(self, folder: Path) -> Paths | None:
        return _all_files(folder / "bin" / name for name in self.names)

    def outside(self) -> Paths | None:
        found = [shutil.which(name) for name in self.names]
        return tuple(Path(path) for path in found if path) if all(found) else None


@dataclass(frozen=True, slots=True)
class AnyProgram(Place):
    """One program that distributions call by different names, on PATH."""

    names: tuple[str, ...]
    """The first that is there is taken."""

    def outside(self) -> Paths | None:
        found = (shutil.which(name) for name in self.names)
        return next(((Path(path),) for path in found if path), None)


@dataclass(frozen=True, slots=True)
class FolderFiles(Place):
    """Files that only the installer puts anywhere."""

    files: tuple[str, ...]
    """Relative to the installer's folder."""

    def inside(self, folder: Path) -> Paths | None:
        return _all_files(folder / file for file in self.files)


@dataclass(frozen=True, slots=True)
class SystemFiles(Place):
    """Files of the system: drivers, layers and libraries, which are on no search path."""

    files: tuple[tuple[str, ...], ...]
    """For each file the places that distributions have for it, the likeliest first, relative to the
    root of the file system. ``{machine}`` is the processor's name, and ``*`` any part of a name."""

    def outside(self) -> Paths | None:
        found = [self._first(places) for places in self.files]
        return tuple(path for path in found if path) if all(found) else None

    @staticmethod
    def _first(places: tuple[str, ...]) -> Path | None:
        patterns = (place.format(machine=platform.machine()) for place in places)
        return next((path for pattern in patterns for path in sorted(ROOT.glob(pattern))), None)


@dataclass(frozen=True, slots=True)
class PythonPackage(Place):
    """A package of the Python that runs Burnish; its path is the folder it is installed in."""

    name: str

    def outside(self) -> Paths | None:
        try:
            return (Path(str(distribution(self.name).locate_file(""))),)
        except PackageNotFoundError:
            return None


def libraries(name: str) -> tuple[str, ...]:
    """The places of a shared library, for ``SystemFiles``: Debian's, Fedora's, Arch's."""
    return tuple(
        f"{folder}/{name}" for folder in ("usr/lib/{machine}-linux-gnu", "usr/lib64", "usr/lib")
    )


def vulkan_files(name: str) -> tuple[str, ...]:
    """The places of a file that tells the Vulkan loader of a driver or layer."""
    return tuple(f"{folder}/vulkan/{name}" for folder in ("usr/share", "usr/local/share", "etc"))


def _all_files(paths: Iterable[Path]) -> Paths | None:
    found = tuple(paths)
    return found if all(path.is_file() for path in found) else None
