"""Declarations of a file: imports, records, functions, rigs and the rest."""

from __future__ import annotations

from typing import ClassVar, Literal

from ....support.frozen import frozen
from ....support.late import Late
from ...diagnostics.source import Source, Span
from .expressions import Expression, Name, Number, TypeName
from .members import Member, RecordKind, Slot


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
class Record(Late):
    """A ``material``, ``light`` or ``pass``: named members, one base, perhaps abstract."""

    late: ClassVar[str] = "members"

    span: Span
    doc: str
    kind: RecordKind
    name: Name
    abstract: bool
    base: Name | None
    blend: Name | None
    """Default blending of a pass's targets."""
    members: tuple[Member, ...]
    mixins: tuple[Name, ...] = ()
    """``: Base + First + Second``, in the order written."""
    by: Name | None = None
    """The pass that draws a material: ``material Leaf by Cutout``."""


@frozen(eq=False)
class Mixin(Late):
    """``mixin Flicker for light { … }``: members for records that already have a base."""

    late: ClassVar[str] = "members"

    span: Span
    doc: str
    kind: RecordKind
    """The kind of the records that it is for."""
    name: Name
    members: tuple[Member, ...]


@frozen(eq=False)
class Argument:
    """A formal parameter of a function or term: ``width : float``, ``width : float = 1``."""

    span: Span
    name: Name
    type: TypeName
    default: Expression | None = None
    """Its value in calls that leave it out."""


@frozen(eq=False)
class TypeParameter:
    """``T: floats``: a type parameter and the family it ranges over."""

    span: Span
    name: Name
    family: Name


@frozen(eq=False)
class Function(Late):
    """``fn f(a: float) -> float = e`` or ``term t(k: rgb) per light = e where { p = … }``."""

    late: ClassVar[str] = "body"

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


LightNumber = Literal["one", "exactly", "at_most", "any"]
"""The number of lights that an entry of a rig stands for.

It is one; or an array of exactly as many as written, of at most so many, or of any number.
"""


@frozen(eq=False)
class RigEntry:
    """An entry of a rig:

    ``sun : Sky``, ``fill : Lamp[2]``, ``lamps : Lamp[<= 8]``, ``all : Lamp[]``. Overrides may
    follow.
    """

    span: Span
    doc: str
    name: Name
    light: Name
    count: Expression | None
    number: LightNumber
    overrides: tuple[Slot, ...]


@frozen(eq=False)
class Rig:
    """A rig: the lights that shine."""

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
class Enumerator:
    """``add`` of an enumeration: a name with a meaning of its own."""

    span: Span
    doc: str
    name: Name


@frozen(eq=False)
class Enumeration:
    """``enum Mode { add, mix }``: a type whose values are its members."""

    span: Span
    doc: str
    name: Name
    members: tuple[Enumerator, ...]


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
    """The group, which says how often the host changes it; ``frame`` if nothing is written."""
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
    Import | Record | Mixin | Function | Rig | StructDeclaration | Enumeration | ExternBlock
    | Space | Constant
)  # fmt: skip


@frozen(eq=False)
class File:
    """One parsed file; declarations that failed to parse are missing and were reported."""

    source: Source
    edition: int
    doc: str
    """Doc comment at the head of the file (``//!`` lines)."""
    declarations: tuple[Declaration, ...]
