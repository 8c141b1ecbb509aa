"""One action of a build: a compile of a file for one variant, with the files that it reads.

``planning.py`` makes the actions of a build. One action is a file with all of its targets, since
what a compile has read and checked serves all of them. Other programs run ``Batch``es of actions,
each in one process: to start one takes as long as to compile several files.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from hashlib import sha256
from pathlib import Path

from ...compiler.documents.actions import ContentDigest
from ...support.frozen import DEFAULTS, changed, frozen
from ..compile_options import OPTIONS, CompileRequest, Option


@frozen
class Variant:
    """One way to compile all files."""

    name: str
    """The name of the folder for its outputs; empty if there is only one variant."""
    request: CompileRequest
    """The options, without files; the output is the folder of the whole build."""

    @property
    def folder(self) -> str:
        """The folder for all outputs of this variant."""
        return "/".join(filter(None, (self.request.output, self.name)))


@frozen
class Action:
    """A command ``burnish compile``, and everything that it depends on."""

    variant: Variant
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
        return ["compile", *_paths(self.request.files), *options_of(self.request)]


@frozen
class Batch:
    """Actions of one variant that one process runs, one after the other: at least one."""

    actions: tuple[Action, ...]

    @property
    def name(self) -> str:
        """What tells it apart from other batches."""
        first, *others = self.actions
        return f"{first.name} and {len(others)} more" if others else first.name

    @property
    def files(self) -> tuple[str, ...]:
        """The files that are compiled."""
        files = (file.as_posix() for each in self.actions for file in each.request.files)
        return tuple(dict.fromkeys(files))

    @property
    def inputs(self) -> Mapping[str, ContentDigest]:
        """All files that are read, by their paths."""
        return dict(sorted(pair for each in self.actions for pair in each.inputs.items()))

    @property
    def folders(self) -> tuple[str, ...]:
        """The folders that have to be there."""
        return tuple(dict.fromkeys(folder for each in self.actions for folder in each.folders))

    @property
    def outputs(self) -> tuple[str, ...]:
        """The folders that are written."""
        return tuple(each.request.output for each in self.actions)

    def words(self) -> list[str]:
        """The arguments of ``burnish`` that run all of it."""
        first = self.actions[0]
        if len(self.actions) == 1:
            return first.words()
        request = changed(first.variant.request, output=first.variant.folder)
        return ["build", "--part", *_paths(map(Path, self.files)), *options_of(request)]


class BuildError(Exception):
    """Something is wrong with a build as a whole; the text is a sentence for people."""


def digest_of(content: bytes) -> ContentDigest:
    """The digest of a content."""
    return ContentDigest(hash=sha256(content).hexdigest(), size_bytes=len(content))


def options_of(request: CompileRequest, rows: Iterable[Option] = OPTIONS) -> list[str]:
    """The options of a command line that asks for this, in the order of the rows."""
    found: list[str] = []
    defaults = getattr(CompileRequest, DEFAULTS)
    for row in rows:
        value, name = getattr(request, row.field), row.names[-1]
        if value == defaults.get(row.field):
            continue
        if row.off:
            found.append(row.off)
        elif not row.metavar:
            found.append(name)
        elif row.many:
            found += [f"{name}={each}" for each in value]
        else:
            found.append(f"{name}={value}")
    return found


def _paths(files: Iterable[Path]) -> list[str]:
    """Paths as words of a command line, which takes none of them for an option."""
    paths = (file.as_posix() for file in files)
    return [f"./{path}" if path.startswith("-") else path for path in paths]
