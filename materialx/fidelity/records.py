"""The records that the process of MaterialX's generator hands over: texts, and all that they read.

They cross a pipe, so they are plain data. Names of types are MaterialX's own: ``color3``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

AddressMode = Literal["constant", "clamp", "periodic", "mirror"]
ADDRESS_MODES: tuple[AddressMode, ...] = ("constant", "clamp", "periodic", "mirror")
"""What is read beyond the edges of an image, in the order of MaterialX's numbers."""

LIGHT_KINDS = {"directional": "ND_directional_light", "point": "ND_point_light"}
"""The node definition for each kind of light of a setting."""

MOST_LIGHTS = 4
"""The length of the array of lights in generated texts."""


@dataclass(frozen=True, slots=True)
class Stream:
    """A vertex attribute that the text reads."""

    name: str
    """The attribute's name in the text, such as ``i_texcoord_0``."""
    type: str


@dataclass(frozen=True, slots=True)
class Uniform:
    """A uniform of the text that holds numbers."""

    name: str
    type: str
    value: tuple[float, ...]
    """The document's value, or the default of the generator; empty if the host sets it."""


@dataclass(frozen=True, slots=True)
class ImageUse:
    """A sampler of the text, and the state that MaterialX's own renderer gives it."""

    name: str
    """The sampler's name in the text."""
    file: str
    """The file as the document says it, with its prefixes; empty if it says none."""
    wrap_u: AddressMode
    wrap_v: AddressMode
    nearest: bool
    """True if texels are not filtered (``filtertype`` is ``closest``)."""
    default: tuple[float, float, float, float]
    """The colour beyond a border, and that of a file that is missing."""
    is_srgb: bool = False
    """True if the host has to decode texels from sRGB: the text does not."""


@dataclass(frozen=True, slots=True)
class Generated:
    """The texts that MaterialX generates for a renderable, with all that has to be bound."""

    vertex: str
    pixel: str
    streams: tuple[Stream, ...]
    uniforms: tuple[Uniform, ...]
    images: tuple[ImageUse, ...]
    light_members: tuple[Stream, ...]
    """The members of an element of ``u_lightData``; none if no light is read."""


class FidelityError(Exception):
    """A picture could not be made; the text tells people why."""
