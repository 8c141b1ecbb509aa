"""Rows for comparisons, logic and choices, which work lane by lane.

They have no range rules: if ranges decide a result, the simplifier replaces the operation.
"""

from __future__ import annotations

from .accuracy import EXACT
from .row import Builtin, nowhere

_ORDERED = ("N, N -> Q",)
_LOGIC = ("B, B -> B",)
_LANES = ("bvec2 -> bool", "bvec3 -> bool", "bvec4 -> bool")


def _comparison(
    name: str,
    operator: str,
    doc: str,
    signatures: tuple[str, ...] = _ORDERED,
) -> Builtin:
    """The row of a comparison; comparisons differ only in their operator and documentation."""
    return Builtin(
        name=name,
        signatures=signatures,
        doc=doc,
        operator=operator,
        accuracy=EXACT,
        samples=((0.0, -0.0), (1.0, 1.0), (1.0, 2.0), (2.0, 1.0)),
    )


ROWS = (
    _comparison("eq", "==", "True if two values are equal, lane by lane.", ("P, P -> Q",)),
    _comparison("ne", "!=", "True if two values differ, lane by lane.", ("P, P -> Q",)),
    _comparison("lt", "<", "True if the first value is less."),
    _comparison("le", "<=", "True if the first value is less or equal."),
    _comparison("gt", ">", "True if the first value is greater."),
    _comparison("ge", ">=", "True if the first value is greater or equal."),
    Builtin(
        name="and",
        signatures=_LOGIC,
        doc="True if both conditions hold.",
        operator="&&",
        short_circuits=True,
        accuracy=EXACT,
    ),
    Builtin(
        name="or",
        signatures=_LOGIC,
        doc="True if at least one condition holds.",
        operator="||",
        short_circuits=True,
        accuracy=EXACT,
    ),
    Builtin(
        name="not",
        signatures=("B -> B",),
        doc="True if the condition does not hold.",
        operator="!",
        accuracy=EXACT,
    ),
    Builtin(
        name="any",
        signatures=_LANES,
        doc="True if at least one lane is true.",
        accuracy=EXACT,
    ),
    Builtin(
        name="all",
        signatures=_LANES,
        doc="True if every lane is true.",
        accuracy=EXACT,
    ),
    Builtin(
        name="choose",
        signatures=("Q, P, P -> P",),
        meaning="limits",
        doc="choose(c, x, y): x where the condition holds, else y, lane by lane.",
        domain=nowhere,
        outside="Both values are computed: it is not a branch. For one condition, write `if`.",
        expansion="choose",
        accuracy=EXACT,
    ),
)
