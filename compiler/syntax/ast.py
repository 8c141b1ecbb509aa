"""The abstract syntax tree: what was written, with its span, before anything is looked up.

All nodes are frozen and slotted. Expressions may nest as deeply as the text is long, so code that
walks them must not recurse (see ``semantics``).
"""

from __future__ import annotations

from typing import Literal

from ...frozen import frozen
from ..diagnostics.source import Source, Span


@frozen
class Name:
    """An identifier where it is written."""

    text: str
    span: Span


# --- expressions ---------------------------------------------------------------------------------


@frozen(eq=False)
class Number:
    """``2``, ``0.5``, ``1e-3``, ``7u``; ``unit`` is ``deg`` or ``rad`` for an angle."""

    span: Span
    text: str
    """Digits as written, without suffix or unit."""
    kind: Literal["int", "uint", "float", "angle"]
    unit: Literal["", "deg", "rad"] = ""


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
    """``f(a, b)``: a function, builtin, term, constructor, or a texture read at a coordinate."""

    span: Span
    callee: Expression
    arguments: tuple[Expression, ...]


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


FoldWord = Literal["sum", "product", "min", "max", "any", "all"]


@frozen(eq=False)
class Fold:
    """``sum i in a..b : e``, with ``from x`` where it has a value to begin with."""

    span: Span
    operator: FoldWord
    turns: Turns
    initial: Expression | None
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
    | With | AtRate | Conversion | Ascription | Array | Fold | Iterate
)  # fmt: skip


# --- types ---------------------------------------------------------------------------------------


@frozen(eq=False)
class TypeName:
    """``float``, ``point<world>``, ``vec3[4]``: name, space arguments, array length if any."""

    span: Span
    name: Name
    arguments: tuple[Name, ...] = ()
    count: Expression | None = None


# --- members of materials, lights, passes and structs --------------------------------------------


@frozen(eq=False)
class Param:
    """``param x : T in a..b per group = default``."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    range: tuple[Expression, Expression] | None
    group: Name | None
    default: Expression | None


@frozen(eq=False)
class Map:
    """``map albedo : texture2d = white with { filter = linear, wrap = repeat }``."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    group: Name | None
    default: Name | None
    state: tuple[tuple[Name, Name], ...]


@frozen(eq=False)
class Attribute:
    """``attribute uv0 : vec2``: a vertex input."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    rate: Name | None = None
    """The ``instance`` of ``per instance``."""


@frozen(eq=False)
class Slot:
    """``name : T = e``, an equation; without ``e`` an abstract slot that a heir has to set."""

    span: Span
    doc: str
    name: Name
    type: TypeName | None
    value: Expression | None


@frozen(eq=False)
class Target:
    """``target color : rgba8 = e blend alpha``: what a pass writes to one render target."""

    span: Span
    doc: str
    name: Name
    format: Name
    value: Expression
    blend: Name | None


@frozen(eq=False)
class Discard:
    """``discard when c``: the pixel is not written where ``c`` holds."""

    span: Span
    condition: Expression


Member = Param | Map | Attribute | Slot | Target | Discard


# --- declarations --------------------------------------------------------------------------------


@frozen(eq=False)
class Import:
    """``import std.lights.{Lamp, Beam}``, ``import std.lights`` or ``import "wood.burnish"``.

    ``path`` is ``("std", "lights")`` or, for a quoted import, the one quoted text; ``names`` is
    ``None`` where everything is imported.
    """

    span: Span
    path: tuple[str, ...]
    quoted: bool
    names: tuple[Name, ...] | None


@frozen(eq=False)
class Record:
    """A ``material``, ``light`` or ``pass``: named members, one base, perhaps abstract."""

    span: Span
    doc: str
    kind: Literal["material", "light", "pass"]
    name: Name
    abstract: bool
    base: Name | None
    blend: Name | None
    """Default blending of a pass's targets."""
    members: tuple[Member, ...]
    mixins: tuple[Name, ...] = ()
    """``: Base + First + Second``, in the order written."""


@frozen(eq=False)
class Mixin:
    """``mixin Flicker for light { … }``: members for records that already have a base."""

    span: Span
    doc: str
    kind: Literal["material", "light", "pass"]
    """Of the records that it is for."""
    name: Name
    members: tuple[Member, ...]


@frozen(eq=False)
class Argument:
    """A formal parameter of a function or term."""

    span: Span
    name: Name
    type: TypeName


@frozen(eq=False)
class TypeParameter:
    """``T: floats``: a type parameter and the family it ranges over."""

    span: Span
    name: Name
    family: Name


@frozen(eq=False)
class Function:
    """``fn f(a: float) -> float = e`` or ``term t(k: rgb) per light = e where { p = … }``."""

    span: Span
    doc: str
    kind: Literal["fn", "term"]
    name: Name
    type_parameters: tuple[TypeParameter, ...]
    arguments: tuple[Argument, ...]
    result: TypeName | None
    per: Name | None
    """The ``light`` of ``per light``."""
    body: Expression
    parts: tuple[Slot, ...] = ()
    """The equations behind ``where``, which the body and they themselves can name."""


@frozen(eq=False)
class RigEntry:
    """``sun : Sky``, ``fill : Lamp[2]``, ``lamps : Lamp[<= 8]``, with overrides."""

    span: Span
    doc: str
    name: Name
    light: Name
    count: Expression | None
    at_most: bool
    overrides: tuple[Slot, ...]


@frozen(eq=False)
class Rig:
    """Which lights shine."""

    span: Span
    doc: str
    name: Name
    entries: tuple[RigEntry, ...]


@frozen(eq=False)
class StructMember:
    """``name : T`` of a struct."""

    span: Span
    doc: str
    name: Name
    type: TypeName


@frozen(eq=False)
class StructDeclaration:
    """``struct Layer { tint : rgb  weight : float }``."""

    span: Span
    doc: str
    name: Name
    members: tuple[StructMember, ...]


@frozen(eq=False)
class ExternMember:
    """``time : float at 76``: a member of a block that the host owns, at its offset in bytes."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    offset: Number
    default: Expression | None


@frozen(eq=False)
class ExternBlock:
    """``extern block PerFrame per frame at group 0, binding 3 { … }``."""

    span: Span
    doc: str
    name: Name
    group: Name | None
    """How often the host changes it; ``frame`` if nothing is written."""
    bind_group: Number
    binding: Number
    members: tuple[ExternMember, ...]


@frozen(eq=False)
class Space:
    """``space bench``: a coordinate space of the user's own."""

    span: Span
    doc: str
    name: Name


@frozen(eq=False)
class Constant:
    """``golden = 1.618`` at file level."""

    span: Span
    doc: str
    name: Name
    type: TypeName | None
    value: Expression


Declaration = (
    Import | Record | Mixin | Function | Rig | StructDeclaration | ExternBlock | Space | Constant
)  # fmt: skip


@frozen(eq=False)
class File:
    """One parsed file; declarations that failed to parse are missing and were reported."""

    source: Source
    edition: int
    doc: str
    """Doc comment at the head of the file (``//!`` lines)."""
    declarations: tuple[Declaration, ...]
