"""Checks the types of arguments that users of the library pass to it.

``entry_points.py`` and the runtime call it first, so that a wrong type is reported at the call and
not deep inside of the compiler.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

Types = type | tuple[type, ...]


def expect(name: str, value: object, types: Types, wanted: str) -> None:
    """Raise ``TypeError`` unless the argument ``name`` has one of the types."""
    if not isinstance(value, types):
        given = type(value).__name__
        raise TypeError(f"`{name}` takes {wanted}, and was given a value of type {given}")


def expect_all(name: str, values: Any, types: Types, wanted: str) -> list[Any]:
    """The values of the iterable argument ``name``; ``TypeError`` unless all have one of the types.

    A text is refused, since it would be an iterable of its characters.
    """
    expect(name, values, Iterable, wanted)
    if isinstance(values, str | bytes):
        raise TypeError(f"`{name}` takes {wanted}, and was given a single one")
    found = list(values)
    for value in found:
        expect(name, value, types, wanted)
    return found
