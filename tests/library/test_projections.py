"""Projections, flows and tiles of textures, against formulas that NumPy computes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .calls import Picture, Quad, called, scattered
from .kit import Floats
from .test_mapping import ALL, AXES, COUNT, UV, D, leaning, near, unit_rows
from .truth import truth

# --- projections along the axes ------------------------------------------------------------------

P = scattered(COUNT, 3, 2, 8)
PLANES = [
    (np.array([0, 0, 1.0]), np.array([0, -1.0, 0])), (np.array([1.0, 0, 0]), np.array([0, 0, 1.0])),
    (np.array([1.0, 0, 0]), np.array([0, -1.0, 0])),
]  # fmt: skip
"""Where u and v point in each projection: upright, and from above with +z downwards."""


def painted(u: Floats, v: Floats) -> tuple[Floats, ...]:
    return 0.6 + 0.1 * u, 0.4 - 0.1 * v, 0.8 + 0.02 * u * v, 0.5 + 0.1 * u + 0.1 * v


def seen(point: Floats, axis: int) -> Floats:
    right, below = PLANES[axis]
    return np.stack(painted(point @ right, point @ below), axis=-1)


@truth("std.mapping.triplanar_weights", "std.mapping.triplanar", "std.mapping.plane_uv")
def test_a_texture_is_projected_from_three_sides() -> None:
    for axis, (right, below) in enumerate(PLANES):
        found = called(ALL, f"plane_uv(p, {axis})", 2, p=P)
        assert found == near(np.stack([P @ right, P @ below], axis=1))
    weights = np.abs(D) ** 3 / (np.abs(D) ** 3).sum(axis=1, keepdims=True)
    assert called(ALL, "triplanar_weights(n, 3)", 3, n=D) == near(weights)
    assert called(ALL, "triplanar_weights(n, 3)", 3, n=np.zeros((1, 3))) == near([[0, 0, 0]])
    expected = sum(weights[:, [i]] * seen(P, i) for i in range(3))
    found = called(ALL, "triplanar(t, p, w)", 4, t=Picture(painted), p=P, w=weights)
    assert found == near(expected)
    found = called(ALL, "triplanar(t, p, n, 3)", 4, t=Picture(painted), p=P, n=D)
    assert found == near(expected)


def in_plane(tangent: Floats, normal: Floats, axis: int, is_udn: bool) -> Floats:
    """The normal of a map, laid onto a plane whose third axis is that of the surface's side."""
    right, below = PLANES[axis]
    flat = np.asarray(normal + tangent[:, [0]] * right - tangent[:, [1]] * below)
    if not is_udn:
        flat[:, axis] = normal[:, axis] * tangent[:, 2]
    return flat


@truth(
    "std.mapping.triplanar_whiteout", "std.mapping.triplanar_udn", "std.mapping.triplanar_normal"
)
def test_normals_are_projected_from_three_sides() -> None:
    maps = [leaning(seed) for seed in (21, 22, 23)]
    weights = np.abs(D) / np.abs(D).sum(axis=1, keepdims=True)
    given = {"x": maps[0], "y": maps[1], "z": maps[2], "n": D, "w": weights}
    for name in ("whiteout", "udn"):
        parts = [weights[:, [i]] * in_plane(maps[i], D, i, name == "udn") for i in range(3)]
        found = called(ALL, f"triplanar_{name}(x, y, z, normalize(n), w)", 3, **given)
        assert found == near(unit_rows(sum(parts))), name
    parts = [
        weights[:, [i]] * in_plane(2 * seen(P, i)[:, :3] - 1, D, i, is_udn=False) for i in range(3)
    ]
    found = called(
        ALL, "triplanar_normal(t, p, normalize(n), w)", 3, t=Picture(painted), p=P, n=D, w=weights
    )
    assert found == near(unit_rows(sum(parts)))


@truth("std.mapping.biplanar", "std.mapping.biplanar_weights")
def test_the_two_nearest_sides_are_projected() -> None:
    normals = np.concatenate([D[: COUNT - 10], AXES, unit_rows(
        np.array([[1, 1, 0], [0, 1, -1.0], [1, 0, 1], [1, 1, 1]])
    )])  # fmt: skip
    n = np.abs(normals)
    order = np.argsort(-n, axis=1, kind="stable")
    shares = (np.clip((n - 0.5773) / (1 - 0.5773), 0, 1)) ** (16 / 8)
    expected = np.zeros((COUNT, 4))
    for row in range(COUNT):
        first, second = order[row, :2]
        a, b = shares[row, first], shares[row, second]
        expected[row] = (a * seen(P[row], first) + b * seen(P[row], second)) / (a + b)
    found = called(ALL, "biplanar(t, p, n, 16)", 4, t=Picture(painted), p=P, n=normals)
    # Of three that are as near, any two are meant.
    assert found[:-1] == near(expected[:-1])
    assert found[-1] == near(np.clip(found[-1], 0, 2))
    nearness = np.array([[1, 0.5], [0.8, 0.6], [1.3, 0.2]])
    weights = called(ALL, "biplanar_weights(v, 16)", 2, v=nearness)
    assert weights == near(np.clip((nearness - 0.5773) / 0.4227, 0, 1) ** 2)


@truth("std.mapping.biplanar")
@pytest.mark.parametrize("axis", range(3))
def test_the_level_is_that_of_the_plane(axis: int) -> None:
    picture = Picture(painted)
    i, j = np.meshgrid((0, 1), (0, 1))
    across, down = np.array([0.1, 0.2, 0.3]), np.array([-0.4, 0.5, 0.7])
    points = Quad(i[..., None] * across + j[..., None] * down)
    other = (axis + 1) % 3
    leaning_to = unit_rows(np.eye(3)[axis] + 0.9 * np.eye(3)[other])
    normal = Quad(np.broadcast_to(leaning_to, (2, 2, 3)))
    called(ALL, "biplanar(t, p, n, 8)", 4, t=picture, p=points, n=normal)
    steps = [[np.mean(lane) for lane in step] for step in picture.steps]
    found = list(zip(steps[::2], steps[1::2], strict=True))
    for right, below in (PLANES[axis], PLANES[other]):
        ways = np.array([across, down]) @ np.stack([right, below], axis=1)
        assert any(np.allclose(each, ways) for each in found)


# --- flow ----------------------------------------------------------------------------------------


@truth("std.mapping.flow_uv", "std.mapping.flow_share", "std.mapping.flowed")
@pytest.mark.parametrize("time", [0.0, 0.2, 0.5, 0.9, 7.75, -0.3])
def test_textures_flow_in_two_phases(time: float) -> None:
    flow = scattered(COUNT, 2, 0.3, 9)
    first, second = time % 1, (time + 0.5) % 1
    found = called(ALL, f"flow_uv(p, f, {time}, 0.5)", 2, p=UV, f=flow)
    assert found == near(UV - flow * (second - 0.5))
    found = called(ALL, f"flow_uv(p, f, {time}, 0.25)", 2, p=UV, f=flow)
    assert found == near(UV - flow * ((time + 0.25) % 1 - 0.5))
    share = 1 - 2 * min(first, 1 - first)
    assert called(ALL, f"flow_share({time})") == near(share)
    ways = [UV - flow * (first - 0.5), UV - flow * (second - 0.5) + 0.5]
    colors = [np.stack(painted(*way.T), axis=1) for way in ways]
    found = called(ALL, f"flowed(t, p, f, {time})", 4, t=Picture(painted), p=UV, f=flow)
    assert found == near((1 - share) * colors[0] + share * colors[1])
    # What begins anew is not seen.
    assert first > 0 or share == near(1)


# --- tiling without repetition -------------------------------------------------------------------


def triangles(uv: Floats) -> tuple[Any, Floats]:
    """The corners around points of a grid of equal triangles, by their barycentric coordinates."""
    side = 1 / (2 * math.sqrt(3))
    axes = side * np.array([[1, 0.5], [0, math.sqrt(3) / 2]])
    x, y = np.linalg.solve(axes, uv.T)
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    a, b = x - i, y - j
    upper = a + b > 1
    corners = [
        (np.where(upper, i + 1, i), np.where(upper, j + 1, j)),
        (np.where(upper, i + 1, i), np.where(upper, j, j + 1)),
        (np.where(upper, i, i + 1), np.where(upper, j + 1, j)),
    ]
    weights = np.where(upper, [a + b - 1, 1 - b, 1 - a], [1 - a - b, b, a])
    back = sum(w[:, None] * (axes @ np.array(c)).T for w, c in zip(weights, corners, strict=True))
    assert back == near(uv)
    return corners, weights.T


@truth("std.mapping.hex_tiles", "std.mapping.HexTiles")
def test_triangles_around_a_point() -> None:
    corners, weights = triangles(UV)
    found = called(ALL, "hex_tiles(p).weights", 3, p=UV)
    assert found == near(weights)
    for name, corner in zip(("first", "second", "third"), corners, strict=True):
        found = called(ALL, f"vec2(hex_tiles(p).{name})", 2, p=UV)
        assert found == near(np.stack(corner, axis=1))


def pcg2d(x: Any, y: Any) -> Floats:
    """Jarzynski and Olano 2020, listing 10, in numbers without a limit."""
    x, y = (int(lane) * 1664525 + 1013904223 for lane in (x % 2**32, y % 2**32))
    for _ in range(2):
        x = (x + y * 1664525) % 2**32
        y = (y + x * 1664525) % 2**32
        x, y = x ^ (x >> 16), y ^ (y >> 16)
    return np.array([x >> 8, y >> 8]) / 2**24


@truth("std.mapping.tile_shift")
def test_corners_are_shifted_by_a_hash() -> None:
    numbers = np.array([0, 1, -1, 7, 1234, -99])
    found = called(ALL, "tile_shift(ivec2(i, j))", 2, i=numbers, j=numbers[::-1])
    expected = [pcg2d(i, j) for i, j in zip(numbers, numbers[::-1], strict=True)]
    assert found == near(np.array(expected))


def shifted_reads(uv: Floats) -> tuple[list[Floats], Floats]:
    corners, weights = triangles(uv)
    reads = []
    for x, y in corners:
        shift = np.array([pcg2d(i, j) for i, j in zip(x, y, strict=True)])
        reads.append(np.stack(painted(*(uv + shift).T), axis=1))
    return reads, weights


@truth("std.mapping.hex_tiled", "std.mapping.shifted")
def test_shifted_reads_are_blended() -> None:
    reads, weights = shifted_reads(UV)
    shares = weights**5
    shares /= shares.sum(axis=1, keepdims=True)
    expected = sum(shares[:, [i]] * reads[i] for i in range(3))
    assert called(ALL, "hex_tiled(t, p, 5)", 4, t=Picture(painted), p=UV) == near(expected)
    picture = Picture(painted)
    i, j = np.meshgrid((0, 1), (0, 1))
    quad = Quad(np.stack([0.1 * i + 0.2 * j, 0.3 * i - 0.4 * j], axis=-1))
    called(ALL, "hex_tiled(t, p, 5)", 4, t=picture, p=quad)
    steps = [[np.mean(lane) for lane in step] for step in picture.steps]
    assert steps[0] == near([0.1, 0.3])
    assert steps[1] == near([0.2, -0.4])


@truth("std.mapping.stochastic_tiled")
def test_the_contrast_is_kept() -> None:
    """Three values without a relation vary as one does, if the sum of squared weights is one."""
    reads, weights = shifted_reads(UV)
    mean = np.array([0.5, 0.25, 0.75, 1])
    shares = weights / np.sqrt((weights**2).sum(axis=1, keepdims=True))
    expected = mean + sum(shares[:, [i]] * (reads[i] - mean) for i in range(3))
    text = "stochastic_tiled(t, p, vec4(0.5, 0.25, 0.75, 1))"
    assert called(ALL, text, 4, t=Picture(painted), p=UV) == near(expected)
