"""Looks through the text of a document before the package ``MaterialX`` gets it.

It finds the lines of elements, which the package forgets and messages need, the comments that stand
before them, and the files that are included. A document may come from anybody: entities are
refused, which could grow without end, and so are elements that nest deeper than the package's
recursion may go. MaterialX takes a ``<`` within the quotes of an attribute, as in
``tiles.<UDIM>.png``, which no other reader of XML does.
"""

from __future__ import annotations

import re
from html import unescape

DEEPEST = 64
"""How deep elements may nest. MaterialX has four levels."""

_PIECE = re.compile(
    r"<!--(?P<comment>.*?)-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>|(?P<doctype><!DOCTYPE)"
    r"|</(?P<end>[^\s>]+)\s*>"
    r"|<(?P<start>[A-Za-z_:][^\s/>]*)(?P<attributes>(?:\s+[^\s=>/]+\s*=\s*(?:\"[^\"]*\"|'[^']*'))*)\s*(?P<empty>/?)>"
    r"|(?P<wrong><)",
    re.DOTALL,
)
_ATTRIBUTE = re.compile(r"([^\s=]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')")


_RULE = re.compile(r"[^\w\s]{3,}")
"""A line that is drawn with signs, in a comment."""
_KEPT_OUT = re.compile(r"<|\w=\"")
"""What a comment has that keeps elements out of a document, rather than to say something."""


class DocumentError(Exception):
    """A document that cannot be read. Its text is a whole message: ``FILE:LINE: error: …``."""


class Outline:
    """The places of the named elements of a text by their paths, and the files that it includes.

    Raises ``DocumentError``.
    """

    def __init__(self, name: str, text: str) -> None:
        self.places: dict[str, tuple[str, int]] = {}
        self.included: list[str] = []
        self.repeated: dict[str, tuple[str, int]] = {}
        """The places of elements whose names another element beside them has already."""
        self.comments: dict[str, str] = {}
        """The comments directly before named elements. By ``""``, those before the document and
        before its first element: they are about the whole of it."""
        self._comment = ""
        self._name = name
        self._tags: list[str] = []
        self._names: list[str] = []
        self._line, self._counted = 1, 0
        for found in _PIECE.finditer(text):
            self._line += text.count("\n", self._counted, found.start())
            self._counted = found.start()
            if found["doctype"]:
                self._fail("documents of MaterialX have no DOCTYPE and no entities")
            elif found["wrong"]:
                self._fail(
                    "this is no XML: an element is not closed, or an attribute has no quotes"
                )
            elif found["comment"] is not None:
                self._comment = " ".join(filter(None, [self._comment, said(found["comment"])]))
            elif found["end"]:
                self._comment = ""
                self._end(found["end"])
            elif found["start"]:
                self._start(found["start"], found["attributes"], bool(found["empty"]))
        if self._tags:
            self._fail(f"this is no XML: <{self._tags[-1]}> is not closed")
        if not self.places and not text.strip():
            self._fail("the file is empty")

    def _start(self, tag: str, attributes: str, is_empty: bool) -> None:
        if not self._tags and tag != "materialx":
            self._fail(f"this is no document of MaterialX: it begins with <{tag}>")
        values = {
            name: unescape(one or other) for name, one, other in _ATTRIBUTE.findall(attributes)
        }
        self._tags.append(tag)
        self._names.append(values.get("name", "") if len(self._tags) > 1 else "")
        if len(self._tags) > DEEPEST:
            self._fail(f"elements nest more than {DEEPEST} deep")
        path, place = "/".join(filter(None, self._names)), (self._name, self._line)
        if path in self.places and "name" in values and not self._is_within_repeated(path):
            self.repeated[path] = place
        self.places.setdefault(path, place)
        self._comment_on("" if len(self.places) == 2 else path)
        if tag.rpartition(":")[2] == "include" and "href" in values:
            self.included.append(values["href"])
        if is_empty:
            self._end(tag)

    def _comment_on(self, path: str) -> None:
        """Take down the comment that was read as one on this element."""
        if self._comment and (path or len(self.places) <= 2):
            told = (self.comments.get(path, ""), self._comment)
            self.comments[path] = " ".join(filter(None, told))
        self._comment = ""

    def _is_within_repeated(self, path: str) -> bool:
        around = path.rpartition("/")[0]
        while around and around not in self.repeated:
            around = around.rpartition("/")[0]
        return bool(around)

    def _end(self, tag: str) -> None:
        if not self._tags or self._tags[-1] != tag:
            opened = f"<{self._tags[-1]}>" if self._tags else "nothing"
            self._fail(f"this is no XML: </{tag}> closes {opened}")
        self._tags.pop()
        self._names.pop()

    def _fail(self, text: str) -> None:
        raise DocumentError(f"{self._name}:{self._line}: error: {text}")


def said(comment: str) -> str:
    """The words of a comment, in one line: nothing if it keeps elements out of a document."""
    return "" if _KEPT_OUT.search(comment) else " ".join(_RULE.sub(" ", comment).split())
