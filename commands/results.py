"""Keeps the output of ``burnish compile``, so that repeating it takes hardly longer than Python.

``cli.main`` asks it before anything else is loaded. A result is found by its command line, word for
word. It is used only if everything that the compile depended on is still the same: the current
folder, Python, every file of this installation, every file that was read, the targets of links, and
the places where files were looked for in vain. Sources are compared byte by byte. The installation
is compared by names, sizes and times of change, which no edit can leave as they were.

Only successful compiles are kept, with the warnings that they printed. If there were errors, or if
a file cannot be written as before, everything is compiled again, so that messages have one origin.
"""

from __future__ import annotations

import os
import sys
from stat import S_ISREG

from ..compiler.cache import digest, load, store
from ..compiler.inputs import unchanged
from .ownership import Ownership, is_depfile
from .replacing import replace_all
from .terminal import print_output, show_everything, wants_color

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from typing import Any

    from ..compiler.inputs import Inputs

STDOUT = "-"
"""The output folder that stands for standard output."""

LARGEST = 4 << 20
"""Bytes of an answer with its sources above which it is not worth keeping."""

_NEVER = frozenset({"--no-cache", "--validate", "--watch", "--emit"})
"""Words of command lines that ask for more than texts."""

_FIELDS = ("folder", "texts", "owners", "depfile", "printed", "warnings", "force")
"""What is kept of an output, in the order of its initialiser."""

_ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))  # noqa: PTH120
LIBRARY = os.path.join(_ROOT, "stdlib", "")  # noqa: PTH118
"""The beginning of the paths of the library's files."""
_PACKAGES = ("click", "jinja2", "lark", "markupsafe")
"""Packages on which the meaning of a command line and the look of a text depend."""


class Question:
    """A command line, with the folder and the program that run it."""

    __slots__ = ("arguments", "circumstances", "key", "place", "program")

    def __init__(self, arguments: Sequence[str]) -> None:
        self.arguments = tuple(arguments)
        self.place = [os.getcwd(), _ROOT]  # noqa: PTH109
        """The current folder, and that of Burnish."""
        self.program = [sys.version, installation()]
        """The texts by which Python and Burnish are the same."""
        here = [*self.place, *arguments]
        self.key = key_of(here)
        """The key of the answer; the next answer to the same command line replaces it."""
        self.circumstances = [*here, *self.program, str(wants_color(sys.stderr))]


class Output:
    """Everything that a compile hands to its user."""

    __slots__ = ("depfile", "folder", "force", "owners", "printed", "texts", "warnings")

    def __init__(
        self,
        folder: str,
        texts: Mapping[str, str | bytes],
        owners: Mapping[str, Sequence[str]],
        depfile: Sequence[str] = (),
        printed: str = "",
        warnings: str = "",
        force: bool = False,
    ) -> None:
        self.folder = folder
        self.texts = texts
        """Files to write into the folder, by name; what is kept has no bytes among them."""
        self.owners = owners
        """The names of these files by the path of the source of each."""
        self.depfile = depfile
        """The path and the text of the file that names what was read; empty if there is none."""
        self.printed = printed
        """The text for standard output."""
        self.warnings = warnings
        """The text for standard error."""
        self.force = force
        """True if they may replace any file."""

    def guard(self) -> Ownership:
        """What keeps files of other sources, and changed ones, from being replaced."""
        return Ownership(self.folder, self.owners, force=self.force)


def ask(arguments: Sequence[str]) -> Question | None:
    """The question of a command line; ``None`` if no answer to it is ever kept."""
    options = (word.partition("=")[0] for word in arguments)
    wanted = arguments[:1] == ["compile"] and _NEVER.isdisjoint(options)
    return asked(arguments) if wanted else None


def asked(arguments: Sequence[str]) -> Question | None:
    """The question of a command line whose files may be kept, and taken from earlier ones."""
    if os.environ.get("BURNISH_VERIFY") or os.environ.get("BURNISH_SHOW"):
        return None
    try:
        return Question(arguments)
    except OSError:
        return None


def answer(question: Question) -> bool:
    """Write the kept output for the question again; True if that was possible.

    Raises ``BrokenPipeError`` if the reader of the output has left: compiling would not help.
    """
    import json

    stored = load("result", question.key)
    if stored is None:
        return False
    try:
        kept = json.loads(stored)
        if kept["circumstances"] != question.circumstances or not are_unchanged(kept):
            return False
        output = Output(*(kept[name] for name in _FIELDS))
        if not _is_asked_for(output, question):
            return False
        if output.folder != STDOUT:
            replace_all(output.folder, encoded(output.texts), output.guard())
        if output.depfile:
            path, text = output.depfile
            folder, name = os.path.split(path)
            replace_all(folder or os.curdir, {name: text.encode()})
        show_everything()
        print_output(output.printed)
        if output.warnings:
            from .console import print_rendered

            print_rendered(output.warnings)
    except BrokenPipeError:
        raise
    except (OSError, ValueError, LookupError, TypeError):
        return False
    return True


def keep(question: Question, output: Output, inputs: Inputs) -> None:
    """Keep the output for a question, unless it is large."""
    if sum(map(len, output.texts.values())) > LARGEST:
        return
    import json

    entry = {
        "circumstances": question.circumstances,
        **noted(inputs),
        **{name: getattr(output, name) for name in _FIELDS},
    }
    payload = json.dumps(entry).encode()
    if len(payload) <= LARGEST:
        store("result", question.key, payload)


def noted(inputs: Inputs) -> dict[str, Any]:
    """What an entry says of the files that a compile has read, but for those of the library."""
    sources = {k: v for k, v in inputs.contents.items() if not k.startswith(LIBRARY)}
    return {
        "sources": {k: v if v is None else v.decode() for k, v in sources.items()},
        "links": {k: v for k, v in inputs.links.items() if not v.startswith(LIBRARY)},
        "folders": inputs.folders,
        "library": list(inputs.library),
    }


def key_of(words: Sequence[str]) -> str:
    """The key of what depends on these words; paths among them may have any bytes."""
    return digest("\0".join(words).encode("utf-8", "surrogatepass"))


def encoded(texts: Mapping[str, str | bytes]) -> dict[str, bytes]:
    """The contents of files that consist of these texts, or of bytes already."""
    return {name: text.encode() if isinstance(text, str) else text for name, text in texts.items()}


def _is_asked_for(output: Output, question: Question) -> bool:
    """True if an answer writes only to places that the command line names.

    The folder is a word of it, or ends one, as in ``-obuild`` and ``--output=build``. Names that
    lead out of the folder are refused where files are written.
    """
    places = [place for place in (output.folder, *output.depfile[:1]) if place != STDOUT]
    named = all(any(word.endswith(place) for word in question.arguments) for place in places)
    return named and all(map(_may_have_rule, output.depfile[:1]))


def _may_have_rule(path: str) -> bool:
    """True if a path is that of an earlier rule, or nothing is there: a device is not replaced."""
    try:
        if not S_ISREG(os.lstat(path).st_mode):
            return False
        with open(path, "rb") as file:  # noqa: PTH123
            return is_depfile(file.read())
    except FileNotFoundError:
        return True


def are_unchanged(kept: dict[str, Any]) -> bool:
    """True if everything that an entry says of files is found, and is the same."""
    sources = {k: v if v is None else v.encode() for k, v in kept["sources"].items()}
    return unchanged(sources, kept["links"], kept["folders"])


def installation() -> str:
    """The digest of the names, sizes and times of all files of the compiler and its packages."""
    found = sorted(_stamps(_ROOT))
    from importlib.util import find_spec

    for package in _PACKAGES:
        spec = find_spec(package)
        if spec is not None and spec.origin is not None:
            found.append(_stamp(spec.origin, os.stat(spec.origin)))  # noqa: PTH116
    return digest("\n".join(found).encode("utf-8", "surrogateescape"))


def _stamps(folder: str) -> Iterator[str]:
    """The stamps of each module, and of everything else in the folders of sub-packages."""
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.is_dir():
                if (folder != _ROOT and entry.name != "__pycache__") or _is_package(entry.path):
                    yield from _stamps(entry.path)
            elif folder != _ROOT or entry.name.endswith(".py"):
                yield _stamp(entry.path, entry.stat())


def _is_package(folder: str) -> bool:
    return os.path.exists(os.path.join(folder, "__init__.py"))  # noqa: PTH110, PTH118


def _stamp(path: str, status: os.stat_result) -> str:
    """A text that differs after each change of a file: nobody can set its time of change back."""
    return f"{path} {status.st_size} {status.st_mtime_ns} {status.st_ctime_ns} {status.st_ino}"
