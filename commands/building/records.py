"""Remembers what each action of a build has made, so that it is not run again in vain.

``running.py`` asks whether an action is up to date, and which former outputs nothing makes any
more; ``ninja.py`` asks what an action makes. As everywhere, what
lies in an output folder is not believed: the record is in the user's cache, and has digests of all
outputs. It is like the cache of actions that servers of the Remote Execution API have.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from hashlib import sha256
from pathlib import Path

from ...compiler.cache import load, store
from ..results import encoded, key_of
from .actions import Action
from .program import program

_NAME = "built"

Outputs = Mapping[str, str]
"""Digests of the contents of files, by their names."""
Named = Mapping[str, tuple[str, tuple[str, ...]]]
"""The source of a folder of outputs, and their names when it was last compiled without an error."""
Made = Mapping[str, tuple[str, Outputs]]
"""The source of a folder of outputs, and what was written there, by the folder; full paths."""


class Records:
    """The records of the builds into one folder."""

    def __init__(self, folder: str) -> None:
        self._key = key_of([os.path.realpath(folder)])
        self._known, self._made_before, self._named_before = _loaded(self._key)
        self._used: dict[str, Outputs] = {}
        self._made = dict(self._made_before)
        self._named = dict(self._named_before)

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
        self._used[_state(action)] = _digests(contents)
        folder, source = action.request.output, str(action.request.files[0])
        for other in [each for each in self._named if _is_beside(each, [folder])]:
            if self._named[other][0] == source:
                del self._named[other]
        self._named[folder] = source, tuple(contents)

    def last_names(self, action: Action) -> list[str]:
        """The names of what an action made when it last had no error, from its folder.

        If its file cannot be read, its rigs are unknown: then the outputs of all rigs are meant.
        """
        folder, source = action.request.output, str(action.request.files[0])
        _, own = self._named.get(folder, (source, ()))
        rigs = {} if action.request.rig is not None else {
            each.removeprefix(f"{folder}/"): names
            for each, (owner, names) in self._named.items()
            if owner == source and os.path.dirname(each) == folder  # noqa: PTH120
        }  # fmt: skip
        return [*own, *(f"{rig}/{name}" for rig, names in rigs.items() for name in names)]

    def wrote(self, action: Action, contents: Mapping[str, str | bytes]) -> None:
        """Remember what now lies in the folder of an action."""
        source = os.path.realpath(action.request.files[0])
        self._made[os.path.realpath(action.request.output)] = source, _digests(contents)

    def replaced(self, action: Action, names: Iterable[str]) -> list[Path]:
        """The former outputs of an action that are none of these any more."""
        folder = os.path.realpath(action.request.output)
        _, before = self._made_before.get(folder, ("", {}))
        gone = before.keys() - set(names)
        return [path for path in _untouched(folder, before) if path.name in gone]

    def abandoned(self, actions: Iterable[Action]) -> list[Path]:
        """The outputs of folders that no action writes any more, and of sources that are gone.

        Others are left: a build of some of the files says nothing of the rest.
        """
        current = {os.path.realpath(each.request.output) for each in actions}
        gone = [
            (folder, outputs)
            for folder, (source, outputs) in self._made.items()
            if not os.path.lexists(source)
            or (folder not in current and _is_beside(folder, current))
        ]
        return [path for folder, outputs in gone for path in _untouched(folder, outputs)]

    def forget(self, paths: Iterable[Path]) -> None:
        """Remember no more of the folders of these files, which are gone."""
        for folder in {str(path.parent) for path in paths}:
            self._made.pop(folder, None)

    def keep(self) -> None:
        """Keep the records of all actions that were asked about, and of all that was written."""
        before = self._known, self._made_before, self._named_before
        if (self._used, self._made, self._named) != before:
            entry = {"states": self._used, "made": self._made, "named": self._named}
            store(_NAME, self._key, json.dumps(entry).encode())


def _loaded(key: str) -> tuple[Mapping[str, Outputs], Made, Named]:
    try:
        stored = load(_NAME, key)
        if stored is None:
            return {}, {}, {}
        found = json.loads(stored)
        states = {str(state): _outputs(each) for state, each in found["states"].items()}
        made = {
            str(folder): (str(source), _outputs(each))
            for folder, (source, each) in found["made"].items()
        }
        named = {
            str(folder): (str(source), tuple(map(str, names)))
            for folder, (source, names) in found["named"].items()
        }
        return states, made, named
    except (ValueError, LookupError, TypeError, AttributeError):
        return {}, {}, {}


def _is_beside(folder: str, current: Iterable[str]) -> bool:
    """True for the folder of a file that now has one for each rig, or the other way round."""
    pairs = ((folder, each) for each in current)
    return any(os.path.dirname(a) == b or os.path.dirname(b) == a for a, b in pairs)  # noqa: PTH120


def _outputs(found: Mapping[object, object]) -> Outputs:
    return {str(name): str(digest) for name, digest in found.items()}


def _digests(contents: Mapping[str, str | bytes]) -> Outputs:
    return {name: sha256(content).hexdigest() for name, content in encoded(contents).items()}


def _untouched(folder: str, outputs: Outputs) -> list[Path]:
    """The files that are as they were written: what somebody has changed is not Burnish's."""
    paths = {Path(folder, name): digest for name, digest in outputs.items()}
    return [path for path, digest in paths.items() if _holds(path, digest)]


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
