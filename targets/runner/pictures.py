"""Pictures for people: what a render target holds, as an image file."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from .textures.kinds import PictureError
from .textures.srgb import encode_srgb

Floats = NDArray[np.float64]


def to_image(pixels: Floats, *, lanes: int = 4) -> Image.Image:
    """A target, (height, width, 4), as a screen shows it: linear light in sRGB, without alpha.

    A target that has but one of the ``lanes`` is shown in grey. What is not finite is shown in
    magenta, which no picture has by chance.
    """
    rgb = np.repeat(pixels[..., :1], 3, axis=2) if lanes == 1 else pixels[..., :3]
    finite = np.isfinite(rgb).all(axis=2, keepdims=True)
    shown = encode_srgb(np.clip(np.where(finite, rgb, 0.0), 0.0, 1.0))
    shown = np.where(finite, shown, [1.0, 0.0, 1.0])
    return Image.fromarray(np.rint(shown * 255).astype(np.uint8), "RGB")


def check_format(path: Path) -> None:
    """Raises ``PictureError`` unless the name's ending says how to write a picture."""
    _format(path)


def save(image: Image.Image, path: Path) -> None:
    """Writes an image, in the format that the name's ending says, whole or not at all.

    Raises ``PictureError``.
    """
    form = _format(path)
    staging = path.with_name(f".burnish-{os.getpid()}{path.suffix}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            image.save(staging, format=form)
            staging.replace(path)
        finally:
            staging.unlink(missing_ok=True)
    except (OSError, ValueError) as error:
        raise _unwritable(path, getattr(error, "strerror", None) or str(error)) from error


def _format(path: Path) -> str:
    """Pillow's name of a format that can be written."""
    Image.init()
    form = Image.EXTENSION.get(path.suffix.lower())
    if form is None or form not in Image.SAVE:
        raise _unwritable(path, "a picture's name ends in .png, .jpg or another image format")
    return form


def _unwritable(path: Path, reason: str) -> PictureError:
    return PictureError(f"cannot write `{path}`: {reason}")
