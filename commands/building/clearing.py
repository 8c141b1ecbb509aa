"""Deletes former outputs of a build that nothing makes any more; ``running.py`` says which."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path


def cleared(paths: Iterable[Path], root: str) -> list[str]:
    """Delete files of a build, and folders below ``root`` that become empty.

    Returns the paths of those that are gone; one that cannot be deleted stays.
    """
    top, gone = Path(os.path.realpath(root)), list[str]()
    for path in paths:
        with suppress(OSError):
            path.unlink()
            gone.append(os.path.relpath(path))
            for folder in path.parents:
                if not folder.is_relative_to(top) or folder == top:
                    break
                folder.rmdir()
    return gone
