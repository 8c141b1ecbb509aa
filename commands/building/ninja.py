"""Writes a graph for Ninja, which runs the actions of a build that are out of date.

``burnish build --ninja`` calls ``graph``. Ninja compares dates of files, so every output is named:
it sees that one is missing, and other rules can use it. Inputs are named as well, with all that a
file imports: a graph is written again when one of them changes, so they are always right. Lists
of dependencies (``--depfile``) would say the same, but Ninja reads some names in them wrongly, such
as those with an apostrophe.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable, Mapping, Sequence
from subprocess import list2cmdline

from ...support.frozen import frozen
from .actions import Batch, BuildError

POOL = "burnish"
_NOT_IN_PATHS = "\n\r\0|"
"""Characters that no path can have in a graph for Ninja."""

_HEAD = """\
# Written by `burnish build --ninja`, for Ninja 1.10 or newer. Changes are lost when it is written
# again, which Ninja has done as soon as one of the sources has changed.
ninja_required_version = 1.10

# Compiles that run at once, so that there is memory for all of them.
pool {pool}
  depth = {depth}

# Outputs that would become the same keep their date, and nothing behind them is run (restat).
rule burnish_compile
  command = $run
  description = burnish $out_folder
  restat = 1
  pool = {pool}

rule burnish_build
  command = {again}
  description = burnish build --ninja
  generator = 1
  restat = 1
"""

_MISTAKES = """\
# A source has a mistake. What mends it need not be among the inputs, such as a file that is
# missing: until then, this graph is written again each time.
build {name}: phony
"""


@frozen
class NinjaGraph:
    """Everything that a graph says besides its actions."""

    path: str
    """The file of the graph itself."""
    called: tuple[str, ...]
    """The words by which Burnish is called."""
    again: tuple[str, ...]
    """The arguments that write the graph again."""
    program: str
    """A file that changes whenever Burnish itself does."""
    depth: int
    """The number of actions that may run at once."""
    mistakes: tuple[str, ...]
    """A name that no file has, if an action has errors: then the graph is always out of date."""


def graph(batches: Sequence[Batch], outputs: Mapping[str, Iterable[str]], about: NinjaGraph) -> str:
    """The text of a graph. ``outputs`` has the names of the files in each folder of outputs.

    Raises ``BuildError`` for names that Ninja cannot have.
    """
    again = _command([*about.called, *about.again])
    head = _HEAD.format(pool=POOL, depth=about.depth, again=again)
    sources = sorted({path for batch in batches for path in batch.inputs})
    inputs = _implicit([*sources, about.program, *about.mistakes])
    return "\n".join([
        head,
        *(_statement(batch, outputs, about) for batch in batches),
        f"build {_path(about.path)}: burnish_build{inputs}\n",
        *(_MISTAKES.format(name=_path(each)) for each in about.mistakes),
        "# A source may be deleted or renamed: then this graph is written again without it.",
        *(f"build {_path(source)}: phony" for source in sources),
        "",
    ])  # fmt: skip


def _statement(batch: Batch, outputs: Mapping[str, Iterable[str]], about: NinjaGraph) -> str:
    """The statement that builds all outputs of a batch."""
    folders = batch.outputs
    files = (f"{folder}/{name}" for folder in folders for name in sorted(outputs[folder]))
    made = " $\n    ".join(map(_path, files))
    imported = [path for path in batch.inputs if path not in batch.files]
    inputs = " ".join(map(_path, batch.files)) + _implicit([*imported, about.program])
    run = _command([*about.called, *batch.words()])
    shown = _value(" ".join(folders))
    return f"build {made}: burnish_compile {inputs}\n  run = {run}\n  out_folder = {shown}\n"


def _implicit(paths: Sequence[str]) -> str:
    return " | " + " ".join(map(_path, paths)) if paths else ""


def _path(path: str) -> str:
    """A path in a statement. Raises ``BuildError`` if Ninja cannot have it there."""
    _insist_on_sayable(path)
    for sign in "$ :":
        path = path.replace(sign, f"${sign}")
    return path


def _value(text: str) -> str:
    """A text as the value of a variable. Raises ``BuildError`` if Ninja cannot have it there."""
    _insist_on_sayable(text)
    return text.replace("$", "$$")


def _command(words: Sequence[str]) -> str:
    """A command line as the value of a variable, for the shell of this system."""
    line = list2cmdline(words) if os.name == "nt" else shlex.join(words)
    if any(sign in line for sign in "\n\r\0"):
        _insist_on_sayable(line)
    return line.replace("$", "$$")


def _insist_on_sayable(text: str) -> None:
    for sign in _NOT_IN_PATHS:
        if sign in text:
            raise BuildError(
                f"a graph for Ninja cannot have {sign!r} in a name, as `{text}` has: rename it"
            )
