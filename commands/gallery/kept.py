"""Keeps the entries of files between runs, so that only changed files are made anew.

An entry depends on its file and on all of the file's imports, on Burnish, the tools of its routes,
and the options. Entries of files with errors are not kept: whoever corrects them wants to see the
result.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import cast

from ...targets.runner.routes import Route, inspect_tools
from ...targets.runner.store import Store, digest
from ..results import installation
from .entry import Entry
from .making import content_of, digest_of

STORE = "gallery"


class KeptEntries:
    """The entries of earlier runs with the same options."""

    def __init__(self, routes: Sequence[Route], shown: Sequence[Route], size: int) -> None:
        self._store = Store(STORE)
        states = inspect_tools([*routes, *shown])
        tools = [f"{name} {state.version} {state.problem}" for name, state in states.items()]
        names = [route.name for route in (*routes, *shown)]
        self._common = digest(installation(), str(size), *names, *tools)

    def read(self, file: Path) -> Entry | None:
        """The entry of a file, if nothing that it depends on has changed."""
        content = self._store.read(self._name(file))
        if content is None:
            return None
        entry = cast(Entry, json.loads(content))
        return entry if _unchanged(entry["inputs"]) else None

    def write(self, file: Path, entry: Entry) -> None:
        """Keep an entry, unless it has errors."""
        if not entry["errors"]:
            self._store.write(self._name(file), json.dumps(entry).encode())

    def _name(self, file: Path) -> str:
        return digest(self._common, str(file))


def _unchanged(inputs: Mapping[str, str]) -> bool:
    return all(digest_of(content_of(Path(path))) == known for path, known in inputs.items())
