"""One action of a build: a compile of a file for one variant, with the files that it reads.

``planning.py`` makes the actions of a build. One action is a file with all of its targets, since
what a compile has read and checked serves all of them: starting a process takes as long as several
files do, and each further target only a fraction of one file.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from hashlib import sha256

from ...compiler.documents.actions import ContentDigest
from ...support.frozen import frozen
from ..compile_options import OPTIONS, CompileRequest, Option


@frozen
class Action:
    """A command ``burnish compile``, and everything that it depends on."""

    name: str
    """The folder of its outputs, below that of the build: ``materials/plastic``."""
    request: CompileRequest
    """The command line; paths are relative to the current folder."""
    inputs: Mapping[str, ContentDigest]
    """The files that are read, but for Burnish's own, by their paths."""
    folders: tuple[str, ...]
    """The folders of the search path, which have to be there."""

    def words(self) -> list[str]:
        """The arguments of ``burnish`` that run this action."""
        return [
            "compile",
            *map(_no_option, map(str, self.request.files)),
            *options_of(self.request),
        ]


class BuildError(Exception):
    """Something is wrong with a build as a whole; the text is a sentence for people."""


def digest_of(content: bytes) -> ContentDigest:
    """The digest of a content."""
    return ContentDigest(hash=sha256(content).hexdigest(), size_bytes=len(content))


def options_of(request: CompileRequest, rows: Iterable[Option] = OPTIONS) -> list[str]:
    """The options of a command line that asks for this, in the order of the rows."""
    found: list[str] = []
    for row in rows:
        value = getattr(request, row.field)
        name = row.names[-1]
        if row.off:
            found += [] if value else [row.off]
        elif not row.metavar:
            found += [name] if value else []
        elif row.many:
            found += [f"{name}={each}" for each in value]
        elif value is not None:
            found.append(f"{name}={value}")
    return found


def _no_option(path: str) -> str:
    """A path that no command takes for an option."""
    return f"./{path}" if path.startswith("-") else path
