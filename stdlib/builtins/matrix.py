"""Rows for matrices. The product of matrices is a form of ``mul``."""

from __future__ import annotations

from .accuracy import CORRECT, EXACT, PLATFORMS, Inherited, promised, silent
from .row import Builtin, nowhere

_SIZES = (2, 3, 4)

DETERMINANT = promised(
    Inherited("sums of products"),
    silent(
        Inherited("sums of products"),
        "no specification limits its error; all known drivers expand it along a column",
        *PLATFORMS,
    ),
)


def _outer(columns: int, rows: int) -> str:
    """The signature of an outer product."""
    size = f"{columns}" if columns == rows else f"{columns}x{rows}"
    return f"vec{rows}, vec{columns} -> mat{size}"


ROWS = (
    Builtin(
        name="transpose",
        signatures=("M -> A",),
        meaning="numbers",
        doc="Rows and columns exchanged.",
        definition="transpose",
        accuracy=EXACT,
        cost=1,
    ),
    Builtin(
        name="determinant",
        signatures=tuple(f"mat{n} -> S" for n in _SIZES),
        meaning="numbers",
        doc="Determinant of a square matrix.",
        definition="determinant",
        accuracy=DETERMINANT,
        cost=16,
    ),
    Builtin(
        name="outer",
        signatures=tuple(_outer(columns, rows) for columns in _SIZES for rows in _SIZES),
        doc="outer(c, r): the matrix whose columns are c times each lane of r.",
        domain=nowhere,
        outside="Not every backend has it, so it is expanded.",
        expansion="outer",
        accuracy=CORRECT,
        cost=4,
    ),
    Builtin(
        name="hadamard",
        signatures=("M, M -> M",),
        doc="The product of two matrices lane by lane. The product of linear algebra is `m * n`.",
        domain=nowhere,
        outside="Not every backend has it, so it is expanded.",
        expansion="hadamard",
        accuracy=CORRECT,
        cost=4,
    ),
    Builtin(
        name="inverse",
        signatures=tuple(f"mat{n} -> mat{n}" for n in _SIZES),
        meaning="reversed",
        doc="The inverse of a square matrix.",
        domain=nowhere,
        outside="The zero matrix if the magnitude of the determinant is below 2^-126.",
        expansion="inverse",
        cost=60,
    ),
)
