"""The document of functions: how an engine calls the slots of one material."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Literal

from ...support.frozen import EMPTY, frozen
from ..constraints import Lanes
from ..ir.functions import PassBlend
from ..ir.render_state import Cull
from ..ir.types import DIMENSION_WORDS, Dimension, Intent, Sample
from .drawing import SamplerState
from .values import ChoiceRow


@frozen(kw_only=True)
class SlotRow:
    """A value that a function returns."""

    name: str
    """The slot, such as ``roughness``."""
    type: str
    """The type as written, or the meaning: ``rgb``, ``normal<world>``."""
    representation: str
    """The type on the machine: ``float``, ``vec3``."""
    doc: str
    """Doc comment; empty where there is none."""
    role: str | None
    """The engines' word for it, such as ``metallic``, if the library declares the slot."""


@frozen(kw_only=True)
class FunctionRow:
    """A function."""

    name: str
    """The name by which backends list it: a slot, or ``surface`` or ``vertices`` for several."""
    stage: str
    """The stage for which it computes, by its name: that of vertices, or that of pixels.

    A function for pixels may compare neighbouring pixels, as reads of textures do.
    """
    slots: tuple[SlotRow, ...]
    """What it returns: one value, or the members of a structure."""
    arguments: tuple[str, ...]
    """Its arguments by name, in order; textures follow them."""
    textures: tuple[str, ...]
    """The textures that it reads, by name, in order."""


@frozen(kw_only=True)
class FunctionMemberRow:
    """A member of a structure."""

    name: str
    """The member's name."""
    type: str
    """The type as written."""
    representation: str
    """The type on the machine."""
    default: Lanes
    """Value before a host sets one; null where the declaration gives none."""
    doc: str
    """Doc comment; empty where there is none."""


@frozen(kw_only=True)
class ArgumentRow:
    """An argument of functions: the same value in all functions that have it."""

    name: str
    """Its name in this document, which no other argument has."""
    source: Literal["surface", "attribute", "varying", "pipeline", "parameter"]
    """What the engine gives.

    ``surface``: a value that it has at each pixel, ``attribute``: a vertex input (interpolated, in
    functions for pixels), ``varying``: what a function for vertices returns, interpolated,
    ``pipeline``: a value of the stage, ``parameter``: what a user sets.
    """
    given: str
    """What that is called: ``position``, ``vertex_color``, ``frag_coord``, ``base``.

    Of a varying, it is the name of the function.
    """
    type: str
    """The type as written, with its space: ``point<world>``."""
    representation: str
    """The type on the machine: ``float``, ``vec3``, ``Lamp[8]``."""
    interpolation: Literal["perspective", "flat"] | None
    """How it is interpolated between vertices and pixels; null for parameters and the pipeline."""
    doc: str
    """Doc comment; empty where there is none."""
    group: str | None
    """Of a parameter, how often it changes: ``frame``, ``view``, ``rig``, ``material``, ``draw``.

    Null for all others.
    """
    default: Lanes
    """Of a parameter, its value before somebody sets one; null where there is none."""
    range: tuple[float, float] | None
    """Lowest and highest value that a host may set; null where the declaration gives none."""
    choices: tuple[ChoiceRow, ...] | None
    """Members of the enumeration that it is, by their numbers, from 0; null for others."""
    library: str | None
    """Declaration of the library that it is; null for others."""
    role: str | None
    """Meaning for a program that shows scenes, such as ``eye``, which an engine knows itself."""
    members: tuple[FunctionMemberRow, ...]
    """Members of a structure, or of an array's elements; empty for all others."""


@frozen(kw_only=True)
class FunctionTextureRow:
    """A texture that functions read."""

    WORDS: ClassVar = {"dimension": DIMENSION_WORDS}

    name: str
    """Name as the host says it."""
    type: str
    """Type as declared, such as ``texture2d`` or ``depth_cube``."""
    dimension: Dimension
    """Dimension."""
    sample: Sample
    """Content: colours, depths to compare with, or whole numbers."""
    intent: Intent
    """``color`` where texels become colours, which are decoded from sRGB; else ``data``."""
    state: SamplerState | None
    """State of its sampler; null where it is only loaded."""
    default: str
    """Texture to bind before a host sets one, such as ``white``."""
    default_texel: tuple[float, ...]
    """The only texel of that texture."""
    doc: str
    """Doc comment; empty where there is none."""
    library: str | None
    """Declaration of the library that it is; null for others."""


@frozen(kw_only=True)
class ArgumentTextRow:
    """An argument in a text."""

    identifier: str
    """Its name in the text."""
    type: str
    """Its type in the text."""
    kind: Literal["value", "texture", "sampler"]
    """``texture`` and ``sampler``: of the texture called ``given``; both may be one object."""
    given: str
    """The argument, or the texture, by its name in this document."""


@frozen(kw_only=True)
class FunctionTextRow:
    """A function in a text."""

    identifier: str
    """Its name in the text."""
    returns: str
    """The type that it returns, in the text."""
    members: tuple[str, ...]
    """The members of the structure that it returns, in the order of its slots; else empty."""
    arguments: tuple[ArgumentTextRow, ...]
    """Its arguments, in order."""
    needs: tuple[str, ...]
    """The structures and functions of the text that it needs, each behind what it needs."""


@frozen(kw_only=True)
class FunctionsBackendRow:
    """The text for one profile."""

    language: str
    """The language."""
    file: str
    """File name, relative to this document."""
    requires: tuple[str, ...]
    """Lines that have to stand at the beginning of the text that gets the functions."""
    helpers: tuple[str, ...]
    """Names of structures and functions that the functions need, in order."""
    functions: Mapping[str, FunctionTextRow]
    """Functions by their name in this document."""


@frozen(kw_only=True)
class OwnPassRow:
    """How the pass draws a material that is tied to it, as far as engines can do so."""

    name: str
    """The pass."""
    cull: Cull
    """Faces that are not drawn, a GPUCullMode: front faces run counter-clockwise."""
    blend: PassBlend
    """Blending of what is drawn with what is there, by the language's word for it."""
    covers: bool
    """True if the alpha is the share of a pixel's samples that are covered."""


@frozen(kw_only=True)
class Functions:
    """Everything that an engine has to know to call the slots of one material."""

    VERSION: ClassVar = "signatures"

    signatures: Literal[1]
    """Version of this document's format."""
    material: str
    """The material."""
    doc: str
    """The material's doc comment; empty where there is none."""
    rig: str | None
    """The rig whose lights are arguments; null where no function needs any."""
    own_pass: OwnPassRow | None = None
    """How it is drawn; left out for a material that is tied to no pass."""
    named: Mapping[str, str] = EMPTY
    """Slots that somebody has named for values of the engine, by these; empty without any."""
    functions: tuple[FunctionRow, ...]
    """The functions: those asked for, then those whose results are interpolated for them."""
    arguments: tuple[ArgumentRow, ...]
    """All arguments."""
    textures: tuple[FunctionTextureRow, ...]
    """All textures that some function reads."""
    backends: Mapping[str, FunctionsBackendRow]
    """Emitted profiles by name."""
