"""Rounding in formats of render targets: the two numbers between which a device's number is."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.reference.picture.formats import clamped, rounded, step
from burnish.compiler.reference.transfer import decode_srgb
from burnish.targets.runner.binding import FORMATS

Floats = NDArray[np.float64]


def colour(number: float) -> Floats:
    return np.full(4, number)


def ends(name: str, low: float, high: float | None = None) -> tuple[float, float]:
    """The two ends of the first lane."""
    found = rounded(name, colour(low), colour(low if high is None else high))
    return float(found[0][0]), float(found[1][0])


@pytest.mark.parametrize(
    ("name", "number", "low", "high"),
    [
        ("rgba8", 0.5, 127 / 255, 128 / 255),
        ("rgba8", 51 / 255, 51 / 255, 51 / 255),
        ("r8", 1.5, 1.0, 1.0),
        ("rgb10a2", 0.5, 511 / 1023, 512 / 1023),
        ("rgba16f", 1.0, 1.0, 1.0),
        ("rgba16f", 1.0003, 1.0, 1.0009765625),
        ("rg16f", 70000.0, 65504.0, np.inf),
        ("r16f", 1e-6, 0.0, 1.0132789611816406e-06),
        ("rgba32f", 0.2, 0.19999998807907104, 0.20000000298023224),
        ("rgba32f", -8.0, -8.0, -8.0),
    ],
)
def test_both_neighbours_are_allowed(name: str, number: float, low: float, high: float) -> None:
    assert ends(name, number) == pytest.approx((low, high), rel=1e-6, abs=0)


def test_srgb_is_rounded_on_its_curve_and_alpha_is_not() -> None:
    number = float(decode_srgb(colour(100.5 / 255))[0])
    low, high = rounded("rgba8_srgb", colour(number), colour(number))
    assert low[0] == pytest.approx(float(decode_srgb(colour(100 / 255))[0]), rel=1e-6)
    assert high[0] == pytest.approx(float(decode_srgb(colour(101 / 255))[0]), rel=1e-6)
    assert (low[3], high[3]) == pytest.approx(
        (np.floor(number * 255) / 255, np.ceil(number * 255) / 255), rel=1e-6
    )


def test_of_an_unknown_colour_the_range_is_known() -> None:
    assert ends("rgba8", np.nan) == pytest.approx((0.0, 1.0), rel=1e-6)
    assert clamped("rgba8", colour(3.0))[0] == 1.0
    assert clamped("rgba16f", colour(3.0))[0] == 3.0


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("number", [0.0, 0.001, 0.3, 1.0])
def test_a_step_is_as_wide_as_what_rounding_leaves_open(name: str, number: float) -> None:
    low, high = rounded(name, colour(number), colour(number * (1 + 1e-12)))
    width = high - low
    assert (width <= 2.5 * step(name, colour(number)) + 1e-6).all()
