"""Sets of files, one for each square of a chart: which layer is read where, and at which level."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .calls import Picture, Quad, called, scattered
from .kit import Floats
from .truth import truth

ALL = "import std.mtlx.textures.{udim_layer, udim_set, udim_set_level}"
TILES = [1003, 1001, 1012, 1020]
READ = f"udim_set(t, p, {TILES}, vec4(0.25, 2, -1, 0.5))"
AROUND = np.concatenate([
    scattered(300, 2, reach=2.5) + 1.5,
    [[0, 0], [1, 0], [1, 1], [2, 1], [2.0, 0.999], [-1e-9, 0], [9.5, 0.5], [9.5, 1.5], [10.5, 0.5]],
    [[-0.5, 1.5], [0.5, -0.5], [-9.5, 1.5], [1e9, 0.5], [0.5, -1e9]],
])  # fmt: skip


def layers_of(at: Floats) -> Any:
    """The layer for each coordinate, by a table of all squares."""
    table = {(number - 1001) % 10 + 1j * ((number - 1001) // 10): layer
             for layer, number in enumerate(TILES)}  # fmt: skip
    squares = np.floor(at[..., 0]) + 1j * np.floor(at[..., 1])
    return np.array([table.get(square, -1) for square in squares.ravel()]).reshape(squares.shape)


@truth("std.mtlx.textures.udim_layer")
def test_a_square_has_the_layer_of_its_number() -> None:
    found = called(ALL, f"float(udim_layer(p, {TILES}))", p=AROUND)
    assert set(found) == {-1, 0, 1, 2, 3}
    np.testing.assert_array_equal(found, layers_of(AROUND))


@truth("std.mtlx.textures.udim_set", "std.mtlx.textures.udim_set_level")
@pytest.mark.parametrize("read", [READ, READ.replace("udim_set", "udim_set_level")])
def test_each_square_shows_its_file_with_v_downwards(read: str) -> None:
    shown = Picture(lambda u, v, layer: (u, v, layer, 0 * u + 1), layered=True)
    found = called(ALL, read, 4, t=shown, p=AROUND)
    layer = layers_of(AROUND)
    within = AROUND - np.floor(AROUND)
    texels = np.column_stack([within[:, 0], 1 - within[:, 1], layer, np.ones(len(layer))])
    expected = np.where((layer < 0)[:, None], [0.25, 2, -1, 0.5], texels)
    np.testing.assert_allclose(found, expected, atol=1e-12)


@truth("std.mtlx.textures.udim_set")
def test_levels_know_nothing_of_the_edges_of_squares() -> None:
    """Neighbouring pixels lie in two squares; what the level follows from is how far they are
    apart on the chart."""
    first, right, down = np.array([1.97, 0.98]), np.array([0.05, 0.02]), np.array([0.01, 0.07])
    row, column = np.mgrid[:2, :2][..., None]
    at = first + column * right + row * down
    shown = Picture(lambda u, v, layer: (u, v, layer, 0 * u + 1), layered=True)
    called(ALL, READ, 4, t=shown, p=Quad(at))
    dx, dy = (np.stack([np.broadcast_to(lane, (2, 2)) for lane in step]) for step in shown.steps)
    np.testing.assert_allclose(dx, np.broadcast_to((right * [1, -1])[:, None, None], dx.shape))
    np.testing.assert_allclose(dy, np.broadcast_to((down * [1, -1])[:, None, None], dy.shape))
