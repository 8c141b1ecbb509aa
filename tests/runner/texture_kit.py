"""Reads the texels that a texture stores."""

from __future__ import annotations

from typing import Any

import numpy as np

from burnish import Texture


def first(texture: Texture) -> np.ndarray[Any, Any]:
    """The first level's bytes, (height, width, 4)."""
    return np.frombuffer(texture.levels[0], np.uint8).reshape(texture.height, texture.width, 4)


def texel(texture: Texture) -> tuple[int, ...]:
    return tuple(texture.levels[0])
