"""Light and adjustments of colours, against standards and the tables of other programs."""

from __future__ import annotations

import colorsys

import numpy as np
import pytest

from .functions import spread, values
from .kit import Floats, close
from .test_color_spaces import BRADFORD, D65, OF_RGB, xyz
from .truth import truth

BT709 = np.array([0.2126, 0.7152, 0.0722])
COLORS = np.concatenate([spread(6, -0.2, 1.4), np.eye(3)])
LESS_THAN_NOTHING = -spread(9)
"""Light that other primaries have; what is linear in light is so of this, too."""


@truth("std.color.luminance")
def test_luminance_has_the_weights_of_rec709() -> None:
    colors = np.concatenate([COLORS, LESS_THAN_NOTHING])
    found = values("color", "luminance(c)", c=colors)
    assert found[:, 0] == close(colors @ BT709)


@truth("std.color.contrast_ratio")
def test_a_contrast_ratio_of_wcag() -> None:
    """It is 21 of black and white, whichever is which."""
    a = np.concatenate([spread(5), [[0, 0, 0], [1, 1, 1]]])
    b = np.concatenate([spread(5)[::-1], [[1, 1, 1], [0, 0, 0]]])
    low, high = np.sort(np.stack([a @ BT709, b @ BT709]), axis=0)
    found = values("color", "contrast_ratio(a, b)", a=a, b=b)[:, 0]
    assert found == close((high + 0.05) / (low + 0.05))
    assert found[-2:] == close([21, 21])


# --- temperature ---------------------------------------------------------------------------------

LOCUS = {
    2000: (0.5267, 0.4133),
    2500: (0.4770, 0.4137),
    2856: (0.4476, 0.4074),
    4000: (0.3805, 0.3768),
    5000: (0.3451, 0.3516),
    6500: (0.3135, 0.3237),
    10000: (0.2807, 0.2884),
    25000: (0.2525, 0.2523),
}
"""Chromaticities of blackbodies as tables of CIE 1931 print them; 2856 K is illuminant A."""


def of_spline(kelvin: float) -> Floats:
    """The two splines of Kim and others, as MaterialX has them in its node `blackbody`."""
    t = 1000 / min(max(kelvin, 1667.0), 25000.0)
    warm, middle = t > 0.25, t > 1000 / 2222
    x = np.polyval(
        [-0.2661239, -0.2343580, 0.8776956, 0.179910]
        if warm
        else [-3.0258469, 2.1070379, 0.2226347, 0.240390],
        t,
    )
    y = np.polyval(
        [-1.1063814, -1.34811020, 2.18555832, -0.20219683]
        if middle
        else [-0.9549476, -1.37418593, 2.09137015, -0.16748867]
        if warm
        else [3.0817580, -5.87338670, 3.75112997, -0.37001483],
        x,
    )
    return xyz((float(x), float(y)))


KELVINS = np.array(
    [900.0, 1667, 1700, 2000, 2221, 2222, 2223, 3000, 3999, 4000, 4001, 6500, 15000, 25000, 4e4]
)


@truth("std.color.blackbody_xyz")
def test_what_glows_lies_on_the_locus() -> None:
    found = values("color", "blackbody_xyz(t)", t=list(LOCUS))
    places = found[:, :2] / found.sum(axis=1, keepdims=True)
    assert places == pytest.approx(np.array(list(LOCUS.values())), abs=1e-3)


@truth("std.color.blackbody_xyz", "std.color.cubic")
def test_the_locus_is_that_of_the_splines() -> None:
    wanted = [of_spline(kelvin) for kelvin in KELVINS.tolist()]
    assert values("color", "blackbody_xyz(t)", t=KELVINS) == close(wanted)


@truth("std.color.cubic")
def test_a_cubic_polynomial() -> None:
    found = values("color", "cubic(a, t)", a=[[2, -3, 5, -7]] * 3, t=[-1.5, 0, 2])
    assert found[:, 0] == close(np.polyval([2, -3, 5, -7], [-1.5, 0, 2]))


@truth("std.color.blackbody")
def test_light_of_what_glows() -> None:
    wanted = [
        np.maximum(np.linalg.solve(OF_RGB["xyz"], of_spline(kelvin)), 0)
        for kelvin in KELVINS.tolist()
    ]
    found = values("color", "blackbody(t)", t=KELVINS)
    assert found == pytest.approx(np.array(wanted), abs=1e-8)
    assert (found[:3, 2] == 0).all(), "a candle has less blue than Rec. 709 can show"


@truth("std.color.white_balance", "std.color.bradford_of_xyz")
def test_white_balance_makes_lamps_white() -> None:
    """By von Kries's rule in Bradford's receptors."""
    receptors, white = BRADFORD @ OF_RGB["xyz"], BRADFORD @ xyz(D65)
    kelvins = np.array([1900.0, 2700, 5500, 9000])
    colors = spread(4)
    wanted = [
        np.linalg.solve(receptors, receptors @ color / (BRADFORD @ of_spline(kelvin)) * white)
        for color, kelvin in zip(colors, kelvins.tolist(), strict=True)
    ]
    found = values("color", "white_balance(c, t)", c=colors, t=kelvins)
    assert found == pytest.approx(np.array(wanted), abs=1e-8)
    lamp = np.linalg.solve(OF_RGB["xyz"], of_spline(2700.0))
    neutral = values("color", "white_balance(c, t)", c=[lamp], t=[2700])
    assert neutral == pytest.approx(np.ones((1, 3)), abs=1e-8)


# --- adjustments ---------------------------------------------------------------------------------


@truth("std.color.exposure")
def test_each_stop_doubles() -> None:
    found = values("color", "exposure(c, t)", c=[[0.1, 0.2, 0.4]] * 3, t=[3, 0, -1])
    assert found == close([[0.8, 1.6, 3.2], [0.1, 0.2, 0.4], [0.05, 0.1, 0.2]])


@truth("std.color.contrast")
def test_contrast_is_around_a_pivot() -> None:
    amounts, pivots = np.array([0, 0.5, 1, 2, 3.0]), np.array([0.5, 0.4, 0.3, 0.2, 0.7])
    colors = spread(5)
    found = values("color", "contrast(c, t, x)", c=colors, t=amounts, x=pivots)
    wanted = pivots + amounts * (colors.T - pivots)
    assert found == close(wanted.T)
    around_grey = values("color", "contrast(c, t)", c=colors, t=amounts)
    assert around_grey == close((0.18 + amounts * (colors.T - 0.18)).T)


@truth("std.color.saturation")
def test_saturation_keeps_luminance() -> None:
    amounts = np.array([0, 0.3, 1, 1.7, 0, 0.3, 1, 1.7, 2])
    found = values("color", "saturation(c, t)", c=COLORS, t=amounts)
    grey = COLORS @ BT709
    assert found == close((grey + amounts * (COLORS.T - grey)).T)
    assert found @ BT709 == close(grey)


@truth("std.color.grayscale")
def test_grey_has_the_same_luminance() -> None:
    assert values("color", "grayscale(c)", c=COLORS) == close(np.outer(COLORS @ BT709, np.ones(3)))


@truth("std.color.vibrance")
def test_vibrance_spares_what_is_colorful() -> None:
    """As three.js writes it."""
    amounts = np.array([0, 0.3, 1, -0.7, 0.5, 0.9, 0.2, -0.1, 0.6])
    most, mean = COLORS.max(axis=1), COLORS.mean(axis=1)
    share = ((most - mean) * amounts * -3)[:, None]
    wanted = COLORS * (1 - share) + most[:, None] * share
    assert values("color", "vibrance(c, t)", c=COLORS, t=amounts) == close(wanted)


@truth("std.color.cdl")
def test_a_color_decision_list() -> None:
    slope, offset = spread(9, 0.5, 1.5), spread(9, -0.3, 0.2)[::-1]
    power, amounts = spread(9, 0.6, 1.8) ** 2, np.linspace(0, 1.6, 9)
    graded = np.maximum(COLORS * slope + offset, 0) ** power
    grey = (graded @ BT709)[:, None]
    found = values(
        "color", "cdl(c, a, b, d, t)", c=COLORS, a=slope, b=offset, d=power, t=amounts
    )  # fmt: skip
    assert found == close(grey + amounts[:, None] * (graded - grey))


@truth("std.color.hsv_adjust")
def test_adjusted_hue_saturation_and_value() -> None:
    colors, amounts = spread(6), spread(6, 0.2, 1.0)[::-1]
    wanted = []
    for color, (turn, factor, light) in zip(colors.tolist(), amounts.tolist(), strict=True):
        hue, saturation, value = colorsys.rgb_to_hsv(*color)
        adjusted = colorsys.hsv_to_rgb((hue + turn) % 1, saturation * factor, value * light)
        wanted.append(adjusted)
    assert values("color", "hsv_adjust(c, a)", c=colors, a=amounts) == close(wanted)


def turned(degrees: float) -> Floats:
    """The matrix of `hueRotate` (Filter Effects, 9.6)."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array(
        [
            [0.213 + c * 0.787 - s * 0.213, 0.715 - c * 0.715 - s * 0.715,
             0.072 - c * 0.072 + s * 0.928],
            [0.213 - c * 0.213 + s * 0.143, 0.715 + c * 0.285 + s * 0.140,
             0.072 - c * 0.072 - s * 0.283],
            [0.213 - c * 0.213 - s * 0.787, 0.715 - c * 0.715 + s * 0.715,
             0.072 + c * 0.928 + s * 0.072],
        ]
    )  # fmt: skip


@truth("std.color.hue_rotate")
def test_hues_turn_as_filters_do() -> None:
    degrees = np.array([0, 30, 90, 180, 250, -40, 400, 77, 123.0])
    for colors in (COLORS, LESS_THAN_NOTHING):
        wanted = [turned(turn) @ c for turn, c in zip(degrees.tolist(), colors, strict=True)]
        assert values("color", "hue_rotate(c, t * 1deg)", c=colors, t=degrees) == close(wanted)


@truth("std.color.gamma")
def test_gamma_is_a_power() -> None:
    found = values("color", "gamma(c, t)", c=[[0.25, -1, 4]] * 3, t=[0.5, 1, 2])
    assert found == close([[0.5, 0, 2], [0.25, 0, 4], [0.0625, 0, 16]])


@truth("std.color.posterize")
def test_posterized_colors_have_steps() -> None:
    found = values("color", "posterize(c, t)", c=[[0.3, 0.99, 1], [0.1, 0.3, 0.6]], t=[4, 5])
    assert found == close([[0.25, 0.75, 1], [0, 0.2, 0.6]])


@truth("std.color.invert")
def test_inverted_colors_are_complements() -> None:
    assert values("color", "invert(c)", c=COLORS) == close(1 - COLORS)


@truth("std.color.cosine_palette")
def test_a_palette_of_waves() -> None:
    t = np.linspace(-0.3, 1.2, 6)
    mean, height, waves, begin = spread(6), spread(6, 0.2, 0.7), spread(6, 0.5, 2), spread(6)[::-1]
    wanted = mean + height * np.cos(2 * np.pi * (waves * t[:, None] + begin))
    found = values(
        "color", "cosine_palette(t, a, b, c, d)", t=t, a=mean, b=height, c=waves, d=begin
    )
    assert found == close(wanted)
