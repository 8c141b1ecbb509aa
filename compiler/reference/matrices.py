"""Defines the meaning of builtins for matrices, which are tuples of columns.

``functions.py`` has them in its table.
"""

from __future__ import annotations

from . import floats
from .namespace import Lane, Lanes, Namespace
from .vectors import inner, scaled

Numbers = tuple[int, ...]
"""Numbers of columns or rows."""


def is_matrix(value: Lanes) -> bool:
    """True if a value is a tuple of columns."""
    return isinstance(value[0], tuple)


def mul(_xp: Namespace, x: Lanes, y: Lanes) -> Lanes:
    """The product of two matrices, a matrix and a column, or a matrix and a scalar."""
    if not is_matrix(x):
        return mul(_xp, y, x)
    if is_matrix(y):
        return tuple(_applied(x, column) for column in y)
    return tuple(scaled(column, y[0]) for column in x) if len(y) == 1 else _applied(x, y)


def _applied(m: Lanes, v: Lanes) -> Lanes:
    """A matrix times a column: the inner product of every row with it."""
    return tuple(inner(row, v) for row in _rows(m))


def _rows(m: Lanes) -> Lanes:
    return tuple(zip(*m, strict=True))


def transpose(_xp: Namespace, m: Lanes) -> Lanes:
    return _rows(m)


def determinant(_xp: Namespace, m: Lanes) -> Lanes:
    return (_determinant(m),)


def outer(_xp: Namespace, column: Lanes, row: Lanes) -> Lanes:
    return tuple(scaled(column, lane) for lane in row)


def hadamard(_xp: Namespace, x: Lanes, y: Lanes) -> Lanes:
    pairs = zip(x, y, strict=True)
    return tuple(tuple(a * b for a, b in zip(m, n, strict=True)) for m, n in pairs)


def inverse(xp: Namespace, m: Lanes) -> Lanes:
    """The transposed cofactors divided by the determinant; all zero if that is zero."""
    minors, size = _Minors(m), tuple(range(len(m)))
    scale = floats.div(xp, 1.0, minors.determinant(size, size))
    return tuple(tuple(minors.cofactor(size, size, i, j) * scale for i in size) for j in size)


def _determinant(m: Lanes) -> Lane:
    size = tuple(range(len(m)))
    return _Minors(m).determinant(size, size)


class _Minors:
    """The determinants of parts of a matrix, which have many of them in common."""

    def __init__(self, m: Lanes) -> None:
        self._m = m
        self._known: dict[tuple[Numbers, Numbers], Lane] = {}

    def determinant(self, columns: Numbers, rows: Numbers) -> Lane:
        """The determinant of some columns and rows, by expansion along the first column (Laplace).

        A matrix without columns has the determinant 1.
        """
        if not columns:
            return 1.0
        part = columns, rows
        if part not in self._known:
            first = self._m[columns[0]]
            self._known[part] = sum(
                first[row] * self.cofactor(columns, rows, 0, place)
                for place, row in enumerate(rows)
            )
        return self._known[part]

    def cofactor(self, columns: Numbers, rows: Numbers, column: int, row: int) -> Lane:
        """The cofactor of an element of such a part."""
        minor = self.determinant(_without(columns, column), _without(rows, row))
        return minor * (-1.0) ** (column + row)


def _without(numbers: Numbers, place: int) -> Numbers:
    return numbers[:place] + numbers[place + 1 :]
