"""Conversions of colours, against standards, published tables, and Python's own ``colorsys``."""

from __future__ import annotations

import colorsys
from collections.abc import Callable, Mapping

import numpy as np
import pytest

from .functions import spread, values
from .kit import Floats, close
from .truth import truth

Triple = tuple[float, float, float]

# --- displays ------------------------------------------------------------------------------------

ENCODED = np.array([-0.2, 0.0, 0.01, 0.036, 0.04045, 0.0405, 0.0449, 0.2, 0.5, 0.8, 1.0, 1.3])


def linear_of(encoded: Floats) -> Floats:
    """IEC 61966-2-1, on both sides of 0.04045."""
    curve = ((np.maximum(encoded, 0) + 0.055) / 1.055) ** 2.4
    return np.where(encoded <= 0.04045, encoded / 12.92, curve)


def in_threes(numbers: Floats) -> Floats:
    """Vectors whose lanes are these numbers and their next ones."""
    return np.stack([numbers, np.roll(numbers, 1), np.roll(numbers, 2)], axis=1)


@truth("std.color.srgb_to_linear")
def test_linear_light_of_encoded_numbers() -> None:
    rows = in_threes(ENCODED)
    assert values("color", "srgb_to_linear(c)", c=rows) == close(linear_of(rows))


@truth("std.color.linear_to_srgb")
def test_encoded_numbers_of_linear_light() -> None:
    """The limit of the standard is rounded, so a number next to it differs by a little."""
    rows = in_threes(ENCODED)
    found = values("color", "linear_to_srgb(c)", c=linear_of(rows))
    assert found == pytest.approx(rows, abs=1e-6)
    limit = values("color", "linear_to_srgb(c)", c=np.full((1, 3), 0.0031308))
    assert limit == close(np.full((1, 3), 12.92 * 0.0031308))


# --- primaries -----------------------------------------------------------------------------------

D65, D60 = (0.3127, 0.3290), (0.32168, 0.33767)
REC709 = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
REC2020 = ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046))
DISPLAY_P3 = ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060))
AP1 = ((0.713, 0.293), (0.165, 0.830), (0.128, 0.044))
BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)


def xyz(place: tuple[float, float]) -> Floats:
    """XYZ of a chromaticity, with Y = 1."""
    x, y = place
    return np.array([x / y, 1.0, (1 - x - y) / y])


def to_xyz(primaries: tuple[tuple[float, float], ...], white: tuple[float, float]) -> Floats:
    """SMPTE RP 177: primaries in such amounts that they make white."""
    columns = np.stack([xyz(place) for place in primaries], axis=1)
    return np.asarray(columns * np.linalg.solve(columns, xyz(white)))


def adapted(white: tuple[float, float], to: tuple[float, float]) -> Floats:
    """XYZ under one white as it is under another one, after Bradford."""
    gain = (BRADFORD @ xyz(to)) / (BRADFORD @ xyz(white))
    return np.asarray(np.linalg.inv(BRADFORD) @ np.diag(gain) @ BRADFORD)


OF_RGB = {
    "xyz": to_xyz(REC709, D65),
    "rec2020": np.linalg.solve(to_xyz(REC2020, D65), to_xyz(REC709, D65)),
    "display_p3": np.linalg.solve(to_xyz(DISPLAY_P3, D65), to_xyz(REC709, D65)),
    "acescg": np.linalg.solve(to_xyz(AP1, D60), adapted(D65, D60) @ to_xyz(REC709, D65)),
}
"""What makes other coordinates of linear light."""


@truth(
    "std.color.rgb_to_xyz", "std.color.xyz_of_rgb", "std.color.rgb_to_rec2020",
    "std.color.rec2020_of_rgb", "std.color.rgb_to_display_p3", "std.color.display_p3_of_rgb",
    "std.color.rgb_to_acescg", "std.color.acescg_of_rgb",
)  # fmt: skip
@pytest.mark.parametrize("name", OF_RGB)
def test_coordinates_follow_from_primaries(name: str) -> None:
    found = values("color", f"rgb_to_{name}(c)", c=np.eye(3)).T
    assert found == pytest.approx(OF_RGB[name], abs=2e-10)


@truth(
    "std.color.xyz_to_rgb", "std.color.rec2020_to_rgb", "std.color.display_p3_to_rgb",
    "std.color.acescg_to_rgb",
)  # fmt: skip
@pytest.mark.parametrize("name", OF_RGB)
def test_linear_light_follows_from_primaries(name: str) -> None:
    found = values("color", f"{name}_to_rgb(c)", c=np.eye(3)).T
    assert found == pytest.approx(np.linalg.inv(OF_RGB[name]), abs=1e-8)


# --- OKLab ---------------------------------------------------------------------------------------

OKLAB = {
    (1.0, 1.0, 1.0): (1.0, 0.0, 0.0),
    (1.0, 0.0, 0.0): (0.62796, 0.22486, 0.12585),
    (0.0, 1.0, 0.0): (0.86644, -0.23389, 0.17950),
    (0.0, 0.0, 1.0): (0.45201, -0.03246, -0.31153),
    (0.0, 0.0, 0.0): (0.0, 0.0, 0.0),
}
"""Of sRGB's primaries, as CSS Color 4 and other programs print them."""
OTTOSSON = {
    (0.950, 1.0, 1.089): (1.0, 0.0, 0.0),
    (1.0, 0.0, 0.0): (0.450, 1.236, -0.019),
    (0.0, 1.0, 0.0): (0.922, -0.671, 0.263),
    (0.0, 0.0, 1.0): (0.153, -1.415, -0.449),
}
"""Of XYZ: the table of Ottosson's page. Some roots are those of negative numbers."""


def columns_of(table: Mapping[Triple, Triple]) -> tuple[Floats, Floats]:
    return np.array(list(table)), np.array(list(table.values()))


@truth(
    "std.color.rgb_to_oklab", "std.color.cones_of_rgb", "std.color.oklab_of_cones",
    "std.color.cube_root",
)  # fmt: skip
def test_oklab_of_primaries() -> None:
    colors, labs = columns_of(OKLAB)
    assert values("color", "rgb_to_oklab(c)", c=colors) == pytest.approx(labs, abs=1e-5)


@truth("std.color.rgb_to_oklab", "std.color.cube_root")
def test_oklab_of_what_no_display_shows() -> None:
    places, labs = columns_of(OTTOSSON)
    found = values("color", "rgb_to_oklab(xyz_to_rgb(c))", c=places)
    assert found == pytest.approx(labs, abs=1e-3)


@truth("std.color.oklab_to_rgb")
def test_linear_light_of_oklab() -> None:
    colors, labs = columns_of(OKLAB)
    assert values("color", "oklab_to_rgb(c)", c=labs) == pytest.approx(colors, abs=1e-4)


def polar(labs: Floats) -> Floats:
    return np.stack(
        [labs[:, 0], np.hypot(labs[:, 1], labs[:, 2]), np.arctan2(labs[:, 2], labs[:, 1])], axis=1
    )


@truth("std.color.rgb_to_oklch")
def test_oklch_of_primaries() -> None:
    """CSS Color 4 prints red as `oklch(0.62796 0.25768 29.234deg)`."""
    colors, labs = columns_of({c: lab for c, lab in OKLAB.items() if lab[1]})
    found = values("color", "rgb_to_oklch(c)", c=colors)
    assert found == pytest.approx(polar(labs), abs=5e-5)
    assert found[0] == pytest.approx([0.62796, 0.25768, np.radians(29.234)], abs=1e-5)


@truth("std.color.oklch_to_rgb")
def test_linear_light_of_oklch() -> None:
    colors, labs = columns_of(OKLAB)
    found = values("color", "oklch_to_rgb(c)", c=polar(labs) + np.array([0, 0, 2 * np.pi]))
    assert found == pytest.approx(colors, abs=1e-4)


@truth("std.color.color_difference")
def test_a_difference_is_the_distance_in_oklab() -> None:
    colors, labs = columns_of(OKLAB)
    others = np.roll(colors, 1, axis=0)
    wanted = np.linalg.norm(labs - np.roll(labs, 1, axis=0), axis=1)
    found = values("color", "color_difference(a, b)", a=colors, b=others)
    assert found[:, 0] == pytest.approx(wanted, abs=2e-5)


# --- CIE L*a*b* ----------------------------------------------------------------------------------

LAB = {
    (1.0, 0.0, 0.0): (53.24, 80.09, 67.20),
    (0.0, 1.0, 0.0): (87.73, -86.18, 83.18),
    (0.0, 0.0, 1.0): (32.30, 79.19, -107.86),
    (1.0, 1.0, 1.0): (100.0, 0.0, 0.0),
}
"""Of sRGB's primaries, as programs print them."""
DARK = np.array([[0.001, 0.004, 0.0], [0.02, 0.003, 0.008], [-0.01, 0.2, 0.6], [0, 0, 0]])


def lab_of(color: Floats) -> Floats:
    """CIE 15, with its two sides of (6 / 29)³."""
    t = OF_RGB["xyz"] @ color / xyz(D65)
    x, y, z = np.where(t > (6 / 29) ** 3, np.cbrt(t), t * (29 / 6) ** 2 / 3 + 4 / 29)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


@truth("std.color.rgb_to_lab", "std.color.lab_root")
def test_lab_of_colors() -> None:
    colors, labs = columns_of(LAB)
    assert values("color", "rgb_to_lab(c)", c=colors) == pytest.approx(labs, abs=0.05)
    colors = np.concatenate([colors, DARK, spread(4)])
    wanted = np.array([lab_of(color) for color in colors])
    assert values("color", "rgb_to_lab(c)", c=colors) == pytest.approx(wanted, abs=1e-6)


@truth("std.color.lab_to_rgb")
def test_linear_light_of_lab() -> None:
    colors = np.concatenate([list(LAB), DARK, spread(4)])
    labs = np.array([lab_of(color) for color in colors])
    assert values("color", "lab_to_rgb(c)", c=labs) == pytest.approx(colors, abs=1e-8)
    near_the_limit = np.array([7.6, 8.36])
    labs = np.stack([near_the_limit, 0 * near_the_limit, 0 * near_the_limit], axis=1)
    grey = np.where(near_the_limit > 8, ((near_the_limit + 16) / 116) ** 3, labs[:, 0] * 27 / 24389)
    assert values("color", "lab_to_rgb(c)", c=labs)[:, 0] == pytest.approx(grey, abs=1e-8)


@truth("std.color.lab_root")
def test_roots_of_lab_meet() -> None:
    t = np.array([[0.008, 0.009, -0.1], [0, 1, 8]])
    wanted = np.where(t > (6 / 29) ** 3, np.cbrt(t), t * (29 / 6) ** 2 / 3 + 4 / 29)
    assert values("color", "lab_root(c)", c=t) == close(wanted)


# --- hue, saturation, and value or lightness -----------------------------------------------------

COLORS = np.concatenate(
    [spread(12), np.eye(3), 0.7 - 0.5 * np.eye(3), [[0, 0, 0], [1, 1, 1], [0.4, 0.4, 0.4]]]
)
"""Each sextant, primaries, their complements, and greys."""


def each(function: Callable[..., tuple[float, float, float]], rows: Floats) -> Floats:
    return np.array([function(*map(float, row)) for row in rows])


def hsl_of(r: float, g: float, b: float) -> tuple[float, float, float]:
    hue, lightness, saturation = colorsys.rgb_to_hls(r, g, b)
    return hue, saturation, lightness


@truth("std.color.rgb_to_hsv", "std.color.rgb_to_hue")
def test_hsv_is_that_of_python() -> None:
    found = values("color", "rgb_to_hsv(c)", c=COLORS)
    assert found == close(each(colorsys.rgb_to_hsv, COLORS))


@truth("std.color.rgb_to_hsv")
def test_less_than_no_light_has_the_hue_of_none() -> None:
    found = values("color", "rgb_to_hsv(c)", c=[[-0.5, 0.2, 0.1], [-1, -2, -3]])
    assert found == close([colorsys.rgb_to_hsv(0, 0.2, 0.1), (0, 0, 0)])


@truth("std.color.rgb_to_hsl", "std.color.rgb_to_hue")
def test_hsl_is_that_of_python() -> None:
    found = values("color", "rgb_to_hsl(c)", c=COLORS)
    assert found == close(each(hsl_of, COLORS))


@truth("std.color.hsv_to_rgb", "std.color.hue_to_rgb")
def test_linear_light_of_hsv() -> None:
    """Hues go on in circles."""
    rows = np.concatenate([spread(12), [[1, 1, 1], [0, 1, 1], [0.5, 0, 0.3]]])
    found = values("color", "hsv_to_rgb(c)", c=rows + np.array([2, 0, 0]))
    assert found == close(each(colorsys.hsv_to_rgb, rows))


@truth("std.color.hsl_to_rgb", "std.color.hue_to_rgb")
def test_linear_light_of_hsl() -> None:
    rows = np.concatenate([spread(12), [[1, 1, 0.5], [0.3, 1, 0], [0.3, 1, 1], [0.5, 0, 0.3]]])
    found = values("color", "hsl_to_rgb(c)", c=rows - np.array([3, 0, 0]))
    assert found == close([colorsys.hls_to_rgb(h, v, s) for h, s, v in rows.tolist()])


@truth("std.color.hue_to_rgb")
def test_pure_hues() -> None:
    hues = np.linspace(-1.2, 1.3, 11)
    wanted = [colorsys.hsv_to_rgb(hue % 1, 1, 1) for hue in hues.tolist()]
    assert values("color", "hue_to_rgb(t)", t=hues) == close(wanted)


@truth("std.color.rgb_to_hue")
def test_a_hue_of_a_color() -> None:
    wanted = each(colorsys.rgb_to_hsv, COLORS)[:, 0]
    assert values("color", "rgb_to_hue(c)", c=COLORS)[:, 0] == close(wanted)
