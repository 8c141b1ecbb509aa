"""Modules and symbols: one file with the names that it can see, and their declarations.

``loader.py`` reads files and links them. The rest of semantics asks a module what a name means. A
module sees its own declarations, those it imports, and everything the library's prelude declares.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from ....support.frozen import fresh, frozen, record
from ...diagnostics.fixes import Hint
from ...diagnostics.nearest import respelling
from ...syntax import ast
from ...syntax.rewriting import inserted_on_top

Named = (
    ast.Record | ast.Mixin | ast.Function | ast.Rig | ast.StructDeclaration
    | ast.ExternBlock | ast.ExternMember | ast.Space | ast.Constant
)  # fmt: skip


@frozen(eq=False)
class Symbol:
    """A declaration and the module whose names it sees; compared by identity."""

    declaration: Named
    module: Module

    @property
    def name(self) -> str:
        """The declared name."""
        return self.declaration.name.text


@record
class Module:
    """One file with everything it can name; functions may share a name (overloads)."""

    file: ast.File
    path: Path | None
    is_standard: bool = False
    """True if it is the standard library's, and so the same module in all compiles."""
    declared: dict[str, tuple[Symbol, ...]] = fresh(factory=dict)
    imported: dict[str, tuple[Symbol, ...]] = fresh(factory=dict)
    chosen: set[tuple[Path | None, str]] = fresh(factory=set)
    """Names that were imported one by one, with their files."""
    missing: set[str] = fresh(factory=set)
    """Names whose import failed, about which enough has been said."""
    incomplete: bool = False
    """True if a file to be imported as a whole could not be, and its names are not known."""
    doubtful: dict[str, Callable[[], None]] = fresh(factory=dict)
    """Names that several imported files declare, with a function that reports one when used."""
    prelude: Module | None = None
    offered: Callable[[str], str] = lambda _name: ""
    """The library file that declares a name, as an import path; empty if none does."""

    def find(self, name: str) -> tuple[Symbol, ...]:
        """The declarations that ``name`` stands for here; empty if there are none."""
        if name in self.doubtful:
            self.doubtful.pop(name)()
        return self.known(name)

    def known(self, name: str) -> tuple[Symbol, ...]:
        """The symbols of a name for suggestions: an ambiguous import is not reported."""
        found = self.declared.get(name) or self.imported.get(name)
        if not found and self.prelude is not None:
            found = self.prelude.declared.get(name)
        return found or ()

    def hint(self, name: ast.Name, known: Iterable[str]) -> Hint:
        """The hint for an unknown name: import it, or write the nearest known one."""
        path = self.offered(name.text)
        if not path:
            return respelling(name.text, name.span, known)
        declaration = f"import {path}.{{{name.text}}}"
        return inserted_on_top(f"add `{declaration}`", name.span.source, declaration)

    def visible(self) -> Iterator[str]:
        """All names that ``find`` knows."""
        yield from self.declared
        yield from self.imported
        if self.prelude is not None:
            yield from self.prelude.declared
