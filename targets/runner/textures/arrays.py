"""Pictures and arrays as the texels that a texture stores: (height, width, 4), 8 bits or floats."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps, UnidentifiedImageError

from ..drivers.draw import TextureFormat
from .mipmaps import Texels
from .texture import PictureError

MAX_SIDE = 8192
"""Texels; the largest texture that WebGPU promises."""


def texel_array(array: Any, srgb: bool) -> tuple[Texels, TextureFormat]:
    """The texels that ``Texture.of_array`` makes of an array, and their format.

    Raises ``PictureError`` for arrays of other shapes and kinds.
    """
    given = np.asarray(array)
    if given.dtype == np.uint8:
        return _four_lanes(given, 255), "rgba8unorm-srgb" if srgb else "rgba8unorm"
    if given.dtype == np.uint16:
        return texel_array(((given.astype(np.uint32) + 128) // 257).astype(np.uint8), srgb)
    if not np.issubdtype(given.dtype, np.floating):
        raise PictureError(f"texels are uint8, uint16 or floats, not {given.dtype}")
    if srgb:
        raise PictureError("texels that are floats are linear: only those of 8 bits can be sRGB")
    with np.errstate(over="ignore"):
        floats = given.astype(np.float32)
    if not np.isfinite(floats).all():
        raise PictureError("texels are finite float32 numbers, and some of these are not")
    return _four_lanes(floats, 1), "rgba32float"


def _four_lanes(given: NDArray[Any], opaque: int) -> NDArray[Any]:
    """Grey in three lanes, and opaque where there is no alpha."""
    texels = given[..., np.newaxis] if given.ndim == 2 else given
    if texels.ndim != 3 or texels.shape[2] not in (1, 3, 4) or 0 in texels.shape:
        wanted = "(height, width) or (height, width, 1, 3 or 4)"
        raise PictureError(f"a texture has the shape {wanted}, not {given.shape}")
    height, width, lanes = texels.shape
    _check_size(width, height, "the array")
    whole = np.full((height, width, 4), opaque, texels.dtype)
    whole[..., : max(lanes, 3)] = texels
    return whole


def _check_size(width: int, height: int, what: str) -> None:
    if max(width, height) > MAX_SIDE:
        size = f"{width} x {height} texels"
        raise PictureError(f"{what} has {size}, and no side may have more than {MAX_SIDE}")


def read_picture(path: Path) -> NDArray[Any]:
    """The picture in a file as an array for ``texel_array``. Raises ``PictureError``."""
    try:
        with warnings.catch_warnings():
            # The size is checked below, before anything is unpacked, and more strictly.
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            with Image.open(path) as picture:
                _check_size(*picture.size, str(path))
                return _lanes(ImageOps.exif_transpose(picture))
    except PictureError:
        raise
    except UnidentifiedImageError:
        raise PictureError(f"{path} is not a picture of a known format") from None
    except Image.DecompressionBombError:
        raise PictureError(f"{path} is too large: no side may have over {MAX_SIDE}") from None
    except OSError as error:
        raise PictureError(f"cannot read {path}: {error.strerror or error}") from None
    except Exception as error:  # Of a damaged file, decoders raise whatever they come upon.
        raise PictureError(f"{path} is damaged: {error}") from None


def _lanes(picture: Image.Image) -> NDArray[Any]:
    """The lanes as they are where they have more than 8 bits, else RGBA."""
    if picture.mode == "F":
        return np.asarray(picture, np.float32)
    if picture.mode.startswith("I"):
        clipped: NDArray[Any] = np.clip(np.asarray(picture), 0, 65535).astype(np.uint16)
        return clipped
    return np.asarray(picture.convert("RGBA"))
