"""Finds the files of Burnish in folders that a command line names beside files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

SUFFIX = ".burnish"
KINDS = ("frame", "material", "kernel")
"""The kinds of declarations that are compiled; a file without any is only for importing."""


def files_in(folder: Path, left_out: Iterable[str] = ()) -> Iterator[str]:
    """The files of Burnish in a folder and those below it, but for hidden ones.

    ``left_out`` are folders, without links, in which outputs lie.
    """
    for place, inner, names in os.walk(folder):
        shown = (name for name in sorted(inner) if not name.startswith("."))
        inner[:] = [each for each in shown if os.path.realpath(Path(place, each)) not in left_out]
        yield from (str(Path(place, name)) for name in sorted(names) if _is_source(name))


def _is_source(name: str) -> bool:
    return name.endswith(SUFFIX) and not name.startswith(".")
