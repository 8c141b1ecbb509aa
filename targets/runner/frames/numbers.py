"""Checks the types of a plan's computed values: ``FrameHost`` calls it."""

from __future__ import annotations

import re

_VECTOR = re.compile(r"[iub]?vec([234])")
_SCALARS = ("float", "int", "uint", "bool")
_WHOLE = ("i", "u")
"""The first letters of the types of whole numbers."""


def is_of(value: object, representation: str) -> bool:
    """True if a value is a number, or a vector of numbers, if its type is one.

    The elements of matrices and arrays are checked where a shader gets them.
    """
    vector = _VECTOR.fullmatch(representation)
    fits = _is_whole if representation.startswith(_WHOLE) else _is_number
    if vector:
        lanes = value if isinstance(value, tuple) else ()
        return len(lanes) == int(vector[1]) and all(map(fits, lanes))
    return representation not in _SCALARS or fits(value)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float)


def _is_whole(value: object) -> bool:
    return isinstance(value, int) or (isinstance(value, float) and value.is_integer())
