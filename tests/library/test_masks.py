"""Masks against NumPy: polynomials, angles, and surfaces whose curvature is known."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.evaluate import evaluate

from ..semantics.kit import leaves, shader
from .kit import MESH, Floats, columns
from .sampled import sampled
from .truth import truth

IMPORTS = "import std.masks"
near = partial(pytest.approx, rel=1e-6, abs=1e-6)
PLACES = np.random.default_rng(12).uniform(-2, 2, (80, 4))


def rise(low: float, high: float, x: Floats) -> Floats:
    """Hermite's polynomial from 0 at ``low`` to 1 at ``high``."""
    return np.interp(x, [low, high], [0, 1]) ** 2 * (3 - 2 * np.interp(x, [low, high], [0, 1]))


@truth("std.masks.height_mask", "std.masks.band_mask")
def test_heights_are_above_a_limit_or_between_two() -> None:
    x = PLACES[:, 0]
    found = sampled(
        IMPORTS, "height_mask(p.x, -0.5, 1.1), band_mask(p.x, -0.5, 0.7, 0.3), 0, 0", p=PLACES
    )
    assert found[:, 0] == near(rise(-0.5, 1.1, x))
    assert found[:, 1] == near(rise(-0.8, -0.5, x) - rise(0.7, 1.0, x))


@truth("std.masks.slope_mask", "std.masks.slope_angle")
def test_slopes_are_angles_to_what_is_upwards() -> None:
    """Normals at known angles around an axis that is not upright."""
    angles, up = np.linspace(0, np.pi, 60), np.array((0.48, 0.6, 0.64))
    aside = np.cross(up, (0.0, 0.0, 1.0))
    aside /= np.linalg.norm(aside)
    normals = np.outer(np.cos(angles), up) + np.outer(np.sin(angles), aside)
    ways = "normalize(p.xyz), normalize(q.xyz)"
    found = sampled(
        IMPORTS, f"slope_angle({ways}), slope_mask({ways}, 40deg, 70deg), 0, 0",
        p=normals, q=np.broadcast_to(up, normals.shape),
    )  # fmt: skip
    assert found[:, 0] == pytest.approx(angles, abs=1e-5)
    assert found[:, 1] == near(rise(np.radians(40), np.radians(70), angles))


CHANGES = "position, normal, 0.1, 0.9"
CURVED = (
    "mean_curvature(position, normal)", f"edge_mask({CHANGES})", f"cavity_mask({CHANGES})"
)  # fmt: skip


def curvatures(positions: Floats, normals: Floats) -> list[Floats]:
    """The curvature and the masks of a quad of pixels, whose positions and normals are given."""
    given = {"vertex_position": positions, "vertex_normal": normals}
    lanes = {name: tuple(np.moveaxis(each, -1, 0)) for name, each in given.items()}
    built = shader(f"import std.masks\nmaterial M {{ color = vec3({', '.join(CURVED)}) }}")
    (target,) = built.results_of(TARGET)
    found = evaluate(
        target.value, leaves(built, {**MESH, "object_to_world": columns(np.eye(4)), **lanes}), np
    )
    return [np.asarray(lane, float) for lane in found[:3]]


def quad(at: Floats, step: float = 1e-3) -> Floats:
    """The places of four neighbouring pixels, whose sides meet at an obtuse angle."""
    steps = np.array([[(0, 0), (1, 0.3)], [(-0.7, 1.1), (0.3, 1.4)]])
    return np.asarray(at + step * steps, np.float64)


@truth("std.masks.mean_curvature", "std.masks.curvature_of_changes")
@truth("std.masks.edge_mask", "std.masks.cavity_mask")
@pytest.mark.parametrize("sign", [1, -1])
def test_spheres_bulge_and_bowls_are_hollow(sign: int) -> None:
    """1 / r everywhere, and the other way if the normal points inwards."""
    u, v = np.moveaxis(quad(np.array((0.4, 0.7))), -1, 0)
    outwards = np.stack([np.cos(u) * np.cos(v), np.sin(v), np.sin(u) * np.cos(v)], axis=-1)
    found = curvatures(2 * outwards, sign * outwards)
    assert found[0] == pytest.approx(np.full((2, 2), sign / 2), rel=1e-3)
    assert found[1] == pytest.approx(np.full((2, 2), 0.5 if sign == 1 else 0), abs=2e-3)
    assert found[2] == pytest.approx(np.full((2, 2), 0.5 if sign == -1 else 0), abs=2e-3)


@truth("std.masks.mean_curvature", "std.masks.curvature_of_changes")
def test_a_saddle_has_the_curvature_of_its_height() -> None:
    """Of a height z(x, y): the divergence of its slopes over the length of the normal, halved."""
    at = np.array((0.3, -0.2))
    x, y = np.moveaxis(quad(at, 1e-4), -1, 0)
    across, along, mixed = 1.4, -0.6, 0.5  # second derivatives of the height
    z = 0.5 * across * x * x + mixed * x * y + 0.5 * along * y * y
    slopes = np.stack([across * x + mixed * y, mixed * x + along * y], axis=-1)
    normals = np.concatenate([-slopes, np.ones((2, 2, 1))], axis=-1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    p, q = slopes[0, 0]
    bent = (1 + q * q) * across - 2 * p * q * mixed + (1 + p * p) * along
    expected = -bent / (2 * (1 + p * p + q * q) ** 1.5)
    found = curvatures(np.stack([x, y, z], axis=-1), normals)
    assert found[0] == pytest.approx(np.full((2, 2), expected), rel=2e-3)


@truth("std.masks.height_blend")
def test_the_higher_layer_shows_first() -> None:
    """Mishkinis 2013, as the mix of two numbers."""
    first, second, share, depth = np.abs(PLACES.T) * [[0.5], [0.5], [0.5], [0.1]] + [
        [0], [0], [0], [0.01]
    ]  # fmt: skip
    heights = np.stack([first + 1 - share, second + share])
    above = np.maximum(heights - heights.max(axis=0) + depth, 0)
    found = sampled(
        IMPORTS, "height_blend(p.x, p.y, p.z, p.w), 0, 0, 0",
        p=np.stack([first, second, share, depth], axis=-1),
    )  # fmt: skip
    assert found[:, 0] == near(above[1] / above.sum(axis=0))
