"""Files of Burnish that are being written: imports,
declarations, and what expressions ask of them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from .expressions import Expression, laid_out
from .leaves.catalogue import catalogue
from .names import Names

_WIDTH = 118
"""The longest line with a comment, in characters."""
_WORD = re.compile(r"\w+")
_WIDE = 16
"""Names are aligned with others that are up to this longer than the shortest."""


@dataclass
class File:
    """A file that is being written. ``path`` is where it lies in the folder, such as
    ``materialx/layer``."""

    path: str
    imports: dict[str, set[str]] = field(default_factory=dict)
    declarations: list[str] = field(default_factory=list)
    heading: str = ""
    is_whole: bool = False
    """True if declarations stay that nothing of this file reads."""
    helpers: dict[str, str] = field(default_factory=dict)
    """The declarations that are left out where nothing reads them, with their names."""
    _structures: dict[tuple[str, tuple[str, ...]], str] = field(default_factory=dict)
    maps: dict[str, str] = field(default_factory=dict)
    """The files of textures by the names of their maps: one name is one file, in all materials."""
    names: Names = field(default_factory=lambda: Names((), catalogue()))

    def imported(self, module: str, name: str) -> str:
        """A name of the library, which this file imports."""
        self.imports.setdefault(module, set()).add(name)
        return name

    def imported_from(self, file: File, name: str) -> str:
        """A name of another file of the import. Imports look beside the importing file first."""
        if file is self:
            return name
        folder, _, stem = file.path.rpartition("/")
        beside = folder == self.path.rpartition("/")[0]
        return self.imported(stem if beside else file.path.replace("/", "."), name)

    def structure(self, wanted: str, types: tuple[str, ...]) -> str:
        """The name of a structure whose members have these types: the same for the same."""
        key = (wanted, types)
        if key not in self._structures:
            self._structures[key] = self.names.fresh(wanted)
        return self._structures[key]

    def helper(self, name: str, text: str) -> None:
        """Add a declaration that is only for others; the same text is written once."""
        if text not in self.helpers:
            self.helpers[text] = name
            self.declarations.append(text)

    def keep(self, is_kept: Callable[[str], bool]) -> None:
        """Remove all other declarations."""
        self.declarations[:] = filter(is_kept, self.declarations)

    def text(self) -> str:
        """The whole file, with the imports that it uses."""
        declarations = self._read_declarations()
        used = _words(declarations)
        imports = {module: names & used for module, names in self.imports.items() if names & used}
        parts = ["burnish 1"]
        if self.heading:
            parts.append(self.heading)
        if imports:
            parts.append(
                "\n".join(_import(module, names) for module, names in sorted(imports.items()))
            )
        return "\n\n".join(parts + declarations) + "\n"

    def _read_declarations(self) -> list[str]:
        """All declarations but for helpers that no other declaration names."""
        kept = self.declarations
        while not self.is_whole:
            words = Counter(word for text in kept for word in set(_WORD.findall(text)))
            found = [text for text in kept if words[self.helpers.get(text, "")] != 1]
            if len(found) == len(kept):
                return found
            kept = found
        return kept


def _words(texts: Iterable[str]) -> set[str]:
    return {word for text in texts for word in _WORD.findall(text)}


def _import(module: str, names: Iterable[str]) -> str:
    line = f"import {module}.{{{', '.join(sorted(names))}}}"
    if len(line) <= 118:
        return line
    lines = [""]
    for name in sorted(names):
        if len(lines[-1]) + len(name) > 108:
            lines.append("")
        lines[-1] += f"{name}, "
    body = "\n    ".join(line.rstrip() for line in lines).removesuffix(",")
    return f"import {module}.{{\n    {body}\n}}"


@dataclass(frozen=True)
class Equation:
    """A slot of a material or a part of a function: ``name : type = value  /// doc``."""

    name: str
    value: Expression | None
    type: str = ""
    doc: str = ""
    prefix: str = ""
    suffix: str = ""
    """What stands between the type and the value, such as a range."""
    group: str = ""
    """The title above this row and those of the same group behind it."""


def equations(rows: list[Equation], indent: int = 1) -> list[str]:
    """The lines of equations, with their signs aligned as far as
    their names are of alike length."""
    heads = [f"{row.prefix}{row.name}" for row in rows]
    shortest = min(map(len, heads), default=0)
    width = max((len(head) for head in heads if len(head) <= shortest + _WIDE), default=0)
    space = "    " * indent
    lines = []
    for head, row in zip(heads, rows, strict=True):
        line = (
            f"{space}{head:{width}} : {row.type}{row.suffix}"
            if row.type
            else f"{space}{head:{width}}"
        )
        if row.value is not None:
            line += " = "
            line += laid_out(row.value, len(line), indent)
        lines.append((line, row.doc))
    column = max((len(line) for line, doc in lines if doc and _fits(line, doc)), default=0)
    texts = [_documented(line, doc, space, column) for line, doc in lines]
    return [part for row in zip(_titles(rows, space), texts, strict=True) for part in row if part]


def _titles(rows: list[Equation], space: str) -> list[str]:
    """For each row the title of the group that begins there, below an empty line."""
    found, last = [], ""
    for number, row in enumerate(rows):
        title = f"{space}// {row.group}" if row.group else ""
        found.append(("\n" if number else "") + title if row.group != last else "")
        last = row.group
    return found


def _fits(line: str, doc: str) -> bool:
    return "\n" not in line and len(line) + len(doc) <= _WIDTH - len("    /// ")


def _documented(line: str, doc: str, space: str, column: int) -> str:
    """A line with its doc comment: behind it if there is room, otherwise above it."""
    if not doc:
        return line
    if _fits(line, doc):
        at = column + 4 if column + 8 + len(doc) <= _WIDTH else len(line) + 4
        return f"{line:{at}}/// {doc}"
    return "\n".join(
        [*(f"{space}/// {part}" for part in wrapped(doc, _WIDTH - len(space) - 4)), line]
    )


def wrapped(text: str, width: int) -> list[str]:
    """A text in lines of at most ``width`` characters."""
    import textwrap

    return textwrap.wrap(" ".join(text.split()), width) or [""]


def one_line(text: str) -> str:
    """A text from a document as part of a comment: one line, and nothing that ends it."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())
