"""Comparisons of scalars, and logic. What ranges decide of them, simplification folds away."""

from __future__ import annotations

from .row import EXACT, Builtin

_ORDERED = ("float, float -> bool", "int, int -> bool", "uint, uint -> bool")
_LOGIC = ("bool, bool -> bool",)
_LANES = ("bvec2 -> bool", "bvec3 -> bool", "bvec4 -> bool")


def _comparison(
    name: str,
    operator: str,
    doc: str,
    signatures: tuple[str, ...] = _ORDERED,
) -> Builtin:
    """Comparisons differ in nothing but their sign and doc line."""
    return Builtin(
        name=name,
        signatures=signatures,
        doc=doc,
        operator=operator,
        accuracy=EXACT,
        samples=((0.0, -0.0), (1.0, 1.0), (1.0, 2.0), (2.0, 1.0)),
    )


ROWS = (
    _comparison("eq", "==", "Whether two scalars are equal.", (*_ORDERED, *_LOGIC)),
    _comparison("ne", "!=", "Whether two scalars differ.", (*_ORDERED, *_LOGIC)),
    _comparison("lt", "<", "Whether the first scalar is less."),
    _comparison("le", "<=", "Whether the first scalar is less or equal."),
    _comparison("gt", ">", "Whether the first scalar is greater."),
    _comparison("ge", ">=", "Whether the first scalar is greater or equal."),
    Builtin(
        name="and",
        signatures=_LOGIC,
        doc="Whether both hold.",
        operator="&&",
        accuracy=EXACT,
    ),
    Builtin(
        name="or",
        signatures=_LOGIC,
        doc="Whether at least one holds.",
        operator="||",
        accuracy=EXACT,
    ),
    Builtin(
        name="not",
        signatures=("bool -> bool",),
        doc="Whether it does not hold.",
        operator="!",
        accuracy=EXACT,
    ),
    Builtin(
        name="any",
        signatures=_LANES,
        doc="Whether at least one lane holds.",
        accuracy=EXACT,
    ),
    Builtin(
        name="all",
        signatures=_LANES,
        doc="Whether every lane holds.",
        accuracy=EXACT,
    ),
)
