"""Lights of `std.area_lights`: rays that hit them or not, of which the mean is an integral."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from .kit import Floats, lanes, unit
from .many import directions, dots, numbers, singles, values
from .truth import truth

MODULE = "std.area_lights"
Hits = Callable[[Floats], Floats]
"""True for those directions from the surface in which a light lies."""


# --- integrals -----------------------------------------------------------------------------------


def axes_around(normal: Floats) -> Floats:
    """Three axes as rows, of which the last is the normal."""
    first = unit(np.cross(normal, (0.6, -0.64, 0.48)))
    return np.stack([first, np.cross(normal, first), normal])


def rays(normal: Floats, steps: int = 400) -> Floats:
    """Directions above a surface, all equally likely."""
    turn, height = ((each + 0.5) / steps for each in np.indices((steps, steps)).reshape(2, -1))
    flat = np.sqrt(1 - height**2)
    turn = 2 * np.pi * turn
    local = np.stack([flat * np.cos(turn), flat * np.sin(turn), height], axis=1)
    return np.asarray(local @ axes_around(normal))


def arriving(hits: Hits, normal: Floats) -> Floats:
    """The sum of the directions of what arrives, over pi; its part along the normal is the
    irradiance over pi.
    """
    arrows = rays(normal)
    return np.asarray(2 * (arrows * hits(arrows)[:, None]).mean(axis=0))


def panel_hits(is_round: bool, middle: Floats, across: Floats, above: Floats) -> Hits:
    """Those rays from the origin that hit a panel, from either side."""

    def hits(arrows: Floats) -> Floats:
        at = arrows @ np.linalg.inv(np.stack([across, above, middle]))
        x, y = at[:, 0] / at[:, 2], at[:, 1] / at[:, 2]
        inside = x * x + y * y < 1 if is_round else (np.abs(x) < 1) & (np.abs(y) < 1)
        return np.asarray(inside & (at[:, 2] > 0), np.float64)

    return hits


def mirrored(width: float, to_eye: Floats, steps: int = 300) -> tuple[Floats, Floats]:
    """Directions above z that facets of GGX mirror to the eye, with their weights if each facet
    mirrors all: seen facets after Dupuy and Benyoub, weighted by the masking of the light.
    """
    turn, share = ((each + 0.5) / steps for each in np.indices((steps, steps)).reshape(2, -1))
    scale = np.array((width, width, 1.0))
    stretched = unit(scale * to_eye)
    height = 1 - share * (1 + stretched[2])
    flat = np.sqrt(np.maximum(1 - height**2, 0))
    cap = np.stack(
        [flat * np.cos(2 * np.pi * turn), flat * np.sin(2 * np.pi * turn), height], axis=1
    )
    facets = (cap + stretched) * scale
    facets /= np.linalg.norm(facets, axis=1, keepdims=True)
    light = 2 * (facets @ to_eye)[:, None] * facets - to_eye

    def hidden(cosine: Any) -> Any:
        return (np.sqrt(1 + width**2 * (1 / cosine**2 - 1)) - 1) / 2

    up = np.maximum(light[:, 2], 1e-9)
    weights = (1 + hidden(to_eye[2])) / (1 + hidden(to_eye[2]) + hidden(up))
    return light, np.where(light[:, 2] > 0, weights, 0)


# --- polygons ------------------------------------------------------------------------------------


@truth(
    "std.area_lights.arc", "std.area_lights.angle_over_sine", "std.area_lights.sharp_over_sine"
)  # fmt: skip
def test_an_arc_turns_around_its_axis() -> None:
    first, last = directions(1), directions(2)
    axes = np.cross(first, last)
    angles = np.arccos(np.clip(dots(first, last), -1, 1)) / np.linalg.norm(axes, axis=1)
    lengths = numbers(0.5, 3, 3)[:, None]
    found = values(MODULE, "arc(a, b)", "vec3", a=singles(first * lengths), b=last)
    assert np.allclose(found, axes * angles[:, None], rtol=2e-6, atol=1e-6)
    assert not values(MODULE, "arc(a, 2 * a)", "vec3", a=[[0.0, 0.0, 3.0]]).any()


@truth("std.area_lights.angle_over_sine", "std.area_lights.sharp_over_sine")
def test_an_angle_over_its_sine() -> None:
    cosine = numbers(-0.999, 0.999, 6)
    found = values(MODULE, "angle_over_sine(c)", c=cosine)
    assert np.allclose(found, np.arccos(cosine) / np.sqrt(1 - cosine**2), rtol=2e-6)
    assert values(MODULE, "angle_over_sine(c)", c=[1.0, 0.0]) == pytest.approx(
        [1, np.pi / 2], rel=2e-6
    )


PANELS = {
    "above": ((0.3, -0.2, 0.9), (0.7, 0.1, 0.0), (-0.1, 0.6, 0.2)),
    "across the horizon": ((0.9, 0.3, 0.25), (0.1, -0.8, 0.5), (0.2, 0.4, 0.6)),
    "lower than the horizon": ((0.9, 0.3, -0.15), (0.1, -0.8, 0.5), (0.2, 0.4, 0.6)),
    "standing on the horizon": ((0.75, 0.25, 0.5), (0.0, 0.5, 0.0), (0.0, 0.0, 0.5)),
    "a corner below": ((0.6, 0.5, 0.7), (-0.4, -0.6, 0.5), (-0.6, 0.3, 0.4)),
}


def panel_of(is_round: bool, panel: tuple[tuple[float, ...], ...]) -> tuple[list[Floats], Hits]:
    """A panel whose corners go counter-clockwise, and the rays that hit it."""
    middle, across, above = map(np.array, panel)
    if np.cross(across, above) @ middle < 0:
        above = -above
    return [middle, across, above], panel_hits(is_round, middle, across, above)


def as_expression(arrows: list[Floats]) -> str:
    """A rectangle as the library makes it."""
    return f"Panel(false, {', '.join(f'vec3{lanes(each)}' for each in arrows)})"


@truth(
    "std.area_lights.panel_light", "std.area_lights.polygon_light", "std.area_lights.with_edge",
    "std.area_lights.Edges", "std.area_lights.Panel", "std.area_lights.on_panel",
    "std.area_lights.square", "std.area_lights.circle",
)  # fmt: skip
@pytest.mark.parametrize("is_round", [False, True])
def test_what_arrives_of_panels(is_round: bool) -> None:
    up = np.array((0.0, 0.0, 1.0))
    panels = [panel_of(is_round, each) for each in PANELS.values()]
    found = values(
        MODULE, f"panel_light(Panel({str(is_round).lower()}, m, a, b), vec3(0, 0, 1))", "vec3",
        **{name: [panel[0][i] for panel in panels] for i, name in enumerate("mab")},
    )  # fmt: skip
    wanted = np.array([arriving(hits, up) for _, hits in panels])
    assert (wanted[:, 2] > 0.02).all()
    assert np.allclose(found, wanted, atol=2e-3)


@truth("std.area_lights.panel_light", "std.area_lights.with_edge", "std.area_lights.polygon_light")
def test_nothing_arrives_from_below() -> None:
    panel, _ = panel_of(False, PANELS["above"])
    assert not values(
        MODULE, f"panel_light({as_expression(panel)}, up)", "vec3", up=[[0.0, 0.0, -1.0]]
    ).any()


@truth("std.area_lights.circle", "std.area_lights.polygon_light")
@pytest.mark.parametrize("height", [0.3, 1.0, 5.0])
def test_a_disc_straight_above(height: float) -> None:
    """The share of the half sphere is the square of the sine of its rim."""
    panel = f"Panel(true, vec3(0, 0, {height}), vec3(1, 0, 0), vec3(0, 1, 0))"
    found = values(MODULE, f"panel_light({panel}, up)", "vec3", up=[[0.0, 0.0, 1.0]])[0]
    assert found == pytest.approx((0, 0, 1 / (1 + height**2)), rel=1e-3, abs=1e-7)


@truth("std.area_lights.circle", "std.area_lights.square")
def test_rims() -> None:
    """Polygons of the area of a circle, and of a square of two by two, around the middle."""
    for name, count, area in (("circle", 16, np.pi), ("square", 4, 4.0)):
        x, y = values(MODULE, f"{name}[int(i)]", "vec2", i=np.arange(count)).T
        turned = x * np.roll(y, -1) - y * np.roll(x, -1)
        assert np.allclose(turned, turned[0], rtol=1e-5)
        assert turned.sum() / 2 == pytest.approx(area, rel=1e-6)
        assert np.allclose(np.hypot(x, y), np.hypot(x[0], y[0]), rtol=1e-6)
        assert (x.sum(), y.sum()) == pytest.approx((0, 0), abs=1e-6)


# --- highlights ----------------------------------------------------------------------------------

FITTED = np.array([
    [
        [0.02, -0.195, 0.005, 0.062],
        [-0.148, 7.049, 0.068, -1.437],
        [1.181, -8.845, -2.114, 9.429],
        [4.813, -0.417, 11.854, -11.722],
        [-4.899, 2.467, -8.3, 3.622],
    ],
    [
        [-0.051, -0.898, -0.02, 2.232],
        [-2.416, -35.457, 0.082, -3.099],
        [13.927, 103.955, -0.115, -5.987],
        [-18.367, -90.126, -1.715, 12.26],
        [6.641, 20.392, 0.251, -5.362],
    ],
    [
        [0.706, 5.983, 2.1, -0.487],
        [-2.923, 19.874, -0.451, 9.41],
        [-5.635, -73.093, 0.018, -9.414],
        [6.668, 25.859, -5.843, -10.137],
        [0.786, 24.002, 6.296, 10.657],
    ],
    [
        [-0.692, -4.976, -0.07, 0.25],
        [5.713, 7.917, -0.074, -6.323],
        [-10.185, -15.742, 4.734, 15.351],
        [7.758, 51.157, -9.88, -11.841],
        [-2.9, -39.936, 4.288, 2.543],
    ],
])  # fmt: skip
"""What `fit_area_lights.py` finds, by the powers of the cosine and of the roughness."""


def transform(nv: float, roughness: float) -> Floats:
    """The transform, by the polynomial."""
    powers = np.outer(nv ** np.arange(4), roughness ** np.arange(5))
    a, b, c, d = np.tensordot(powers, FITTED, axes=2) * roughness**2
    sine = np.sqrt(1 - nv * nv)
    return np.array([[nv * nv + a, 0, sine * (nv + b)], [0, 1, 0], [-sine * d, 0, c]])


SEEN = [(0.95, 0.3), (0.8, 0.9), (0.6, 0.2), (0.3, 0.5), (1.0, 0.7)]


@truth("std.area_lights.highlight_transform", "std.area_lights.highlight_parts")
@pytest.mark.parametrize(("nv", "roughness"), SEEN)
def test_the_transform_is_the_one_that_was_found(nv: float, roughness: float) -> None:
    nv, roughness = singles((nv, roughness))
    found = [
        values(MODULE, f"highlight_transform(nv, r)[{i}]", "vec3", nv=nv, r=roughness)[0]
        for i in range(3)
    ]
    assert pytest.approx(transform(nv, roughness), rel=1e-5, abs=1e-6) == np.array(found).T


@truth("std.area_lights.highlight_transform", "std.area_lights.highlight_parts")
@pytest.mark.parametrize(
    ("nv", "roughness", "elsewhere"),
    [(0.95, 0.1, 0.02), (0.95, 0.5, 0.03), (0.8, 0.9, 0.05), (0.6, 0.3, 0.07), (0.6, 0.6, 0.12),
     (0.2, 0.2, 0.13), (0.2, 0.6, 0.31), (0.05, 0.4, 0.4)],
)  # fmt: skip
def test_the_transformed_cosine_is_a_highlight(
    nv: float, roughness: float, elsewhere: float
) -> None:
    """The share of a highlight of GGX that lies elsewhere is as small as the library says."""
    width = roughness**2
    eye = np.array((np.sqrt(1 - nv * nv), 0.0, nv))
    light, weights = mirrored(width, eye, 200)
    half = unit_rows(light + eye)
    facets = width**2 / (np.pi * (half[:, 2] ** 2 * (width**2 - 1) + 1) ** 2)
    seen = 2 * nv / (nv + np.sqrt(nv**2 + width**2 * (1 - nv**2)))
    density = facets * seen / (4 * nv)
    turn = transform(nv, roughness)
    turned = light @ turn.T
    lengths = np.linalg.norm(turned, axis=1)
    cosine = np.maximum(turned[:, 2], 0) / lengths**4 / np.pi * np.linalg.det(turn)
    both = np.minimum(weights / weights.mean(), cosine / density).mean()
    assert 1 - both < elsewhere


def unit_rows(arrows: Floats) -> Floats:
    return np.asarray(arrows / np.linalg.norm(arrows, axis=1, keepdims=True))


@truth("std.area_lights.axes_to_eye")
def test_axes_towards_the_eye() -> None:
    normal, eye = directions(4), directions(5)
    rows = np.stack(
        [values(MODULE, f"axes_to_eye(n, e)[{i}]", "vec3", n=normal, e=eye) for i in range(3)],
        axis=-1,
    )
    assert np.allclose(rows @ rows.transpose(0, 2, 1), np.eye(3), atol=1e-5)
    assert np.allclose(np.linalg.det(rows), 1, atol=1e-5)
    assert np.allclose(rows[:, 2], normal, atol=1e-5)
    seen = np.einsum("nij,nj->ni", rows, eye)
    assert (seen[:, 0] > 0).all()
    assert np.allclose(seen[:, 1], 0, atol=1e-5)


@truth("std.area_lights.axes_to_eye")
def test_axes_of_an_eye_straight_above() -> None:
    normal = unit((0.3, 0.8, 0.5))
    rows = np.stack(
        [values(MODULE, f"axes_to_eye(n, n)[{i}]", "vec3", n=[normal])[0] for i in range(3)],
        axis=-1,
    )
    assert rows @ rows.T == pytest.approx(np.eye(3), abs=1e-5)
    assert rows[2] == pytest.approx(normal)


LIT = [
    ("above", 0.9, 0.5, 0.01), ("above", 0.6, 0.4, 0.05), ("across the horizon", 0.8, 0.9, 0.01),
    ("above", 0.4, 0.7, 0.04),
]  # fmt: skip


@truth("std.area_lights.mirrored_panel")
@pytest.mark.parametrize(("name", "nv", "roughness", "error"), LIT)
def test_a_panel_is_mirrored(name: str, nv: float, roughness: float, error: float) -> None:
    """Nearly as facets of GGX do."""
    panel, hits = panel_of(False, PANELS[name])
    turn = np.pi - 0.6  # so that the panel's mirrored image is in sight
    eye = np.array((np.sqrt(1 - nv**2) * np.cos(turn), np.sqrt(1 - nv**2) * np.sin(turn), nv))
    light, weights = mirrored(roughness**2, eye)
    wanted = (hits(light) * weights).sum() / weights.sum()
    call = f"mirrored_panel({as_expression(panel)}, vec3(0, 0, 1), e, {roughness})"
    found = values(MODULE, call, e=[eye])[0]
    assert 0.05 < wanted < 0.95
    assert found == pytest.approx(wanted, abs=error)
