"""Reads pictures from files into arrays.

A picture may come from anywhere, and its name and header may lie. So only a few formats are
accepted, whatever its name is; and its size, as its header states it, is counted before its texels
are decoded.
"""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from math import prod
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps, UnidentifiedImageError
from PIL.ImageFile import ImageFile

from ....compiler.budget import BudgetError, Tally, check
from ..drivers.texels import Dimension
from ..files import FileError, opened
from .arrays import MAX_SIDE, check_sides
from .high_range import format_of, read_floats
from .kinds import FACES, Kind, PictureError
from .metered import PARTS, Metered
from .panorama import cube_of
from .photometric import is_photometric, read_candelas

FORMATS = ("PNG", "JPEG", "WEBP", "GIF", "BMP", "TGA", "TIFF")
"""The formats of pictures without floats, by Pillow's names. Pillow knows others, and runs programs
for some of them."""

_SMALL = ("1", "L", "LA", "P", "PA", "RGB", "RGBA", "RGBX", "RGBa", "CMYK", "YCbCr", "LAB", "HSV")
"""The modes of Pillow in which a lane has 8 bits."""
_OF_SMALL, _OF_LARGE = (6, 20), (22, 32)
"""The bytes of a pixel as a texture with all its levels, and the further bytes for decoding it and
making the levels, as measured: of colours in lanes of 8 bits, and of anything else."""
_PASSING_OF_LAYERS = 5
"""The factor of the layers' size that is needed while a texture is made of them, levels
included."""
_SCAN = b"\xff\xda"
"""The first bytes of a scan of a JPEG picture."""
_MOST_SCANS = 64
"""The most scans of a picture, or of one of its parts. Each is decoded into all texels; encoders
write a dozen."""
_PART = 1 << 20
"""The bytes of a file that are searched at once."""
_TILE_SIZE = 322, 323
"""The tags of a TIFF picture for the width and the height of its tiles."""
_BYTES_OF_TILE = 16
"""The most bytes of a texel in a tile that has been decoded."""

# Pillow reports damage by exceptions. Its log messages are not for the terminal.
logging.getLogger("PIL").addHandler(logging.NullHandler())


def read_pictures(paths: Sequence[Path], dimension: Dimension, sample: Kind) -> NDArray[Any]:
    """The array of a texture from one picture for each layer, or of cubes from panoramas. Raises
    ``PictureError``, and ``BudgetError`` if it takes too much."""
    memory = Tally("memory", "the texture takes")
    if dimension == "cube" and len(paths) == 1:
        return cube_of(read_picture(paths[0], sample, memory), str(paths[0]))
    if dimension == "cube" and len(paths) != len(FACES):
        wanted = f"a cube takes six pictures, {', '.join(FACES)}, or a panorama"
        raise PictureError(f"{wanted}; there {_are(len(paths))}")
    if dimension == "2d" and len(paths) != 1:
        raise PictureError(f"a flat texture takes one picture; there {_are(len(paths))}")
    arrays = [read_picture(path, sample, memory) for path in paths]
    if dimension == "2d":
        return arrays[0]
    for path, array in zip(paths[1:], arrays[1:], strict=True):
        if array.shape != arrays[0].shape or array.dtype != arrays[0].dtype:
            raise PictureError(
                f"the pictures of one texture are alike, and {path} is {_size_of(array)}"
                f" where {paths[0]} is {_size_of(arrays[0])}"
            )
    memory.add(0, passing=_PASSING_OF_LAYERS * sum(each.nbytes for each in arrays))
    return _cubes_of(arrays, paths) if dimension == "cube_array" else np.stack(arrays)


def _cubes_of(pictures: Sequence[NDArray[Any]], paths: Sequence[Path]) -> NDArray[Any]:
    """The faces of several cubes, one cube after the other, from six square pictures for each or
    from one panorama for each. Raises ``PictureError``."""
    height, width = pictures[0].shape[:2]
    if height != width:
        named = zip(pictures, paths, strict=True)
        return np.concatenate([cube_of(picture, str(path)) for picture, path in named])
    if len(pictures) % len(FACES):
        wanted = f"each cube of an array takes six pictures, {', '.join(FACES)}, or a panorama"
        raise PictureError(f"{wanted}; there {_are(len(pictures))}")
    return np.stack(pictures)


def read_picture(path: Path, sample: Kind, memory: Tally) -> NDArray[Any]:
    """The array of the picture in a file, for ``texel_array``.

    ``memory`` counts the memory of the texture. Raises ``PictureError`` and ``BudgetError``.
    """
    with _told(str(path)), opened(path, str(path)) as file:
        if form := format_of(path):
            return read_floats(path, form, str(path), memory)
        if is_photometric(path):
            return read_candelas(file, str(path))
        return _decoded(file, str(path), sample, FORMATS, memory)


def picture_in(
    data: bytes, name: str, memory: Tally, sample: Kind = "float",
    formats: tuple[str, ...] = FORMATS,
) -> NDArray[Any]:  # fmt: skip
    """The array of a picture from its bytes, in one of these formats of Pillow.

    ``name`` is the picture's name in errors, and ``memory`` counts the memory of the texture.
    Raises ``PictureError`` and ``BudgetError``.
    """
    with _told(name):
        return _decoded(BytesIO(data), name, sample, formats, memory)


def announced_size(data: bytes, name: str) -> tuple[int, int]:
    """The size in the header of a picture: width and height.

    Nothing is decoded. Raises ``PictureError``.
    """
    with _told(name), _header_of(BytesIO(data), name, FORMATS) as picture:
        return picture.size


def picture_given(data: bytes, name: str, dimension: Dimension, sample: Kind) -> NDArray[Any]:
    """The array of a texture from the bytes of one picture which, if its name says so, consists of
    floats: a layer or a slice, or a cube from a panorama. Raises ``PictureError``, and
    ``BudgetError`` if it takes too much."""
    memory = Tally("memory", "the texture takes")
    if form := format_of(Path(name)):
        with _told(name), TemporaryDirectory(prefix="burnish-") as folder:
            path = Path(folder) / f"picture{Path(name).suffix.lower()}"
            path.write_bytes(data)
            array: NDArray[Any] = read_floats(path, form, name, memory)
    elif is_photometric(Path(name)):
        array = read_candelas(BytesIO(data), name)
    else:
        array = picture_in(data, name, memory, sample)
    if dimension in ("cube", "cube_array"):
        return cube_of(array, name)
    return array if dimension == "2d" else array[np.newaxis]


def _decoded(
    file: BinaryIO, name: str, sample: Kind, formats: tuple[str, ...], memory: Tally
) -> NDArray[Any]:
    with _header_of(file, name, formats) as picture:
        _check_size(picture, name, sample, memory)
        _check_scans(file, picture, name)
        ImageOps.exif_transpose(picture, in_place=True)
        return _LANES[sample](picture)


@contextmanager
def _header_of(file: BinaryIO, name: str, formats: tuple[str, ...]) -> Iterator[ImageFile]:
    """The picture in a file, of which only the header has been read. Its texels are decoded where
    they are first asked for in the ``with`` block."""
    metered = Metered(file, name)
    with warnings.catch_warnings():
        # The size is checked before anything is decoded, and more strictly; other warnings
        # are of metadata, which nobody asks for.
        warnings.simplefilter("ignore")
        try:
            picture = Image.open(metered, formats=formats)
        except UnidentifiedImageError:
            *most, last = formats
            raise PictureError(
                f"{name} is not a picture of a known format: {', '.join(most)} or {last}"
            ) from None
        with picture:
            metered.end_header()
            yield picture


def _check_size(picture: ImageFile, name: str, sample: Kind, memory: Tally) -> None:
    """Count a picture before its texels are decoded."""
    width, height = picture.size
    check_sides(width, height, name)
    check("pixels", width * height, f"{name} has")
    is_small = picture.mode in _SMALL and sample == "float"
    kept, passing = _OF_SMALL if is_small else _OF_LARGE
    passing = width * height * passing + _texels_of_tile(picture) * _BYTES_OF_TILE
    memory.add(width * height * kept, passing=passing)
    if len(picture.tile) > PARTS:
        raise PictureError(f"{name} is damaged: it consists of {len(picture.tile):,} parts")


def _texels_of_tile(picture: ImageFile) -> int:
    """The number of texels of a TIFF picture's tile, which may be far larger than the picture."""
    tags = getattr(picture, "tag_v2", {})
    return prod(int(tags.get(tag, 0)) for tag in _TILE_SIZE)


def _check_scans(file: BinaryIO, picture: ImageFile, name: str) -> None:
    """Refuse a picture of a few bytes that takes very long to decode: one of many scans."""
    if picture.format == "JPEG" or "jpeg" in str(picture.info.get("compression")):
        scans = sum(part.count(_SCAN) for part in _parts_of(file))
        if scans > _MOST_SCANS * max(len(picture.tile), 1):
            raise PictureError(f"{name} is damaged: it has {scans:,} scans")


def _parts_of(file: BinaryIO) -> Iterator[bytes]:
    """The bytes of a file, part by part; afterwards the file is at its old position.

    Parts overlap by one byte.
    """
    place = file.tell()
    file.seek(0)
    last = b""
    while part := file.read(_PART):
        yield last + part
        last = part[-1:]
    file.seek(place)


@contextmanager
def _told(name: str) -> Iterator[None]:
    """Turn any error about a picture into a ``PictureError``."""
    try:
        yield
    except (BudgetError, PictureError, MemoryError, ModuleNotFoundError):
        raise
    except FileError as error:
        raise PictureError(str(error)) from None
    except Image.DecompressionBombError:
        raise PictureError(f"{name} is too large: no side may have over {MAX_SIDE}") from None
    except OSError as error:
        raise PictureError(f"cannot read {name}: {error.strerror or error}") from None
    except Exception as error:  # Of a damaged file, decoders raise whatever they come upon.
        raise PictureError(f"{name} is damaged: {error}") from None


def _colors(picture: Image.Image) -> NDArray[Any]:
    """The lanes of the picture unchanged if they have more than 8 bits, else RGBA."""
    if picture.mode == "F":
        return np.asarray(picture, np.float32)
    if picture.mode.startswith("I"):
        return _sixteen_bits(picture)
    return np.asarray(picture if picture.mode == "RGBA" else picture.convert("RGBA"))


def _depths(picture: Image.Image) -> NDArray[Any]:
    """The brightness of the picture."""
    if picture.mode == "F":
        return np.asarray(picture, np.float32)
    if picture.mode.startswith("I"):
        return _sixteen_bits(picture)
    return np.asarray(picture.convert("L"))


def _integers(picture: Image.Image) -> NDArray[Any]:
    """The numbers in the file; with a palette, the indices of the colours."""
    if picture.mode == "1":
        return np.asarray(picture).astype(np.uint8)
    if picture.mode in ("P", "L", "RGB", "RGBA") or picture.mode.startswith("I"):
        return np.asarray(picture)
    return np.asarray(picture.convert("RGBA"))


_LANES = {"float": _colors, "depth": _depths, "int": _integers, "uint": _integers}


def _sixteen_bits(picture: Image.Image) -> NDArray[np.uint16]:
    clipped: NDArray[np.uint16] = np.clip(np.asarray(picture), 0, 65535).astype(np.uint16)
    return clipped


def _size_of(array: NDArray[Any]) -> str:
    lanes = f" of {array.shape[2]} lanes" if array.ndim == 3 else ""
    return f"{array.shape[1]} x {array.shape[0]} {array.dtype}{lanes}"


def _are(count: int) -> str:
    return "is one" if count == 1 else f"are {count}"
