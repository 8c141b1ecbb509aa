"""What makes two pictures agree, by pictures of a few pixels."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.reference.picture import Expected
from burnish.targets.conformance.compare import Comparison, compare
from burnish.targets.conformance.tolerances import UNDECIDED_SHARE, Tolerance

HEIGHT, WIDTH = 4, 50
CLEAR = -8.0
TOLERANCE = Tolerance(0.01, 0.1, "for tests", functions={"sin": 0.5, "cos": 0.25})
NOWHERE = np.zeros((HEIGHT, WIDTH), dtype=np.bool_)

Floats = NDArray[np.float64]


def picture(value: float = 1.0) -> Floats:
    """One value in every lane."""
    return np.full((HEIGHT, WIDTH, 4), value)


def expected(*targets: Floats, radius: float = 0.0, undecided: Any = NOWHERE) -> Expected:
    """Targets that are covered where they are not clear."""
    covered = targets[0][..., 0] != CLEAR
    return Expected(targets, covered, undecided, tuple(picture(radius) for _ in targets))


def compared(got: Floats, wanted: Expected | None = None, step: float = 0.0) -> Comparison:
    """A picture of one target against the reference's, which is 1 everywhere unless given."""
    return compare((got,), wanted or expected(picture()), TOLERANCE, [step])


def changed(value: float, *, x: int = 7, y: int = 2, lane: int = 3) -> Floats:
    """A picture of ones with another value in one lane of one pixel."""
    got = picture()
    got[y, x, lane] = value
    return got


def test_equal_pictures_agree() -> None:
    found = compared(picture())
    assert found.agrees
    assert (found.pixels, found.covered, found.undecided, found.wrong) == (200, 200, 0, 0)
    assert found.max_difference == found.excess == 0.0


@pytest.mark.parametrize(
    ("value", "radius", "step", "agrees"),
    [
        (1.1, 0.0, 0.0, True),
        (1.12, 0.0, 0.0, False),
        (0.88, 0.0, 0.0, False),
        (1.12, 0.02, 0.0, True),
        (1.12, 0.0, 0.02, True),
    ],
)
def test_the_tolerance_is_a_sum(value: float, radius: float, step: float, agrees: bool) -> None:
    found = compared(changed(value), expected(picture(), radius=radius), step)
    assert found.agrees is agrees
    assert found.wrong == (not agrees)
    assert found.max_difference == pytest.approx(abs(value - 1))
    assert found.excess == pytest.approx(abs(value - 1) / (0.11 + 1.25 * radius + step))


def test_one_wrong_lane_of_one_pixel_is_found() -> None:
    found = compared(changed(2.0))
    assert found.worst is not None and not found.agrees
    assert (found.worst.x, found.worst.y, found.worst.target) == (7, 2, 0)
    assert found.worst.got == (1.0, 1.0, 1.0, 2.0)
    assert found.worst.expected == (1.0, 1.0, 1.0, 1.0)


def test_the_worst_is_measured_in_tolerances_and_in_any_target() -> None:
    wanted = expected(picture(100.0), picture(1.0))
    first, second = picture(100.0), picture(1.0)
    first[0, 0, 0], second[1, 3, 2] = 105.0, 1.1
    found = compare((first, second), wanted, TOLERANCE, [0.0, 0.0])
    assert found.agrees
    assert found.max_difference == pytest.approx(5.0)
    assert found.worst is not None
    assert (found.worst.x, found.worst.y, found.worst.target) == (3, 1, 1)


@pytest.mark.parametrize("got", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_never_agrees(got: float) -> None:
    found = compared(changed(got))
    assert not found.agrees and found.wrong == 1
    assert found.max_difference == found.excess == math.inf


@pytest.mark.parametrize("got", [1.0, math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("wanted", [1e39, -1e39, math.nan, math.inf, -math.inf])
def test_nothing_is_promised_where_the_reference_leaves_float32(got: float, wanted: float) -> None:
    """It is no agreement, and no fault of the driver's."""
    found = compared(changed(got), expected(changed(wanted)))
    assert not found.agrees and (found.wrong, found.overflowing) == (0, 1)
    assert found.proven == found.covered - 1
    assert found.max_difference == found.excess == 0
    assert found.overflow is not None
    assert (found.overflow.x, found.overflow.y, found.overflow.target) == (7, 2, 0)


def test_the_largest_float_is_one() -> None:
    largest = float(np.finfo(np.float32).max)
    assert compared(changed(largest), expected(changed(largest))).agrees


def test_an_undecided_pixel_does_not_overflow() -> None:
    undecided = NOWHERE.copy()
    undecided[2, 7] = True
    assert compared(picture(), expected(changed(math.inf), undecided=undecided)).agrees


def test_an_infinite_radius_allows_nothing() -> None:
    assert not compared(picture(), expected(picture(), radius=math.inf)).agrees


def test_a_pixel_covered_by_one_of_the_two_only_is_wrong() -> None:
    half = picture()
    half[:, :20] = CLEAR
    assert compared(half, expected(half)).covered == HEIGHT * 30
    assert compared(picture(), expected(half)).wrong == HEIGHT * 20
    assert compared(half, expected(picture())).wrong == HEIGHT * 20


def test_undecided_pixels_are_not_compared() -> None:
    undecided = NOWHERE.copy()
    undecided[2, 7] = True
    for value in (5.0, math.nan):
        found = compared(changed(value), expected(picture(), undecided=undecided))
        assert found.agrees and found.undecided == 1
        assert found.max_difference == 0.0


def test_too_many_undecided_pixels_prove_nothing() -> None:
    undecided = NOWHERE.copy()
    allowed = int(UNDECIDED_SHARE * undecided.size)
    undecided.flat[:allowed] = True
    assert compared(picture(), expected(picture(), undecided=undecided)).agrees
    undecided.flat[allowed] = True
    found = compared(picture(), expected(picture(), undecided=undecided))
    assert found.too_undecided and not found.agrees and not found.wrong


def test_where_nothing_is_decided_there_is_no_worst_pixel() -> None:
    found = compared(changed(2.0), expected(picture(), undecided=~NOWHERE))
    assert found.worst is None and not found.agrees
