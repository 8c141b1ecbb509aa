"""Rows for square matrices. The product of matrices is a form of ``mul``."""

from __future__ import annotations

from .accuracy import CORRECT, EXACT, PLATFORMS, Inherited, promised, silent
from .row import Builtin, nowhere

DETERMINANT = promised(
    Inherited("sums of products"),
    silent(
        Inherited("sums of products"),
        "no specification limits its error; all known drivers expand it along a column",
        *PLATFORMS,
    ),
)

ROWS = (
    Builtin(
        name="transpose",
        signatures=("M -> M",),
        meaning="numbers",
        doc="Rows and columns exchanged.",
        definition="transpose",
        accuracy=EXACT,
        cost=1,
    ),
    Builtin(
        name="determinant",
        signatures=("M -> S",),
        meaning="numbers",
        doc="Determinant.",
        definition="determinant",
        accuracy=DETERMINANT,
        cost=16,
    ),
    Builtin(
        name="outer",
        signatures=("vec2, vec2 -> mat2", "vec3, vec3 -> mat3", "vec4, vec4 -> mat4"),
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
        signatures=("M -> M",),
        meaning="reversed",
        doc="The inverse matrix.",
        domain=nowhere,
        outside="The zero matrix if the magnitude of the determinant is below 2^-126.",
        expansion="inverse",
        cost=60,
    ),
)
