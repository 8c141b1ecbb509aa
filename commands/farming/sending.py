"""What a run sends to the workers of a farm: everything that they need, as they share no disk.

``farm.py`` sends a ``Parcel`` to each worker, once, and then the subjects. ``worker.py`` unpacks
it.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from ...compiler.inputs import Inputs
from ..compared import ConformRequest


class Ability(NamedTuple):
    """What a worker is, and what it can do."""

    program: str
    """Its Burnish: the version and the digest of the code."""
    lacking: Mapping[str, str]
    """The routes that it cannot draw with, by name, and why."""


class Parcel(NamedTuple):
    """One run, for all workers that take part in it."""

    program: str
    """The Burnish that has asked; no other one answers."""
    request: ConformRequest
    needed: tuple[str, ...]
    """The routes with which a worker has to be able to draw."""
    folder: str
    """The current folder of who has asked."""
    folders: tuple[str, ...]
    """Absolute paths of folders that have to be there."""
    contents: Mapping[str, bytes]
    """The contents of all files that are read, by their absolute paths."""
    limits: Mapping[str, int]
    """The limits of the command's budget."""


def contents_of(inputs: Iterable[Inputs]) -> tuple[tuple[str, ...], dict[str, bytes]]:
    """The folders and the files that compiles have read, by absolute paths.

    A link is sent as the file to which it leads.
    """
    folders: dict[str, None] = {}
    contents: dict[str, bytes] = {}
    for each in inputs:
        folders.update(dict.fromkeys(map(_absolute, each.folders)))
        for asked, real in each.links.items():
            content = each.contents.get(real)
            if content is not None:
                contents[_absolute(asked)] = content
    return tuple(folders), contents


def unpacked(parcel: Parcel, root: Path) -> Path:
    """Write the files of a parcel below ``root``, as they lie where they come from.

    Returns the folder that is like the current one there.
    """
    for folder in (parcel.folder, *parcel.folders):
        _below(root, folder).mkdir(parents=True, exist_ok=True)
    for path, content in parcel.contents.items():
        place = _below(root, path)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
    return _below(root, parcel.folder)


def for_farm(request: ConformRequest) -> ConformRequest:
    """A request that means the same on workers: absolute paths would mean other files there."""
    return request._replace(
        files=tuple(map(_from_here, request.files)),
        search_path=tuple(map(_from_here, request.search_path)),
    )


def _from_here(path: Path) -> Path:
    return Path(os.path.relpath(path)) if path.is_absolute() else path


def _absolute(path: str) -> str:
    return os.path.abspath(path)  # noqa: PTH100 - links in the path stay as they are


def _below(root: Path, path: str) -> Path:
    """The place for an absolute path below ``root``, which no path leaves."""
    parts = Path(os.path.normpath(path)).parts[1:]
    return root.joinpath(*parts)
