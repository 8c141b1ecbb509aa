"""Cascades: the sun's views of slices of what a camera sees, against NumPy."""

from __future__ import annotations

import math

import numpy as np
import pytest

from .kit import Floats, close, columns, lanes, matrix, moved, of, shown, unit, written
from .truth import truth

SUN = np.array([0.36, -0.8, 0.48])
"""The direction in which the light travels."""


@truth(
    "std.shadows.cascade",
    "std.shadows.corner",
    "std.shadows.how_far",
    "std.shadows.slice_end",
    "std.shadows.seen_by_sun",
)
@pytest.mark.parametrize("number", [0, 1, 2])
def test_a_cascade_contains_its_slice_of_the_view_and_what_shades_it(number: int) -> None:
    camera = "perspective(60deg, 2, 0.5, 4.5) * look_at({eye}, {target}, {up})".format(
        eye="(vec3(0, 0, 5) as point<world>)", target="(vec3(0) as point<world>)",
        up="(vec3(0, 1, 0) as vector<world>)",
    )  # fmt: skip
    sun = "(vec3(0.36, -0.8, 0.48) as direction<world>)"
    cascade = matrix(f"cascade({camera}, {sun}, {number}, 3, 7)")

    # Half way between equal depths, and equal ratios, 9 ^ (i / 3).
    ends = [0.5 * (0.5 + 4 * i / 3 + 0.5 * 9 ** (i / 3)) for i in (number, number + 1)]
    steep = math.tan(math.radians(30))
    corners = np.array([
        (x * 2 * steep * d, y * steep * d, 5 - d) for d in ends for x in (-1, 1) for y in (-1, 1)
    ])  # fmt: skip
    # A ball around the corners, seen from behind everything that shades it.
    middle = corners.mean(axis=0)
    radius = np.linalg.norm(corners - middle, axis=1).max()
    for place in (*corners, *(corners - 7 * SUN)):
        x, y, depth = moved(cascade, place)
        along = float((place - middle) @ SUN)
        beside = np.linalg.norm(place - middle - along * SUN)
        assert math.hypot(x, y) == pytest.approx(beside / radius)
        assert depth == pytest.approx((along + radius + 7) / (2 * radius + 7))
        assert depth > -1e-9
    assert np.linalg.det(cascade[:3, :3]) < 0  # Depths grow away from the sun: not mirrored.


@truth("std.shadows.slice_end", "std.shadows.how_far", "std.shadows.cascade")
def test_slices_of_a_view_without_a_perspective_are_equally_deep() -> None:
    camera = "orthographic(4, 2, 1, 10) * look_at({eye}, {target}, {up})".format(
        eye="(vec3(0, 0, 5) as point<world>)", target="(vec3(0) as point<world>)",
        up="(vec3(0, 1, 0) as vector<world>)",
    )  # fmt: skip
    cascade = matrix(f"cascade({camera}, (vec3(0, -1, 0) as direction<world>), 1, 3, 2)")
    # The second third of the way from 4 to -5, around (0, 0, -0.5), 4 by 2 by 3 large.
    radius = math.sqrt(2**2 + 1**2 + 1.5**2)
    assert moved(cascade, (0.0, radius + 2, -0.5)) == close((0, 0, 0))
    assert moved(cascade, (0.0, -radius, -0.5)) == close((0, 0, 1))
    assert abs(moved(cascade, (radius, 0.0, -0.5))[0]) == pytest.approx(1)


@truth("std.shadows.seen_by_sun")
@pytest.mark.parametrize(
    ("direction", "up"),
    [
        ((0.36, -0.8, 0.48), (0, 1, 0)),
        ((-0.6, 0.0, 0.8), (0, 1, 0)),
        ((0.0, -1.0, 0.0), (0, 0, 1)),  # Straight down: there is another way up.
        ((0.1, 0.95, 0.2), (0, 0, 1)),
        ((0.5, -0.88, 0.1), (0, 1, 0)),
        ((math.sqrt(0.19), 0.9, 0.0), (0, 1, 0)),
    ],
)
def test_the_sun_sees_a_ball(direction: tuple[float, ...], up: tuple[float, ...]) -> None:
    sun, middle, radius, reach = unit(direction), np.array((0.5, -2.0, 1.0)), 3.0, 4.0
    camera = matrix(
        f"seen_by_sun({written(sun, 'direction<world>')}, {written(middle)}, {radius}, {reach})",
        "import std.shadows.{seen_by_sun}",
    )
    assert moved(camera, middle - radius * sun - reach * sun) == close((0, 0, 0))
    assert moved(camera, middle + radius * sun) == close((0, 0, 1))
    above = unit(np.array(up) - (np.array(up) @ sun) * sun)
    right = np.cross(sun, above)
    assert moved(camera, middle + radius * above)[:2] == close((0, 1))
    assert moved(camera, middle + radius * right)[:2] == close((1, 0))


def lens(left: float, right: float, low: float, high: float) -> Floats:
    """A camera at the origin that looks along -z, from depth 1 to 4, through a part of the plane at
    depth 1 that need not be in the middle: Vulkan's depths, and y upwards."""
    x, y = 2 / (right - left), 2 / (high - low)
    return np.array([
        [x, 0, x * (left + right) / 2, 0], [0, y, y * (low + high) / 2, 0],
        [0, 0, -4 / 3, -4 / 3], [0, 0, -1, 0],
    ])  # fmt: skip


def slice_corners(camera: Floats, number: int, count: int) -> Floats:
    """The corners of a slice of what this camera sees: left and right, top and bottom, near and far
    take turns in this order."""
    back = np.linalg.inv(camera)
    found = []
    for end in (number, number + 1):
        share = 0.5 * end / count + 0.5 * (4 ** (end / count) - 1) / (4 - 1)
        for y, x in ((1, -1), (1, 1), (-1, -1), (-1, 1)):
            near, far = (place[:3] / place[3] for place in (back @ (x, y, z, 1) for z in (0, 1)))
            found.append(near + share * (far - near))
    return np.array(found)


LENSES = [lens(x - 1, x + 1, y - 0.5, y + 0.5) for x in (-2, 2) for y in (-1, 1)]
"""Cameras that see more to one side: in each another corner is the farthest one."""


@truth("std.shadows.corner", "std.shadows.slice_end", "std.shadows.how_far")
@pytest.mark.parametrize("corner", range(8))
def test_corners_of_a_slice(corner: int) -> None:
    found = shown(
        "import std.shadows.{corner}\nmaterial M { param camera : transform<world, clip>\n"
        f"color = vec3(corner(camera, {corner}, 1, 3)) }}", camera=columns(LENSES[1]),
    )  # fmt: skip
    assert found == close(slice_corners(LENSES[1], 1, 3)[corner])


@truth("std.shadows.cascade", "std.shadows.seen_by_sun")
@pytest.mark.parametrize("camera", LENSES)
def test_a_cascade_is_as_large_as_its_farthest_corner_says(camera: Floats) -> None:
    sun, reach = unit((0.6, -0.3, 0.5)), 5.0
    corners = slice_corners(camera, 1, 3)
    middle = corners.mean(axis=0)
    radius = np.linalg.norm(corners - middle, axis=1).max()
    for place, depth in ((middle - (radius + reach) * sun, 0), (middle + radius * sun, 1)):
        found = shown(
            "import std.shadows.{cascade}\nmaterial M { param camera : transform<world, clip>\n"
            "param sun : direction<world>  param at : point<world>\n"
            f"color = vec3((cascade(camera, sun, 1, 3, {reach}) * vec4(at, 1)).xyz) }}",
            camera=columns(camera), sun=lanes(sun), at=lanes(place),
        )  # fmt: skip
        assert found == close((0, 0, depth))


@truth("std.shadows.slice_end")
@pytest.mark.parametrize(
    ("ratio", "is_even"),
    [
        (0.25, False),
        (0.99899, False),
        (0.99901, True),
        (1.00099, True),
        (1.00101, False),
        (9, False),
    ],
)
def test_slices_end_half_way_between_two_ways_to_divide(ratio: float, is_even: bool) -> None:
    """Where there is almost no perspective, both are the same."""
    even = 2 / 5
    wanted = 0.5 * even + 0.5 * (even if is_even else (ratio**even - 1) / (ratio - 1))
    found = of(f"slice_end({ratio}, 2, 5)", "M", "import std.shadows.{slice_end}")
    assert found == close([wanted] * 3)
