"""Textures that end in any colour, against texels that NumPy filters with those beyond the edge."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .calls import Picture, Quad, called, scattered
from .kit import Floats
from .truth import truth

ALL = "import std.mtlx.textures.{bordered, bordered_nearest, share_within}"
SIZE = (5, 3)
TEXELS = np.random.default_rng(3).uniform(0, 1, (SIZE[1], SIZE[0], 4))
BEYOND = np.array([0.25, 2.0, -1.0, 0.5])
COORDINATES = scattered(400, 2, reach=1.0) + 0.5
AXES = {"both": (1, 1), "u": (1, 0), "v": (0, 1), "none": (0, 0)}


def texel(column: Any, row: Any, has_border: tuple[int, int]) -> Floats:
    """Texels by their numbers: beyond the edges of axes with a border, that colour."""
    inside = np.ones(np.shape(column), bool)
    for number, size, is_bordered in zip((column, row), SIZE, has_border, strict=True):
        if is_bordered:
            inside &= (number >= 0) & (number < size)
    held = TEXELS[np.clip(row, 0, SIZE[1] - 1), np.clip(column, 0, SIZE[0] - 1)]
    return np.where(inside[..., None], held, BEYOND)


def filtered(at: Floats, has_border: tuple[int, int]) -> Floats:
    """The four texels around each coordinate, by their distances."""
    place = at * SIZE - 0.5
    low = np.floor(place).astype(int)
    share = place - low
    found = np.zeros((*at.shape[:-1], 4))
    for right in (0, 1):
        for down in (0, 1):
            part = np.abs(1 - right - share[..., 0]) * np.abs(1 - down - share[..., 1])
            found += part[..., None] * texel(low[..., 0] + right, low[..., 1] + down, has_border)
    return found


def clamped(*at: Any) -> tuple[Any, ...]:
    """What a sampler gives that clamps."""
    return tuple(np.moveaxis(filtered(np.stack(np.broadcast_arrays(*at), -1), (0, 0)), -1, 0))


def nearest(*at: Any) -> tuple[Any, ...]:
    """What it gives without a filter."""
    column, row = (np.floor(x * size).astype(int) for x, size in zip(at, SIZE, strict=True))
    return tuple(np.moveaxis(texel(column, row, (0, 0)), -1, 0))


def call(function: str, axes: tuple[int, int]) -> str:
    """The expression that reads the texture ``t`` at ``p``."""
    beyond = ", ".join(map(str, BEYOND))
    return f"{function}(t, p, vec2({axes[0]}, {axes[1]}), vec4({beyond}))"


@truth(*(f"std.mtlx.textures.{name}" for name in ("bordered", "share_within", "level_within")))
@pytest.mark.parametrize("name", AXES)
def test_borders_are_those_of_a_sampler(name: str) -> None:
    found = called(ALL, call("bordered", AXES[name]), 4, t=Picture(clamped, SIZE), p=COORDINATES)
    np.testing.assert_allclose(found, filtered(COORDINATES, AXES[name]), atol=1e-12)


@truth("std.mtlx.textures.bordered_nearest")
@pytest.mark.parametrize("name", AXES)
def test_borders_without_a_filter(name: str) -> None:
    corners = np.array([[0.0, 0.5], [0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.999, 0.001]])
    at = np.concatenate([COORDINATES, corners])
    column, row = (np.floor(at[:, lane] * SIZE[lane]).astype(int) for lane in (0, 1))
    found = called(ALL, call("bordered_nearest", AXES[name]), 4, t=Picture(nearest, SIZE), p=at)
    np.testing.assert_allclose(found, texel(column, row, AXES[name]), atol=1e-12)


@truth("std.mtlx.textures.bordered", "std.mtlx.textures.level_within")
@pytest.mark.parametrize("axes", AXES)
@pytest.mark.parametrize("step", [(0.2, 0.1), (1.6, 0.4), (0.3, 4.0), (2.5, 40.0)], ids=str)
def test_edges_of_two_levels_are_mixed(step: tuple[float, float], axes: str) -> None:
    """The levels are those of a device, by the longest way of a pixel. The last ones are one texel
    wide."""
    size = np.array([64.0, 32.0])
    first = COORDINATES[:64, None, None, :]
    row, column = np.mgrid[:2, :2][..., None]
    at = first + (column * step[0] * np.array([0.8, 0.6]) + row * step[1] * [0.0, 1.0]) / size
    white = Picture(lambda u, _: (0 * u + 1,) * 4, (64, 32))
    expression = f"bordered(t, p, vec2({AXES[axes][0]}, {AXES[axes][1]}), vec4(0)).x"
    found = called(ALL, expression, t=white, p=Quad(at))
    level = max(0, np.log2(max(step)))
    lower = int(level)
    shares = []
    for texels in (np.maximum(size // 2**lower, 1), np.maximum(size // 2 ** (lower + 1), 1)):
        share = np.clip(np.minimum(at, 1 - at) * texels + 0.5, 0, 1)
        shares.append(np.where(np.array(AXES[axes]) == 1, share, 1).prod(-1))
    wanted = shares[0] + (level - lower) * (shares[1] - shares[0])
    np.testing.assert_allclose(found.reshape(-1), wanted.reshape(-1), atol=1e-9)
