"""Textures that a host hands to an instance: from pictures, arrays and single colours.

A texture's numbers are what its file says, unless the caller calls them sRGB: only the caller knows
whether a picture shows colours or holds data, such as normals or roughness.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..drivers.draw import Image, TextureFormat
from ..instances.literals import color_channels

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

SRGB_PREFIX = "srgb:"

_DEFAULTS: dict[str, Sequence[int]] = {
    "white": (255, 255, 255, 255),
    "black": (0, 0, 0, 255),
    "gray": (128, 128, 128, 255),
    "transparent": (0, 0, 0, 0),
    "flat_normal": (128, 128, 255, 255),
}


class PictureError(ValueError):
    """A picture that cannot be made a texture of; the text says why, for people."""


@dataclass(frozen=True, slots=True)
class Texture:
    """Texels with all their mip levels, the first row on top."""

    format: TextureFormat
    width: int
    """Of the first level; each further one halves both, rounding down, to no less than 1."""
    height: int
    levels: tuple[bytes, ...]

    @classmethod
    def load(cls, path: str | Path, *, srgb: bool = False) -> Texture:
        """The first picture of a file, turned as its camera noted, with 8 bits a lane.

        Palettes are looked up, grey becomes three equal lanes, what has no alpha is opaque, and of
        16 bits 8 are left. A file of floats keeps them. With ``srgb`` the colours
        (not alpha) are decoded when a shader reads them.

        Raises ``PictureError`` if there is no picture, if it is damaged, or if a side has more than
        8192 texels, the most that WebGPU promises.
        """
        from .arrays import read_picture

        return cls.of_array(read_picture(Path(path)), srgb=srgb)

    @classmethod
    def of_array(cls, array: Any, *, srgb: bool = False) -> Texture:
        """The texture of an array: (height, width), or with 1, 3 or 4 lanes (height, width, lanes).

        ``uint8`` and ``uint16`` mean 0..1, and are kept with 8 bits; floats are kept as they are,
        and are linear. Raises ``PictureError`` for arrays of other shapes and kinds.
        """
        from .arrays import texel_array
        from .mipmaps import levels

        texels, format_ = texel_array(array, srgb)
        height, width, _ = texels.shape
        stored = tuple(level.tobytes() for level in levels(texels, format_))
        return cls(format_, width, height, stored)

    @classmethod
    def solid(cls, color: str | Sequence[float]) -> Texture:
        """One texel of a colour: ``"#b5651d"``, which is sRGB, or 3 or 4 linear lanes in 0..1.

        Raises ``PictureError`` for what is neither.
        """
        import numpy as np

        if isinstance(color, str):
            channels = color_channels(color)
            if channels is None:
                raise PictureError(f"{color!r} is no colour, which would be '#b5651d'")
            return cls.of_array(np.array([[channels]], np.uint8), srgb=True)
        lanes = np.array(color, np.float64)
        if lanes.shape not in ((3,), (4,)) or not ((lanes >= 0) & (lanes <= 1)).all():
            raise PictureError(f"a colour has 3 or 4 lanes in 0..1, and {color!r} has not")
        return cls.of_array(np.rint(lanes * 255).astype(np.uint8).reshape(1, 1, -1))

    @classmethod
    def parse(cls, text: str) -> Texture:
        """What a command line says: ``picture.png``, ``srgb:picture.png`` or ``#b5651d``.

        Raises ``PictureError``.
        """
        if text.startswith("#"):
            return cls.solid(text)
        return cls.load(text.removeprefix(SRGB_PREFIX), srgb=text.startswith(SRGB_PREFIX))

    def image(self) -> Image:
        """The texture as drivers take it."""
        return Image(self.format, self.width, self.height, self.levels)

    def linear(self) -> list[NDArray[np.float64]]:
        """Each level as a shader reads it, (height, width, 4): exactly what the bytes stand for."""
        import numpy as np

        from .mipmaps import decoded

        kind = np.dtype("<f4" if self.format == "rgba32float" else "u1")
        found = []
        for number, level in enumerate(self.levels):
            height, width = max(self.height >> number, 1), max(self.width >> number, 1)
            texels = np.frombuffer(level, kind).reshape(height, width, 4)
            found.append(decoded(texels, self.format))
        return found


def default_texture(name: str) -> Texture:
    """One of the textures that a ``map`` can have until a host sets one; not sRGB."""
    return Texture("rgba8unorm", 1, 1, (bytes(_DEFAULTS[name]),))
