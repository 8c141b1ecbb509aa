"""Comparing pictures, by pictures whose differences are known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from burnish.materialx.fidelity.comparing import BEYOND, Floats, compare
from burnish.materialx.fidelity.settings import BACKGROUND

SIDE = 40


def picture() -> Floats:
    """A square on the background."""
    made = np.full((SIDE, SIDE, 4), BACKGROUND[0])
    made[5:35, 5:35] = np.linspace(0.1, 0.9, 30 * 30 * 4).reshape(30, 30, 4)
    return made


def test_a_picture_is_like_itself() -> None:
    found = compare(picture(), picture())
    assert (found.verdict, found.drawn, found.beyond, found.largest) == ("alike", 900, 0, 0.0)
    assert found.worst is None


def test_small_differences_are_alike() -> None:
    found = compare(picture(), picture() + np.where(picture() > 0, 0.9 * BEYOND, 0))
    assert (found.verdict, found.beyond) == ("alike", 0)
    assert math.isclose(found.largest, 0.9 * BEYOND)
    assert found.percentiles == pytest.approx((found.largest,) * 3)


def test_a_thousandth_of_the_pixels_may_differ() -> None:
    other = np.tile(picture(), (2, 2, 1))
    wrong = other.copy()
    for number in range(3):
        wrong[10, 10 + number, 1] += 0.5
    found = compare(wrong, other)
    assert (found.verdict, found.drawn, found.beyond) == ("alike", 3600, 3)
    wrong[10, 13, 1] += 0.5
    assert compare(wrong, other).verdict == "different"


def test_the_worst_pixel_has_its_place() -> None:
    other = picture()
    other[20, 7, 2] += 0.25
    found = compare(other, picture())
    assert found.worst is not None
    assert (found.worst.x, found.worst.y) == (7, 20)
    assert math.isclose(found.worst.ours[2] - found.worst.theirs[2], 0.25)
    assert found.sentence().startswith("different: 1 of 900 pixels differ by more than 0.001")
    assert "the worst is at x 7, y 20" in found.sentence()


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_numbers_that_are_not_finite_agree_only_with_themselves(value: float) -> None:
    other = picture()
    other[20, 20] = value
    assert compare(other, other).verdict == "alike"
    assert compare(other, other).not_finite == (1, 1)
    found = compare(other, picture())
    assert (found.verdict, found.largest) == ("different", math.inf)
    assert "not finite: 1 pixels of Burnish, 0 of MaterialX" in found.sentence()


def test_a_pixel_that_only_one_side_draws_is_different() -> None:
    other = picture()
    other[:, 4] = 0.5
    found = compare(other, picture())
    assert (found.verdict, found.drawn, found.beyond) == ("different", 940, 40)


def test_what_hardly_covers_a_pixel_is_not_drawn() -> None:
    other = picture()
    other[:, 4] = [0.5, 0.5, 0.5, 0.0005]
    assert compare(other, picture()).verdict == "alike"
    assert compare(picture(), other).verdict == "different"


def test_black_is_drawn_and_nothing_is_not() -> None:
    black = np.where(picture() > 0, 0.0, picture())
    assert compare(black, black).verdict == "alike"
    empty = np.full((SIDE, SIDE, 4), BACKGROUND[0])
    found = compare(empty, empty)
    assert found.verdict == "not run"
    assert "nothing is compared" in found.sentence()


def test_bright_pixels_differ_relatively() -> None:
    bright = np.where(picture() > 0, 500.0, picture())
    assert compare(bright + np.where(bright > 0, 0.4, 0), bright).verdict == "alike"
    assert compare(bright + np.where(bright > 0, 0.6, 0), bright).verdict == "different"


def test_pictures_of_different_sizes_are_refused() -> None:
    with pytest.raises(ValueError, match="different sizes"):
        compare(picture(), picture()[1:])
