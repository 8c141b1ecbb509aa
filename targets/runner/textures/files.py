"""Reads pictures from files into arrays."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps, UnidentifiedImageError

from ..drivers.texels import Dimension
from .arrays import MAX_SIDE, check_sides
from .high_range import format_of, read_floats
from .kinds import FACES, Kind, PictureError
from .panorama import cube_of


def read_pictures(paths: Sequence[Path], dimension: Dimension, sample: Kind) -> NDArray[Any]:
    """The array of a texture from one picture for each layer, or of a cube from a panorama. Raises
    ``PictureError``."""
    if dimension == "cube" and len(paths) == 1:
        return cube_of(read_picture(paths[0], sample), str(paths[0]))
    if dimension == "cube" and len(paths) != len(FACES):
        wanted = f"a cube takes six pictures, {', '.join(FACES)}, or a panorama"
        raise PictureError(f"{wanted}; there {_are(len(paths))}")
    if dimension == "2d" and len(paths) != 1:
        raise PictureError(f"a flat texture takes one picture; there {_are(len(paths))}")
    arrays = [read_picture(path, sample) for path in paths]
    if dimension == "2d":
        return arrays[0]
    for path, array in zip(paths[1:], arrays[1:], strict=True):
        if array.shape != arrays[0].shape or array.dtype != arrays[0].dtype:
            raise PictureError(
                f"the pictures of one texture are alike, and {path} is {_size_of(array)}"
                f" where {paths[0]} is {_size_of(arrays[0])}"
            )
    return np.stack(arrays)


def read_picture(path: Path, sample: Kind = "float") -> NDArray[Any]:
    """The array of the picture in a file, for ``texel_array``. Raises ``PictureError``."""
    with _told(str(path)):
        if path.exists() and not (path.is_file() or path.is_dir()):
            raise PictureError(f"cannot read {path}: it is a pipe or a device")
        if form := format_of(path):
            return read_floats(path, form, str(path))
        return _decoded(path, str(path), sample)


def picture_in(
    data: bytes, name: str, formats: tuple[str, ...], sample: Kind = "float"
) -> NDArray[Any]:
    """The array of the picture that some bytes are, in one of these formats of Pillow; errors call
    it ``name``. Raises ``PictureError``."""
    with _told(name):
        return _decoded(BytesIO(data), name, sample, formats)


def announced_size(data: bytes, name: str, formats: tuple[str, ...]) -> tuple[int, int]:
    """The width and height of the picture that some bytes are, as they say themselves: nothing is
    decoded. Raises ``PictureError``."""
    with _told(name), Image.open(BytesIO(data), formats=formats) as picture:
        return picture.size


def picture_given(
    data: bytes, name: str, formats: tuple[str, ...], dimension: Dimension, sample: Kind
) -> NDArray[Any]:
    """The array of a texture from the bytes of one picture, in one of these formats or, if its name
    says so, of floats: a layer or a slice, or a cube from a panorama. Raises ``PictureError``."""
    if form := format_of(Path(name)):
        with _told(name), TemporaryDirectory(prefix="burnish-") as folder:
            path = Path(folder) / f"picture{Path(name).suffix.lower()}"
            path.write_bytes(data)
            array: NDArray[Any] = read_floats(path, form, name)
    else:
        array = picture_in(data, name, formats, sample)
    if dimension == "cube":
        return cube_of(array, name)
    return array if dimension == "2d" else array[np.newaxis]


def _decoded(
    source: Path | BytesIO, name: str, sample: Kind, formats: tuple[str, ...] | None = None
) -> NDArray[Any]:
    with warnings.catch_warnings():
        # The size is checked below, before anything is decoded, and more strictly.
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        with Image.open(source, formats=formats) as picture:
            check_sides(*picture.size, name)
            return _LANES[sample](ImageOps.exif_transpose(picture))


@contextmanager
def _told(name: str) -> Iterator[None]:
    """Turn whatever goes wrong with a picture into a ``PictureError``."""
    try:
        yield
    except (PictureError, MemoryError, ModuleNotFoundError):
        raise
    except UnidentifiedImageError:
        raise PictureError(f"{name} is not a picture of a known format") from None
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
    return np.asarray(picture.convert("RGBA"))


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
