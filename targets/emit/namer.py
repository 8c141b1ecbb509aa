"""Turns names of a material into names that are legal in a language and differ from each other.

``names.py`` uses a ``Namer`` for everything that a program declares outside of functions, and
``stage.py`` one for the locals of each function.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Set
from functools import lru_cache

from ..description.reserved import Reserved

_UNUSUAL = re.compile(r"[^A-Za-z0-9_]")
_UNDERSCORES = re.compile(r"_{2,}")
_LONGEST = 128
"""The length at which names are cut: WebGL refuses names beyond 1024 characters, and readers give
up much earlier."""


class Namer:
    """Hands out the names of one scope. A name that is taken or reserved gets a suffix."""

    def __init__(
        self, reserved: Reserved, taken: Iterable[str] = (), outer: Set[str] = frozenset()
    ) -> None:
        self._reserved = reserved
        self._taken = set(taken)
        self._outer = outer
        """The names of the scope around this one. They are not copied, as there may be many of
        both."""
        self._scopes: list[list[str]] = []
        self._numbers: dict[str, int] = {}
        """The last number that was tried for a stem, so that what is wanted often stays cheap."""

    def declare(self, wanted: str) -> str:
        """A legal name that nothing visible has yet: ``wanted`` itself if possible."""
        name = _legal(wanted, self._reserved)
        if name is None or name in self._taken or name in self._outer:
            name = next(filter(self._free, self._others(_base(wanted))))
        self._taken.add(name)
        if self._scopes:
            self._scopes[-1].append(name)
        return name

    def take(self, name: str) -> None:
        """Declare a name that another namer has made."""
        self._taken.add(name)

    def inner(self, taken: Iterable[str] = ()) -> Namer:
        """A namer for an inner scope, whose names hide none of this one's, and none of ``taken``.

        Only the outermost scope can be asked for inner ones.
        """
        assert not self._outer, "only the outermost scope has inner ones"
        return Namer(self._reserved, taken, self._taken)

    def enter(self) -> None:
        """Open a block; its names may be used again after ``leave``."""
        self._scopes.append([])

    def leave(self) -> None:
        """Close the innermost block."""
        self._taken.difference_update(self._scopes.pop())
        self._numbers.clear()

    def _free(self, name: str) -> bool:
        taken = name in self._taken or name in self._outer
        return not taken and not self._reserved.refuses(name)

    def _others(self, base: str) -> Iterable[str]:
        """Names to try instead of ``base``, which is taken or reserved."""
        stem = base.rstrip("_") or "user"
        if stem[0].isdigit() or self._reserved.refuses(f"{stem}_2"):
            # A suffix cannot help a word such as ``gl_FragColor``.
            stem = f"user_{stem.lstrip('_')}"
            yield stem
        yield f"{stem}_"
        while True:
            number = self._numbers[stem] = self._numbers.get(stem, 1) + 1
            yield f"{stem}_{number}"


@lru_cache(maxsize=4096)
def _legal(wanted: str, reserved: Reserved) -> str | None:
    """``wanted`` in allowed letters; empty if the language does not allow the result as a name."""
    name = _base(wanted)
    return None if name[:1].isdigit() or reserved.refuses(name) else name


def _base(wanted: str) -> str:
    """``wanted`` in letters that are allowed.

    It has no two underscores in a row, since GLSL and WGSL reserve such names.
    """
    return _UNDERSCORES.sub("_", _UNUSUAL.sub("_", wanted))[:_LONGEST]
