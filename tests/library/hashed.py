"""Hashes as their papers have them, written with 32-bit integers of NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Words = NDArray[np.uint32]


def words(values: Any) -> Words:
    """Integers modulo 2^32."""
    return np.asarray(np.asarray(values, np.int64) & 0xFFFFFFFF, np.uint32)


def _u(value: int) -> np.uint32:
    return np.uint32(value)


def pcg(x: Words) -> Words:
    """Jarzynski and Olano 2020, ``pcg``."""
    state = x * _u(747796405) + _u(2891336453)
    word = ((state >> ((state >> _u(28)) + _u(4))) ^ state) * _u(277803737)
    return np.asarray((word >> _u(22)) ^ word, np.uint32)


def _seeded(v: Words) -> list[Words]:
    return [np.asarray(lane * _u(1664525) + _u(1013904223)) for lane in np.moveaxis(v, -1, 0)]


def pcg2d(v: Words) -> Words:
    """Jarzynski and Olano 2020, ``pcg2d``."""
    x, y = _seeded(v)
    for _ in range(2):
        x = x + y * _u(1664525)
        y = y + x * _u(1664525)
        x, y = x ^ (x >> _u(16)), y ^ (y >> _u(16))
    return np.stack([x, y], axis=-1)


def pcg3d(v: Words) -> Words:
    """Jarzynski and Olano 2020, ``pcg3d``."""
    x, y, z = _seeded(v)
    for turn in range(2):
        if turn:
            x, y, z = (lane ^ (lane >> _u(16)) for lane in (x, y, z))
        x = x + y * z
        y = y + z * x
        z = z + x * y
    return np.stack([x, y, z], axis=-1)


def pcg4d(v: Words) -> Words:
    """Jarzynski and Olano 2020, ``pcg4d``."""
    x, y, z, w = _seeded(v)
    for turn in range(2):
        if turn:
            x, y, z, w = (lane ^ (lane >> _u(16)) for lane in (x, y, z, w))
        x = x + y * w
        y = y + z * x
        z = z + x * y
        w = w + y * z
    return np.stack([x, y, z, w], axis=-1)


def hashed(cells: Any) -> Words:
    """The hashes of cells, whose last axis has one to four coordinates."""
    v = words(cells)
    if v.shape[-1] == 1:
        return pcg(v)
    return {2: pcg2d, 3: pcg3d, 4: pcg4d}[v.shape[-1]](v)


def fractions(cells: Any) -> NDArray[np.float64]:
    """Numbers from 0 to 1 for cells: the 24 high bits of their hashes."""
    return np.asarray((hashed(cells) >> _u(8)) / 2.0**24, np.float64)
