"""Converts arrays to the texels that a texture stores, of shape (depth, height, width, lanes)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..drivers.texels import Dimension, TextureFormat
from .kinds import FACES, Kind, PictureError
from .mipmaps import Texels

MAX_SIDE = 8192
"""The longest side of a texture that every WebGPU device supports, in texels."""
MAX_VOLUME_SIDE = 2048
MAX_LAYERS = 256
"""The most slices of a 3D texture on a side, and the most layers, that every device supports."""


def texel_array(
    array: Any, srgb: bool, dimension: Dimension, sample: Kind
) -> tuple[Texels, TextureFormat]:
    """The texels and the format of the texture that ``Texture.of_array`` makes of an array.

    Raises ``PictureError`` for arrays of other shapes and types.
    """
    given = np.asarray(array)
    if srgb and sample != "float":
        raise PictureError("only colours can be sRGB")
    match sample:
        case "float":
            return _colors(given, srgb, dimension)
        case "depth":
            return _shaped(_depths(given), dimension, (1,)), "depth32float"
        case _:
            return _integers(given, dimension, sample)


def check_level(
    first: Texels, array: Any, number: int, srgb: bool, dimension: Dimension, sample: Kind
) -> Texels:
    """The texels of a smaller level that the caller has made. Raises ``PictureError``."""
    texels, _ = texel_array(array, srgb, dimension, sample)
    halved = [max(side >> number, 1) for side in first.shape[:3]]
    if dimension != "3d":
        halved[0] = first.shape[0]
    wanted = (*halved, first.shape[3])
    if texels.shape != wanted or texels.dtype != first.dtype:
        raise PictureError(
            f"level {number} has {_size(texels)} of {texels.dtype}, and half of the one before"
            f" is {' x '.join(map(str, wanted[2::-1]))} of {first.dtype}"
        )
    return texels


def _colors(given: NDArray[Any], srgb: bool, dimension: Dimension) -> tuple[Texels, TextureFormat]:
    if given.dtype == np.uint16:
        given = ((given.astype(np.uint32) + 128) // 257).astype(np.uint8)
    if given.dtype == np.uint8:
        texels = _four_lanes(_shaped(given, dimension, (1, 3, 4)), 255)
        return texels, "rgba8unorm-srgb" if srgb else "rgba8unorm"
    if not np.issubdtype(given.dtype, np.floating):
        raise PictureError(f"texels are uint8, uint16 or floats, not {given.dtype}")
    if srgb:
        raise PictureError("texels that are floats are linear: only those of 8 bits can be sRGB")
    floats = _single(given)
    return _four_lanes(_shaped(floats, dimension, (1, 3, 4)), 1), "rgba32float"


def _single(given: NDArray[Any]) -> NDArray[np.float32]:
    with np.errstate(over="ignore"):
        floats = given.astype(np.float32, copy=False)
    if not np.isfinite(floats).all():
        raise PictureError("texels are finite float32 numbers, and some of these are not")
    return floats


def _depths(given: NDArray[Any]) -> NDArray[np.float32]:
    """Depths in 0..1; integers of 8 and 16 bits are scaled to this range."""
    if given.dtype in (np.uint8, np.uint16):
        return (given / np.iinfo(given.dtype).max).astype(np.float32)
    if not np.issubdtype(given.dtype, np.floating):
        raise PictureError(f"depths are floats, uint8 or uint16, not {given.dtype}")
    depths = _single(given)
    if not ((depths >= 0) & (depths <= 1)).all():
        raise PictureError("depths lie in 0..1, and some of these do not")
    return depths


def _integers(
    given: NDArray[Any], dimension: Dimension, sample: Kind
) -> tuple[Texels, TextureFormat]:
    if given.dtype.kind not in "iu":
        raise PictureError(f"the texture holds integers, not {given.dtype}")
    limits = np.iinfo(np.int32 if sample == "int" else np.uint32)
    if given.size and not (limits.min <= given.min() and given.max() <= limits.max):
        raise PictureError(f"a texel of integers lies in {limits.min}..{limits.max}")
    texels = _shaped(given, dimension, (1, 3, 4))
    if texels.shape[3] == 3:
        texels = _four_lanes(texels, 1)
    single = texels.shape[3] == 1
    if sample == "int":
        return texels.astype(np.int32), "r32sint" if single else "rgba32sint"
    if texels.dtype == np.uint8:
        return texels, "r8uint" if single else "rgba8uint"
    return texels.astype(np.uint32), "r32uint" if single else "rgba32uint"


def _shaped(given: NDArray[Any], dimension: Dimension, lanes: tuple[int, ...]) -> NDArray[Any]:
    """The array in the shape (depth, height, width, lanes)."""
    flat = dimension == "2d"
    texels = given[..., np.newaxis] if given.ndim == 3 - flat else given
    if texels.ndim != 4 - flat or texels.shape[-1] not in lanes or 0 in texels.shape:
        *most, last = map(str, lanes)
        counts = f"{', '.join(most)} or {last}" if most else last
        sides = "height, width" if flat else "layers, height, width"
        raise PictureError(f"a texture has the shape ({sides}) or ({sides}, {counts}), not "
                           f"{given.shape}")  # fmt: skip
    whole = texels[np.newaxis] if flat else texels
    _check_size(whole, dimension)
    return whole


def _check_size(texels: NDArray[Any], dimension: Dimension) -> None:
    depth, height, width, _ = texels.shape
    if dimension == "3d":
        if max(depth, height, width) > MAX_VOLUME_SIDE:
            what = f"the volume has {_size(texels)} texels"
            raise PictureError(f"{what}, and no side may have more than {MAX_VOLUME_SIDE}")
        return
    check_sides(width, height, "the array")
    if dimension in ("2d_array", "cube_array") and depth > MAX_LAYERS:
        what = "layers" if dimension == "2d_array" else "faces"
        raise PictureError(f"the array has {depth} {what}, and may have {MAX_LAYERS}")
    if dimension == "cube" and (depth != len(FACES) or width != height):
        raise PictureError(f"a cube has six square faces, and not {_size(texels)} texels")
    if dimension == "cube_array" and (depth % len(FACES) or width != height):
        raise PictureError(f"each cube has six square faces, and these are {_size(texels)} texels")


def check_sides(width: int, height: int, what: str) -> None:
    """Raise ``PictureError`` for a picture that is too large."""
    if max(width, height) > MAX_SIDE:
        size = f"{width} x {height} texels"
        raise PictureError(f"{what} has {size}, and no side may have more than {MAX_SIDE}")


def _size(texels: NDArray[Any]) -> str:
    depth, height, width, _ = texels.shape
    return f"{width} x {height} x {depth}"


def _four_lanes(texels: NDArray[Any], opaque: int) -> NDArray[Any]:
    """Texels with four lanes: grey becomes three equal lanes, a missing alpha is opaque."""
    if texels.shape[3] == 4:
        return texels
    whole = np.full((*texels.shape[:3], 4), opaque, texels.dtype)
    whole[..., : max(texels.shape[3], 3)] = texels
    return whole
