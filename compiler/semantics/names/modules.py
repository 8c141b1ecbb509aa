"""Modules and symbols: one file with the names that it can see, and their declarations.

``loader.py`` reads files and links them. The rest of semantics asks a module what a name means. A
module sees its own declarations, those it imports, and everything the library's prelude declares.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from ....support.frozen import fresh, frozen, record
from ...diagnostics.fixes import Edit, Fix, FixIt, Hint, fix_it
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
    offers: Callable[[], Mapping[str, Offer]] = dict
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
            return _imported(name, written, offers[written].path)
        fitting = {each for each, offer in offers.items() if offer.kind in kinds}
        meant = _without_kind(written, fitting)
        if meant is None:
            if near := respelling(written, name.span, known):
                return near
            found = nearest_in(name.span.source, written, fitting)
            meant = found if found and similarity(written, found) >= _ALIKE else None
        return "" if meant is None else _imported(name, meant, offers[meant].path)

    def instead(self, name: ast.Name, meant: Sequence[str]) -> Hint:
        """The hint for a name that other systems have for something of the library.

        ``meant`` are the names here, the likeliest first; empty if the library has none of them.
        """
        offers = self.offers()
        known = [each for each in meant if self.known(each) or each in offers]
        if not known:
            return ""
        said = f"did you mean {' or '.join(f'`{each}`' for each in known)}?"
        first = known[0]
        if self.known(first):
            return fix_it(said, (name.span, first)) if name.span.text == name.text else said
        return _imported(name, first, offers[first].path, said)

    def visible(self) -> Iterator[str]:
        """All names that ``find`` knows."""
        yield from self.declared
        yield from self.imported
        if self.prelude is not None:
            yield from self.prelude.declared


def _without_kind(written: str, fitting: Iterable[str]) -> str | None:
    """The name that a written one has beside the word ``light``, as in ``DirectionalLight``."""
    short = written.casefold().replace("_", "").removesuffix("light")
    return next((each for each in fitting if each.casefold() == short), None)


def _imported(name: ast.Name, meant: str, path: str, asked: str = "") -> Hint:
    """A hint to import a name of the library, and to write it if it is misspelt.

    ``asked`` is the question in front, where several names may be meant.
    """
    declaration = f"import {path}.{{{meant}}}"
    on_top = inserted_on_top(f"add `{declaration}`", name.span.source, declaration)
    if meant == name.text:
        return on_top
    said = f"{asked or f'did you mean `{meant}`?'} {on_top.text}"
    respelt = Edit(name.span, meant)
    if name.span.text != name.text:
        return said
    return FixIt(said, tuple(Fix((*fix.edits, respelt)) for fix in on_top.fixes))
