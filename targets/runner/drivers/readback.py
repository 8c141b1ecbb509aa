"""Converts the texels of a render target to float32 RGBA, as answers have them.

Every driver calls this module for the texels that it reads back.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ....compiler.reference.transfer import decode_srgb
from .frame_job import FrameTexels
from .render_state import TargetFormat

TexelLanes = tuple[int, np.dtype[np.float32 | np.float16 | np.uint8]]

TEXEL_LANES: dict[TargetFormat, TexelLanes] = {
    "r32float": (1, np.dtype("<f4")),
    "rg32float": (2, np.dtype("<f4")),
    "rgba32float": (4, np.dtype("<f4")),
    "r16float": (1, np.dtype("<f2")),
    "rg16float": (2, np.dtype("<f2")),
    "rgba16float": (4, np.dtype("<f2")),
    "r8unorm": (1, np.dtype("u1")),
    "rg8unorm": (2, np.dtype("u1")),
    "rgba8unorm": (4, np.dtype("u1")),
    "rgba8unorm-srgb": (4, np.dtype("u1")),
}
"""The number of lanes of a texel, and their type."""


def to_float(texels: bytes, format: TargetFormat, width: int, height: int) -> bytes:
    """A target's tightly packed texels as a shader would read them: float32 RGBA."""
    count, kind = TEXEL_LANES[format]
    lanes = np.frombuffer(texels, kind).reshape(height, width, count)
    picture = np.zeros((height, width, 4), np.float32)
    picture[..., 3] = 1.0
    picture[..., :count] = lanes / np.float32(255.0) if kind == np.uint8 else lanes
    if format == "rgba8unorm-srgb":
        picture[..., :3] = decode_srgb(picture[..., :3].astype(np.float64))
    return picture.tobytes()


def depths_to_float(texels: bytes) -> bytes:
    """Tightly packed depths as float32 RGBA, in the first lane."""
    picture = np.zeros((len(texels) // 4, 4), np.float32)
    picture[:, 3] = 1.0
    picture[:, 0] = np.frombuffer(texels, "<f4")
    return picture.tobytes()


def layers_of(texels: FrameTexels) -> NDArray[np.float64]:
    """The texels of a texture that was read back: (layers, height, width, 4)."""
    shape = texels.layers, texels.height, texels.width, 4
    return np.frombuffer(texels.texels, "<f4").reshape(shape).astype(np.float64)
