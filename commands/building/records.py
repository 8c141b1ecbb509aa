"""Remembers what each action of a build has made, so that it is not run again in vain.

``running.py`` asks whether an action is up to date, ``ninja.py`` what it makes. As everywhere, what
lies in an output folder is not believed: the record is in the user's cache, and has digests of all
outputs. It is like the cache of actions that servers of the Remote Execution API have.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

from ...compiler.cache import load, store
from ..results import encoded, key_of
from .actions import Action
from .program import program

_NAME = "built"

Outputs = Mapping[str, str]
"""Digests of the contents of files, by their names."""


class Records:
    """The records of the builds into one folder."""

    def __init__(self, folder: str) -> None:
        self._key = key_of([os.path.realpath(folder)])
        self._known = _loaded(self._key)
        self._used: dict[str, Outputs] = {}

    def outputs(self, action: Action) -> Outputs | None:
        """What an action makes; ``None`` if it was not run yet, or with other inputs."""
        state = _state(action)
        found = self._used.get(state) or self._known.get(state)
        if found is not None:
            self._used[state] = found
        return found

    def are_current(self, action: Action) -> bool:
        """True if all outputs of an action are there, and are what it would make again."""
        found = self.outputs(action)
        return found is not None and all(
            _holds(Path(action.request.output, name), digest) for name, digest in found.items()
        )

    def note(self, action: Action, contents: Mapping[str, str | bytes]) -> None:
        """Remember what an action makes."""
        self._used[_state(action)] = {
            name: sha256(content).hexdigest() for name, content in encoded(contents).items()
        }

    def keep(self) -> None:
        """Keep the records of all actions that were asked about."""
        if self._used != self._known:
            store(_NAME, self._key, json.dumps(self._used).encode())


def _loaded(key: str) -> dict[str, Outputs]:
    try:
        stored = load(_NAME, key)
        found = {} if stored is None else json.loads(stored)
        return {
            str(state): {str(name): str(digest) for name, digest in outputs.items()}
            for state, outputs in found.items()
        }
    except (ValueError, AttributeError):
        return {}


def _state(action: Action) -> str:
    """A digest of all that decides what an action makes, and where."""
    inputs = [(path, each.hash) for path, each in action.inputs.items()]
    whole = repr((action.words(), inputs, action.folders, program()))
    return sha256(whole.encode("utf-8", "surrogatepass")).hexdigest()


def _holds(path: Path, digest: str) -> bool:
    """True if there is a file with this content, and no link."""
    try:
        return not path.is_symlink() and sha256(path.read_bytes()).hexdigest() == digest
    except OSError:
        return False
