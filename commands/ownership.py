"""Of which sources the files in output folders are, and with which contents they were written.

``compile`` and ``build`` overwrite nothing of another source, and nothing that somebody has changed
by hand. Two builds may write into one folder, one behind the other or both at once, and two sources
may declare materials of one name. Which source has made a file, its text does not say. So it is
kept in the user's cache folder, where nobody else can write: nothing that lies in an output folder
is believed. A file that no entry tells of, as in a folder that was checked out, is replaced if it
looks like one that Burnish has written, and never if it looks like anything else.
"""

from __future__ import annotations

import os

from ..compiler.cache import digest, load, store

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    Noted = dict[str, dict[str, str]]
    """The digests of the files of each source, by their names without capital letters."""

_NAME = "written"
_CHANGED = "it is not as it was written here last: somebody changed it, or wrote it elsewhere"
_OWN = (b"by Burnish.", b'{\n  "format": ', b'{\n  "plan": ', b'{\n  "signatures": ')
"""What is among the first bytes of each text, reflection and plan."""
HEAD = 4096
"""The bytes at the beginning of a file by which it is recognised, if nothing is known of it."""
_MODULES = (b"\x03\x02\x23\x07", b"DXBC")
"""The first bytes of SPIR-V and of DXIL, which nobody writes by hand."""


class Ownership:
    """Guards one folder while files are written into it; ``replacing.py`` asks it."""

    def __init__(
        self, folder: str, sources: Mapping[str, Sequence[str]], *, force: bool = False
    ) -> None:
        """``sources`` has the names of the new files, by the path of the source of each.

        With ``force`` it objects to nothing, and only notes whose the files are.
        """
        self._source_of = {
            name: os.path.realpath(path) for path, names in sources.items() for name in names
        }
        self._force = force
        self._key = digest(os.fsencode(os.path.realpath(folder)))

    def objection(self, name: str, content: bytes) -> str | None:
        """The reason why a file with this content must not be replaced; else ``None``."""
        if self._force:
            return None
        source = self._source_of[name]
        for other, digests in self._noted().items():
            written = digests.get(name.casefold())
            if written is None:
                continue
            if other != source and os.path.lexists(other):
                return f"`{_shown(other)}` was compiled to it, not `{_shown(source)}`"
            # A source that is gone, or has been renamed, has no outputs.
            as_written = not content or written == digest(content)
            return None if as_written else _CHANGED
        head = content[:HEAD]
        is_own = not head or head.startswith(_MODULES) or any(mark in head for mark in _OWN)
        return None if is_own else "it is no file that Burnish has written"

    def settle(self, contents: Mapping[str, bytes]) -> None:
        """Note of which sources the new files are, and what is in them."""
        import json

        noted = self._noted()
        new = {name.casefold(): name for name in self._source_of}
        after = {
            path: {name: each for name, each in digests.items() if name not in new}
            for path, digests in noted.items()
        }
        for key, name in sorted(new.items()):
            after.setdefault(self._source_of[name], {})[key] = digest(contents[name])
        after = {path: digests for path, digests in after.items() if digests}
        if after != noted:
            store(_NAME, self._key, json.dumps(after).encode())

    def _noted(self) -> Noted:
        """The files of each source, as far as they are known."""
        stored = load(_NAME, self._key)
        if stored is None:
            return {}
        import json

        try:
            found: Noted = json.loads(stored)
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
