"""The operands with which every builtin is called: numbers of all magnitudes, and special ones.

All builtins get the same operands. So they hold what any of them may stumble over: numbers of every
magnitude, numbers close to each other, at the borders of domains, and pairs that are equal or
opposite. A tile of the picture is a kind of sample.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from burnish.stdlib.builtins.facts import LARGEST_FLOAT
from burnish.targets.conformance.corpus.numbers import EDGES, WHOLE_EDGES

from .overloads import FLOAT_MAPS, INT_MAPS

SIDE = 128
"""The picture's side: 16384 samples of each builtin, about 14 000 of them random."""
_TILE = 32
SEED = 11

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Shape = tuple[int, ...]

SPECIAL = np.array(EDGES)
SPECIAL_INTEGERS = np.array(WHOLE_EDGES)


Numbers = Callable[[np.random.Generator, Shape], Floats]

_KINDS: tuple[Numbers, ...] = (
    lambda c, s: c.uniform(-1.0, 1.0, s),
    lambda c, s: c.uniform(-1.0, 1.0, s),
    lambda c, s: c.uniform(0.0, 1.0, s),
    lambda c, s: c.uniform(0.0, 8.0, s),
    lambda c, s: c.uniform(-8.0, 8.0, s),
    lambda c, s: c.uniform(-130.0, 130.0, s),
    lambda c, s: _signed(c, 2.0 ** c.uniform(-3.0, 10.0, s)),
    lambda c, s: _signed(c, 2.0 ** c.uniform(-20.0, 20.0, s)),
    lambda c, s: 2.0 ** c.uniform(-60.0, 60.0, s),
    lambda c, s: _signed(c, 2.0 ** c.uniform(-126.0, 128.0, s)),
    # Close to 1, halves, and multiples of a quarter turn.
    lambda c, s: _signed(c, 1.0 + c.uniform(-1.0, 1.0, s) * 2.0 ** c.uniform(-23.0, 0.0, s)),
    lambda c, s: np.rint(c.uniform(-40.0, 40.0, s)) / 2,
    lambda c, s: math.pi / 2 * np.rint(c.uniform(-9.0, 9.0, s)) + c.normal(0.0, 1e-3, s),
    lambda c, s: np.where(c.random(s) < 0.3, c.choice(SPECIAL, s), c.uniform(-2.0, 2.0, s)),
)


def float_operands() -> list[Floats]:
    """The contents of each texture of floats, (side, side, 4); every number is a float32."""
    chance = np.random.default_rng(SEED)
    shape = (FLOAT_MAPS, _TILE, _TILE, 4)
    tiles = [kind(chance, shape) for kind in _KINDS]
    tiles += [_special(chance, shape), _related(chance, shape)]
    pictures = _tiled(np.clip(tiles, -LARGEST_FLOAT, LARGEST_FLOAT))
    return list(pictures.astype(np.float32).astype(np.float64))


def _special(chance: np.random.Generator, shape: Shape) -> Floats:
    """Special numbers; the first two operands are pairs of all of them, as far as there is room."""
    tile: Floats = chance.choice(SPECIAL, shape)
    pairs = np.stack(np.meshgrid(SPECIAL, SPECIAL), axis=-1).reshape(-1, 2)
    room = _TILE * _TILE
    chosen = pairs[:: math.ceil(len(pairs) / room)]
    for lane in range(4):
        for operand in range(2):
            numbers = np.roll(chosen[:, operand], 7 * lane)
            tile[operand, ..., lane].flat[: len(chosen)] = numbers
    return tile


def _related(chance: np.random.Generator, shape: Shape) -> Floats:
    """Operands that are equal to the first one, opposite, or next to it."""
    tile = _signed(chance, 2.0 ** chance.uniform(-8.0, 8.0, shape))
    factors: Floats = chance.choice([1.0, -1.0, 1.0 + 2.0**-23, 0.5], tile[1:].shape)
    tile[1:] = tile[0] * factors
    return tile


def integer_operands() -> list[Integers]:
    """The contents of each texture of integers."""
    chance = np.random.default_rng(SEED)
    shape = (INT_MAPS, _TILE, _TILE, 4)
    tiles = [
        *(chance.integers(-(2**31), 2**31, shape) for _ in range(4)),
        *(chance.integers(-40, 41, shape) for _ in range(4)),
        *(chance.integers(0, 2**31, shape) >> chance.integers(0, 31, shape) for _ in range(4)),
        *(chance.choice(SPECIAL_INTEGERS, shape) for _ in range(4)),
    ]
    return list(_tiled(np.array(tiles)))


def _signed(chance: np.random.Generator, magnitudes: Floats) -> Floats:
    signs: Floats = chance.choice([-1.0, 1.0], magnitudes.shape)
    return magnitudes * signs


def _tiled(tiles: NDArray[np.generic]) -> NDArray[np.generic]:
    """Tiles (count, maps, side, side, 4) as pictures (maps, side, side, 4)."""
    across = SIDE // _TILE
    rows = [
        np.concatenate(list(tiles[row * across : (row + 1) * across]), axis=2)
        for row in range(across)
    ]
    return np.concatenate(rows, axis=1)
