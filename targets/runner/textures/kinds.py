"""The kinds of texels, how texts name them, and the error for a picture of another kind."""

from __future__ import annotations

from typing import Literal

Kind = Literal["float", "depth", "int", "uint"]
"""The kind of a texture's texels, in the reflection's words (``sample``)."""

FACES = ("+x", "-x", "+y", "-y", "+z", "-z")
"""The faces of a cube, in the order in which they are stored."""

SRGB_PREFIX = "srgb:"
LINEAR_PREFIX = "linear:"
"""The beginnings of texts that say themselves how the numbers in a file are meant."""


def without_prefix(text: str) -> str:
    """The names of files in a text for ``Texture.parse``."""
    return text.removeprefix(SRGB_PREFIX).removeprefix(LINEAR_PREFIX)


class PictureError(ValueError):
    """A picture cannot become a texture; the text tells people why."""
