"""Pictures for people as PNG files: a reference in 16 bits, and what is outside of its bounds.

They are written here, as Pillow cannot write 16 bits of several lanes, and as whoever judges
pictures in tests needs NumPy only.
"""

from __future__ import annotations

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

from ....compiler.reference.transfer import encode_srgb

_BEGINS = b"\x89PNG\r\n\x1a\n"
_RGB = 2
_MAGENTA = (1.0, 0.0, 1.0)
_OUTSIDE, _UNDECIDED = (255, 0, 0), (60, 110, 220)
_DIMMED = 0.35
"""The brightness of pixels about which nothing is said."""


def as_png(pixels: NDArray[np.uint8] | NDArray[np.uint16]) -> bytes:
    """The file of a picture with three lanes, (height, width, 3)."""
    height, width, _ = pixels.shape
    bits = 8 * pixels.itemsize
    rows = pixels.astype(pixels.dtype.newbyteorder(">")).reshape(height, -1).view(np.uint8)
    unfiltered = np.hstack([np.zeros((height, 1), np.uint8), rows])
    head = struct.pack(">IIBBBBB", width, height, bits, _RGB, 0, 0, 0)
    parts = (b"IHDR", head), (b"IDAT", zlib.compress(unfiltered.tobytes(), 6)), (b"IEND", b"")
    return _BEGINS + b"".join(_chunk(kind, data) for kind, data in parts)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def seen(pixels: NDArray[np.float64]) -> NDArray[np.float64]:
    """A picture (height, width, lanes) as a screen shows it: three lanes of sRGB in 0..1.

    One lane is grey, a missing third one is black, and what is no number is magenta.
    """
    lanes = pixels.shape[-1]
    rgb = np.zeros((*pixels.shape[:2], 3))
    rgb[..., : min(lanes, 3)] = pixels[..., :3]
    if lanes == 1:
        rgb = np.repeat(rgb[..., :1], 3, axis=2)
    finite = np.isfinite(rgb).all(axis=2, keepdims=True)
    encoded = encode_srgb(np.clip(np.where(finite, rgb, 0.0), 0.0, 1.0))
    return np.where(finite, encoded, _MAGENTA)


def sixteen_bits(pixels: NDArray[np.float64]) -> bytes:
    """A picture as a PNG file with 16 bits."""
    return as_png(np.rint(seen(pixels) * 65535).astype(np.uint16))


def marked(
    reference: NDArray[np.float64], outside: NDArray[np.bool_], undecided: NDArray[np.bool_]
) -> bytes:
    """A PNG file with pixels outside of their bounds in red, and those that are not compared in
    blue, on a dim reference."""
    shown = np.rint(seen(reference) * _DIMMED * 255).astype(np.uint8)
    shown[undecided] = _UNDECIDED
    shown[outside] = _OUTSIDE
    return as_png(shown)
