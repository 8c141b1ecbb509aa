"""Keys of a file's declarations: what the check of each of them can depend on.

A declaration reads what it names. So its key is a digest of its text and of the texts of all
declarations that it names, and that these name in turn; of the blocks and spaces of the file, which
count without being named; of the imported files; and of the materials, lights, rigs and passes that
it is tried with, as far as they count. ``unused.py`` asks for the keys.
"""

from __future__ import annotations

import re
from _blake2 import blake2b  # As in hashlib, which takes longer to load than a dozen modules.
from collections.abc import Hashable, Iterable, Iterator, Mapping

from ....support.frozen import cached_property
from ...syntax import ast
from ..names.modules import Module, Symbol

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

    def of(self, symbol: Symbol) -> Hashable:
        """The key of a declaration."""
        match symbol.declaration:
            case ast.Record(kind="material", abstract=False):
                around = self._of_drawn
            case (
                ast.Function(kind="fn")
                | ast.Constant()
                | ast.StructDeclaration()
                | ast.Enumeration()
            ):
                around = b""
            case _:
                around = self._of_all
        return self._surroundings, around, symbol.name, self._wholes[symbol.name]

    def readers(self, name: str) -> set[str]:
        """The names of the declarations that name another one, directly or not."""
        found: set[str] = set()
        _spread(self._named_by, name, found)
        return found

    def add_named(self, name: str, found: set[str]) -> None:
        """Add to ``found`` what a declaration names, directly or not.

        Names that are there already are not followed again.
        """
        _spread(self._named, name, found)

    @cached_property
    def _of_drawn(self) -> bytes:
        return self._together(symbol for pair in self._drawn for symbol in pair)

    @cached_property
    def _of_all(self) -> bytes:
        return self._together(self._tried_with)

    def _together(self, symbols: Iterable[Symbol]) -> bytes:
        """A digest of symbols in their order; those of other files have their place in it."""
        return _digest(
            self._wholes[symbol.name] if symbol.module is self._module else _identity(symbol)
            for symbol in symbols
        )

    @cached_property
    def _surroundings(self) -> bytes:
        """A digest of all that a declaration may depend on besides the declarations it names."""
        module = self._module
        imported = (
            f"{name} {symbol.module.file.source.name}"
            for name, symbols in module.imported.items()
            for symbol in symbols
        )
        unnamed = (
            _text(symbol)
            for symbols in module.declared.values()
            for symbol in symbols
            if isinstance(symbol.declaration, _EVERYWHERE)
        )
        doubts = (str(module.incomplete), *sorted(module.missing), *sorted(module.doubtful))
        files = (each.file.source.text for each in _imported_files(module))
        return _digest(_bytes("\n".join(part)) for part in (imported, unnamed, doubts, files))

    @cached_property
    def _texts(self) -> Mapping[str, str]:
        """The texts of the declarations of each name, each behind the kind of its declaration."""
        return {
            name: "\n".join(f"{type(s.declaration).__name__} {_text(s)}" for s in symbols)
            for name, symbols in self._module.declared.items()
        }

    @cached_property
    def _named(self) -> Mapping[str, frozenset[str]]:
        """The declared names that stand in the declarations of each name."""
        declared = self._module.declared.keys()
        return {
            name: frozenset(declared & set(_WORD.findall(text)))
            for name, text in self._texts.items()
        }

    @cached_property
    def _named_by(self) -> Mapping[str, set[str]]:
        found: dict[str, set[str]] = {name: set() for name in self._texts}
        for name, others in self._named.items():
            for other in others:
                found[other].add(name)
        return found

    @cached_property
    def _wholes(self) -> Mapping[str, bytes]:
        """For each name, the digest of its declarations and of all that they name."""
        wholes: dict[str, bytes] = {}
        for circle in _circles(self._named):
            behind = {wholes[other] for name in circle for other in self._named[name] - circle}
            own = (_bytes(self._texts[name]) for name in sorted(circle))
            wholes.update(dict.fromkeys(circle, _digest((*own, *sorted(behind)))))
        return wholes


def _spread(
    graph: Mapping[str, frozenset[str]] | Mapping[str, set[str]], start: str, found: set[str]
) -> None:
    """Add to ``found`` all to which arrows lead from a start, without going through known ones."""
    pending = [start]
    while pending:
        new = graph[pending.pop()] - found
        found |= new
        pending += new


def _circles(graph: Mapping[str, frozenset[str]]) -> Iterator[frozenset[str]]:
    """The strongly connected components of a graph, each behind those to which its arrows lead.

    Source: Tarjan, *Depth-first search and linear graph algorithms*, 1972; without recursion.
    """
    numbers: dict[str, int] = {}
    lowest: dict[str, int] = {}
    open_: dict[str, None] = {}
    for root in graph:
        pending = [] if root in numbers else [(root, iter(graph[root]))]
        while pending:
            node, others = pending[-1]
            if node not in numbers:
                numbers[node] = lowest[node] = len(numbers)
                open_[node] = None
            for other in others:
                if other not in numbers:
                    pending.append((other, iter(graph[other])))
                    break
                if other in open_:
                    lowest[node] = min(lowest[node], lowest[other])
            else:
                pending.pop()
                if pending:
                    before, _ = pending[-1]
                    lowest[before] = min(lowest[before], lowest[node])
                if lowest[node] == numbers[node]:
                    yield frozenset(_closed(open_, node))


def _closed(open_: dict[str, None], first: str) -> Iterator[str]:
    """The nodes that were opened since ``first``, which are no longer open."""
    while first in open_:
        yield open_.popitem()[0]


def _text(symbol: Symbol) -> str:
    span = symbol.declaration.span
    return span.source.text[span.start : span.end]


def _identity(symbol: Symbol) -> bytes:
    return _bytes(f"{symbol.module.file.source.name} {symbol.name}")


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


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


def _digest(parts: Iterable[bytes]) -> bytes:
    """A digest of texts, each with its length."""
    made = blake2b(digest_size=16)
    for part in parts:
        made.update(len(part).to_bytes(8, "little"))
        made.update(part)
    return made.digest()
