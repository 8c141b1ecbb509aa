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
    "struct",
]  # fmt: skip

ARROWS: frozenset[str] = frozenset({"vector", "direction", "normal"})
GEOMETRY: frozenset[str] = ARROWS | {"point"}
COLORS: frozenset[str] = frozenset({"rgb", "rgba"})
MAPS: frozenset[str] = frozenset({"transform", "basis"})


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

    def __str__(self) -> str:
        return f"{self.kind}<{', '.join(self.spaces)}>" if self.spaces else self.kind

    def member(self, name: str) -> Meaning | None:
        """The meaning of member ``name`` of a struct."""
        return dict(self.members).get(name)


ANGLE = Meaning("angle")
RGB = Meaning("rgb")
RGBA = Meaning("rgba")
