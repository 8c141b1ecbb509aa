"""Keeps what each of many files has become, from one command to the next.

``results.py`` keeps the output of a whole command line, unless it is large, and after any edit all
of it is made anew. Here each file has an entry of its own, which is used as long as everything that
its compile depended on is the same. ``many_files.py`` asks for the entries of all files. Files with
warnings have none, as these are told in the order of all files.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from ..compiler.cache import load, prune, store_unpruned
from ..compiler.inputs import Inputs
from .compiled_record import Compiled
from .results import LARGEST, are_unchanged, key_of, noted

if TYPE_CHECKING:
    from .compile_options import CompileRequest
    from .results import Question

MOST = 4096
"""The number of entries that stay: many times as many as a command line has files."""
_NAME = "file"


class KeptFiles:
    """The entries of files that one command line names. It is sent to processes that compile."""

    def __init__(self, question: Question) -> None:
        self._place = question.place
        self._program = question.program

    def find(self, request: CompileRequest) -> Compiled | None:
        """What the only file of a request has become, if it would become the same again."""
        stored = load(_NAME, key_of(self._words(request)))
        if stored is None:
            return None
        try:
            entry = json.loads(stored)
            if entry["circumstances"] != self._circumstances(request) or not are_unchanged(entry):
                return None
            return Compiled(
                entry["texts"], entry["reflections"], entry["plans"], tuple(entry["lines"]),
                tuple(entry["remarks"]), (), _inputs(entry),
            )  # fmt: skip
        except (ValueError, LookupError, TypeError, AttributeError):
            return None

    def keep(self, request: CompileRequest, found: Compiled) -> None:
        """Keep what a file has become, in place of what it was before."""
        if found.inputs is None or found.diagnostics:
            return
        entry = {
            "circumstances": self._circumstances(request),
            **noted(found.inputs),
            "texts": dict(found.texts),
            "reflections": dict(found.reflections),
            "plans": dict(found.plans),
            "lines": found.lines,
            "remarks": found.remarks,
        }
        payload = json.dumps(entry).encode()
        if len(payload) <= LARGEST:
            store_unpruned(_NAME, key_of(self._words(request)), payload)

    def prune(self) -> None:
        """Delete the oldest entries, if there are too many: once behind all that are kept."""
        prune(_NAME, MOST)

    def _words(self, request: CompileRequest) -> list[str]:
        return [*self._place, repr(request)]

    def _circumstances(self, request: CompileRequest) -> list[str]:
        return [*self._words(request), *self._program]


def _inputs(entry: dict[str, object]) -> Inputs:
    """The inputs that an entry says of."""
    found = Inputs()
    sources, links, folders = entry["sources"], entry["links"], entry["folders"]
    assert isinstance(sources, dict) and isinstance(links, dict) and isinstance(folders, list)
    found.contents = {path: None if v is None else v.encode() for path, v in sources.items()}
    found.links = links
    found.folders = folders
    return found
