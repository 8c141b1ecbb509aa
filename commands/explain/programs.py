"""The programs that show diagnostics: for each code a shortest wrong one, and the same one mended.

Each file of rows in ``compiler/diagnostics/rules`` has a text file of this name here, such as
``b03_types.txt``. They use the library, which the compiler's own folder knows nothing of. Only
``burnish explain``, the generator of docs/diagnostics.md and tests read them: a compile never does.
An entry of a file is one of these two::

    === B0301
    the wrong program
    --- right
    the right program

    === B0001
    --- no program: why no text of a program can show the diagnostic

A title such as ``=== B0701 for glsl:es100`` names the targets without which nothing is reported.
"""

from __future__ import annotations

from pathlib import Path

from ...support.frozen import frozen

_FOLDER = Path(__file__).parent
_TITLE = "=== "
_FOR = " for "
_RIGHT = "--- right\n"
_NONE = "--- no program: "


@frozen
class ShownProgram:
    """The entry of one diagnostic: two programs, or a reason why there are none."""

    code: str
    targets: str
    """The targets that both programs are compiled for; empty if ``burnish check`` is enough."""
    wrong: str
    """The program that is told the diagnostic and nothing else; empty if there is a reason."""
    right: str
    """The mended program, about which there is nothing to say."""
    reason: str
    """The reason why there are no programs, as a sentence; empty if there are."""

    @property
    def condition(self) -> str:
        """The condition under which the wrong program is wrong, as words behind "wrong"."""
        return f" if it is compiled for {self.targets}" if self.targets else ""


def shown(code: str) -> ShownProgram:
    """The programs of a code. Raises ``KeyError`` if no file has an entry for it."""
    return {entry.code: entry for entry in _section(code[:3])}[code]


def every_shown() -> list[ShownProgram]:
    """The entries of all files, section by section, in the order in which they are written."""
    sections = sorted(path.name[:3].upper() for path in _FOLDER.glob("b*.txt"))
    return [entry for section in sections for entry in _section(section)]


def _section(section: str) -> list[ShownProgram]:
    (path,) = _FOLDER.glob(f"{section.lower()}_*.txt")
    text = "\n" + path.read_text(encoding="utf-8")
    return [_entry(part) for part in text.split(f"\n{_TITLE}")[1:]]


def _entry(part: str) -> ShownProgram:
    title, _, body = part.partition("\n")
    code, _, targets = title.partition(_FOR)
    if body.startswith(_NONE):
        return ShownProgram(code, targets, "", "", " ".join(body.removeprefix(_NONE).split()))
    wrong, _, right = body.partition(_RIGHT)
    return ShownProgram(code, targets, wrong.rstrip() + "\n", right.rstrip() + "\n", "")
