"""Computes mip levels, and converts texels to numbers and back.

The levels are made here and not by a driver, because each driver filters in its own way.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from ....compiler.reference.transfer import decode_srgb, encode_srgb
from ..drivers.texels import TEXELS, Dimension, TextureFormat

Texels = NDArray[np.uint8 | np.float32 | np.uint32 | np.int32]
"""Texels as stored, of shape (depth, height, width, lanes)."""

Linear = NDArray[np.float64]
"""Texels as a shader reads them, of shape (depth, height, width, 4)."""

_BAND = 128
"""The rows of a level that are made at once: the numbers of a whole large one would take
gigabytes."""


def decoded(texels: Texels, format: TextureFormat) -> Linear:
    """The numbers that a GPU reads: 8-bit lanes are divided by 255, and sRGB is decoded."""
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
    """The nearest texels; lanes of 8 bits are clamped to 0..1."""
    if format == "rgba32float":
        return lanes.astype(np.float32)
    limited = np.clip(lanes, 0.0, 1.0)
    if format == "rgba8unorm-srgb":
        limited[..., :3] = encode_srgb(limited[..., :3])
    return np.rint(limited * 255.0).astype(np.uint8)


def stored_levels(
    format: TextureFormat, levels: Sequence[bytes], size: Callable[[int], tuple[int, int, int]]
) -> list[NDArray[np.float64] | NDArray[np.int64]]:
    """Each level as a shader reads it. Depths have one lane; missing lanes of others are 0, 0, 1.

    ``size`` returns a level's depth, height and width.
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
    """All smaller levels of a colour texture, down to a single texel, or to one in each layer.

    Each level halves width and height, and the depth of a 3D texture, and rounds them down. Its
    texels are the means, in linear light, of the texels that they cover.
    """
    axes = (2, 1, 0) if dimension == "3d" else (2, 1)
    found: list[Texels] = []
    if all(texels.shape[axis] == 1 for axis in axes):
        return found
    lanes = _second(texels, format)
    if dimension == "3d":
        lanes = _halved(lanes, 0)
    found.append(_encoded_in_bands(lanes, format))
    while any(lanes.shape[axis] != 1 for axis in axes):
        for axis in axes:
            lanes = _halved(lanes, axis)
        found.append(_encoded_in_bands(lanes, format))
    return found


def _second(texels: Texels, format: TextureFormat) -> Linear:
    """The numbers of texels with half as many columns and rows."""
    depth, height, width, count = texels.shape
    rows = max(height // 2, 1)
    lanes = np.empty((depth, rows, max(width // 2, 1), count))
    reach = 3 if height % 2 else 2
    for start in range(0, rows, _BAND):
        end = min(start + _BAND, rows)
        band = _halved(decoded(texels[:, 2 * start : 2 * end + reach - 2], format), 2)
        lanes[:, start:end] = _halved(band, 1, start, height)
    return lanes


def _encoded_in_bands(lanes: Linear, format: TextureFormat) -> Texels:
    bands = (lanes[:, start : start + _BAND] for start in range(0, lanes.shape[1], _BAND))
    return np.concatenate([encoded(band, format) for band in bands], axis=1)


def _halved(lanes: Linear, axis: int, first: int = 0, of: int | None = None) -> Linear:
    """Half as many slices (axis 0), rows or columns; each is the mean of what it covers. Where only
    a band is given, the results begin with number ``first``, and there were ``of`` in all.

    If the number is odd, 2n + 1, each of the n results covers a bit more than two. The i-th covers
    n - i parts of the first, n parts of the second and i + 1 parts of the third, out of 2n + 1
    parts.
    """
    rows = np.moveaxis(lanes, axis, 0)
    total = len(rows) if of is None else of
    n, made = total // 2, len(rows) // 2
    if n == 0:
        return lanes
    if total % 2 == 0:
        mean = (rows[0::2] + rows[1::2]) / 2.0
    else:
        i = np.arange(first, first + made).reshape(made, *([1] * (rows.ndim - 1)))
        before, middle, behind = rows[0:-1:2], rows[1::2], rows[2::2]
        mean = ((n - i) * before + n * middle + (i + 1) * behind) / total
    return np.moveaxis(mean, 0, axis)
