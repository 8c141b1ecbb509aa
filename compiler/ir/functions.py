"""The types of functions that an engine calls: what is asked for, and what semantics makes of it.

Semantics makes a ``Shader`` whose results are values of slots. ``stage_functions`` finds out what
the arguments of the functions are.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from ...support.frozen import EMPTY, frozen
from .render_state import Cull
from .shader import Shader


@frozen
class Offer:
    """A slot that an engine takes of a material that has it."""

    name: str
    at_vertices: bool = False
    """True if it is computed for vertices, and not for pixels."""
    owner: str | None = ""
    """The record of the library that has to declare it; empty where a user's has to.

    ``None`` if it does not matter, as somebody asks for this slot.
    """
    changed: bool = False
    """True if it counts only where something else is said than where it is declared.

    The engine itself has what the declaration says.
    """
    made_of: tuple[str, ...] = ()
    """Slots of which the declaration makes it: what is said of these counts as well."""
    blended: bool = False
    """True if it is left out where the material is tied to a pass that does not blend."""
    usual: float | str | None = None
    """What the engine has itself, if that is known: a number, or the word of another slot.

    Where the declaration says something else, the slot is given even if it is as declared.
    """
    beside: tuple[str, ...] = ()
    """The words of the slots without which such a value has no effect."""


@frozen
class FunctionsAsked:
    """The functions that somebody wants of a material."""

    slots: tuple[str, ...] = ()
    """Slots by name, perhaps followed by ``@vertex`` or ``@fragment``; empty for the own slots."""
    offers: tuple[Offer, ...] = ()
    """Slots to return as far as the material has them, instead of these."""
    left: tuple[Offer, ...] = ()
    """Slots to leave out of the own ones where they are as declared: the engine has these."""
    together: bool = False
    """True for one function that returns all slots, instead of a function for each slot.

    There is one for pixels and one for vertices.
    """
    lit: bool = False
    """True if lights may be arguments: those of a rig that was asked for."""
    at_vertices: frozenset[str] = frozenset()
    """The slots that are computed for vertices unless something else is said.

    They are the library's names: ``std.file.Record.name``.
    """
    words: Mapping[str, str] = EMPTY
    """The engines' words for slots, by the library's names; they are made without being named."""
    of_surface: Mapping[str, str] = EMPTY
    """The engines' words for slots whose interpolated values they have, by the library's names."""
    moving: Mapping[str, str] = EMPTY
    """The words of these that a material moves where it says something else of a slot."""


@frozen
class SlotInfo:
    """A slot whose value a function returns."""

    name: str
    function: str
    declared_type: str
    """The type as it is written, or its meaning: ``rgb``, ``normal<world>``, ``float``."""
    doc: str
    word: str = ""
    """The engines' word for it, if the library declares it and they have one."""


@frozen
class SurfaceInfo:
    """A value of the surface that engines have, as the library declares it."""

    name: str
    word: str
    """The engines' word for it."""
    declared_type: str
    doc: str


PassBlend = Literal["none", "alpha", "premultiplied", "add", "multiply", "other"]
"""How a pass blends what it draws with what is there: ``other`` has no word of its own."""


@frozen
class OwnPass:
    """How the pass draws a material that is tied to it."""

    name: str
    cull: Cull
    """The faces that are not drawn: of those whose vertices run counter-clockwise in front."""
    blend: PassBlend
    """The blending of the first target that has one, by the language's word for it."""
    covers: bool
    """True if the alpha is the share of a pixel's samples that are covered."""


@frozen
class FunctionsShader:
    """The values of a material's slots as a shader, with what hosts are told of them."""

    shader: Shader
    """Its results are of the kind ``VALUE``, and, for pixels, of the kind ``SURFACE``."""
    slots: tuple[SlotInfo, ...]
    """The slots in the order of the results of the kind ``VALUE``."""
    surface: tuple[SurfaceInfo, ...]
    """The values that engines have, in the order of the results of the kind ``SURFACE``."""
    own_pass: OwnPass | None = None
    """How it is drawn, if it is tied to a pass."""
