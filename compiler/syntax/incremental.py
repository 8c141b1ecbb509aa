"""Parses a user's file again after an edit: only the sections that the edit has changed.

The front end calls ``parse`` for each file. Sections are remembered by their text, so it does not
matter where they stood before, nor in which file: the trees of those without a mistake, and of
others that they have some. Many texts are read once, so a section is remembered when it is read for
the second time. If anything in a file has
to be reported, it is cut into tokens as a whole, since messages depend on what stands around a
mistake; but even then, other sections are not parsed again.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from itertools import chain, pairwise

from ...support.locks import lock
from ..diagnostics.diagnostic import Report
from ..diagnostics.source import Source
from . import ast, parser
from .parser import Known, Part, parse_section
from .sections import Section, sections
from .stored import loaded, stored

MOST_KEPT = 16 * 1024 * 1024
"""The largest size of all remembered sections: eight to thirty bytes for each character."""

_Key = tuple[str, str]
"""The text of a section, and the header that follows."""

_Content = Callable[[], Part] | None
"""Loads the content of a section; None if that cannot be read alone."""

_MISTAKEN = b""
"""Stands for the tree of a section that cannot be read alone."""
_READ_ONCE = b"?"
"""Stands for the tree of a section that was read once, and is not remembered yet."""


class KnownSections:
    """Trees of sections by their texts, those that were used last. Threads may share it."""

    def __init__(self, most: int = MOST_KEPT) -> None:
        self._most = most
        self._size = 0
        self._kept: OrderedDict[_Key, bytes] = OrderedDict()
        self._lock = lock()

    def find(self, keys: Iterable[_Key]) -> list[bytes | None]:
        """For each section its tree, as bytes, if it is remembered."""
        kept = self._kept
        with self._lock:
            return [self._used(key) if key in kept else None for key in keys]

    def is_read_again(self, key: _Key) -> bool:
        """True if a section was read before; it is noted that it was read now."""
        with self._lock:
            again = key in self._kept
        if not again:
            self.keep(key, _READ_ONCE)
        return again

    def keep(self, key: _Key, tree: bytes) -> None:
        """Remember a section."""
        with self._lock:
            self._forget(key)
            self._kept[key] = tree
            self._size += _size(key, tree)
            while self._kept and self._size > self._most:
                self._forget(next(iter(self._kept)))

    def _used(self, key: _Key) -> bytes | None:
        self._kept.move_to_end(key)
        tree = self._kept[key]
        return None if tree is _READ_ONCE else tree

    def _forget(self, key: _Key) -> None:
        tree = self._kept.pop(key, None)
        if tree is not None:
            self._size -= _size(key, tree)


KNOWN_SECTIONS = KnownSections()
"""The sections of this process."""


def parse(source: Source, report: Report) -> ast.File:
    """The declarations of ``source`` that could be read; ``report`` gets the mistakes."""
    cut = list(sections(source.text))
    contents = _contents(source, cut)
    if None in contents:
        return parser.parse(source, report, _known(cut, contents))
    parts = [content() for content in contents if content is not None]
    edition = max(part.edition for part in parts)
    doc = "\n".join(chain.from_iterable(part.doc for part in parts))
    return ast.File(source, edition, doc, tuple(chain.from_iterable(p.declarations for p in parts)))


def _contents(source: Source, cut: Sequence[Section]) -> list[_Content]:
    """The content of each section."""
    keys = [_key(source.text, section) for section in cut]
    found: list[_Content] = []
    for section, key, tree in zip(cut, keys, KNOWN_SECTIONS.find(keys), strict=True):
        if tree is None:
            part = parse_section(source, section)
            _keep(key, part, section)
            found.append(None if part is None else partial(_same, part))
        else:
            known = partial(loaded, tree, source, section.start)
            found.append(None if tree == _MISTAKEN else known)
    return found


def _known(cut: Sequence[Section], contents: Sequence[_Content]) -> Iterator[Known]:
    """The sections that can be read alone, without the first one, which may have no header."""
    for (before, section), content in zip(pairwise(cut), contents[1:], strict=True):
        if content is not None:
            yield Known(section, before.ahead[0], content)


def _same(part: Part) -> Part:
    return part


def _keep(key: _Key, part: Part | None, section: Section) -> None:
    """Remember a section, unless expressions are nested so deeply that they cannot be stored."""
    if not KNOWN_SECTIONS.is_read_again(key):
        return
    with suppress(RecursionError):
        KNOWN_SECTIONS.keep(key, _MISTAKEN if part is None else stored(part, section.start))


def _key(text: str, section: Section) -> _Key:
    return text[section.start : section.end], text[slice(*section.ahead)]


def _size(key: _Key, tree: bytes) -> int:
    return sum(map(len, key)) + len(tree)
