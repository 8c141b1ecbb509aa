"""Names, types and expressions, as they were written.

Expressions may nest as deeply as the text is long, so code that walks them must not recurse.
"""

from __future__ import annotations

from typing import Literal

from ....support.frozen import frozen
from ...diagnostics.source import Span


@frozen
class Name:
    """An identifier where it is written."""

    text: str
    span: Span


@frozen(eq=False)
class Number:
    """``2``, ``0.5``, ``1e-3``, ``7u``; ``unit`` is ``deg`` for an angle, ``mm`` for a length."""

    span: Span
    text: str
    """Digits as written, without suffix or unit."""
    kind: Literal["int", "uint", "float", "angle", "length"]
    unit: str = ""
    """One of ``compiler.units``, or none."""


@frozen(eq=False)
class Color:
    """``#rgb``, ``#rrggbb`` or ``#rrggbbaa``: sRGB-encoded channels in 0..255, alpha linear."""

    span: Span
    channels: tuple[int, ...]


@frozen(eq=False)
class Boolean:
    """``true`` or ``false``."""

    span: Span
    value: bool


@frozen(eq=False)
class Reference:
    """A bare name used as a value."""

    span: Span
    name: str


@frozen(eq=False)
class Unary:
    """``-x`` or ``not x``."""

    span: Span
    operator: Literal["-", "~", "not"]
    operand: Expression


@frozen(eq=False)
class Binary:
    """``a + b`` and the like."""

    span: Span
    operator: Literal[
        "+", "-", "*", "/", "mod", "&", "|", "^", "<<", ">>",
        "==", "!=", "<", "<=", ">", ">=", "and", "or",
    ]  # fmt: skip
    left: Expression
    right: Expression


@frozen(eq=False)
class Conditional:
    """``if c then a else b``."""

    span: Span
    condition: Expression
    then: Expression
    otherwise: Expression


@frozen(eq=False)
class Call:
    """``f(a, b)``: a function, builtin, term, constructor, or a texture read at a coordinate.

    In ``f(a, width = b)``, an argument is given by its name.
    """

    span: Span
    callee: Expression
    arguments: tuple[Expression, ...]
    names: tuple[Name | None, ...] = ()
    """For each argument the name that it is given by, if it is; empty where no argument is."""


@frozen(eq=False)
class Field:
    """``x.name``: a swizzle, a struct member, or a slot of ``light`` or ``material``."""

    span: Span
    operand: Expression
    name: Name


@frozen(eq=False)
class Index:
    """``x[i]``: lane of a vector, column of a matrix, element of an array."""

    span: Span
    operand: Expression
    index: Expression


@frozen(eq=False)
class With:
    """``e with { slot = value … }``: a term evaluated with slots replaced."""

    span: Span
    operand: Expression
    replacements: tuple[tuple[Name, Expression], ...]


@frozen(eq=False)
class AtRate:
    """``@vertex e``: ``e`` computed at the vertex and interpolated."""

    span: Span
    rate: Name
    operand: Expression


@frozen(eq=False)
class Conversion:
    """``e in S``: a point, vector or normal as it is seen from space ``S``."""

    span: Span
    operand: Expression
    space: Name


@frozen(eq=False)
class Ascription:
    """``(e as T)``: the same numbers with the meaning of type ``T``."""

    span: Span
    operand: Expression
    type: TypeName


@frozen(eq=False)
class Array:
    """``[a, b, c]``."""

    span: Span
    elements: tuple[Expression, ...]


@frozen(eq=False)
class Turns:
    """``i in a..b up to n``: the turns of a loop, ``a <= i < b``, and how many there can be."""

    variable: Name
    """Empty where the turns have no number: ``up to n``."""
    start: Expression
    end: Expression
    most: Expression | None


FoldWord = Literal["sum", "product", "min", "max", "any", "all", "each"]
"""``each`` makes layers of a frame's draws, and has no meaning elsewhere."""


@frozen(eq=False)
class Fold:
    """``sum i in a..b : e``, with ``from x`` where it has a value to begin with."""

    span: Span
    operator: FoldWord
    turns: Turns
    initial: Expression | None
    body: Expression


@frozen(eq=False)
class FoldOver:
    """``sum lamp in rig : e``, ``each face in cube : e``: a frame's repetition, over no range."""

    span: Span
    operator: FoldWord
    variable: Name
    over: Expression
    body: Expression


@frozen(eq=False)
class Iterate:
    """``iterate x from e up to n while c : next``."""

    span: Span
    state: Name
    initial: Expression
    turns: Turns
    condition: Expression | None
    body: Expression


Expression = (
    Number | Color | Boolean | Reference | Unary | Binary | Conditional | Call | Field | Index
    | With | AtRate | Conversion | Ascription | Array | Fold | FoldOver | Iterate
)  # fmt: skip


# --- written types -------------------------------------------------------------------------------


@frozen(eq=False)
class TypeName:
    """``float``, ``point<world>``, ``vec3[4]``, ``vec3[]``: name, space arguments, array length."""

    span: Span
    name: Name
    arguments: tuple[Name, ...] = ()
    count: Expression | None = None
    unsized: bool = False
    """An array whose length only the host knows: ``vec3[]``."""
