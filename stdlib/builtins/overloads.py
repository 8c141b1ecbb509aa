"""Every overload of a builtin: the types of its operands and of its result.

A row writes its signatures with letters that stand for several types. Here they are spelled out:
for the host's table of builtins (``targets/web_host/serving``), and for tests.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import product

from ...support.frozen import frozen
from . import BUILTINS, Builtin

COMPUTING = tuple(
    row for row in BUILTINS.values() if row.method is None and not row.uniform_control_flow
)
"""The builtins whose results depend on their operands only."""

_PREFIXES = {"float": "", "int": "i", "uint": "u", "bool": "b"}
_FAMILIES: dict[str, tuple[str, ...]] = {
    "T": ("float",), "V": ("float",), "N": ("float", "int", "uint"), "I": ("int", "uint"),
    "B": ("bool",), "P": ("float", "int", "uint", "bool"),
}  # fmt: skip
_SAME_WIDTH = {"Q": "bool", "U": "uint", "J": "int"}
_NAMED = re.compile(r"(?P<prefix>[iub]?)(?P<form>vec|mat)(?P<size>\d)")


@frozen
class Shape:
    """A type: lanes of a kind, in columns if it is a matrix."""

    kind: str
    width: int
    columns: int = 0

    def __str__(self) -> str:
        if self.columns:
            return f"mat{self.width}"
        return self.kind if self.width == 1 else f"{_PREFIXES[self.kind]}vec{self.width}"

    @property
    def lanes(self) -> int:
        """All lanes there are."""
        return self.width * max(self.columns, 1)


@frozen
class Overload:
    """A builtin with the types of its operands and of its result."""

    row: Builtin
    operands: tuple[Shape, ...]
    result: Shape

    def __str__(self) -> str:
        return f"{self.row.name}({', '.join(map(str, self.operands))})"


def overloads(row: Builtin) -> Iterator[Overload]:
    """All overloads of a builtin. A pair of equal types stands for every pair of them."""
    seen = set()
    for signature in row.signatures:
        operands, result = signature.split(" -> ")
        words = [*operands.split(", "), result]
        for kind, width in _choices(words):
            shapes = [_shape(word, kind, width) for word in words]
            found = Overload(row, tuple(shapes[:-1]), shapes[-1])
            if str(found) not in seen:
                seen.add(str(found))
                yield found


def _choices(words: Sequence[str]) -> list[tuple[str, int]]:
    """The kinds and widths for which the letters of a signature can stand."""
    letters = {word for word in words if len(word) == 1}
    if not letters:
        return [("float", 1)]
    narrowest = 2 if letters & {"V", "M"} else 1
    kinds = next((_FAMILIES[letter] for letter in letters if letter in _FAMILIES), ("float",))
    return list(product(kinds, range(narrowest, 5)))


def _shape(word: str, kind: str, width: int) -> Shape:
    if word in _SAME_WIDTH:
        return Shape(_SAME_WIDTH[word], width)
    if word == "M":
        return Shape("float", width, width)
    if word in ("S", "L"):
        return Shape(kind, 1)
    if word == "C":
        return Shape("float", width)
    if word in _FAMILIES:
        return Shape(kind, width)
    named = _NAMED.fullmatch(word)
    if named is None:
        return Shape(word, 1)
    lanes = int(named["size"])
    of_prefix = {short: long for long, short in _PREFIXES.items()}
    return Shape(of_prefix[named["prefix"]], lanes, lanes if named["form"] == "mat" else 0)
