"""Texels to numbers and back, and the levels below them.

The levels are made here and not by a driver, because drivers filter each in their own way.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from ..drivers.draw import TEXELS, Dimension, TextureFormat
from .srgb import decode_srgb, encode_srgb

Texels = NDArray[np.uint8 | np.float32 | np.uint32 | np.int32]
"""(depth, height, width, lanes), as stored."""

Linear = NDArray[np.float64]
"""(depth, height, width, 4), as a shader reads it."""

_BAND = 256
"""Rows that are worked on at a time."""


def decoded(texels: Texels, format: TextureFormat) -> Linear:
    """What a GPU reads from stored texels: 8-bit lanes over 255, sRGB-encoded ones made linear."""
    if format == "rgba32float":
        return texels.astype(np.float64)
    table = np.arange(256) / 255.0
    if format == "rgba8unorm":
        lanes: Linear = table[texels]
        return lanes
    lanes = np.empty(texels.shape)
    lanes[..., :3] = decode_srgb(table)[texels[..., :3]]
    lanes[..., 3] = table[texels[..., 3]]
    return lanes


def encoded(lanes: Linear, format: TextureFormat) -> Texels:
    """The nearest texels; lanes of 8 bits are limited to 0..1."""
    if format == "rgba32float":
        return lanes.astype(np.float32)
    limited = np.clip(lanes, 0.0, 1.0)
    if format == "rgba8unorm-srgb":
        limited[..., :3] = encode_srgb(limited[..., :3])
    return np.rint(limited * 255.0).astype(np.uint8)


def stored_levels(
    format: TextureFormat, levels: Sequence[bytes], size: Callable[[int], tuple[int, int, int]]
) -> list[NDArray[np.float64] | NDArray[np.int64]]:
    """Each level as a shader reads it: of depths one lane, else four, 0, 0, 1 where there are not.

    ``size`` is a level's depth, height and width.
    """
    texel = TEXELS[format]
    found: list[NDArray[np.float64] | NDArray[np.int64]] = []
    for number, data in enumerate(levels):
        texels = np.frombuffer(data, texel.kind).reshape(*size(number), texel.lanes)
        if texel.sample == "float":
            found.append(decoded(texels, format))
        elif texel.sample == "depth":
            found.append(texels.astype(np.float64))
        else:
            whole = np.zeros((*texels.shape[:3], 4), np.int64)
            whole[..., 3] = 1
            whole[..., : texel.lanes] = texels
            found.append(whole)
    return found


def smaller(texels: Texels, format: TextureFormat, dimension: Dimension) -> list[Texels]:
    """All levels below one of colours, down to a single texel, or one in each layer.

    Each halves width and height, and a volume's depth, rounding down, and averages what its texels
    cover, in linear light.
    """
    axes = (2, 1, 0) if dimension == "3d" else (2, 1)
    found: list[Texels] = []
    if all(texels.shape[axis] == 1 for axis in axes):
        return found
    # The whole first level as float64 would be gigabytes; half of its columns are bearable.
    bands = (texels[:, start : start + _BAND] for start in range(0, texels.shape[1], _BAND))
    lanes = np.concatenate([_halved(decoded(band, format), 2) for band in bands], axis=1)
    for axis in axes[1:]:
        lanes = _halved(lanes, axis)
    found.append(encoded(lanes, format))
    while any(lanes.shape[axis] != 1 for axis in axes):
        for axis in axes:
            lanes = _halved(lanes, axis)
        found.append(encoded(lanes, format))
    return found


def _halved(lanes: Linear, axis: int) -> Linear:
    """Half as many slices (axis 0), rows or columns, each the mean of those it covers.

    Half of an odd number covers two and a bit: of 2n + 1, the i-th covers n - i parts of the first,
    n of the second, and i + 1 of the third, of which there are 2n + 1 altogether.
    """
    rows = np.moveaxis(lanes, axis, 0)
    half = len(rows) // 2
    if half == 0:
        return lanes
    if len(rows) % 2 == 0:
        mean = (rows[0::2] + rows[1::2]) / 2.0
    else:
        i = np.arange(half).reshape(half, *([1] * (rows.ndim - 1)))
        first, second, third = rows[0:-1:2], rows[1::2], rows[2::2]
        mean = ((half - i) * first + half * second + (i + 1) * third) / len(rows)
    return np.moveaxis(mean, 0, axis)
