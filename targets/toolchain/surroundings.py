"""The environment and the folder of programs that Burnish starts, and where it looks for programs.

The current folder may be somebody else's: a repository that was cloned, an archive that was
unpacked. Nothing that lies there may become code or configuration of a program that is started. So
no program runs in the current folder, where all relative paths of the environment would lead, none
is looked for there, and Python workers get neither that folder nor Python's variables.

What the environment names by absolute paths is the user's own choice, and stays.
"""

from __future__ import annotations

import os
import shutil
import site
import sys
from collections.abc import Iterator
from pathlib import Path

NEUTRAL = Path(sys.base_prefix).anchor or os.sep
"""The folder in which programs run that need none of their own: the root of the file system."""

QUIET = {"NO_COLOR": "1", "RUST_BACKTRACE": "0", "LC_ALL": "C.UTF-8"}
"""Variables with which the tools write messages that can be read by ``messages.py``."""

_LAUNCHER = Path(__file__).with_name("launcher.py")


def which(name: str) -> Path | None:
    """The absolute path of a program on PATH, but never of one in the current folder.

    Python's own ``shutil.which`` also takes programs by relative entries of PATH, and on Windows
    looks into the current folder first.
    """
    if os.path.isabs(name):  # noqa: PTH117 - it is no Path
        return Path(name) if shutil.which(name) else None
    endings = ("", ".exe") if os.name == "nt" else ("",)
    paths = (Path(folder) / f"{name}{end}" for folder in _search_path() for end in endings)
    return next((path for path in paths if shutil.which(path)), None)


def search_path() -> str:
    """PATH without its relative entries, empty ones included, and without the current folder."""
    return os.pathsep.join(_search_path())


def environment() -> dict[str, str]:
    """The environment for programs: the user's, without paths that lead to the current folder.

    Variables of Python are for the Python that runs Burnish. Other relative paths, such as those of
    ``LD_LIBRARY_PATH`` and ``NODE_PATH``, lead nowhere from the folder in which programs run.
    """
    kept = {name: text for name, text in os.environ.items() if not name.startswith("PYTHON")}
    return kept | {"PATH": search_path()}


def python_worker(module: str, *arguments: str) -> list[str]:
    """The command that runs a module of Burnish in a Python of its own.

    It is the same Burnish that runs here, wherever that was found, with the packages that the same
    Python has installed. Other entries of the user's ``PYTHONPATH`` come after all of these.
    """
    flags = "-EP"
    if not site.ENABLE_USER_SITE:
        flags += "s"
    if sys.flags.dont_write_bytecode:
        flags += "B"
    further = os.pathsep.join(_absolute(os.environ.get("PYTHONPATH", "")))
    return [sys.executable, flags, str(_LAUNCHER), further, module, *arguments]


def _search_path() -> Iterator[str]:
    return _absolute(os.environ.get("PATH", os.defpath))


def _absolute(folders: str) -> Iterator[str]:
    """The absolute folders of a list, without the current one."""
    for folder in folders.split(os.pathsep):
        if os.path.isabs(folder) and not _is_current(folder):  # noqa: PTH117 - of the host's kind
            yield folder


def _is_current(folder: str) -> bool:
    try:
        return os.path.samefile(folder, os.curdir)  # noqa: PTH121
    except OSError:
        return False
