"""Square matrices. Their product is a form of ``mul``."""

from __future__ import annotations

from .facts import UNKNOWN, Fact
from .row import EXACT, Builtin, nowhere


def _same_components(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return facts[0]


def _unknown_components(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    return UNKNOWN.as_kind("matrix")


ROWS = (
    Builtin(
        name="transpose",
        signatures=("M -> M",),
        meaning="numbers",
        doc="Rows and columns exchanged.",
        range=_same_components,
        accuracy=EXACT,
        cost=1,
    ),
    Builtin(
        name="determinant",
        signatures=("M -> S",),
        meaning="numbers",
        doc="Determinant.",
        cost=16,
    ),
    Builtin(
        name="inverse",
        signatures=("M -> M",),
        meaning="reversed",
        doc="The matrix that undoes this one.",
        domain=nowhere,
        outside="The zero matrix where the determinant is below 2^-126 in magnitude.",
        expansion="inverse",
        range=_unknown_components,
        cost=60,
    ),
)
