"""Remembers results of ``compile`` for as long as nothing changes on which they depend.

An engine or an editor asks for the same material again and again, most often without an edit.
``compile`` then returns the record that it made before. A result is found by all arguments, and it
is used only if every file that was read has the same bytes, links lead to the same files, and what
was looked for in vain is still missing. Results with errors are not kept. Neither is anything while
passes are verified or shown, which asks for more than the result.

What is kept is bounded: the results that were used last stay, up to a number of them and of the
characters of their texts. The graphs behind them are bounded by ``graphs.py``.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable

from ..compiler.watching import is_watched
from ..support.frozen import frozen
from ..support.locks import lock
from .compiled import CompileResult

MOST_RESULTS = 256
"""The largest number of results that are kept."""
MOST_CHARACTERS = 2 << 20
"""The largest number of characters of all kept texts. With reflections that were read, results take
some 5 bytes for each of them; with graphs that somebody wanted to stay, 25, which is 50 MB."""


@frozen(eq=False)
class _Kept:
    result: CompileResult
    library: object
    """The library with which the result was made: another one after a change of its files."""
    characters: int


class Remembered:
    """Results by everything that ``compile`` was given. Several threads may use it."""

    def __init__(self, results: int = MOST_RESULTS, characters: int = MOST_CHARACTERS) -> None:
        self._most_results = results
        self._most_characters = characters
        self._kept: OrderedDict[Hashable, _Kept] = OrderedDict()
        """The results, the one that was used last at the end."""
        self._characters = 0
        self._lock = lock()

    def find(self, key: Hashable, library: object) -> CompileResult | None:
        """The result for these arguments, if it would be the same again."""
        with self._lock:
            kept = self._kept.get(key)
        if kept is None or is_watched():
            return None
        if kept.library is not library or not kept.result.inputs.are_current():
            self._drop(key)
            return None
        with self._lock:
            if key in self._kept:
                self._kept.move_to_end(key)
        return kept.result

    def keep(self, key: Hashable, library: object, result: CompileResult) -> None:
        """Remember a result, in place of those that have not been used for the longest time."""
        characters = sum(len(file.text) for each in result.materials for file in each.files)
        if characters > self._most_characters or is_watched():
            return
        self._drop(key)
        with self._lock:
            self._kept[key] = _Kept(result, library, characters)
            self._characters += characters
            while len(self._kept) > self._most_results or self._characters > self._most_characters:
                _key, oldest = self._kept.popitem(last=False)
                self._characters -= oldest.characters

    def _drop(self, key: Hashable) -> None:
        with self._lock:
            kept = self._kept.pop(key, None)
            if kept is not None:
                self._characters -= kept.characters
