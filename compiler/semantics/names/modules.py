"""Modules and symbols: one file with the names that it can see, and their declarations.

``loader.py`` reads files and links them. The rest of semantics asks a module what a name means. A
module sees its own declarations, those it imports, and everything the library's prelude declares.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ....support.frozen import cached_property, fresh, frozen, record
from ...diagnostics.fixes import Edit, Fix, FixIt, Hint
from ...diagnostics.nearest import nearest_in, respelt, similarity
from ...syntax import ast
from ...syntax.rewriting import inserted_on_top

if TYPE_CHECKING:
    from ....stdlib.other_names import Meant

Named = (
    ast.Record | ast.Mixin | ast.Function | ast.Rig | ast.StructDeclaration
    | ast.Enumeration | ast.ExternBlock | ast.ExternMember | ast.Space | ast.Constant
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

    @property
    def import_path(self) -> str:
        """The path by which a module of the library is imported, such as ``std.mtlx.noise``."""
        return self.file.source.name.removesuffix(".burnish").replace("/", ".")

    @cached_property
    def read(self) -> frozenset[str]:
        """The names in all expressions of the file; ``light.name`` counts as one, too.

        Each declaration may ask for them, and they are looked for in all of the others.
        """
        return frozenset(_names_in(self.file.declarations))

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

        A name of the library that is nearly the same, or that other systems call so, may be meant,
        too, if it is of these kinds.
        """
        offers, written = self.offers(), name.text
        if written in offers:
            return _imports(name, [offer.path for offer in offers[written]])
        fitting = {
            each: offer.path
            for each, offered in offers.items()
            for offer in reversed(offered)
            if offer.kind in kinds
        }
        near = nearest_in(name.span.source, written, known)
        if near is None or not _is_alike(near, written):
            meant = _said_elsewhere(written, fitting)
            if meant is not None and _offered(meant, offers, kinds):
                return self._meant(name, meant)
            if told := _compared(written):
                return told
        if near:
            return respelt(written, name.span, near)
        found = nearest_in(name.span.source, written, fitting)
        if found is None or similarity(written, found) < _ALIKE:
            return ""
        return _imported(name, found, fitting[found])

    def _meant(self, name: ast.Name, meant: Meant) -> Hint:
        """The hint for a name that means something of the library, or one of several."""
        if len(meant.names) > 1:
            choice = ", ".join(f"`{each}`" for each in meant.names)
            return f"`{meant.path}` has {choice}: import what you need"
        (one,) = meant.names
        modules = (symbol.module for symbol in self.known(one))
        is_seen = any(each.is_standard and each.import_path == meant.path for each in modules)
        if not meant.advice:
            seen = respelt(name.text, name.span, one)
            return seen if is_seen else _imported(name, one, meant.path)
        said = f"did you mean `{one}`, where {meant.advice}?"
        return said if is_seen else f"{said} {_import_on_top(name, one, meant.path).text}"

    def visible(self) -> Iterator[str]:
        """All names that ``find`` knows."""
        yield from self.declared
        yield from self.imported
        if self.prelude is not None:
            yield from self.prelude.declared


def _names_in(root: object) -> Iterator[str]:
    """The names in all expressions of a syntax tree: `name`, and `light.name`."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        match node:
            case ast.Reference(name=name) | ast.Field(name=ast.Name(text=name)):
                yield name
        waiting += ast.parts(node)


def _is_alike(one: str, other: str) -> bool:
    """True if two names differ only in their style, as ``softLight`` and ``soft_light`` do."""
    from ....stdlib.other_names import folded

    return folded(one) == folded(other)


def _said_elsewhere(written: str, fitting: Mapping[str, str]) -> Meant | None:
    """What the library has for a name of another system; one of several names may be meant.

    It differs in its style, as ``softLight`` does; has the word ``light`` beside it, as
    ``HemisphericLamp``; or is another one, as ``luma``.
    """
    from ....stdlib.other_names import BY_FOLDED, Meant, folded

    plain = folded(written)
    alike = (plain, plain.removesuffix("light"))
    found = min((each for each in fitting if folded(each) in alike), default=None)
    return BY_FOLDED.get(plain) if found is None else Meant(fitting[found], (found,))


def _compared(written: str) -> str:
    """What the pages for those who come from other systems say of a name of theirs."""
    from ....stdlib.comparisons import compared

    row = compared().get(written)
    return "" if row is None else row.hint


def _offered(meant: Meant, offers: Offers, kinds: Sequence[str]) -> bool:
    """True if all that may be meant is there, and of these kinds."""
    return all(
        any(offer.path == meant.path and offer.kind in kinds for offer in offers.get(each, ()))
        for each in meant.names
    )


def _imports(name: ast.Name, paths: Iterable[str]) -> Hint:
    """A hint to import a name from the file of the library that has it, or from one of several."""
    ways = [_import_on_top(name, name.text, path) for path in dict.fromkeys(paths)]
    said = " or ".join(way.text.removeprefix("add ") for way in ways)
    return FixIt(f"add {said}", tuple(fix for way in ways for fix in way.fixes))


def _import_on_top(name: ast.Name, meant: str, path: str) -> FixIt:
    """A hint to add the import of a name of the library to the file that has ``name``."""
    declaration = f"import {path}.{{{meant}}}"
    return inserted_on_top(f"add `{declaration}`", name.span.source, declaration)


def _imported(name: ast.Name, meant: str, path: str) -> Hint:
    """A hint to write a name of the library for one that is not, and to import it."""
    on_top = _import_on_top(name, meant, path)
    said = f"did you mean `{meant}`? {on_top.text}"
    if name.span.text != name.text:
        return said
    respelt = Edit(name.span, meant)
    return FixIt(said, tuple(Fix((*fix.edits, respelt)) for fix in on_top.fixes))
