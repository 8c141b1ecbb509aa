"""Constraints on the fields of documents, which Python's types cannot say.

They stand in ``Annotated`` beside the type of a field. ``reading`` checks them, ``schema`` writes
them as keywords of JSON Schema, and ``typescript`` heeds what pages call a type. ``Spelling`` says
which words documents have for those of the language.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Annotated, Any

from ..support.frozen import frozen


@frozen
class Range:
    """Bounds of a number, both of which are allowed; ``None`` where there is none."""

    least: float | None = None
    most: float | None = None
    multiple_of: int | None = None


@frozen
class Length:
    """The least number of elements of a list."""

    least: int


@frozen
class Pattern:
    """A regular expression that a whole text follows."""

    text: str


@frozen
class TypeScript:
    """The name of a type in pages, where it is one of the browser's own."""

    text: str


@frozen
class Nested:
    """A value of any shape: a scalar of JSON, or lists of such values.

    With ``objects``, it may also be objects of them.
    """

    name: str
    """The name of the type in schemas and pages."""
    doc: str
    objects: bool = False


Spelling = Mapping[str, str]
"""WebGPU's words by the language's: documents have the former, and records in Python the latter.

The class attribute ``WORDS`` of a record has the spelling of the fields that have one.
"""


def dashed(words: Iterable[str]) -> Spelling:
    """WebGPU's words where the language has the same ones, but for ``_``, as ``-`` is a minus."""
    return {word: word.replace("_", "-") for word in words}


Count = Annotated[int, Range(least=0)]
"""A number of things, a number of one of them, or a place in bytes."""
Positive = Annotated[int, Range(least=1)]
"""A number of things of which there is at least one; also lines and columns."""

Lanes = Annotated[
    Any,
    Nested(
        "Lanes",
        "A value: a scalar, or nested arrays of a vector's lanes, a matrix's columns, an array's "
        "elements.",
    ),
]
"""A value as nested tuples; ``None`` where there is none."""
