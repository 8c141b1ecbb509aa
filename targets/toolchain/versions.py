"""Functions that read a tool's version from the paths of its files; ``None`` if they find none."""

from __future__ import annotations

import json
import mmap
import os
import re
from collections.abc import Callable
from importlib.metadata import version as installed_version
from pathlib import Path

from .limits import ASKED
from .places import Paths
from .process import run
from .surroundings import which

Version = Callable[[Paths], str | None]

VERSION_LIMIT = 20.0
"""The seconds that a tool may take to print its version."""


def says(option: str, pattern: str) -> Version:
    """Read the version from the output of the first file, which is a program."""

    def version(paths: Paths) -> str | None:
        return _said([str(paths[0]), option], pattern)

    return version


def says_by_rustup(option: str, pattern: str) -> Version:
    """Read the version from the output of a program in whose place rustup may stand.

    rustup has no compiler where it has no folder, and would make one in the user's home.
    """
    plain = says(option, pattern)

    def version(paths: Paths) -> str | None:
        is_rustup = paths[0].resolve().name == "rustup"
        folder = Path(os.environ.get("RUSTUP_HOME") or Path.home() / ".rustup")
        return None if is_rustup and not folder.is_dir() else plain(paths)

    return version


def browser_beside(programs: tuple[str, ...]) -> Version:
    """Read the version from the output of the browser in whose folder the first file is."""

    def version(paths: Paths) -> str | None:
        beside = (paths[0].parent / name for name in programs)
        program = next((path for path in beside if path.is_file()), None)
        return _said([str(program), "--version"], r"(\d+(?:\.\d+)+)") if program else None

    return version


def refuses_sandbox() -> bool:
    """True if Chromium certainly does not start with its sandbox: as root."""
    return os.name == "posix" and os.geteuid() == 0


def written_in(number: int, pattern: bytes) -> Version:
    """Find the version in the binary with this index; searching megabytes takes milliseconds."""

    def version(paths: Paths) -> str | None:
        with (
            paths[number].open("rb") as file,
            mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content,
        ):
            found = re.search(pattern, content)
            return found[1].decode() if found else None

    return version


def stated(*keys: str) -> Version:
    """Read the version from the first file, a JSON document, under nested ``keys``."""

    def version(paths: Paths) -> str | None:
        value = json.loads(paths[0].read_text("utf-8"))
        for key in keys:
            value = value.get(key) if isinstance(value, dict) else None
        return value if isinstance(value, str) else None

    return version


def in_folder_name(paths: Paths) -> str | None:
    """Read the version from the name of the cache folder: ``dxc-3.7`` contains 3.7."""
    return paths[0].parent.name.partition("-")[2]


def of_python_package(name: str) -> Version:
    """Read the version from the metadata of an installed Python package."""
    return lambda _paths: installed_version(name)


def of_debian_package(name: str) -> Version:
    """Read the version of a program that does not say its own, from Debian's list of packages."""

    def version(_paths: Paths) -> str | None:
        program = which("dpkg-query")
        command = [str(program), "--show", "--showformat", "${Version}", name]
        return _said(command, r"(?:\d+:)?(\d+(?:\.\d+)*)") if program else None

    return version


def _said(command: list[str], pattern: str) -> str | None:
    outcome = run(command, time_limit=VERSION_LIMIT, limits=ASKED)
    found = re.search(pattern, outcome.log) if outcome.ending == "ended" else None
    return found[1] if found else None
