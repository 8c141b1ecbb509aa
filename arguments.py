"""Checks of what callers of the library hand over: a wrong type is told where it comes in."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

Types = type | tuple[type, ...]


def expect(name: str, value: object, types: Types, wanted: str) -> None:
    """Raise ``TypeError`` unless the argument ``name`` is of one of some types."""
    if not isinstance(value, types):
        given = type(value).__name__
        raise TypeError(f"`{name}` takes {wanted}, and was given a value of type {given}")


def expect_all(name: str, values: Any, types: Types, wanted: str) -> list[Any]:
    """What the argument ``name`` iterates over; ``TypeError`` unless all is of some types.

    A text is not taken for its characters.
    """
    expect(name, values, Iterable, wanted)
    if isinstance(values, str | bytes):
        raise TypeError(f"`{name}` takes {wanted}, and was given a single one")
    found = list(values)
    for value in found:
        expect(name, value, types, wanted)
    return found
