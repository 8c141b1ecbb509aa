"""Noises as papers describe them, written with NumPy in any number of dimensions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product

import numpy as np

from .hashed import fractions, hashed
from .kit import Floats

Noise = Callable[[Floats], Floats]

GRADIENTS = {
    2: np.array([(1, 2), (-1, 2), (1, -2), (-1, -2), (2, 1), (2, -1), (-2, 1), (-2, -1)]),
    3: np.array([
        (1, 1, 0), (-1, 1, 0), (1, -1, 0), (-1, -1, 0), (1, 0, 1), (-1, 0, 1), (1, 0, -1),
        (-1, 0, -1), (0, 1, 1), (0, -1, 1), (0, 1, -1), (0, -1, -1), (1, 1, 0), (0, -1, 1),
        (-1, 1, 0), (0, -1, -1),
    ]),
}  # fmt: skip
"""Directions: those of MaterialX in a plane, and the 16 of Perlin 2002 in space."""
ON_LATTICE, ON_SIMPLICES = {2: 0.6616, 3: 0.9649}, {2: 45.2, 3: 76.8}
"""What makes the largest sums 1, nearly."""


def corners(dimension: int, low: int, high: int) -> Iterator[Floats]:
    """All steps from ``low`` to below ``high`` along each axis."""
    for step in product(range(low, high), repeat=dimension):
        yield np.array(step)


def slopes(cells: Floats) -> Floats:
    """The direction that belongs to each corner: the highest bits of its hash."""
    table = GRADIENTS[cells.shape[-1]]
    return np.asarray(table[hashed(cells)[..., 0] // (2**32 // len(table))], np.float64)


def wrapped(cells: Floats, period: Floats | None) -> Floats:
    return cells if period is None else np.mod(cells, period)


def fade(t: Floats) -> Floats:
    return 6 * t**5 - 15 * t**4 + 10 * t**3


def value(p: Floats, period: Floats | None = None) -> Floats:
    """Numbers of corners, blended."""
    cell, total = np.floor(p), np.zeros(p.shape[:-1])
    for k in corners(p.shape[-1], 0, 2):
        weight = np.prod(np.where(k == 1, fade(p - cell), 1 - fade(p - cell)), axis=-1)
        total += weight * fractions(wrapped(cell + k, period))[..., 0]
    return total


def gradient(p: Floats, period: Floats | None = None) -> Floats:
    """Perlin 2002: planes through zero at corners, blended."""
    cell, total = np.floor(p), np.zeros(p.shape[:-1])
    for k in corners(p.shape[-1], 0, 2):
        weight = np.prod(np.where(k == 1, fade(p - cell), 1 - fade(p - cell)), axis=-1)
        total += weight * (slopes(wrapped(cell + k, period)) * (p - cell - k)).sum(axis=-1)
    return ON_LATTICE[p.shape[-1]] * total


def simplex(p: Floats) -> Floats:
    """Perlin 2001: kernels at all corners around, of which those of other simplices are 0."""
    dimension = p.shape[-1]
    skew = (np.sqrt(dimension + 1) - 1) / dimension
    unskew = (1 - 1 / np.sqrt(dimension + 1)) / dimension
    cell, total = np.floor(p + skew * p.sum(axis=-1, keepdims=True)), np.zeros(p.shape[:-1])
    for k in corners(dimension, -1, 3):
        away = p - (cell + k - unskew * (cell + k).sum(axis=-1, keepdims=True))
        kernel = np.maximum(0.5 - (away**2).sum(axis=-1), 0) ** 4
        total += kernel * (slopes(cell + k) * away).sum(axis=-1)
    return ON_SIMPLICES[dimension] * total


def derivative(noise: Noise, p: Floats, step: float = 1e-5) -> Floats:
    """The gradient of a noise by differences."""
    steps = step * np.eye(p.shape[-1])
    return np.stack([(noise(p + s) - noise(p - s)) / (2 * step) for s in steps], axis=-1)


def features(p: Floats, jitter: float, reach: int = 3) -> tuple[Floats, Floats]:
    """Cells around places, and the ways to their feature points, along a new first axis."""
    return _features(p, jitter, np.floor(p), -reach, reach + 1)


def near_features(p: Floats, jitter: float, period: Floats | None = None) -> tuple[Floats, Floats]:
    """The same of the cells around the corner that is nearest to a place, four along each axis."""
    return _features(p, jitter, np.floor(p + 0.5), -2, 2, period)


def _features(
    p: Floats, jitter: float, around: Floats, low: int, high: int, period: Floats | None = None
) -> tuple[Floats, Floats]:
    steps = np.stack(list(corners(p.shape[-1], low, high)))
    cells = around + steps[:, None]
    return cells, cells + 0.5 + jitter * (fractions(wrapped(cells, period)) - 0.5) - p


def measured(away: Floats, metric: str) -> Floats:
    """The lengths of vectors in a metric."""
    order = {"euclidean": 2, "manhattan": 1, "chebyshev": np.inf}[metric]
    return np.asarray(np.linalg.norm(away, ord=order, axis=-1))


def octaves(noise: Noise, p: Floats, count: int, lacunarity: float, gain: float) -> Floats:
    """A sum of octaves of a noise."""
    return np.asarray(sum(gain**i * noise(lacunarity**i * p) for i in range(count)), np.float64)
