"""A test chart: the picture that ``burnish render`` gives kernels which need one."""

from __future__ import annotations

import numpy as np

from .texture import Texture

_SQUARES = 8
"""Squares of the board in the lower right quarter, across and down."""
_SPECKS = 0.08
"""The part of the lower left quarter's texels that are specks."""


def chart(size: tuple[int, int]) -> Texture:
    """A chart of (width, height) texels that shows what filters do: rings that grow finer, bars,
    a noisy gradient with specks, and a board of coloured squares, one in each quarter."""
    width, height = size
    y, x = np.meshgrid(
        (np.arange(height) + 0.5) / height, (np.arange(width) + 0.5) / width, indexing="ij"
    )
    u, v = (2 * x) % 1.0, (2 * y) % 1.0
    right, below = x >= 0.5, y >= 0.5
    rings = 0.5 + 0.5 * np.cos(60 * ((u - 0.5) ** 2 + (v - 0.5) ** 2))
    bars = ((u * 2 ** np.floor(1 + 4 * v)) % 1.0 < 0.5).astype(np.float64)
    chance = np.random.default_rng(1)
    noisy = 0.2 + 0.6 * u + 0.08 * chance.standard_normal(u.shape)
    noisy = np.where(chance.random(u.shape) < _SPECKS, chance.random(u.shape), noisy)
    board = (np.floor(_SQUARES * u) + np.floor(_SQUARES * v)) % 2
    parts = ((rings, rings * v, 1 - rings), (bars,) * 3, (noisy, noisy, 0.8 * noisy),
             (board, 0.3 + 0.4 * u, 1 - board))  # fmt: skip
    quarters = [np.stack(part, axis=2) for part in parts]
    upper = np.where(right[..., None], quarters[1], quarters[0])
    lower = np.where(right[..., None], quarters[3], quarters[2])
    texels = np.where(below[..., None], lower, upper)
    return Texture.of_array(np.rint(255 * texels.clip(0, 1)).astype(np.uint8))
