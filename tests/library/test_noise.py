"""Noises against the formulas of papers, written with NumPy."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from .hashed import fractions, hashed
from .kit import Floats
from .noises import GRADIENTS, ON_LATTICE, corners, derivative, fade, gradient, simplex, value
from .sampled import sampled
from .truth import truth

IMPORTS = "import std.noise"
AXES = {2: "p.xy", 3: "p.xyz"}
PERIOD = {2: "k.xy", 3: "k.xyz"}
near = partial(pytest.approx, rel=1e-6, abs=1e-6)


def places(count: int = 80, dimension: int = 3) -> Floats:
    """Places on both sides of zero, and some on lattices and between them."""
    some = np.random.default_rng(2).uniform(-9, 9, (count, dimension))
    return np.concatenate([some, np.floor(some[:6]), np.floor(some[:6]) + 0.5])


# --- white noise ---------------------------------------------------------------------------------


@truth("std.noise.white_noise")
@pytest.mark.parametrize(("cell", "count"), [("k.x", 1), ("k.xy", 2), ("k.xyz", 3), ("k", 4)])
def test_white_noise_is_a_fraction_for_each_cell(cell: str, count: int) -> None:
    cells = np.random.default_rng(3).integers(-(2**31), 2**31, (40, 4))
    found = sampled(IMPORTS, f"white_noise({cell}), 0, 0, 0", k=cells)[:, 0]
    assert np.array_equal(found, fractions(cells[:, :count])[:, 0])


@truth("std.noise.white_noise")
@pytest.mark.parametrize(("place", "count"), [("p.x", 1), ("p.xy", 2), ("p.xyz", 3), ("p", 4)])
def test_white_noise_of_floats_hashes_their_bits(place: str, count: int) -> None:
    some = places(dimension=4).astype(np.float32)
    signs = np.array([[0, 0, 0, 0], [-0.0, -0.0, -0.0, -0.0], [1, -0.0, 2, 0]], np.float32)
    some = np.concatenate([some, signs])
    bits = (some + np.float32(0)).view(np.uint32).astype(np.int64)
    found = sampled(IMPORTS, f"white_noise({place}), 0, 0, 0", p=some.astype(np.float64))[:, 0]
    assert np.array_equal(found, fractions(bits[:, :count])[:, 0])


@truth("std.noise.cell_noise", "std.noise.cell_of")
@pytest.mark.parametrize("dimension", [2, 3])
def test_cell_noise_is_the_same_in_all_of_a_cell(dimension: int) -> None:
    some = places()
    found = sampled(IMPORTS, f"cell_noise({AXES[dimension]}), 0, 0, 0", p=some)[:, 0]
    cells = np.floor(some[:, :dimension])
    assert np.array_equal(found, fractions(cells)[:, 0])
    lanes = f"vec{dimension}(cell_of({AXES[dimension]}))" + (", 0" * (4 - dimension))
    assert np.array_equal(sampled(IMPORTS, lanes, p=some)[:, :dimension], cells)


# --- noise on lattices ---------------------------------------------------------------------------

NOISES = {"value_noise": value, "gradient_noise": gradient, "simplex_noise": simplex}


@truth("std.noise.value_noise", "std.noise.gradient_noise", "std.noise.simplex_noise")
@truth("std.noise.quintic", "std.noise.blended_along", "std.noise.across_cell")
@truth("std.noise.level_at", "std.noise.levels", "std.noise.plane_at", "std.noise.planes")
@truth("std.noise.slope_at", "std.noise.gradients2", "std.noise.gradients3")
@truth("std.noise.simplex_corner")
@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("name", NOISES)
def test_noises_are_those_of_papers(name: str, dimension: int) -> None:
    some = places()
    found = sampled(IMPORTS, f"{name}({AXES[dimension]}), 0, 0, 0", p=some)[:, 0]
    assert found == near(NOISES[name](some[:, :dimension]))


@truth("std.noise.value_noise_derivatives", "std.noise.gradient_noise_derivatives")
@truth("std.noise.simplex_noise_derivatives", "std.noise.quintic_slope")
@truth("std.noise.Derivatives2", "std.noise.Derivatives3", "std.noise.blended_along")
@truth("std.noise.across_cell", "std.noise.level_at", "std.noise.levels", "std.noise.plane_at")
@truth("std.noise.planes", "std.noise.simplex_corner")
@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("name", NOISES)
def test_gradients_are_limits_of_differences(name: str, dimension: int) -> None:
    some = places()
    known = f"{name}_derivatives({AXES[dimension]})"
    lanes = f"{known}.value, {known}.gradient" + (", 0" if dimension == 2 else "")
    found = sampled(IMPORTS, lanes, p=some)
    noise, at = NOISES[name], some[:, :dimension]
    assert found[:, 0] == near(noise(at))
    assert found[:, 1 : 1 + dimension] == pytest.approx(derivative(noise, at), abs=1e-5)


@truth("std.noise.tiling_value_noise", "std.noise.tiling_value_noise_derivatives")
@truth("std.noise.tiling_gradient_noise", "std.noise.tiling_gradient_noise_derivatives")
@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("name", ["value_noise", "gradient_noise"])
def test_tiles_repeat_after_their_period(name: str, dimension: int) -> None:
    some, period = places(), np.array([3, 5, 2])
    given = {"k": np.broadcast_to(period, some.shape)}
    noise = partial(NOISES[name], period=period[:dimension])  # type: ignore[call-arg]
    known = f"tiling_{name}_derivatives({AXES[dimension]}, {PERIOD[dimension]})"
    lanes = f"tiling_{name}({AXES[dimension]}, {PERIOD[dimension]}), {known}.gradient"
    found = sampled(IMPORTS, lanes + (", 0" if dimension == 2 else ""), p=some, **given)
    at = some[:, :dimension]
    assert found[:, 0] == near(noise(at))
    assert found[:, 1 : 1 + dimension] == pytest.approx(derivative(noise, at), abs=1e-5)
    moved = some + period * np.array([1, -2, 3])
    assert sampled(IMPORTS, lanes + (", 0" if dimension == 2 else ""), p=moved, **given) == near(
        found
    )


@truth("std.noise.planes")
@pytest.mark.parametrize(("dimension", "steps"), [(2, 201), (3, 51)])
def test_no_gradient_noise_is_beyond_one(dimension: int, steps: int) -> None:
    """Whatever the directions at the corners of a cell are, and one place comes close to 1."""
    axis = np.linspace(0, 1, steps)
    at = np.stack(np.meshgrid(*[axis] * dimension, indexing="ij"), axis=-1)
    largest = np.zeros(at.shape[:-1])
    for k in corners(dimension, 0, 2):
        weight = np.prod(np.where(k == 1, fade(at), 1 - fade(at)), axis=-1)
        largest += weight * ((at - k) @ GRADIENTS[dimension].T).max(axis=-1)
    assert 0.995 < ON_LATTICE[dimension] * largest.max() <= 1


@truth("std.noise.simplex_noise_derivatives")
@pytest.mark.parametrize("dimension", [2, 3])
def test_no_simplex_noise_is_beyond_one(dimension: int) -> None:
    some = np.random.default_rng(4).uniform(-99, 99, (40_000, dimension))
    found = sampled(IMPORTS, f"simplex_noise({AXES[dimension]}), 0, 0, 0", p=some)[:, 0]
    assert 0.9 < np.abs(found).max() <= 1
    assert found.mean() == pytest.approx(0, abs=0.02)


@truth("std.noise.simplex_noise_derivatives")
@pytest.mark.parametrize("dimension", [2, 3])
def test_simplices_meet_without_a_step(dimension: int) -> None:
    """On diagonals, where it is a matter of rounding which corners are used."""
    along = np.linspace(-3, 3, 61)[:, None] * np.ones(dimension)
    crossed = along.copy()
    crossed[:, -1] += 0.25
    some = np.concatenate([along, crossed])
    found = sampled(IMPORTS, f"simplex_noise({AXES[dimension]}), 0, 0, 0", p=some)[:, 0]
    assert found == near(simplex(some))


@truth("std.noise.slope_at")
@pytest.mark.parametrize("dimension", [2, 3])
def test_each_direction_is_as_likely_as_others(dimension: int) -> None:
    cells = np.indices((40, 40, 1) if dimension == 3 else (40, 40)).reshape(dimension, -1).T
    number = hashed(cells)[:, 0] // (2**32 // len(GRADIENTS[dimension]))
    counts = np.bincount(number, minlength=len(GRADIENTS[dimension]))
    assert counts.min() > 0.7 * counts.mean()
    lanes = f"slope_at({PERIOD[dimension]})" + ", 0" * (4 - dimension)
    found = sampled(IMPORTS, lanes, k=cells)[:, :dimension]
    assert np.array_equal(found, GRADIENTS[dimension][number])
