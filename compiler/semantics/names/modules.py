"""Modules and symbols: one file with the names that it can see, and their declarations.

``loader.py`` reads files and links them. The rest of semantics asks a module what a name means. A
module sees its own declarations, those it imports, and everything the library's prelude declares.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from ....support.frozen import fresh, frozen, record
from ...diagnostics.fixes import Edit, Fix, FixIt, Hint
from ...diagnostics.nearest import nearest_in, respelling, similarity
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


_ALIKE = 0.75
"""The least similarity of an unknown name and one that the file does not even import."""


@frozen
class Offer:
    """A declaration of a library file that a file has not imported."""

    path: str
    """The import path of the library file."""
    kind: str
    """The word with which it is declared, such as ``light``; empty for some rare ones."""
    arguments: tuple[str, ...] = ()
    """The names of a function's arguments."""


Offers = Mapping[str, Sequence[Offer]]
"""What library files declare, by name; several may have declarations of one name."""


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
    offers: Callable[[], Offers] = dict
    """Finds what the library's files declare, by name: an unknown name may be one of these."""

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

    def hint(self, name: ast.Name, known: Iterable[str], kinds: Sequence[str] = ()) -> Hint:
        """The hint for an unknown name: import it, or write the nearest known one.

        A name of the library that is nearly the same may be meant, too, if it is of these kinds.
        """
        offers, written = self.offers(), name.text
        if written in offers:
            return _imported(name, written, offers[written][0].path)
        if called := self._called_elsewhere(name, offers, kinds):
            return called
        fitting = {each for each, offered in offers.items() if offered[0].kind in kinds}
        meant = _without_kind(written, fitting)
        if meant is None:
            if near := respelling(written, name.span, known):
                return near
            found = nearest_in(name.span.source, written, fitting)
            meant = found if found and similarity(written, found) >= _ALIKE else None
        return "" if meant is None else _imported(name, meant, offers[meant][0].path)

    def _called_elsewhere(self, name: ast.Name, offers: Offers, kinds: Sequence[str]) -> Hint:
        """The hint for a name that another system has for something of the library."""
        from ....stdlib.builtins.in_library import in_library

        meant = in_library(name.text)
        offered = () if meant is None else offers.get(meant.name, ())
        offer = next((each for each in offered if meant and each.path == meant.path), None)
        if meant is None or offer is None or offer.kind not in kinds:
            return ""
        advice = f" ({meant.advice})" if meant.advice else ""
        said = f"it is `{meant.name}({', '.join(offer.arguments)})` of the library{advice}"
        is_seen = any(symbol.module.is_standard for symbol in self.known(meant.name))
        on_top = None if is_seen else _import_on_top(name, meant.name, meant.path)
        text = said if on_top is None else f"{said}: {on_top.text}"
        return text if advice else _respelt(name, meant.name, text, on_top)

    def visible(self) -> Iterator[str]:
        """All names that ``find`` knows."""
        yield from self.declared
        yield from self.imported
        if self.prelude is not None:
            yield from self.prelude.declared


def _without_kind(written: str, fitting: Iterable[str]) -> str | None:
    """The name that a written one is without its case, ``_`` and the word ``light``.

    So are ``smoothUnion``, and ``DirectionalLight``.
    """
    short = written.casefold().replace("_", "").removesuffix("light")
    return next((each for each in fitting if each.casefold().replace("_", "") == short), None)


def _imported(name: ast.Name, meant: str, path: str) -> Hint:
    """A hint to import a name of the library, and to write it if it is misspelt."""
    on_top = _import_on_top(name, meant, path)
    if meant == name.text:
        return on_top
    return _respelt(name, meant, f"did you mean `{meant}`? {on_top.text}", on_top)


def _import_on_top(name: ast.Name, meant: str, path: str) -> FixIt:
    """A hint to add the import of a name of the library to the file that has ``name``."""
    declaration = f"import {path}.{{{meant}}}"
    return inserted_on_top(f"add `{declaration}`", name.span.source, declaration)


def _respelt(name: ast.Name, meant: str, said: str, on_top: FixIt | None) -> Hint:
    """A hint with the edits that write ``meant`` for ``name``, and add its import if it needs one.

    There are no edits where the name is not written in the text as it is.
    """
    if name.span.text != name.text:
        return said
    added = (Fix(()),) if on_top is None else on_top.fixes
    return FixIt(said, tuple(Fix((*fix.edits, Edit(name.span, meant))) for fix in added))
