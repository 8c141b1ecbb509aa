"""Samples: their moments are the integrals of what they should be spread over."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .calls import called
from .kit import Floats, hammersley, on_circle
from .truth import truth

ALL = "import std.sampling"
MANY = 2048
SQUARE = hammersley(MANY)
NUMBERS = np.arange(MANY)


def near(expected: Any, within: float = 1e-6) -> Any:
    return pytest.approx(np.asarray(expected, np.float64), abs=within)


@truth("std.sampling.r2", "std.sampling.share")
def test_r2_steps_by_the_plastic_number() -> None:
    """The root of x³ = x + 1; 2^-24 is the step of what is found."""
    plastic = np.roots([1, 0, -1, -1]).real.max()
    numbers = np.array([0, 1, 2, 3, 1000, 100_000])
    steps = np.outer(numbers, [1 / plastic, 1 / plastic**2])
    assert called(ALL, "r2(i)", 2, i=numbers) == near((0.5 + steps) % 1, 1e-4)
    assert called(ALL, "r2(i)", 2, i=numbers[:5]) == near((0.5 + steps[:5]) % 1, 5e-7)
    # Bit for bit, in units of 2^-32; the last bits count where they carry.
    many = np.array([*range(0, 300), 123_456_789])
    units = [round(2**32 / plastic), round(2**32 / plastic**2)]
    expected = (np.outer(many, units) + 2**31) % 2**32 // 256 / 2**24
    assert called(ALL, "r2(i)", 2, i=many) == near(expected, 1e-12)
    assert called(ALL, "share(uint(i))", 1, i=np.array([255, 256, -1])) == near(
        [0, 2**-24, 1 - 2**-24], 1e-12
    )


@truth("std.sampling.golden_turn", "std.sampling.vogel_disc")
def test_a_sunflower() -> None:
    golden = (math.sqrt(5) - 1) / 2
    assert called(ALL, "golden_turn(i)", 1, i=NUMBERS) == near(NUMBERS * golden % 1)
    many = np.array([0, 255, 123_456_789])
    expected = many * round(2**32 * golden) % 2**32 // 256 / 2**24
    assert called(ALL, "golden_turn(i)", 1, i=many) == near(expected, 1e-12)
    found = called(ALL, f"vogel_disc(i, {MANY}, 0.2)", 2, i=NUMBERS)
    radius = np.sqrt((NUMBERS + 0.5) / MANY)
    turn = 2 * np.pi * (NUMBERS * golden + 0.2)
    expected = radius[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    assert found == near(expected, 5e-6)


def of_sphere(d: Floats, lowest: float) -> None:
    """Directions are spread evenly over the part of the sphere above a height."""
    assert np.linalg.norm(d, axis=1) == near(np.ones(len(d)))
    heights = np.sort(d[:, 2])
    even = lowest + (1 - lowest) * (np.arange(len(d)) + 0.5) / len(d)
    assert heights == near(even, 2e-3)
    assert d[:, :2].mean(axis=0) == near([0, 0], 3e-3)
    flat = (d[:, :2] ** 2).mean(axis=0)
    assert flat == near(np.full(2, (1 - (heights**2).mean()) / 2), 3e-3)


@truth("std.sampling.fibonacci_sphere", "std.sampling.fibonacci_hemisphere")
def test_lattices_on_the_sphere() -> None:
    for name, lowest in (("sphere", -1.0), ("hemisphere", 0.0)):
        found = called(ALL, f"fibonacci_{name}(i, {MANY})", 3, i=NUMBERS)
        of_sphere(found, lowest)
        # The height falls evenly, and each point lies a golden section of a turn farther.
        assert found[:, 2] == near(1 - (1 - lowest) * (NUMBERS + 0.5) / MANY)
        turns = np.diff(np.unwrap(np.arctan2(found[:, 1], found[:, 0])))
        assert turns % (2 * np.pi) == near(np.full(MANY - 1, np.pi * (math.sqrt(5) - 1)), 1e-4)


@truth("std.sampling.sphere_direction", "std.sampling.hemisphere_direction")
def test_directions_are_spread_evenly() -> None:
    of_sphere(called(ALL, "sphere_direction(p)", 3, p=SQUARE), -1)
    of_sphere(called(ALL, "hemisphere_direction(p)", 3, p=SQUARE), 0)


@truth("std.sampling.cone_direction")
def test_directions_of_a_cone() -> None:
    found = called(ALL, "cone_direction(p, 0.7)", 3, p=SQUARE)
    of_sphere(found, 0.7)
    height = 1 - 0.3 * SQUARE[:, 1]
    flat = np.sqrt(1 - height**2)[:, None] * on_circle(SQUARE[:, 0])
    assert found == near(np.column_stack([flat, height]))


@truth("std.sampling.concentric_disc")
def test_squares_become_circles() -> None:
    found = called(ALL, "concentric_disc(p)", 2, p=SQUARE)
    at = 2 * SQUARE - 1
    # A ring of the square becomes a circle as wide, and its eighths become eighths.
    assert np.hypot(*found.T) == near(np.abs(at).max(axis=1))
    assert (found**2).mean(axis=0) == near([0.25, 0.25], 1e-3)
    corners = np.array([[1, 1], [0, 1], [0, 0], [1, 0], [1, 0.75], [0.25, 1], [0.5, 0.5]])
    turn = np.pi * np.array([1 / 4, 3 / 4, 5 / 4, 7 / 4, 1 / 8, 5 / 8])
    expected = [*np.stack([np.cos(turn), np.sin(turn)], axis=1), (0, 0)]
    assert called(ALL, "concentric_disc(p)", 2, p=corners) == near(expected)


@truth("std.sampling.triangle_weights")
def test_points_of_a_triangle() -> None:
    found = called(ALL, "triangle_weights(p)", 3, p=SQUARE)
    assert found.sum(axis=1) == near(np.ones(MANY))
    assert (found >= 0).all()
    # Moments of barycentric coordinates over a triangle: 1/3, 1/6 and 1/12.
    moments = found.T @ found / MANY
    assert found.mean(axis=0) == near(np.full(3, 1 / 3), 1e-3)
    assert moments == near(np.full((3, 3), 1 / 12) + np.eye(3) / 12, 1e-3)
    ends = called(ALL, "triangle_weights(p)", 3, p=np.array([[0.0, 0], [1, 0], [1, 1]]))
    assert ends == near(np.eye(3))


@truth("std.sampling.interleaved_gradient_noise")
def test_noise_of_pixels_is_even_over_neighbours() -> None:
    x, y = np.meshgrid(np.arange(48.0), np.arange(48.0))
    pixels = np.stack([x.ravel(), y.ravel()], axis=1) + 0.5
    found = called(ALL, "interleaved_gradient_noise(p)", 1, p=pixels).reshape(48, 48)
    whole = 52.9829189 * ((0.06711056 * (x + 0.5) + 0.00583715 * (y + 0.5)) % 1)
    assert found == near(whole % 1, 1e-9)
    beside = np.array([[-7.5, 2.5], [-1.5, -40.5]])
    whole = 52.9829189 * (beside @ (0.06711056, 0.00583715) % 1)
    assert called(ALL, "interleaved_gradient_noise(p)", 1, p=beside) == near(whole % 1, 1e-9)
    # Each 3 by 3 pixels hold about all ninths.
    ninths = np.sort(found[10:13, 20:23].ravel())
    assert ninths == near((np.arange(9) + 0.5) / 9, 0.12)
