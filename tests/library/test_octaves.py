"""Sums of octaves of noise, and places and flows that noise moves, against NumPy."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from .kit import Floats
from .noises import Noise, derivative, gradient, octaves
from .sampled import sampled
from .truth import truth

IMPORTS = "import std.noise"
AXES = {2: "p.xy", 3: "p.xyz"}
near = partial(pytest.approx, rel=1e-6, abs=1e-6)
PLACES = np.random.default_rng(5).uniform(-7, 7, (60, 3))

SUMS: dict[str, Noise] = {
    "fbm": gradient,
    "turbulence": lambda p: np.abs(gradient(p)),
    "ridged": lambda p: (1 - np.abs(gradient(p))) ** 2,
}


@truth("std.noise.fbm", "std.noise.turbulence", "std.noise.ridged", "std.noise.ridge")
@truth("std.noise.Octaves", "std.noise.next_octave")
@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("name", SUMS)
def test_octaves_are_added(name: str, dimension: int) -> None:
    at, place = PLACES[:, :dimension], AXES[dimension]
    found = sampled(
        IMPORTS,
        f"{name}({place}, 3, 1.9, 0.6), {name}({place}, 3), {name}({place}, 1), {name}({place}, 0)",
        p=PLACES,
    )
    expected = [
        octaves(SUMS[name], at, *rest) for rest in [(3, 1.9, 0.6), (3, 2, 0.5), (1, 2, 0.5)]
    ]
    assert found[:, :3] == near(np.stack(expected, axis=-1))
    assert not found[:, 3].any()


@truth("std.noise.most_octaves")
def test_sums_have_twelve_octaves_at_most() -> None:
    many = np.full((4, 4), 20)
    found = sampled(IMPORTS, "fbm(p.xy, k.x, 1.5, 0.9), 0, 0, 0", p=PLACES[:4], k=many)[:, 0]
    assert found == near(octaves(gradient, PLACES[:4, :2], 12, 1.5, 0.9))


# --- places that are moved -----------------------------------------------------------------------

SHIFTS: dict[int, list[tuple[float, ...]]] = {
    2: [(0, 0), (5.2, 1.3)],
    3: [(0, 0, 0), (5.2, 1.3, 8.4), (1.7, 9.2, 2.8)],
}


@truth("std.noise.domain_warp")
@pytest.mark.parametrize("dimension", [2, 3])
def test_places_are_warped_by_sums(dimension: int) -> None:
    at = PLACES[:, :dimension]
    sums = [octaves(gradient, at + shift, 4, 2, 0.5) for shift in SHIFTS[dimension]]
    expression = f"domain_warp({AXES[dimension]}, 0.7, 4)" + ", 0" * (4 - dimension)
    found = sampled(IMPORTS, expression, p=PLACES)[:, :dimension]
    assert found == near(at + 0.7 * np.stack(sums, axis=-1))


@truth("std.noise.curl_noise")
def test_a_flow_in_a_plane_follows_the_lines_of_a_noise() -> None:
    slope = derivative(gradient, PLACES[:, :2])
    found = sampled(IMPORTS, "curl_noise(p.xy), 0, 0", p=PLACES)[:, :2]
    assert found == pytest.approx(np.stack([slope[:, 1], -slope[:, 0]], axis=-1), abs=1e-5)


@truth("std.noise.curl_noise")
def test_a_flow_in_space_is_a_curl() -> None:
    shifts = np.array([(0, 0, 0), (31.5, -47.25, 12.75), (-23.25, 11.75, 58.5)])
    a, b, c = (derivative(gradient, PLACES + shift) for shift in shifts)
    curl = [c[:, 1] - b[:, 2], a[:, 2] - c[:, 0], b[:, 0] - a[:, 1]]
    found = sampled(IMPORTS, "curl_noise(p.xyz), 0", p=PLACES)[:, :3]
    assert found == pytest.approx(np.stack(curl, axis=-1), abs=1e-5)


@truth("std.noise.curl_noise")
@pytest.mark.parametrize("dimension", [2, 3])
def test_flows_have_no_sources(dimension: int) -> None:
    def flow(p: Floats) -> Floats:
        expression = f"curl_noise({AXES[dimension]})" + ", 0" * (4 - dimension)
        return sampled(IMPORTS, expression, p=p)[:, :dimension]

    steps, inside = 1e-5 * np.eye(dimension), PLACES[:, :dimension]
    sources = sum(
        (flow(inside + step)[:, axis] - flow(inside - step)[:, axis]) / 2e-5
        for axis, step in enumerate(steps)
    )
    assert sources == pytest.approx(np.zeros(len(inside)), abs=1e-4)
