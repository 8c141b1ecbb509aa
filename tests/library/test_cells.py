"""Cells around points against NumPy."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from .hashed import fractions
from .kit import Floats
from .noises import features, measured, near_features
from .sampled import sampled
from .truth import truth

IMPORTS = "import std.cellular"
AXES = {2: "p.xy", 3: "p.xyz"}
near = partial(pytest.approx, rel=1e-6, abs=1e-6)
PLACES = np.random.default_rng(5).uniform(-7, 7, (60, 3))


@truth(
    "std.cellular.voronoi",
    "std.cellular.Voronoi2",
    "std.cellular.Voronoi3",
    "std.cellular.nearer_feature",
)
@truth("std.cellular.measured_in", "std.cellular.euclidean", "std.cellular.manhattan")
@truth(
    "std.cellular.chebyshev",
    "std.cellular.feature",
    "std.cellular.near_cell",
    "std.cellular.to_feature",
)
@truth("std.cellular.worley_noise", "std.cellular.to_corner")
@pytest.mark.parametrize("metric", ["euclidean", "manhattan", "chebyshev"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_cells_are_those_of_the_nearest_points(dimension: int, metric: str) -> None:
    at, place, jitter = PLACES[:, :dimension], AXES[dimension], 0.6
    cells, away = near_features(at, jitter)
    distances = measured(away, metric)
    order = np.argsort(distances, axis=0)[:1, :, None]
    known = f"voronoi({place}, {jitter}, {metric})"
    lanes = f"{known}.f1, {known}.f2, worley_noise({place}, {jitter}, {metric}), 0"
    found = sampled(IMPORTS, lanes, p=PLACES)[:, :3]
    assert found == near(np.sort(distances, axis=0)[[0, 1, 0]].T)
    rest = ", 0" * (4 - dimension)
    found = sampled(IMPORTS, f"{known}.away{rest}", p=PLACES)[:, :dimension]
    assert found == near(np.take_along_axis(away, order, axis=0)[0])
    found = sampled(IMPORTS, f"vec{dimension}({known}.cell){rest}", p=PLACES)[:, :dimension]
    assert np.array_equal(found, np.take_along_axis(cells, order, axis=0)[0])


def diagonal_places(count: int, dimension: int) -> Floats:
    """Places towards two corners of the cells that are looked at."""
    chance = np.random.default_rng(6)
    along = chance.uniform(0.3, 0.5, (count, dimension)) * chance.choice([-1, 1], (count, 1))
    return np.asarray(chance.integers(-99, 99, (count, dimension)) + along, np.float64)


@truth("std.cellular.voronoi", "std.cellular.worley_noise", "std.cellular.near_cell")
@pytest.mark.parametrize(("dimension", "count"), [(2, 6000), (3, 3000)])
def test_points_may_be_anywhere_in_their_cells(dimension: int, count: int) -> None:
    """Where the longest way along an axis counts, the next one is often in a cell at a corner."""
    some = diagonal_places(count, dimension)
    away, place = near_features(some, 1)[1], AXES[dimension]
    ways = [np.sort(measured(away, metric), axis=0) for metric in ("euclidean", "chebyshev")]
    known = f"voronoi({place})"
    lanes = f"{known}.f1, {known}.f2, worley_noise({place}), voronoi({place}, 1, chebyshev).f2"
    found = sampled(IMPORTS, lanes, p=some)
    assert found == near(np.stack([*ways[0][[0, 1, 0]], ways[1][1]], axis=-1))


@truth("std.cellular.voronoi", "std.cellular.worley_noise")
@pytest.mark.parametrize(("dimension", "jitter", "beyond"), [(2, 1.0, 1.5), (3, 0.83, 1.585)])
def test_no_nearer_point_is_overlooked(dimension: int, jitter: float, beyond: float) -> None:
    """The nearest point is nearer than any in cells that are not looked at."""
    farthest = np.sqrt(dimension) * (0.5 + 0.5 * jitter)
    assert farthest < 1.5 + 0.5 * (1 - jitter) == pytest.approx(beyond)
    some = np.random.default_rng(6).uniform(-40, 40, (500, dimension))
    found = sampled(
        IMPORTS, f"worley_noise({AXES[dimension]}, {jitter}, euclidean), 0, 0, 0", p=some
    )
    assert found[:, 0] == near(measured(features(some, jitter)[1], "euclidean").min(axis=0))


@truth("std.cellular.tiling_worley_noise")
@pytest.mark.parametrize(("dimension", "count"), [(2, 6000), (3, 12_000)])
def test_tiles_of_cells_repeat_after_their_period(dimension: int, count: int) -> None:
    some = diagonal_places(count, dimension)
    period = np.array([3, 5, 2])[:dimension]
    axes = "xyz"[:dimension]
    found = sampled(
        IMPORTS, f"tiling_worley_noise(p.{axes}, k.{axes}), 0, 0, 0",
        p=some, k=np.broadcast_to(period, some.shape),
    )  # fmt: skip
    expected = measured(near_features(some, 1, period)[1], "euclidean").min(axis=0)
    assert found[:, 0] == near(expected)


@truth("std.cellular.nearer_feature")
@pytest.mark.parametrize("dimension", [2, 3])
def test_of_points_that_are_as_far_the_first_one_counts(dimension: int) -> None:
    """A corner of a grid of points without jitter has some at the same distance."""
    known = f"voronoi({AXES[dimension]}, 0, euclidean)"
    rest, corner = ", 0" * (4 - dimension), np.zeros((1, dimension))
    for lanes, first in ((f"vec{dimension}({known}.cell)", -1.0), (f"{known}.away", -0.5)):
        found = sampled(IMPORTS, lanes + rest, p=corner)[0, :dimension]
        assert found.tolist() == [first] * dimension


@truth("std.cellular.smooth_worley_noise", "std.cellular.SmoothMinimum")
@truth("std.cellular.with_distance", "std.cellular.smooth_distance")
@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("sharpness", [2.0, 16.0, 4000.0])
def test_smooth_cells_add_all_points(dimension: int, sharpness: float) -> None:
    """Quilez 2014, also where powers of the sharpness alone would be beyond all numbers."""
    distances = measured(near_features(PLACES[:, :dimension], 1)[1], "euclidean")
    least = distances.min(axis=0)
    expected = least - np.log2(np.exp2(sharpness * (least - distances)).sum(axis=0)) / sharpness
    noise = f"smooth_worley_noise({AXES[dimension]}, {sharpness}), 0, 0, 0"
    assert sampled(IMPORTS, noise, p=PLACES)[:, 0] == near(expected)


@truth("std.cellular.smooth_worley_noise")
@pytest.mark.parametrize("dimension", [2, 3])
def test_smooth_cells_have_no_visible_steps(dimension: int) -> None:
    """What the cells that are not looked at would add is less than a shade of 8 bits."""
    distances = measured(features(PLACES[:, :dimension], 1)[1], "euclidean")
    expected = -np.log2(np.exp2(-8 * distances).sum(axis=0)) / 8
    noise = f"smooth_worley_noise({AXES[dimension]}, 8), 0, 0, 0"
    assert np.abs(sampled(IMPORTS, noise, p=PLACES)[:, 0] - expected).max() < 1 / 256


@truth("std.cellular.voronoi_edge", "std.cellular.to_border", "std.cellular.neighbour")
@pytest.mark.parametrize("jitter", [0.3, 1.0])
def test_borders_are_as_far_from_both_points(jitter: float) -> None:
    """The distance to the border of two points is half that of their distances' squares."""
    at = np.random.default_rng(7).uniform(-7, 7, (300, 2))
    away = features(at, jitter, 4)[1]
    lengths = measured(away, "euclidean")
    nearest = lengths.argmin(axis=0)
    first = away[nearest, np.arange(len(at))]
    apart = measured(away - first, "euclidean")
    with np.errstate(divide="ignore", invalid="ignore"):
        borders = (lengths**2 - lengths.min(axis=0) ** 2) / (2 * apart)
    expected = np.where(apart > 1e-9, borders, 9).min(axis=0)
    found = sampled(IMPORTS, f"voronoi_edge(p.xy, {jitter}), 0, 0, 0", p=at)[:, 0]
    assert found == near(expected)


@truth("std.cellular.feature")
def test_features_are_random_places_of_cells() -> None:
    cells = np.random.default_rng(8).integers(-50, 50, (20, 3))
    for dimension, cell in ((2, "k.xy"), (3, "k.xyz")):
        expression = f"feature({cell}, 0.5)" + ", 0" * (4 - dimension)
        found = sampled(IMPORTS, expression, k=cells)[:, :dimension]
        assert found == near(0.25 + 0.5 * fractions(cells[:, :dimension]))
