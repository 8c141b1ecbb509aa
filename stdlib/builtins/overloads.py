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
_VECTOR = re.compile(r"(?P<prefix>[iub]?)vec(?P<lanes>\d)")
_MATRIX = re.compile(r"mat(?P<columns>\d)(x(?P<rows>\d))?")
_SIZES = (2, 3, 4)


@frozen
class Shape:
    """A type: lanes of a kind, in columns if it is a matrix."""

    kind: str
    width: int
    columns: int = 0

    def __str__(self) -> str:
        if self.columns:
            is_square = self.columns == self.width
            return f"mat{self.columns}" if is_square else f"mat{self.columns}x{self.width}"
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
        for choice in _choices(words):
            shapes = [_shape(word, choice) for word in words]
            found = Overload(row, tuple(shapes[:-1]), shapes[-1])
            if str(found) not in seen:
                seen.add(str(found))
                yield found


@frozen
class _Choice:
    """What the letters of a signature stand for."""

    kind: str
    width: int
    """Lanes of vectors, and rows of the matrix ``M``."""
    columns: int = 0
    """Columns of the matrix ``M``."""
    further: int = 0
    """Columns of the matrix ``Z``."""


def _choices(words: Sequence[str]) -> list[_Choice]:
    """The kinds, widths and sizes for which the letters of a signature can stand."""
    letters = {word for word in words if len(word) == 1}
    if not letters:
        return [_Choice("float", 1)]
    if "M" in letters:
        sizes = product(_SIZES, _SIZES, _SIZES if "Z" in letters else (0,))
        return [_Choice("float", rows, columns, more) for rows, columns, more in sizes]
    narrowest = 2 if "V" in letters else 1
    kinds = next((_FAMILIES[letter] for letter in letters if letter in _FAMILIES), ("float",))
    return [_Choice(kind, width) for kind, width in product(kinds, range(narrowest, 5))]


def _shape(word: str, choice: _Choice) -> Shape:
    if (of_matrix := _shape_of_matrix(word, choice)) is not None:
        return of_matrix
    if word in _SAME_WIDTH:
        return Shape(_SAME_WIDTH[word], choice.width)
    if word in ("S", "L"):
        return Shape(choice.kind, 1)
    if word in _FAMILIES:
        return Shape(choice.kind, choice.width)
    if (vector := _VECTOR.fullmatch(word)) is not None:
        of_prefix = {short: long for long, short in _PREFIXES.items()}
        return Shape(of_prefix[vector["prefix"]], int(vector["lanes"]))
    if (matrix := _MATRIX.fullmatch(word)) is not None:
        return Shape("float", int(matrix["rows"] or matrix["columns"]), int(matrix["columns"]))
    return Shape(word, 1)


def _shape_of_matrix(word: str, choice: _Choice) -> Shape | None:
    """The type of a letter that has to do with the matrix ``M``; ``None`` for others."""
    rows, columns, further = choice.width, choice.columns, choice.further
    widths = {
        "M": (rows, columns),
        "C": (rows, 0),
        "O": (columns, 0),
        "A": (columns, rows),
        "Z": (columns, further),
        "Y": (rows, further),
    }
    return Shape("float", *widths[word]) if word in widths else None
