"""Filtered patterns against the overlap of rectangles, and samples, in NumPy."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.evaluate import evaluate

from ..semantics.kit import leaves, shader
from .hashed import fractions
from .kit import MESH, Floats
from .sampled import Values, sampled
from .truth import truth

IMPORTS = "import std.patterns"
near = partial(pytest.approx, rel=1e-6, abs=1e-6)
RANDOM = np.random.default_rng(9)
PLACES = RANDOM.uniform(-3, 3, (60, 2))
WIDTHS = np.concatenate([
    np.zeros((10, 2)), RANDOM.uniform(0, 0.6, (25, 2)), RANDOM.uniform(0.5, 5, (25, 2))
])  # fmt: skip
"""Footprints of points, of parts of cells, and of several cells."""
USED = np.maximum(WIDTHS, 1 / 1024)
CELLS = np.arange(-8, 9)


def filtered(expression: str) -> Floats:
    """The first lane of a pattern, whose footprint is ``q``."""
    return sampled(IMPORTS, f"{expression}, 0, 0, 0", p=PLACES, q=WIDTHS)[:, 0]


def share(axis: int, first: Values, last: Values) -> Floats:
    """The shares of footprints that lie in each of some intervals along an axis."""
    x, w = PLACES[:, axis, None], USED[:, axis, None]
    inside = np.minimum(x + w / 2, last) - np.maximum(x - w / 2, first)
    return np.asarray(np.maximum(inside, 0) / w)


def at_cells(axis: int) -> Floats:
    return share(axis, CELLS, CELLS + 1.0)


@truth("std.patterns.pulse_train", "std.patterns.stripes")
@truth("std.patterns.narrowest", "std.patterns.at_least_narrowest")
@pytest.mark.parametrize("duty", [0.5, 0.3, 1.0])
def test_stripes_cover_a_share(duty: float) -> None:
    expected = share(0, CELLS, CELLS + duty).sum(axis=1)
    assert filtered(f"stripes(p.x, {duty}, q.x)") == near(expected)
    assert filtered(f"pulse_train(p.x, {duty}, q.x)") == near(expected)


@truth("std.patterns.filtered_step", "std.patterns.at_least_narrowest", "std.patterns.narrowest")
def test_a_step_covers_what_is_above_its_edge() -> None:
    expected = share(0, np.array([0.3]), np.array([99.0]))[:, 0]
    assert filtered("filtered_step(0.3, p.x, q.x)") == near(expected)
    close_by = sampled(IMPORTS, "filtered_step(0, p.x, 0), 0, 0, 0", p=np.array([[2.0**-13]]))
    assert close_by[0, 0] == 0.5 + 0.125


@truth("std.patterns.checker")
def test_odd_squares_of_a_board_are_high() -> None:
    odd = (CELLS[:, None] + CELLS) % 2 == 1
    expected = np.einsum("ni,nj,ij->n", at_cells(0), at_cells(1), odd.astype(float))
    assert filtered("checker(p.xy, q.xy)") == near(expected)


@truth("std.patterns.grid")
@pytest.mark.parametrize("line", [0.1, 0.45])
def test_a_grid_has_gaps_between_its_lines(line: float) -> None:
    gaps = [share(axis, CELLS + line / 2, CELLS + 1 - line / 2).sum(axis=1) for axis in (0, 1)]
    assert filtered(f"grid(p.xy, {line}, q.xy)") == near(1 - gaps[0] * gaps[1])


@truth("std.patterns.bricks", "std.patterns.brick_row", "std.patterns.Bricks")
@pytest.mark.parametrize("offset", [0.5, 0.3, 0.0])
def test_a_wall_has_mortar_around_each_brick(offset: float) -> None:
    mortar = np.array((0.08, 0.2))
    expected = np.zeros(len(PLACES))
    for row in CELLS:
        height = share(1, row + mortar[1:] / 2, row + 1 - mortar[1:] / 2)[:, 0]
        left = CELLS + offset * (row % 2) + mortar[0] / 2
        expected += height * share(0, left, left + 1 - mortar[0]).sum(axis=1)
    wall = f"bricks(p.xy, {offset}, vec2(0.08, 0.2), q.xy)"
    assert filtered(f"{wall}.brick") == near(expected)
    rows = np.floor(PLACES[:, 1])
    along = PLACES[:, 0] - offset * (rows % 2)
    inside = np.stack([along - np.floor(along), PLACES[:, 1] - rows], axis=-1)
    found = sampled(IMPORTS, f"vec2({wall}.cell), {wall}.uv", p=PLACES, q=WIDTHS)
    assert np.array_equal(found[:, :2], np.stack([np.floor(along), rows], axis=-1))
    assert found[:, 2:] == near(inside)


# --- footprints ----------------------------------------------------------------------------------

FORMS = [
    ("stripes(x.x, 0.5)", "stripes(x.x, 0.5, w.x)"),
    ("checker(x)", "checker(x, w)"),
    ("grid(x, 0.2)", "grid(x, 0.2, w)"),
    ("bricks(x, 0.5, vec2(0.1)).brick", "bricks(x, 0.5, vec2(0.1), w).brick"),
    ("dots(x, 0.3)", "dots(x, 0.3, w)"),
    ("hexagon_lines(x, 0.2)", "hexagon_lines(x, 0.2, w)"),
    ("truchet_lines(x, 0.2)", "truchet_lines(x, 0.2, w)"),
]


@truth("std.patterns.footprint", "std.patterns.stripes", "std.patterns.checker")
@truth("std.patterns.grid", "std.patterns.bricks", "std.patterns.dots")
@truth("std.patterns.hexagon_lines", "std.patterns.truchet_lines")
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("short", "whole"), FORMS)
def test_a_footprint_is_the_larger_change_to_a_neighbour(short: str, whole: str, sign: int) -> None:
    """In a quad, ``uv`` changes by (-0.3, 0.2) across and by (0.1, -0.4) down, or the reverse."""
    u = sign * np.array([[[0.75, 0.45], [0.85, 0.55]]])
    v = sign * np.array([[[0.1, 0.3], [-0.3, -0.1]]])
    head = "import std.patterns\nmaterial M { x = uv  w = vec2(0.3, 0.4)  color = vec3("
    found = []
    for expression in (short, whole):
        built = shader(f"{head}{expression}) }}")
        (target,) = built.results_of(TARGET)
        lanes = evaluate(target.value, leaves(built, {**MESH, "vertex_uv": (u, v)}), np)
        found.append(np.asarray(lanes[0], float))
    assert found[0] == near(found[1])
    assert np.ptp(found[1]) > 0.01


# --- other edges ---------------------------------------------------------------------------------

HEXAGON = np.array([(np.cos(turn), np.sin(turn)) for turn in np.arange(6) * np.pi / 3])


def hexagon(p: Floats) -> tuple[Floats, Floats, Floats]:
    """The number and the middle of the nearest of all middles, and the distance of the border."""
    numbers = np.array([(i, j) for i in range(-15, 16) for j in range(-9, 10) if (i + j) % 2 == 0])
    middles = numbers * (0.5, np.sqrt(0.75))
    nearest = np.linalg.norm(p[:, None] - middles, axis=-1).argmin(axis=1)
    away = p - middles[nearest]
    return numbers[nearest], away, 0.5 - (away @ HEXAGON.T).max(axis=1)


def dot(p: Floats) -> Floats:
    """How far the edge of a disc with the radius 0.3 is, outside of it."""
    return np.asarray(np.linalg.norm(p - np.floor(p) - 0.5, axis=1) - 0.3)


def curve(p: Floats) -> Floats:
    """How far the nearer curve of a cell is: circles around two corners."""
    cell = np.floor(p)
    at = p - cell
    turned = fractions(cell)[:, 0] < 0.5
    first = np.stack([turned, np.zeros_like(turned)], axis=-1)
    distances = [np.linalg.norm(at - corner, axis=1) for corner in (first, 1 - first)]
    return np.asarray(np.minimum(*(np.abs(distance - 0.5) for distance in distances)))


@truth("std.patterns.hexagons", "std.patterns.Hexagon")
def test_hexagons_are_around_the_nearest_middle() -> None:
    some = np.random.default_rng(11).uniform(-6, 6, (400, 2))
    cell, at, edge = hexagon(some)
    found = sampled(IMPORTS, "vec2(hexagons(p.xy).cell), hexagons(p.xy).at", p=some)
    assert np.array_equal(found[:, :2], cell)
    assert found[:, 2:] == near(at)
    found = sampled(IMPORTS, "hexagons(p.xy).to_edge, 0, 0, 0", p=some)
    assert found[:, 0] == near(edge)
    assert edge.min() >= 0


@truth("std.patterns.hexagons")
def test_halfway_between_two_middles_lies_the_next_hexagon() -> None:
    """Between the middles of (0, 0) and (1, 1)."""
    halfway = np.array([[0.25, np.sqrt(0.75) / 2]])
    found = sampled(IMPORTS, "vec2(hexagons(p.xy).cell), 0, 0", p=halfway)
    assert found[0, :2].tolist() == [1, 1]


@truth("std.patterns.truchet")
def test_curves_go_around_two_corners_of_a_cell() -> None:
    assert filtered("truchet(p.xy)") == near(curve(PLACES))


EDGES: list[tuple[str, Callable[[Floats], Floats], float]] = [
    ("dots(p.xy, 0.3, q.xy)", dot, np.pi * 0.09),
    ("hexagon_lines(p.xy, 0.2, q.xy)", lambda p: hexagon(p)[2] - 0.1, 1 - 0.8**2),
    ("truchet_lines(p.xy, 0.2, q.xy)", lambda p: curve(p) - 0.1, np.pi / 2 * 0.2),
]
"""Patterns, how far their edge is at a place, and their mean."""


@truth("std.patterns.dots", "std.patterns.hexagon_lines", "std.patterns.truchet_lines")
@truth("std.patterns.filtered_step", "std.patterns.towards_mean")
@pytest.mark.parametrize(("expression", "outside", "mean"), EDGES)
def test_edges_are_filtered_up_to_the_mean(
    expression: str, outside: Callable[[Floats], Floats], mean: float
) -> None:
    width = USED.max(axis=1)
    near_edge = np.clip(0.5 - outside(PLACES) / width, 0, 1)
    t = np.clip(2 * (width - 0.5), 0, 1)
    t = t * t * (3 - 2 * t)
    assert filtered(expression) == near(near_edge + t * (mean - near_edge))


@truth("std.patterns.dots", "std.patterns.hexagon_lines", "std.patterns.truchet_lines")
@pytest.mark.parametrize(("expression", "outside", "mean"), EDGES)
def test_means_are_those_of_samples(
    expression: str, outside: Callable[[Floats], Floats], mean: float
) -> None:
    samples = np.random.default_rng(10).uniform(-2, 2, (10_000, 2))
    inside = outside(samples * (1, np.sqrt(0.75)) if "hexagon" in expression else samples) < 0
    assert inside.mean() == pytest.approx(mean, abs=0.02)


# --- other coordinates ---------------------------------------------------------------------------


@truth("std.patterns.twirled")
def test_places_are_turned_more_the_farther_they_are() -> None:
    """Products of complex numbers."""
    z = (PLACES - (0.3, -0.8)) @ (1, 1j)
    z *= np.exp(1j * np.radians(40) * np.abs(z))
    found = sampled(IMPORTS, "twirled(p.xy, 40deg, vec2(0.3, -0.8)), 0, 0", p=PLACES)[:, :2]
    assert found == near(np.stack([0.3 + z.real, z.imag - 0.8], axis=-1))
