"""Finds out which line of a finished text computes which value, for the source map.

While statements are printed, a mark is put into each: a number between two characters of the
private use area, which neither names nor comments can contain. Marks pass through the skeleton with
the statements, and are taken out of the finished text. Only when somebody asks for the source map
are they read.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence

from ...compiler.ir.node import Node
from ...compiler.ir.program import Function
from ..description.forms import Forms

_OPEN, _CLOSE = "\ue000", "\ue001"
_MARK = re.compile(f"{_OPEN}([0-9]+){_CLOSE}")


Mark = Callable[[str, Node], str]
"""A function that puts a mark into a text which says what value it computes."""


class Marks:
    """The marks of one text, and the values that its statements compute."""

    def __init__(self, forms: Forms) -> None:
        self._nodes: list[Node] = []
        self._forms = forms
        self._text = ""

    def mark(self, text: str, node: Node) -> str:
        """``text`` with a mark which says that it computes ``node``."""
        self._nodes.append(node)
        return f"{_OPEN}{len(self._nodes) - 1}{_CLOSE}{text}"

    def of(self, function: Function) -> Mark:
        """The function that marks the statements of a function.

        A builtin's definition is of no material: all of it stands for a value that it computes.
        """
        node = function.stands_for
        return self.mark if node is None else lambda text, _node: self.mark(text, node)

    def taken_out(self, text: str) -> str:
        """The finished text without its marks, which are kept here."""
        self._text = text
        return _MARK.sub("", text)

    def origins(self) -> dict[int, Node]:
        """The value that each statement of the finished text belongs to, by line (counted from 1).

        Statements that skeletons add, such as ``return output;``, belong to the same value
        as the statement before them in their function, or else the one behind.
        """
        lines = self._text.split("\n")
        own = {
            number: self._nodes[int(found[1])]
            for number, line in enumerate(lines, start=1)
            if _OPEN in line and (found := _MARK.search(line))
        }
        plain = _MARK.sub("", self._text).split("\n")
        return dict(_completed(plain, own, self._forms))


def _completed(
    lines: Sequence[str], own: Mapping[int, Node], forms: Forms
) -> Iterator[tuple[int, Node]]:
    """The value that each statement belongs to, in functions that have at least one mark."""
    no_statements = {"", forms.end, forms.else_}
    for first, last in _top_level(lines, forms.end):
        node = next((own[number] for number in range(first, last) if number in own), None)
        if node is None:
            continue
        for number in range(first, last):
            line = lines[number - 1]
            text = line.strip()
            if line.startswith(" ") and text not in no_statements and not text.startswith("//"):
                node = own.get(number, node)
                yield number, node


def _top_level(lines: Sequence[str], end: str) -> Iterator[tuple[int, int]]:
    """Ranges of lines, each up to an ``end`` in the first column."""
    first = 1
    for number, line in enumerate(lines, start=1):
        if line.startswith(end):
            yield first, number
            first = number + 1
