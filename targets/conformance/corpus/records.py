"""The documents of the corpus: an index, and a file for each operation.

``burnish schema corpus`` and ``burnish schema corpus_index`` print their JSON Schemas, and
docs/corpus.md says how a program reads them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from ....compiler.constraints import Count, Length, Pattern, Positive
from ....support.frozen import frozen

VERSION: Literal[1] = 1
"""The version of the format; another one need not be readable by what reads this one."""

Bits = Annotated[str, Pattern("[0-9a-f]{8}")]
"""The 32 bits of a lane, as eight hexadecimal digits."""
Ends = tuple[Bits, Bits]
Operand = Annotated[tuple[Bits, ...], Length(1)]
Kind = Literal["float", "int", "uint", "bool"]


@frozen(kw_only=True)
class PromiseRow:
    """A set of specifications that a device keeps."""

    name: str
    """Name of the promise, by which results have it in ``within``."""
    title: str
    """The specifications, in words."""


@frozen(kw_only=True)
class OperationRow:
    """An operation in the index."""

    name: str
    """Name of the operation."""
    file: str
    """Its file, beside the index."""
    cases: Count
    """Number of its cases, of all overloads together."""
    guarded: Count
    """Number of those that are ``guarded``."""


@frozen(kw_only=True)
class CorpusIndex:
    """The index of a corpus, ``index.json``."""

    corpus: Literal[1]
    """Version of the format."""
    generator: str
    """The program that made it, with its version."""
    seed: Count
    """Seed of the operands that are drawn at random."""
    promises: tuple[PromiseRow, ...]
    """Promises, of which each result has the interval."""
    operations: tuple[OperationRow, ...]
    """Operations."""


@frozen(kw_only=True)
class SpecificationRow:
    """A platform's promise of the accuracy of an operation."""

    platform: str
    """Name of the platform, as it is called in ``promises`` of the index."""
    accuracy: str
    """The promise, in words."""
    source: str
    """The section that says it, or the reason to assume it."""
    assumed: bool
    """True if the specification is silent."""


@frozen(kw_only=True)
class TypeRow:
    """The type of an operand or of a result."""

    name: str
    """Name of the type, such as ``vec3``."""
    kind: Kind
    """Kind of its lanes."""
    width: Positive
    """Number of lanes, of a matrix those of a column."""
    columns: Count
    """Number of columns of a matrix; 0 of all others."""


@frozen(kw_only=True)
class LaneRow:
    """One lane of a result."""

    exact: str
    """The result without any rounding but that to a float64: ``float.hex`` of it.

    It is a decimal number for integers, and 0 or 1 for conditions.
    """
    nearest: Ends
    """The exact result, rounded to the nearest float32, ties to even; an integer as it is.

    Both ends are the same, but for results so close to the middle between two float32 numbers that
    either may be the nearest.
    """
    within: Mapping[str, Ends | None]
    """For each promise, the least and the greatest result that a conforming device may return.

    Null where nothing is promised: the result may be anything, also infinite or NaN.
    """


@frozen(kw_only=True)
class CaseRow:
    """The operands of one case, and the result of the operation."""

    operands: tuple[Operand, ...]
    """Operands; the lanes of each, those of a matrix column by column."""
    guarded: bool
    """True if Burnish does not rely on an operation of the device for these operands.

    They are outside of the domain where all languages define it alike. Then the language has a
    guard around it, or expands the operation, and the result is the meaning that the manual states.
    """
    result: Annotated[tuple[LaneRow, ...], Length(1)]
    """Lanes of the result, those of a matrix column by column."""


@frozen(kw_only=True)
class OverloadRow:
    """An operation for certain types."""

    operands: tuple[TypeRow, ...]
    """Types of the operands."""
    result: TypeRow
    """Type of the result."""
    cases: tuple[CaseRow, ...]
    """Cases."""


@frozen(kw_only=True)
class Corpus:
    """The cases of an operation: a builtin function or an operator."""

    corpus: Literal[1]
    """Version of the format."""
    name: str
    """Name of the operation; that of a function is the same in the language."""
    operator: str
    """The sign of an operator in most languages; empty of a function.

    The meaning need not be theirs: that of ``%`` is ``mod``, which rounds quotients down.
    """
    doc: str
    """The meaning."""
    domain: str
    """Operands for which all languages define it alike, in words.

    Empty if these are all operands, or none. Where there are none, all cases are ``guarded``.
    """
    outside: str
    """The meaning for other operands."""
    specifications: tuple[SpecificationRow, ...]
    """What each platform promises of it."""
    overloads: tuple[OverloadRow, ...]
    """The operation for different types."""
