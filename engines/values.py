"""The records of engines' tables: which values an engine has, and which it takes."""

from __future__ import annotations

from collections.abc import Mapping

from ..support.frozen import EMPTY, frozen

Place = tuple[str, str]
"""The source of an argument, and what that calls it: ``("surface", "uv")``."""

MOVED = "moved_"
"""What the names of variables begin with that have where a vertex is moved to."""


@frozen
class Between:
    """A value that vertices hand to pixels."""

    type: str
    name: str
    value: str
    """What a vertex has of it."""
    is_moved: bool = False
    """True if it is that of the vertex where the material has moved it."""
    is_flat: bool = False
    """True if pixels get that of one vertex."""


@frozen
class Output:
    """A value of a surface that an engine takes."""

    input: str
    """The row of the table of all engines."""
    type: str
    """The type that the engine takes."""
    statement: str
    """The statement that gives it the ``{value}``."""
    factor: str = ""
    """Another row, by which the value is multiplied if the material gives it."""


@frozen(kw_only=True)
class Tables:
    """What an engine has and takes."""

    title: str
    """The engine's name in messages."""
    lit: tuple[Output, ...]
    """What a pixel of a surface is that the engine lights."""
    unlit: tuple[Output, ...]
    """What a pixel of a surface is that needs no light."""
    moved: tuple[Output, ...]
    """Where a vertex is."""
    at_vertices: Mapping[Place, str]
    """What a vertex has."""
    at_pixels: Mapping[Place, str | Between]
    """What a pixel has."""
    vertex_roles: Mapping[str, str]
    """Parameters that the engine sets itself, by their role in a scene."""
    pixel_roles: Mapping[str, str]
    own_inputs: tuple[str, ...] = ()
    """Vertex inputs of four lanes that a material can use as its own."""
    interpolated: frozenset[str]
    """The types of values that vertices can hand to pixels."""
    lanes: Mapping[str, str] = EMPTY
    """The lanes of a value between vertices and pixels, by its type, where all have four."""
    parameter: str = "{name}"
    """How a parameter is read."""
    texture: str = "{name}"
    between: str = "{name}"
    hand_over: str = "{name} = {value};"
    """The statement of a vertex that hands a value to pixels."""

    @property
    def taken(self) -> frozenset[str]:
        """The rows of the table of all engines that the engine takes."""
        rows = (*self.lit, *self.unlit, *self.moved)
        return frozenset({each.input for each in rows} | {each.factor for each in rows} - {""})

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of values between vertices and pixels, and of those that move a vertex."""
        handed = [row.name for row in self.at_pixels.values() if isinstance(row, Between)]
        return (*handed, *(f"{MOVED}{row.input}" for row in self.moved))
