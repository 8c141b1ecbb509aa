"""Makes a cube from a panorama: one picture of all directions, twice as wide as high.

The middle of the picture lies along -z, where a camera looks by itself; u goes to the right, to +x,
and the top is +y (equirectangular). ``files.py`` calls this module.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .kinds import PictureError

Floats = NDArray[np.float64]


def cube_of(picture: NDArray[Any], name: str) -> NDArray[np.float32]:
    """The six faces of a panorama of floats, of shape (6, side, side, lanes).

    A side is half as long as the picture is high. Raises ``PictureError``, which calls the picture
    ``name``.
    """
    height, width = picture.shape[:2]
    if picture.dtype != np.float32:
        raise PictureError(f"a cube takes six pictures, or a panorama of floats, and not {name}")
    if width != 2 * height or height < 2:
        raise PictureError(
            f"a panorama is twice as wide as high, and {name} has {width} x {height} texels"
        )
    texels = picture[..., np.newaxis] if picture.ndim == 2 else picture
    faces = (_seen(texels, towards) for towards in face_directions(height // 2))
    return np.stack([face.astype(np.float32) for face in faces])


def face_directions(side: int) -> Iterator[Floats]:
    """The direction of each texel of each face, of shape (side, side, 3): right and down on a face
    are s and t, as Direct3D, Vulkan, OpenGL and WebGPU have them."""
    steps = (np.arange(side) + 0.5) / side * 2 - 1
    t, s = np.meshgrid(steps, steps, indexing="ij")
    one = np.ones_like(s)
    faces = (
        (one, -t, -s), (-one, -t, s), (s, one, t), (s, -one, -t), (s, -t, one), (-s, -t, -one),
    )  # fmt: skip
    return (np.stack(face, axis=2) for face in faces)


def _seen(texels: NDArray[Any], towards: Floats) -> Floats:
    """The texels in some directions, filtered between the four nearest, around the sides."""
    height, width = texels.shape[:2]
    x, y, z = np.moveaxis(towards / np.linalg.norm(towards, axis=2, keepdims=True), 2, 0)
    across = (0.5 + np.arctan2(x, -z) / (2 * np.pi)) * width - 0.5
    down = np.clip(np.arccos(np.clip(y, -1, 1)) / np.pi * height - 0.5, 0, height - 1)
    left, above = np.floor(across).astype(int), np.floor(down).astype(int)
    right, below = (left + 1) % width, np.minimum(above + 1, height - 1)
    share_x, share_y = (across - left)[..., None], (down - above)[..., None]
    left %= width
    upper = texels[above, left] * (1 - share_x) + texels[above, right] * share_x
    lower = texels[below, left] * (1 - share_x) + texels[below, right] * share_x
    found: Floats = upper * (1 - share_y) + lower * share_y
    return found
