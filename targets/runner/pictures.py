"""Writes the contents of a render target as a file: an image for people, or its numbers.

``burnish render`` calls this module.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ...compiler.reference.transfer import encode_srgb
from .textures.high_range import check_installed, encoded_floats, format_of
from .textures.kinds import PictureError

Floats = NDArray[np.float64]


class Development(NamedTuple):
    """The way from light to what a screen can show."""

    exposure: float = 0.0
    """The stops by which light is brightened: each doubles it."""
    curve: str = "none"
    """A key of ``CURVES``."""

    def applied(self, light: Floats) -> Floats:
        """What a screen shows of light, before it is encoded."""
        return np.clip(CURVES[self.curve](np.maximum(light * 2.0**self.exposure, 0.0)), 0.0, 1.0)


def _reinhard(light: Floats) -> Floats:
    """E. Reinhard and others, "Photographic Tone Reproduction for Digital Images", 2002, eq. 3."""
    return light / (1 + light)


def _aces(light: Floats) -> Floats:
    """The fit of ACES by K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016."""
    return light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14)


CURVES: Mapping[str, Callable[[Floats], Floats]] = {
    "none": lambda light: light, "reinhard": _reinhard, "aces": _aces,
}  # fmt: skip
"""Tone mapping, each lane by itself; without any, light above 1 is cut off."""
AS_IT_IS = Development()


def to_image(pixels: Floats, *, lanes: int = 4, development: Development = AS_IT_IS) -> Image.Image:
    """A target of shape (height, width, 4) as a screen shows it: sRGB, without alpha.

    A target with a single lane is no light, and is shown in grey as it is. Numbers that are not
    finite are shown in magenta, which no picture contains by accident.
    """
    if lanes == 1:
        rgb, development = np.repeat(pixels[..., :1], 3, axis=2), AS_IT_IS
    else:
        rgb = pixels[..., :3]
    finite = np.isfinite(rgb).all(axis=2, keepdims=True)
    shown = encode_srgb(development.applied(np.where(finite, rgb, 0.0)))
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
