"""Remembers which declarations of a file were right, so that an edit costs what it changes.

An editor asks for the mistakes of a file at each edit, and most of its declarations are as they
were. ``unused.py`` tries none again that was right before, if the text of everything that it can
read is the same. A declaration reads what it names, so its key is a digest of its text and of those
of all declarations that it names, and these name in turn; of how the file's other names are
declared; of the imported files; and of the materials, lights, rigs and passes that it is tried
with, as far as they count. Only outcomes of checks in which nothing at all was found are kept.

Nothing is remembered while graphs are verified or shown (``is_watched``), as in tests.
"""

from __future__ import annotations

import re
from collections import OrderedDict
from collections.abc import Hashable, Iterable
from hashlib import blake2b

from ....support.frozen import cached_property, frozen
from ....support.locks import lock
from ...syntax import ast
from ..names.modules import Module, Symbol

MOST_KEPT = 16_384
"""The largest number of outcomes that are kept, of some 500 bytes each."""

Place = tuple[str, int]
"""A declaration of a file: its name, and its number among those of this name."""


@frozen
class Outcome:
    """What checking a declaration did, besides finding nothing."""

    reached: frozenset[Place]
    """The declarations of the file that were checked with it."""
    nodes: int
    """The number of nodes of its trees."""
    length: int
    """The number of characters that were tried for it."""


class KnownRight:
    """Outcomes by the keys of declarations, those that were used last. Threads may share it."""

    def __init__(self, most: int = MOST_KEPT) -> None:
        self._most = most
        self._kept: OrderedDict[Hashable, Outcome] = OrderedDict()
        self._library: object = None
        self._lock = lock()

    def find(self, key: Hashable, library: object) -> Outcome | None:
        """The outcome of a declaration that was right with this library, if it is remembered."""
        with self._lock:
            if library is not self._library or key not in self._kept:
                return None
            self._kept.move_to_end(key)
            return self._kept[key]

    def keep(self, outcomes: Iterable[tuple[Hashable, Outcome]], library: object) -> None:
        """Remember outcomes; those with a library whose files have changed are forgotten."""
        with self._lock:
            if library is not self._library:
                self._kept.clear()
                self._library = library
            for key, outcome in outcomes:
                self._kept[key] = outcome
                self._kept.move_to_end(key)
            while len(self._kept) > self._most:
                self._kept.popitem(last=False)


KNOWN_RIGHT = KnownRight()
"""The outcomes of this process."""

_WORD = re.compile(r"\w+")
_EVERYWHERE = ast.ExternBlock | ast.ExternMember | ast.Space
"""Declarations that others may depend on without naming them."""


class Keys:
    """The keys of a file's declarations, for the symbols that they are tried with."""

    def __init__(
        self, module: Module, tried_with: Iterable[Symbol], drawn: Iterable[tuple[Symbol, Symbol]]
    ) -> None:
        """``drawn`` are the rigs and passes with which materials have to agree."""
        self._module = module
        self._tried_with = tuple(tried_with)
        self._drawn = tuple(drawn)
        self._digests: dict[str, bytes] = {}
        """The digests of all declarations of a name, with all that they name."""

    def of(self, symbol: Symbol) -> Hashable:
        """The key of a declaration."""
        match symbol.declaration:
            case ast.Record(kind="material", abstract=False):
                around = self._of_drawn
            case ast.Function(kind="fn") | ast.Constant() | ast.StructDeclaration():
                around = b""
            case _:
                around = self._of_all
        return self._surroundings, around, symbol.name, self._whole(symbol.name)

    @cached_property
    def _of_drawn(self) -> bytes:
        return self._together(symbol for pair in self._drawn for symbol in pair)

    @cached_property
    def _of_all(self) -> bytes:
        return self._together(self._tried_with)

    def _together(self, symbols: Iterable[Symbol]) -> bytes:
        """A digest of symbols in their order; those of the library have their place in it."""
        parts = [
            self._whole(symbol.name) if symbol.module is self._module else _identity(symbol)
            for symbol in symbols
        ]
        return _digest(parts)

    @cached_property
    def _surroundings(self) -> bytes:
        """A digest of all that a declaration may depend on besides the texts that it names."""
        module = self._module
        declared = [
            f"{name} {type(s.declaration).__name__} {getattr(s.declaration, 'kind', '')} "
            f"{getattr(s.declaration, 'abstract', '')}"
            for name, symbols in module.declared.items()
            for s in symbols
        ]
        imported = [
            f"{name} {symbol.module.file.source.name}"
            for name, symbols in module.imported.items()
            for symbol in symbols
        ]
        unnamed = [
            _text(symbol)
            for symbols in module.declared.values()
            for symbol in symbols
            if isinstance(symbol.declaration, _EVERYWHERE)
        ]
        files = [each.file.source.text for each in _imported_files(module)]
        doubts = [str(module.incomplete), *sorted(module.missing), *sorted(module.doubtful)]
        parts = ("\n".join(part) for part in (declared, imported, unnamed, doubts))
        return _digest(part.encode("utf-8", "replace") for part in (*parts, *files))

    def _whole(self, name: str) -> bytes:
        """The digest of the declarations of a name, and of all that they name, directly or not."""
        if name not in self._digests:
            found, pending = {name}, [name]
            while pending:
                new = self._named[pending.pop()] - found
                found |= new
                pending += new
            self._digests[name] = _digest(self._own[each] for each in sorted(found))
        return self._digests[name]

    @cached_property
    def _texts(self) -> dict[str, str]:
        return {
            name: "\n".join(map(_text, symbols)) for name, symbols in self._module.declared.items()
        }

    @cached_property
    def _own(self) -> dict[str, bytes]:
        return {name: text.encode("utf-8", "replace") for name, text in self._texts.items()}

    @cached_property
    def _named(self) -> dict[str, frozenset[str]]:
        """The declared names that stand in the declarations of each name."""
        declared = self._module.declared.keys()
        return {
            name: frozenset(declared & set(_WORD.findall(text)))
            for name, text in self._texts.items()
        }


def _text(symbol: Symbol) -> str:
    span = symbol.declaration.span
    return span.source.text[span.start : span.end]


def _identity(symbol: Symbol) -> bytes:
    return f"{symbol.module.file.source.name} {symbol.name}".encode("utf-8", "replace")


def _imported_files(module: Module) -> list[Module]:
    """The files that a file imports, and these in turn, without those of the library."""
    found: dict[int, Module] = {}
    pending = [module]
    while pending:
        symbols = (s for known in pending.pop().imported.values() for s in known)
        for inner in (s.module for s in symbols if not s.module.is_standard):
            if inner is not module and id(inner) not in found:
                found[id(inner)] = inner
                pending.append(inner)
    return sorted(found.values(), key=lambda each: each.file.source.name)


def _digest(parts: Iterable[bytes]) -> bytes:
    """A digest of texts, each with its length."""
    made = blake2b(digest_size=16)
    for part in parts:
        made.update(len(part).to_bytes(8, "little"))
        made.update(part)
    return made.digest()
