"""Defines what builtins mean for matrices, which are tuples of columns.

``functions.py`` has them in its table.
"""

from __future__ import annotations

from . import floats
from .namespace import Lane, Lanes, Namespace
from .vectors import inner, scaled


def is_matrix(value: Lanes) -> bool:
    """Whether a value is a tuple of columns."""
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
    scale = floats.div(xp, 1.0, _determinant(m))
    size = range(len(m))
    return tuple(tuple(_cofactor(m, i, j) * scale for i in size) for j in size)


def _cofactor(m: Lanes, column: int, row: int) -> Lane:
    minor = tuple(lanes[:row] + lanes[row + 1 :] for i, lanes in enumerate(m) if i != column)
    return _determinant(minor) * (-1.0) ** (column + row)


def _determinant(m: Lanes) -> Lane:
    """By expansion along the first column (Laplace); a matrix without columns has the determinant
    1."""
    if not m:
        return 1.0
    return sum(lane * _cofactor(m, 0, row) for row, lane in enumerate(m[0]))
