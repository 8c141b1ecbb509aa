"""Reads the pictures that are judged: arrays, and files of formats that keep numbers as they are.

A file may come from anywhere. Its size has to be that of the golden picture, which is known before
anything is decoded.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .within import GoldenError, Output, read_npy

Array = NDArray[Any]

_PNG = b"\x89PNG\r\n\x1a\n"
_PNG_HEAD = 26
"""The bytes of a PNG file up to the kind of its colours."""
_GREY = 0
_SIDES = slice(16, 20), slice(20, 24)
_OF_COLOURS = {"1": "L", "L": "L", "RGB": "RGB", "RGBA": "RGBA"}
"""Modes of Pillow that have the lanes of the file; others, such as palettes, become colours."""


def read_picture(path: Path, output: Output) -> Array:
    """The array of a picture in a file, by the ending of its name: its numbers as they are stored.

    Raises ``GoldenError``, and ``ModuleNotFoundError`` where a package is missing for the format.
    """
    ending = path.suffix.lower()
    if ending not in READERS:
        known = ", ".join(READERS)
        raise GoldenError(
            f"cannot judge {path}: pictures are {known}"
            + (", as others do not keep numbers exactly" if ending else "")
        )
    if not path.is_file():
        raise GoldenError(f"there is no file {path}")
    try:
        return READERS[ending](path, output)
    except (GoldenError, ModuleNotFoundError, MemoryError):
        raise
    except OSError as error:
        if error.strerror is None:  # Pillow raises such errors for damaged files.
            raise GoldenError(f"{path} is damaged: {error}") from None
        raise GoldenError(f"cannot read {path}: {error.strerror}") from None
    except Exception as error:  # Of a damaged file, decoders raise whatever they come upon.
        raise GoldenError(f"{path} is damaged: {error}") from None


def _npy(path: Path, _output: Output) -> Array:
    return read_npy(path)


def _png(path: Path, output: Output) -> Array:
    with path.open("rb") as file:
        head = file.read(_PNG_HEAD)
    if len(head) < _PNG_HEAD or not head.startswith(_PNG):
        raise GoldenError(f"{path} is no PNG file")
    width, height = (int.from_bytes(head[side], "big") for side in _SIDES)
    _check_size(path, width, height, output)
    bits, colours = head[24], head[25]
    return _deep_png(path) if bits == 16 and colours != _GREY else _usual_png(path)


def _usual_png(path: Path) -> Array:
    """A PNG file of 8 bits or fewer, or of 16 bits of grey."""
    from PIL import Image

    with Image.open(path, formats=("PNG",)) as picture:
        if picture.mode.startswith("I"):
            return np.asarray(picture).astype(np.uint16)
        return np.asarray(picture.convert(_OF_COLOURS.get(picture.mode, "RGBA")))


def _deep_png(path: Path) -> Array:
    """A PNG file with 16 bits of several lanes, of which Pillow drops half."""
    import OpenImageIO

    as_it_is = OpenImageIO.ImageSpec()
    as_it_is.attribute("oiio:UnassociatedAlpha", 1)
    source = OpenImageIO.ImageInput.open(str(path), as_it_is)
    texels = None if source is None else source.read_image("uint16")
    if source is None or texels is None:
        raise GoldenError(f"{path} is damaged")
    source.close()
    found: Array = texels
    if found.shape[2] == 2:
        return found[..., [0, 0, 0, 1]]
    return found


def _exr(path: Path, output: Output) -> Array:
    from ....compiler.budget import Tally
    from ...runner.textures.high_range import format_of, read_floats
    from ...runner.textures.kinds import PictureError

    form = format_of(path)
    assert form is not None, "its ending is that of a format"
    try:
        found: Array = read_floats(path, form, str(path), Tally("memory", "the picture takes"))
    except PictureError as error:
        raise GoldenError(str(error)) from None
    _check_size(path, found.shape[1], found.shape[0], output)
    return found


def _check_size(path: Path, width: int, height: int, output: Output) -> None:
    if (width, height) != (output.width, output.height):
        raise GoldenError(
            f"{path} is {width} x {height} pixels large, and {output.title} is "
            f"{output.width} x {output.height}"
        )


READERS: Mapping[str, Callable[[Path, Output], Array]] = {".npy": _npy, ".png": _png, ".exr": _exr}
"""The formats, by the ending of a file's name."""
