"""Reads files of wrong programs, each followed by the messages about it.

A file consists of cases::

    === what the user wanted
    the program
    --- said
    the messages

If a title begins with ``in a material:``, the program consists only of equations. They are put into
a material that imports the library's lights and terms; their first line is line 2.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import burnish
from burnish.compiler.diagnostics.diagnostic import Diagnostic
from burnish.compiler.diagnostics.render import render_all

FOLDER = Path(__file__).parent
_TITLE = "=== "
_SAID = "--- said\n"
SILENT = "nothing"
"""Stands for no message: the program has a meaning, though not the intended one."""

_WITHIN = "in a material: "
_AROUND = ("import std.lights  import std.terms  material M {\n", "}\n")
_PASS = re.compile(r"^pass (\w+)", re.MULTILINE)
_RIG = re.compile(r"^rig (\w+)", re.MULTILINE)


@dataclass(frozen=True)
class Case:
    """A wrong program and the messages that it must get."""

    title: str
    written: str
    said: str

    @property
    def program(self) -> str:
        """The text to compile."""
        if not self.title.startswith(_WITHIN):
            return self.written
        before, behind = _AROUND
        return before + self.written + behind

    def shown(self, said: str) -> str:
        """The text of the case in its file, with ``said`` as its messages."""
        return f"{_TITLE}{self.title}\n{self.written}{_SAID}{said}"


def cases(path: Path) -> list[Case]:
    """The cases of a file, in its order."""
    return [_case(part) for part in path.read_text(encoding="utf-8").split(f"\n{_TITLE}")]


def _case(part: str) -> Case:
    title, _, rest = part.removeprefix(_TITLE).partition("\n")
    written, _, said = (rest + "\n" if rest else "").partition(_SAID)
    return Case(title, written, said.rstrip("\n") + "\n")


@cache
def told(case: Case) -> tuple[Diagnostic, ...]:
    """All diagnostics of a program, compiled with the last pass that it declares.

    Several tests ask for those of each program.
    """
    path = Path("m.burnish")
    path.write_text(case.program, encoding="utf-8")
    passes = _PASS.findall(case.program)
    found = burnish.check(path, pass_=passes[-1] if passes else None)
    if found:
        return found
    try:
        burnish.compile(path, ("wgsl",))
    except burnish.CompileError as error:
        return error.diagnostics
    return ()


def said(case: Case) -> str:
    """The messages about a program, as a terminal shows them."""
    return (render_all(told(case)).rstrip("\n") or SILENT) + "\n"
