"""Keeps transcripts of the library's equations, so that a process checks them once or twice.

Each elaboration of a material asks for the library's part of its records. It is transcribed when it
is asked for the second time, as many processes compile one material only. Nothing is taken from
here while graphs are verified or shown (``is_watched``), as in tests.
"""

from __future__ import annotations

from ....support.locks import lock
from ...watching import is_watched
from ..names.kept_of_library import KeptOfLibrary
from ..state.transcripts import Kept, LibraryPart

MOST_KEPT = 64
"""The largest number of chains of records of which transcripts are kept: some 100 kB each."""


class KeptTranscripts:
    """Transcripts by the library's parts of instances. Threads may share it."""

    def __init__(self, most: int = MOST_KEPT) -> None:
        self._kept: KeptOfLibrary[Kept] = KeptOfLibrary(most)
        self._asked: KeptOfLibrary[bool] = KeptOfLibrary(most)
        """The parts that were asked for."""

    def __len__(self) -> int:
        return len(self._kept)

    def of(self, part: LibraryPart) -> Kept:
        """The transcripts of the library's part of an instance, as far as there are any by now."""
        if is_watched():
            return {}
        symbol = part.chain[-1]
        known = self._kept.find(symbol, part)
        if known is None and self._asked.find(symbol, part):
            known = _transcribed(part)
            self._kept.keep(symbol, part, known)
        elif known is None:
            self._asked.keep(symbol, part, True)
        return known or {}


KEPT_TRANSCRIPTS = KeptTranscripts()
"""The transcripts of this process."""


_LOADING = lock()
"""Held while the module is loaded: a process that forks meanwhile would wait for it for ever."""


def _transcribed(part: LibraryPart) -> Kept:
    with _LOADING:
        from .transcribing import transcribed

    return transcribed(part)
