"""Keeps transcripts of the library's equations, so that a process checks them once or twice.

Each elaboration of a material asks for the chain of the library's records behind its own. A chain
is transcribed when it is asked for the second time, as many processes compile one material only.
Chains of a library whose files have changed are forgotten. Nothing is taken from here while graphs
are verified or shown (``is_watched``), as in tests.
"""

from __future__ import annotations

from collections import OrderedDict

from ....support.locks import lock
from ...watching import is_watched
from ..names.modules import Module
from ..state.transcripts import Kept, LibraryPart

MOST_KEPT = 64
"""The largest number of chains of which transcripts are kept: some 100 kB each."""


class KeptTranscripts:
    """Transcripts by the chains that were asked for last. Threads may share it."""

    def __init__(self, most: int = MOST_KEPT) -> None:
        self._most = most
        self._kept: OrderedDict[LibraryPart, Kept | None] = OrderedDict()
        self._library: Module | None = None
        """The module of the records that all others extend; another one after a change."""
        self._lock = lock()

    def of(self, part: LibraryPart) -> Kept:
        """The transcripts of a chain, as far as there are any by now."""
        if is_watched():
            return {}
        with self._lock:
            is_first = self._is_first(part)
            known = self._kept[part]
        if is_first or known is not None:
            return known or {}
        made = _transcribed(part)
        with self._lock:
            if part in self._kept:
                self._kept[part] = made
        return made

    def _is_first(self, part: LibraryPart) -> bool:
        """True if a chain is not remembered yet; from now on it is one of those asked for last."""
        library = part.chain[-1].module
        if library is not self._library:
            self._kept.clear()
            self._library = library
        is_first = part not in self._kept
        self._kept.setdefault(part, None)
        self._kept.move_to_end(part)
        if len(self._kept) > self._most:
            self._kept.popitem(last=False)
        return is_first


KEPT_TRANSCRIPTS = KeptTranscripts()
"""The transcripts of this process."""


def _transcribed(part: LibraryPart) -> Kept:
    from .transcribing import transcribed

    return transcribed(part)
