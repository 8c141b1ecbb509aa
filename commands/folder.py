"""Which files of a folder that somebody has received may be shown.

``burnish gallery`` and ``burnish view`` show folders. What lies in one may be a link to a private
file, or a pipe that never ends; neither belongs to the folder.
"""

from __future__ import annotations

from pathlib import Path


def is_file_within(path: Path, root: Path) -> bool:
    """Whether a path leads to a regular file below ``root``, which is a path without links."""
    try:
        found = path.resolve()
        return found.is_relative_to(root) and found.is_file()
    except (OSError, RuntimeError, ValueError):  # A circle of links, or no name of a file.
        return False
