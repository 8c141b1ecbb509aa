"""The list of everything that has to be run to build some files, as a document.

``burnish build --actions`` writes it, for the programs that run commands on many machines.
``commands/building`` fills it in. Its digests are those of Bazel's Remote Execution API, version 2,
whose messages a program that speaks it can make of each row again.
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from ...support.frozen import frozen
from ..constraints import Count, Pattern


@frozen(kw_only=True)
class ContentDigest:
    """The digest of a file's content, or of a message of the Remote Execution API."""

    hash: Annotated[str, Pattern("[0-9a-f]{64}")]
    """SHA-256 of the bytes, in lower-case hexadecimal digits."""
    size_bytes: Count
    """The number of bytes."""


@frozen(kw_only=True)
class InputFile:
    """A file that a command reads."""

    path: str
    """Its path, from the folder in which the command runs."""
    digest: ContentDigest


@frozen(kw_only=True)
class NamedText:
    """A name with its value."""

    name: str
    value: str


@frozen(kw_only=True)
class BuildAction:
    """A command, with all that it needs, and all that it makes."""

    name: str
    """What tells it apart from all others: the folder of its outputs, below that of the build."""
    arguments: tuple[str, ...]
    """The command: the program, and its arguments."""
    environment: tuple[NamedText, ...]
    """The variables that the command needs; it may have no other ones."""
    platform: tuple[NamedText, ...]
    """What a machine has to have: ``burnish`` is its version with the digest of its code, and
    ``compilers`` are those of other makers with their versions, if the command runs them."""
    inputs: tuple[InputFile, ...]
    """All files that the command reads, in the order of their paths."""
    input_folders: tuple[str, ...]
    """Folders that have to be there even if no input is in them."""
    outputs: tuple[str, ...]
    """What the command makes: folders, in which nothing else is put."""
    command_digest: ContentDigest
    """The digest of the message ``Command``: arguments, environment, outputs and platform."""
    input_root_digest: ContentDigest
    """The digest of the message ``Directory`` of the folder in which the command runs."""
    digest: ContentDigest
    """The digest of the message ``Action``: whatever has the same one has the same outputs."""


@frozen(kw_only=True)
class BuildActions:
    """Everything that has to be run to build some files. No command needs another one's outputs."""

    VERSION: ClassVar = "build"

    build: Literal[1]
    """Version of this document's format."""
    actions: tuple[BuildAction, ...]
    """The actions, in the order of the files."""
