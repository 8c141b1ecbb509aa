"""Keeps what depends on declarations of the library alone, for all compiles of a process.

Whoever computes such a thing has a ``KeptOfLibrary`` for it: flattened records, the leaves of
records, transcripts of equations, and bodies of functions.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable
from typing import Generic, TypeVar

from ....support.locks import lock
from .modules import Module, Symbol

V = TypeVar("V")


class KeptOfLibrary(Generic[V]):
    """Values by keys, those that were used last. Threads may share it.

    A library whose files have changed has other modules, and what was kept of it is forgotten.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._kept: OrderedDict[Hashable, V] = OrderedDict()
        self._prelude: Module | None = None
        self._lock = lock()

    def __len__(self) -> int:
        return len(self._kept)

    def find(self, symbol: Symbol, key: Hashable) -> V | None:
        """The value for a key, which is about a symbol of the library; ``None`` if none is kept."""
        with self._lock:
            if _prelude(symbol) is not self._prelude or key not in self._kept:
                return None
            self._kept.move_to_end(key)
            return self._kept[key]

    def keep(self, symbol: Symbol, key: Hashable, value: V) -> None:
        """Keep a value for a key."""
        with self._lock:
            prelude = _prelude(symbol)
            if prelude is not self._prelude:
                self._kept.clear()
                self._prelude = prelude
            self._kept[key] = value
            self._kept.move_to_end(key)
            if len(self._kept) > self._most:
                self._kept.popitem(last=False)


def _prelude(symbol: Symbol) -> Module:
    """The module that all other modules of a library see."""
    return symbol.module.prelude or symbol.module
