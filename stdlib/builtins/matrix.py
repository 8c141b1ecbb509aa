"""Square matrices. Their product is a form of ``mul``."""

from __future__ import annotations

from .row import EXACT, Builtin, nowhere

ROWS = (
    Builtin(
        name="transpose",
        signatures=("M -> M",),
        doc="Rows and columns exchanged.",
        accuracy=EXACT,
        cost=1,
    ),
    Builtin(
        name="determinant",
        signatures=("M -> S",),
        doc="Determinant.",
        cost=16,
    ),
    Builtin(
        name="inverse",
        signatures=("M -> M",),
        doc="The matrix that undoes this one.",
        domain=nowhere,
        outside="The zero matrix where the determinant is below 2^-126 in magnitude.",
        expansion="inverse",
        cost=60,
    ),
)
