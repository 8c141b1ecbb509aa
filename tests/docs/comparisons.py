"""Tables of what other systems have: what stands in their last columns is tried as Burnish.

A table of a page ``docs/coming_from_*.md`` has a mark before it that says what its last column
holds: ``<!-- a material -->`` expressions and members of a material or a pass, and whole
declarations; ``<!-- types -->`` types; ``<!-- a rig -->`` lights of a rig; ``<!-- a frame -->``
steps and members of a frame. Other code in a cell says what the cell needs: ``std.color`` is
imported, and ``+ Tangents`` is a mixin of the material.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

import burnish
from burnish.compiler.diagnostics.render import render_all

from .kit import ROOT

PAGES = tuple(sorted((ROOT / "docs").glob("coming_from_*.md")))
MARKED = re.compile(r"^<!-- (a material|types|a rig|a frame) -->\n((?:\|.*\n)+)", re.MULTILINE)
CODE = re.compile(r"`([^`]+)`")
BEHIND_BAR = re.compile(r"(?<!\\)\|")

DECLARATIONS = (
    "import", "fn", "term", "material", "abstract", "light", "pass", "rig", "frame", "struct",
    "space", "mixin", "kernel", "extern",
)  # fmt: skip
OF_PASSES = ("target", "discard", "depth", "raster", "stencil", "clear")
MEMBERS = ("param", "map", "attribute", "buffer", "expand", "tessellate")
_EQUATION = re.compile(r"\w+ *(: *[\w<>]+ *)?=[^=]")

KNOWN = """
import std.lights
import std.terms
import std.frames.{FullScreen}

abstract material Named : Surface {
    param x : float in 0..1
    param y : float in 0..1
    param t : float in 0..1
    param n : int
    param u : uint
    param v : vec3
    param w : vec3
    param a : rgb
    param b : rgb
    param m : mat4
    param time : float per frame
    map albedo : texture2d
    map bumps  : texture2d = flat_normal
    map sky    : texture_cube = black
    map shadow : depth2d
    map sheets : texture2d_array
}

material Solid {}

pass Blurred : FullScreen {
    map source : texture2d
    target color : rgba8 = source(uv)
}

abstract frame Drawn {
    models scene
    lit = Forward(scene)
    output picture = lit.color
}
"""
"""What the code of a cell may use, besides the slots of a surface; the pages say the same."""


@dataclass(frozen=True)
class Cell:
    """The last cell of a row."""

    kind: str
    row: str
    codes: tuple[str, ...]

    def __str__(self) -> str:
        return self.row

    @property
    def modules(self) -> tuple[str, ...]:
        return tuple(sorted({code for code in self.codes if code.startswith("std.")}))

    @property
    def mixins(self) -> tuple[str, ...]:
        return tuple(code for code in self.codes if code.startswith("+ "))

    @property
    def tried(self) -> tuple[str, ...]:
        return tuple(c for c in self.codes if c not in (*self.modules, *self.mixins))


def cells(page: str) -> Iterator[Cell]:
    """The last cells of all marked tables of a page."""
    for kind, rows in MARKED.findall(page):
        for row in rows.splitlines()[2:]:
            *_, last, _ = BEHIND_BAR.split(row)
            codes = tuple(code.replace("\\|", "|") for code in CODE.findall(last))
            yield Cell(kind, row, codes)


def unmarked_tables(page: str) -> int:
    """The number of tables that no mark stands before."""
    return len(re.findall(r"^\|[-| ]+\|$", page, re.MULTILINE)) - len(MARKED.findall(page))


def program(tried: list[Cell]) -> str:
    """A file that has the code of several cells, which need the same modules."""
    imports = "".join(f"import {module}\n" for module in tried[0].modules)
    return f"{imports}{KNOWN}" + "".join(
        _DECLARED[cell.kind](cell, f"Tried{number}") for number, cell in enumerate(tried)
    )


def said_of(source: str) -> str:
    """What the compiler says of a file, but for what nothing reads or needs yet."""
    found = [each for each in burnish.check(source) if each.rule.code not in ("B0210", "B0811")]
    return render_all(found)


def _types(cell: Cell, name: str) -> str:
    """Arguments of a function, which may have any type."""
    formals = ", ".join(f"tried_{number}: {code}" for number, code in enumerate(cell.tried))
    return f"fn {name.lower()}({formals}) -> float = 0\n"


def _material(cell: Cell, name: str) -> str:
    """Equations and members of a material, members of a pass, and declarations beside them."""
    members, of_pass, beside = [], [], []
    for number, code in enumerate(cell.tried):
        first = code.split()[0]
        if first in DECLARATIONS:
            beside.append(code)
        elif first in OF_PASSES:
            of_pass.append(code)
        elif first in MEMBERS or _EQUATION.match(code):
            members.append(code)
        else:
            members.append(f"tried_{number} = {code}")
    header = " ".join((f"material {name} : Named", *cell.mixins))
    records = (_record(header, members), _record(f"pass {name}Pass : Forward", of_pass))
    return "\n".join((*records, *beside, ""))


def _record(header: str, members: Iterable[str]) -> str:
    return "\n".join((f"{header} {{", *members, "}")) + "\n"


_DECLARED: Mapping[str, Callable[[Cell, str], str]] = {
    "types": _types,
    "a material": _material,
    "a rig": lambda cell, name: _record(f"rig {name}", cell.tried),
    "a frame": lambda cell, name: _record(f"frame {name} : Drawn", cell.tried),
}
