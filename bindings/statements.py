"""Statements of straight-line code: what computes derived values, before any language prints it.

``scheduling`` makes them of expressions, and each language has a spelling for each of them.
"""

from __future__ import annotations

from ..compiler.tracing import Expression
from ..support.frozen import frozen
from .fields import Field


@frozen(kw_only=True)
class Place:
    """A field of a block that code reads or writes, or a part of it."""

    block: str
    """Name of the block in the binding."""
    way: tuple[str | int | None, ...]
    """Words of fields, and numbers of elements.

    ``None`` is a number that is computed: the next operand of the expression that reads it.
    """
    part: tuple[int, ...] = ()
    """The lane of a vector, or the column and the lane of a matrix."""
    is_choice: bool = False
    """True if it is a member of an enumeration, which is a type of its own in some languages."""


@frozen(kw_only=True)
class Let:
    """A name for a number."""

    name: str
    value: Expression


@frozen(kw_only=True)
class Set:
    """A field, or a member of an element of a table, gets its value."""

    place: Place
    field: Field
    index: str
    """Name of the variable that has the number of the element; empty for a field alone."""
    lanes: tuple[Expression, ...] | tuple[tuple[Expression, ...], ...]
    """Lanes of a number or a vector, or those of each column."""


@frozen(kw_only=True)
class Each:
    """Statements that are executed for each element of a table."""

    index: str
    count: int
    body: tuple[Statement, ...]


@frozen(kw_only=True)
class Fold:
    """A loop that combines terms, each with what the ones before have become."""

    index: str
    count: Expression
    """Number of terms; nothing where it is below one."""
    bound: int
    """The largest number of terms."""
    states: tuple[tuple[str, Expression], ...]
    """Names of the lanes of the value, each with what it begins with."""
    body: tuple[Statement, ...]
    following: tuple[Expression, ...]
    """What the lanes become with each term."""


@frozen(kw_only=True)
class Return:
    """The value of a helper."""

    value: Expression


Statement = Let | Set | Each | Fold | Return
