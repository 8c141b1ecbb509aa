"""The values that a pass captures of each vertex, and their layout in the buffer.

Semantics makes a ``Capture`` of the ``capture`` members of a pass. Whatever writes the buffer (a
stream output, or a kernel) follows it, and the reflection tells it to the host.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...support.frozen import frozen
from .types import Type, width

NUMBER_SIZE = 4
"""Bytes of each number that is captured."""


@frozen
class CapturedMember:
    """One value of each vertex."""

    name: str
    type: Type
    """A number, or a vector of numbers."""
    declared_type: str
    """The type as written: ``point<world>``."""
    offset: int
    """The offset in bytes, from where the vertex begins."""
    doc: str = ""


@frozen
class Capture:
    """All values of a vertex, one behind the other and without gaps."""

    members: tuple[CapturedMember, ...]

    @property
    def numbers(self) -> int:
        """The number of 32-bit numbers of each vertex."""
        return sum(width(member.type) for member in self.members)

    @property
    def stride(self) -> int:
        """The bytes from one vertex to the next."""
        return NUMBER_SIZE * self.numbers

    def member(self, name: str) -> CapturedMember:
        """The member of this name."""
        return next(member for member in self.members if member.name == name)


def laid_out(values: Iterable[tuple[str, Type, str, str]]) -> Capture:
    """A capture of values: of each its name, its type, the type as written, and its doc comment."""
    members: list[CapturedMember] = []
    offset = 0
    for name, type_, declared, doc in values:
        members.append(CapturedMember(name, type_, declared, offset, doc))
        offset += NUMBER_SIZE * width(type_)
    return Capture(tuple(members))
