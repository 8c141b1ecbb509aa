"""Meanings (semantic types): the sense of a value beyond its numbers, such as a colour.

Another one is a point in world space. Semantics checks meanings and then forgets them: they cost
nothing at run time, and no node has one.
"""

from __future__ import annotations

from typing import Literal

from ...support.frozen import frozen

MeaningKind = Literal[
    "point", "vector", "direction", "normal",  # in one space
    "rgb", "rgba", "angle",
    "transform", "basis",  # from one space to another
    "struct", "enum",
]  # fmt: skip

ARROWS: frozenset[str] = frozenset({"vector", "direction", "normal"})
GEOMETRY: frozenset[str] = ARROWS | {"point"}
COLORS: frozenset[str] = frozenset({"rgb", "rgba"})
MAPS: frozenset[str] = frozenset({"transform", "basis"})


@frozen(key=True)
class Choice:
    """A member of an enumeration: its number is its place among the members."""

    name: str
    doc: str


@frozen(key=True)
class Enumeration:
    """``enum Mode { add, mix }``: what the values of an ``int`` are called."""

    name: str
    path: str
    """The file that declares it, as two files may each have a ``Mode``."""
    choices: tuple[Choice, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the members, by their numbers."""
        return tuple(choice.name for choice in self.choices)


@frozen(key=True)
class Meaning:
    """``point<world>``, ``rgb``, ``transform<object, world>``; of an array, that of its elements.

    A ``direction`` is a vector of length one. A ``normal`` stands upright on a surface and so moves
    by the inverse transpose of the matrix that moves vectors.
    """

    kind: MeaningKind
    spaces: tuple[str, ...] = ()
    members: tuple[tuple[str, Meaning | None], ...] = ()
    """The names and meanings of a struct's members."""
    enumeration: Enumeration | None = None
    """The enumeration of a value that is a member of one."""

    def __str__(self) -> str:
        if self.enumeration is not None:
            return self.enumeration.name
        return f"{self.kind}<{', '.join(self.spaces)}>" if self.spaces else self.kind

    def member(self, name: str) -> Meaning | None:
        """The meaning of member ``name`` of a struct."""
        return dict(self.members).get(name)


ANGLE = Meaning("angle")
RGB = Meaning("rgb")
RGBA = Meaning("rgba")
