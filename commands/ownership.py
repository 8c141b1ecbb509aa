"""Of which sources the files in output folders are: ``compile`` overwrites nothing of another one.

Two builds may write into one folder, one behind the other or both at once, and two sources may
declare materials of one name. Which source has made a file, its text does not say. So it is kept in
the user's cache folder, where nobody else can write: nothing that lies in an output folder is
believed. A file that no entry tells of, as in a folder that was checked out, is replaced if it
looks like one that Burnish has written, and never if it looks like anything else.
"""

from __future__ import annotations

import os

from ..compiler.cache import digest, load, store

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

_NAME = "outputs"
_OWN = (b"by Burnish.", b'{\n  "format": ', b'{\n  "plan": ', b'{\n  "signatures": ')
"""What is among the first bytes of each text, reflection and plan."""
_MODULES = (b"\x03\x02\x23\x07", b"DXBC")
"""The first bytes of SPIR-V and of DXIL, which nobody writes by hand."""


class Ownership:
    """Guards one folder while files are written into it; ``replacing.py`` asks it."""

    def __init__(self, folder: str, sources: Mapping[str, Sequence[str]]) -> None:
        """``sources`` has the names of the new files, by the path of the source of each."""
        self._sources = {os.path.realpath(path): names for path, names in sources.items()}
        self._source_of = {
            name: path for path, names in self._sources.items() for name in names
        }  # fmt: skip
        self._key = digest(os.fsencode(os.path.realpath(folder)))

    def objection(self, name: str, head: bytes) -> str | None:
        """The reason why a file with other contents must not be replaced; else ``None``."""
        source = self._source_of[name]
        for other, names in self._noted().items():
            if name.casefold() in names:
                if other == source or not os.path.lexists(other):
                    return None  # A source that is gone, or has been renamed, has no outputs.
                return f"`{_shown(other)}` was compiled to it, not `{_shown(source)}`"
        is_own = not head or head.startswith(_MODULES) or any(mark in head for mark in _OWN)
        return None if is_own else "it is no file that Burnish has written"

    def settle(self) -> None:
        """Note of which sources the new files are."""
        import json

        noted = self._noted()
        new = {name.casefold() for name in self._source_of}
        after = {path: [each for each in names if each not in new] for path, names in noted.items()}
        for path, names in self._sources.items():
            after[path] = sorted({*after.get(path, ()), *map(str.casefold, names)})
        after = {path: names for path, names in after.items() if names}
        if after != noted:
            store(_NAME, self._key, json.dumps(after).encode())

    def _noted(self) -> dict[str, list[str]]:
        """The names of the files of each source, as far as they are known."""
        stored = load(_NAME, self._key)
        if stored is None:
            return {}
        import json

        try:
            found: dict[str, list[str]] = json.loads(stored)
        except ValueError:
            return {}
        return found


def is_depfile(content: bytes) -> bool:
    """True for what ``--depfile`` writes, or nothing: one rule, which names files of Burnish."""
    lines = content.replace(b"\\\n", b"").splitlines()
    return not content or (len(lines) == 1 and b":" in lines[0] and b".burnish" in lines[0])


def _shown(path: str) -> str:
    """A path as a user would write it: relative, if it is below the current folder."""
    here = os.path.join(os.getcwd(), "")  # noqa: PTH109, PTH118
    return path.removeprefix(here)
