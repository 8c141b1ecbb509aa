"""The fields of blocks and structures: where each value lies, and what a host may set it to."""

from __future__ import annotations

from typing import Any

from ..compiler.packing import LaneKind
from ..support.frozen import cached_property, frozen


@frozen(kw_only=True)
class Numbers:
    """The type of a number, a vector or a matrix, as it is stored."""

    kind: LaneKind
    """The kind of the lanes; a bool is the uint 0 or 1."""
    truth: bool = False
    """True if the lanes are bools."""
    lanes: int
    """Lanes of a number, of a vector, or of a column."""
    columns: int = 0
    """Columns of a matrix, 0 of others."""
    stored_lanes: int
    """Lanes that a column or an element takes up: 4 where one behind 3 is not read."""


@frozen(kw_only=True)
class Choice:
    """A member of an enumeration."""

    name: str
    doc: str


@frozen(kw_only=True)
class Enumeration:
    """An enumeration of the language: its members by their numbers, from 0."""

    name: str
    """Name in the binding, which no other enumeration or structure has."""
    members: tuple[Choice, ...]


@frozen(kw_only=True)
class Field:
    """A value in a block or a structure."""

    name: str
    """Name as the host says it, ``torch.axis``."""
    word: str
    """The name in one word, ``torch_axis``."""
    type: Numbers | Structure
    """Type of the value, or of an array's elements."""
    offset: int
    """Bytes from the start of the block or structure."""
    stride: int = 0
    """Bytes from one element of an array to the next."""
    capacity: int = 0
    """Elements of an array; 0 of anything else."""
    default: Any = None
    """The value before a host sets one, in nested tuples; ``None`` where it has to be set."""
    range: tuple[float, float] | None = None
    """The lowest and the highest value that a lane may have."""
    enumeration: Enumeration | None = None
    """The enumeration that it is, if it is one: what is stored is the number of a member."""
    meaning: str = ""
    """The type as written: ``rgb``, ``direction<world>``."""
    doc: str = ""
    role: str | None = None
    counter: str = ""
    """The word of the field with the number of elements in use; empty where all are."""
    counts: str = ""
    """The word of the array whose elements in use it counts; empty for any other field."""
    computed: bool = False
    """True if it is derived from others, so that no host sets it."""

    @property
    def choices(self) -> tuple[str, ...]:
        """Names of the members of the enumeration that it is; none of any other field."""
        return () if self.enumeration is None else tuple(e.name for e in self.enumeration.members)

    @property
    def is_unit(self) -> bool:
        """True if it has length one, as directions and normals have."""
        plain = self.meaning.partition("[")[0].partition("<")[0]
        is_vector = isinstance(self.type, Numbers) and self.type.lanes > 1
        return is_vector and plain in ("direction", "normal")

    @property
    def size(self) -> int:
        """Bytes that the value takes up, with the lanes behind elements that are not read."""
        return self.stride * self.capacity if self.capacity else self.element_size

    @property
    def element_size(self) -> int:
        """Bytes of the value, or of an element of the array."""
        if isinstance(self.type, Structure):
            return self.type.size
        return 4 * self.type.stored_lanes * (self.type.columns or 1)


@frozen(kw_only=True)
class Pad:
    """Bytes that hold no value."""

    number: int
    offset: int
    lanes: int


@frozen(kw_only=True)
class Structure:
    """The fields of a block, or of an element of an array, with their offsets."""

    name: str
    """Name in the binding, which no other structure or block has."""
    size: int
    fields: tuple[Field, ...]

    @cached_property
    def parts(self) -> tuple[Field | Pad, ...]:
        """The fields and the pads between them, without a gap."""
        found: list[Field | Pad] = []
        end = 0
        for field in self.fields:
            _pad(found, end, field.offset)
            found.append(field)
            end = field.offset + field.size
        _pad(found, end, self.size)
        return tuple(found)

    def field(self, word: str) -> Field:
        """The field of this word."""
        return next(each for each in self.fields if each.word == word)


def _pad(found: list[Field | Pad], start: int, end: int) -> None:
    if end > start:
        number = sum(isinstance(each, Pad) for each in found)
        found.append(Pad(number=number, offset=start, lanes=(end - start) // 4))
