"""The kinds of texels, and the error for a picture that has texels of another kind."""

from __future__ import annotations

from typing import Literal

Kind = Literal["float", "depth", "int", "uint"]
"""The kind of a texture's texels, in the reflection's words (``sample``)."""

FACES = ("+x", "-x", "+y", "-y", "+z", "-z")
"""The faces of a cube, in the order in which they are stored."""


class PictureError(ValueError):
    """A picture cannot become a texture; the text tells people why."""
