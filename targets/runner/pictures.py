"""Writes the contents of a render target as a file: an image for people, or its numbers.

``burnish render`` calls this module.
"""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ...compiler.reference.transfer import encode_srgb
from .textures.high_range import check_installed, encoded_floats, format_of
from .textures.kinds import PictureError

Floats = NDArray[np.float64]


def cut_off(light: Floats) -> Floats:
    """What a screen shows of light as it is: nothing that is brighter than white."""
    return np.clip(light, 0.0, 1.0)


def to_image(
    pixels: Floats, lanes: int = 4, developed: Callable[[Floats], Floats] = cut_off
) -> Image.Image:
    """A target of shape (height, width, 4) as a screen shows it: sRGB, without alpha.

    ``developed`` says what a screen shows of light. A target with a single lane is no light, and is
    shown in grey as it is. Numbers that are not finite are shown in magenta, which no picture
    contains by accident.
    """
    if lanes == 1:
        rgb, developed = np.repeat(pixels[..., :1], 3, axis=2), cut_off
    else:
        rgb = pixels[..., :3]
    finite = np.isfinite(rgb).all(axis=2, keepdims=True)
    shown = encode_srgb(developed(np.where(finite, rgb, 0.0)))
    shown = np.where(finite, shown, [1.0, 0.0, 1.0])
    return Image.fromarray(np.rint(shown * 255).astype(np.uint8), "RGB")


def check_format(path: Path) -> None:
    """Raise ``PictureError`` unless the ending of the name is that of a known image format."""
    if keeps_numbers(path):
        check_installed()
    else:
        _format(path)


def keeps_numbers(path: Path) -> bool:
    """True if files with this ending keep a target's numbers, instead of what a screen shows."""
    return format_of(path) is not None


def encoded_numbers(pixels: Floats, path: Path, *, lanes: int = 4) -> bytes:
    """The file of a target's numbers, of shape (height, width, lanes or more), in linear light;
    raises ``PictureError``."""
    form = format_of(path)
    assert form is not None
    return encoded_floats(pixels, lanes, path, form)


def encoded(image: Image.Image, path: Path, **further: Any) -> bytes:
    """A file in the format of its name's ending; raises ``PictureError``.

    ``further`` are Pillow's options for this format, such as more pictures.
    """
    file = BytesIO()
    try:
        image.save(file, format=_format(path), **further)
    except (OSError, ValueError) as error:
        raise _unwritable(path, getattr(error, "strerror", None) or str(error)) from error
    return file.getvalue()


def _format(path: Path) -> str:
    """Pillow's name of the format to write."""
    Image.init()
    form = Image.EXTENSION.get(path.suffix.lower())
    if form is None or form not in Image.SAVE:
        raise _unwritable(path, "a picture's name ends in .png, .jpg, .exr or another image format")
    return form


def _unwritable(path: Path, reason: str) -> PictureError:
    return PictureError(f"cannot write `{path}`: {reason}")
