"""Writes what ``--depfile`` asks for: a rule of Make without commands, which Ninja reads as well.

It says that the outputs depend on all files that were read: the sources, what they import, and the
files of the library. A place where a file was looked for in vain is not among them, since neither
program knows of files that must not be there.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path

from ..compiler.inputs import Inputs
from .ownership import is_depfile

_BLANK = re.compile(r"(\\*)([ \t])")
_MARK = re.compile("[#:]")


class NoNameError(ValueError):
    """A path that no rule can name; the message says why."""


def depfile(targets: Sequence[str], sources: Sequence[Path], inputs: Inputs) -> str:
    """The rule for some targets. Raises ``NoNameError``."""
    right = "".join(f" \\\n  {escaped(path)}" for path in files_read(inputs, sources))
    return " \\\n  ".join(map(escaped, targets)) + f":{right}\n"


def depfile_of(
    name: str,
    targets: Sequence[str],
    outputs: Sequence[str],
    sources: Sequence[Path],
    inputs: Inputs,
    *,
    force: bool = False,
) -> str:
    """The text of the file ``name``: a rule for targets, where outputs are written besides.

    Raises ``CompileError`` if a name cannot be written in it, or if something else is in the way.
    """
    from .output import foreign, obstacle, unwritable

    path = Path(name)
    try:
        text = depfile(targets, sources, inputs)
    except NoNameError as error:
        raise unwritable(path, str(error)) from error
    place = os.path.realpath(path)
    if place in inputs.contents:
        raise unwritable(path, "it is one of the files that were read")
    if place in map(os.path.realpath, outputs):
        raise unwritable(path, "it is one of the outputs")
    reason = obstacle(path.parent, path.name)
    if reason is not None:
        raise unwritable(path, reason)
    if not force and path.is_file() and not is_depfile(path.read_bytes()):
        raise foreign(path, "it is no file that `--depfile` has written")
    return text


def files_read(inputs: Inputs, sources: Sequence[Path]) -> list[str]:
    """The paths of all files that were read, as they were asked for, without doubles.

    Build systems compare names word by word. So names stay as they were given, and imports are
    relative to the current folder where all sources are.
    """
    below = "" if any(map(os.path.isabs, sources)) else f"{os.path.realpath(os.curdir)}{os.sep}"
    asked = {real: path for path, real in reversed(inputs.links.items())}
    own = [asked.get(real, real) for real, text in inputs.contents.items() if text is not None]
    found = (path.removeprefix(below) for path in (*own, *sorted(inputs.library)))
    return list(dict.fromkeys(found))


def escaped(path: str) -> str:
    """A path as Make and Ninja read it: as compilers of C write them.

    Backslashes are doubled only before a blank, which needs one itself. The colon of a drive of
    Windows stays bare.
    """
    if "\n" in path or "\r" in path:
        raise NoNameError("it has a line break, which no rule of Make can name")
    drive, rest = os.path.splitdrive(path)
    rest = _BLANK.sub(r"\1\1\\\2", rest)
    return drive + _MARK.sub(r"\\\g<0>", rest).replace("$", "$$")
