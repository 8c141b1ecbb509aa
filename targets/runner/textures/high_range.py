"""Reads and writes pictures of high dynamic range: ``.exr`` (OpenEXR) and ``.hdr`` (Radiance).

``files.py`` reads the textures in such files by this module, and ``pictures.py`` writes them. Their
numbers are linear light, and may be larger than 1. OpenImageIO decodes and encodes them.

A file may come from anywhere, so its first bytes and its header are checked before any texel is
decoded: how large it is, and that its channels are those of a picture.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path, PurePath
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ....compiler.budget import Tally, check
from .arrays import check_sides
from .kinds import PictureError

if TYPE_CHECKING:
    from OpenImageIO import ImageInput

_KEPT_OF_PIXEL, _PASSING_OF_PIXEL = 22, 34
"""The bytes of a pixel as a texture of four floats with all its levels; and the further bytes for
decoding it and making the levels, as measured."""
_BYTES_OF_CHANNEL = 6
"""Bytes that decoding takes for each of the channels that the file has."""


@dataclass(frozen=True, slots=True)
class Format:
    """A format of files whose texels are floats."""

    name: str
    """OpenImageIO's name."""
    begins: bytes
    """The first bytes of each file."""
    has_alpha: bool
    """True if the format stores other channels than red, green and blue, and any float."""


FORMATS = {
    ".exr": Format("openexr", b"\x76\x2f\x31\x01", has_alpha=True),
    ".hdr": Format("hdr", b"#?", has_alpha=False),
}
"""The formats, by the ending of a file's name, in small letters."""


def format_of(path: PurePath) -> Format | None:
    """The format of a file name's ending, if it is one of these."""
    return FORMATS.get(path.suffix.lower())


def check_installed() -> None:
    """Raise ``ModuleNotFoundError`` if OpenImageIO is not installed, before long work."""
    import_module("OpenImageIO")


def read_floats(path: Path, form: Format, name: str, memory: Tally) -> NDArray[np.float32]:
    """The texels of a file: (height, width), or (height, width, lanes) with 3 or 4 lanes.

    ``name`` is the file's name in errors, and ``memory`` counts the memory of the texture. Raises
    ``PictureError`` for a file that is of another format, damaged or too large, and ``OSError`` if
    it cannot be read at all; and ``BudgetError`` if it takes too much.
    """
    with path.open("rb") as file:
        if file.read(len(form.begins)) != form.begins:
            raise PictureError(f"{name} is no file of the format that its name says")
    import OpenImageIO

    source = OpenImageIO.ImageInput.open(str(path))
    if source is None:
        raise _damaged(name, OpenImageIO.geterror())
    try:
        if source.format_name() != form.name:
            raise _damaged(name, "")
        return _texels(source, name, memory)
    finally:
        source.close()


def _texels(source: ImageInput, name: str, memory: Tally) -> NDArray[np.float32]:
    spec = source.spec()
    check_sides(spec.width, spec.height, name)
    pixels = spec.width * spec.height
    check("pixels", pixels, f"{name} has")
    beside = _PASSING_OF_PIXEL + spec.nchannels * _BYTES_OF_CHANNEL
    # A tile may be far larger than the picture.
    beside_tile = spec.tile_width * spec.tile_height * spec.nchannels * _BYTES_OF_CHANNEL
    memory.add(pixels * _KEPT_OF_PIXEL, passing=pixels * beside + beside_tile)
    if spec.deep or spec.depth > 1:
        raise PictureError(f"{name} is no flat picture: it has several values behind a texel")
    channels = _channels(spec.channelnames, name)
    first, last = min(channels), max(channels)
    texels = source.read_image(0, 0, first, last + 1, "float")
    if texels is None:
        raise _damaged(name, source.geterror())
    found: NDArray[np.float32] = texels.reshape(spec.height, spec.width, -1)
    if channels != list(range(first, last + 1)):
        found = found[..., [channel - first for channel in channels]]
    return found[..., 0] if len(channels) == 1 else found


def _channels(names: Sequence[str], picture: str) -> list[int]:
    """The numbers of the channels that make the picture: colours, or the only one."""
    for wanted in (("R", "G", "B", "A"), ("R", "G", "B")):
        if set(wanted) <= set(names):
            return [names.index(name) for name in wanted]
    if len(names) == 1:
        return [0]
    listed = ", ".join(names[:8]) + (", …" if len(names) > 8 else "")
    raise PictureError(
        f"{picture} has the channels {listed}: a picture has R, G and B, or only one"
    )


def _damaged(name: str, reason: str) -> PictureError:
    """The error for a file that cannot be read completely; decoders may say more than one line."""
    first = reason.strip().partition("\n")[0]
    return PictureError(f"{name} is damaged" + (f": {first}" if first else ""))


def encoded_floats(pixels: NDArray[np.float64], lanes: int, path: Path, form: Format) -> bytes:
    """The file of a render target's contents, of shape (height, width, lanes or more).

    ``lanes`` of them are written. Raises ``PictureError``.
    """
    shown = np.ascontiguousarray(_stored(pixels, lanes, path, form), np.float32)
    height, width, count = shown.shape
    import OpenImageIO

    spec = OpenImageIO.ImageSpec(width, height, count, "float")
    spec.channelnames = ("Y",) if count == 1 else tuple("RGBA"[:count])
    # Without a date of its own, a file would have the present one, and no two would be equal.
    spec.attribute("DateTime", "1970:01:01 00:00:00")
    with TemporaryDirectory(prefix="burnish-") as folder:
        written = Path(folder) / f"picture{path.suffix.lower()}"
        sink = OpenImageIO.ImageOutput.create(form.name)
        if sink is None:
            raise PictureError(f"cannot write `{path}`: {OpenImageIO.geterror()}")
        if not (sink.open(str(written), spec) and sink.write_image(shown) and sink.close()):
            raise PictureError(f"cannot write `{path}`: {sink.geterror()}")
        return written.read_bytes()


def _stored(
    pixels: NDArray[np.float64], lanes: int, path: Path, form: Format
) -> NDArray[np.float64]:
    """The lanes that a file gets."""
    if form.has_alpha:
        return pixels[..., :lanes]
    if not np.isfinite(pixels[..., :lanes]).all():
        raise PictureError(
            f"cannot write `{path}`: some numbers are not finite, which only .exr can store"
        )
    rgb = np.zeros((*pixels.shape[:2], 3))
    rgb[..., : min(lanes, 3)] = pixels[..., : min(lanes, 3)]
    return np.repeat(rgb[..., :1], 3, axis=2) if lanes == 1 else rgb
