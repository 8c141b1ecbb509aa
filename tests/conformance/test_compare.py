"""The comparison of two pictures, by pictures of a few pixels."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.reference.picture import Expected
from burnish.targets.conformance.compare import (
    FEW,
    PROVEN_SHARE,
    Comparison,
    compare,
    proves_little,
)
from burnish.targets.conformance.judging import summed_up

HEIGHT, WIDTH = 20, 50
CLEAR = -8.0
STEP = 0.001
NOWHERE = np.zeros((HEIGHT, WIDTH), dtype=np.bool_)

Floats = NDArray[np.float64]


def picture(value: float = 1.0) -> Floats:
    """One value in every lane."""
    return np.full((HEIGHT, WIDTH, 4), value)


def expected(*targets: Floats, below: float = 0.001, above: float = 0.002) -> Expected:
    """Targets that are covered where they are not clear, with bounds at these distances."""
    covered = targets[0][..., 0] != CLEAR
    seen = covered[..., None]
    return Expected(
        targets=targets,
        covered=covered,
        undecided=NOWHERE,
        low=tuple(np.where(seen, target - below, target) for target in targets),
        high=tuple(np.where(seen, target + above, target) for target in targets),
        layers=covered.astype(np.int64),
    )


def compared(
    got: Floats,
    wanted: Expected | None = None,
    meant: Floats | None = None,
    possible: Expected | None = None,
) -> Comparison:
    """A picture of one target against the reference's, which is 1 everywhere unless given."""
    wanted = wanted or expected(picture())
    source = wanted.targets if meant is None else (meant,)
    return compare((got,), wanted, source, [picture(STEP)], "guaranteed", possible)


def changed(value: float, *, x: int = 7, y: int = 2, lane: int = 3) -> Floats:
    """A picture of ones with another value in one lane of one pixel."""
    got = picture()
    got[y, x, lane] = value
    return got


def with_bounds(low: float, high: float, *, wide: Any = None) -> Expected:
    """A picture of ones, that has other bounds in some pixels: in one, unless they are given."""
    wanted = expected(picture())
    where = NOWHERE.copy()
    where[2, 7] = True
    chosen = (where if wide is None else wide)[..., None]
    return replace(
        wanted,
        low=(np.where(chosen, low, wanted.low[0]),),
        high=(np.where(chosen, high, wanted.high[0]),),
    )


def test_equal_pictures_agree() -> None:
    found = compared(picture())
    assert found.agrees and not found.blames_compiler
    assert (found.pixels, found.covered, found.proven) == (1000, 1000, 1000)
    assert (found.undecided, found.wide, found.wrong, found.changed) == (0, 0, 0, 0)
    assert found.max_difference == found.excess == 0.0


@pytest.mark.parametrize(
    ("value", "agrees", "excess"),
    [(1.002, True, 1.0), (1.0021, False, 1.05), (0.999, True, 1.0), (0.9989, False, 1.1)],
)
def test_a_value_lies_between_its_bounds(value: float, agrees: bool, excess: float) -> None:
    found = compared(changed(value))
    assert found.agrees is agrees
    assert found.wrong == (not agrees)
    assert found.max_difference == pytest.approx(abs(value - 1))
    assert found.excess == pytest.approx(excess)


def test_one_wrong_lane_of_one_pixel_is_found() -> None:
    found = compared(changed(2.0))
    assert found.worst is not None and not found.agrees
    assert (found.worst.x, found.worst.y, found.worst.target) == (7, 2, 0)
    assert found.worst.got == (1.0, 1.0, 1.0, 2.0)
    assert found.worst.expected == (1.0, 1.0, 1.0, 1.0)
    assert (found.worst.low[3], found.worst.high[3]) == (0.999, 1.002)


def test_the_worst_is_measured_in_bounds_and_in_any_target() -> None:
    wanted = expected(picture(100.0), picture(1.0))
    wanted = replace(wanted, high=(picture(110.0), picture(1.002)))
    first, second = picture(100.0), picture(1.0)
    first[0, 0, 0], second[1, 3, 2] = 105.0, 1.0019
    found = compare((first, second), wanted, wanted.targets, [picture(STEP)] * 2, "guaranteed")
    assert found.agrees
    assert found.max_difference == pytest.approx(5.0)
    assert found.worst is not None
    assert (found.worst.x, found.worst.y, found.worst.target) == (3, 1, 1)


@pytest.mark.parametrize("got", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_does_not_agree(got: float) -> None:
    found = compared(changed(got))
    assert not found.agrees and found.wrong == 1
    assert found.max_difference == found.excess == math.inf


@pytest.mark.parametrize("got", [-1e30, math.nan, math.inf, -math.inf])
def test_where_nothing_is_known_everything_agrees_and_proves_nothing(got: float) -> None:
    found = compared(changed(got), with_bounds(-math.inf, math.inf))
    assert found.agrees
    assert (found.wide, found.proven) == (1, 999)


def test_what_may_overflow_may_be_infinite_on_that_side_only() -> None:
    wanted = with_bounds(0.5, math.inf)
    assert compared(changed(math.inf), wanted).agrees
    assert not compared(changed(-math.inf), wanted).agrees
    assert not compared(changed(math.nan), wanted).agrees


@pytest.mark.parametrize("got", [1.0, math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("value", [1e39, -1e39, math.nan, math.inf, -math.inf])
def test_nothing_is_promised_where_the_value_leaves_float32(got: float, value: float) -> None:
    """Such a pixel is no agreement, and no fault of the driver's."""
    found = compared(changed(got), expected(changed(value)))
    assert not found.agrees and (found.wrong, found.changed, found.overflowing) == (0, 0, 1)
    assert found.proven == found.covered - 1
    assert found.max_difference == found.excess == 0
    assert found.overflow is not None
    assert (found.overflow.x, found.overflow.y, found.overflow.target) == (7, 2, 0)


def test_nothing_is_promised_where_what_the_material_means_leaves_float32() -> None:
    """The compiler folds what overflows to the largest float."""
    largest = picture(float(np.finfo(np.float32).max))
    meant = largest.copy()
    meant[2, 7, 3] = 1e76
    found = compared(largest, expected(largest, below=0.0, above=0.0), meant)
    assert (found.changed, found.overflowing, found.agrees) == (0, 1, False)
    assert found.overflow is not None and (found.overflow.x, found.overflow.y) == (7, 2)


def test_the_largest_float_is_one() -> None:
    largest = float(np.finfo(np.float32).max)
    assert compared(changed(largest), expected(changed(largest))).agrees


def test_an_undecided_pixel_does_not_overflow() -> None:
    undecided = NOWHERE.copy()
    undecided[2, 7] = True
    wanted = replace(expected(changed(math.inf)), undecided=undecided)
    assert compared(picture(), wanted).agrees


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
        found = compared(changed(value), replace(expected(picture()), undecided=undecided))
        assert found.agrees and found.undecided == 1
        assert found.max_difference == 0.0


# --- the meaning ---------------------------------------------------------------------------------


def test_the_compiler_is_to_blame_if_the_meaning_is_out_of_bounds() -> None:
    found = compared(picture(), meant=changed(1.5))
    assert found.blames_compiler and not found.agrees
    assert (found.changed, found.wrong) == (1, 0)
    assert found.change is not None
    assert (found.change.x, found.change.y) == (7, 2)
    assert (found.change.got[3], found.change.expected[3]) == (1.5, 1.0)


def test_rounding_to_float64_is_no_change_of_meaning() -> None:
    """Even where every device has exactly one value."""
    wanted = expected(picture(), below=0.0, above=0.0)
    assert compared(picture(), wanted, changed(1.0 + 1e-14)).agrees
    assert not compared(picture(), wanted, changed(1.0 + 1e-9)).agrees


def test_what_numbers_of_about_one_leave_when_they_cancel_is_no_change_of_meaning() -> None:
    """`mix(x, x, x) - x` is not exactly 0 in float64, but may be simplified to 0."""
    black = expected(picture(0.0), below=0.0, above=0.0)
    meant = np.full_like(picture(0.0), 2.0**-53)
    assert compared(picture(0.0), black, meant).agrees
    assert compared(picture(0.0), black, 1e6 * meant).blames_compiler


def test_what_a_device_may_make_of_the_material_is_no_change_of_meaning() -> None:
    """A decision may be tipped by how float64 rounds as well."""
    ones, zero = picture(), changed(0.0)
    folded = expected(ones, below=0.0, above=0.0)
    assert compared(ones, folded, zero).changed == 1
    assert compared(ones, folded, zero, expected(zero, below=0.0, above=1.0)).changed == 0
    assert compared(ones, folded, zero, expected(zero, below=0.0, above=0.5)).changed == 1


# --- what is proven ------------------------------------------------------------------------------


def test_a_bound_says_nothing_if_it_leaves_most_of_the_range_open() -> None:
    ramp = np.broadcast_to(np.linspace(0, 1, WIDTH)[None, :, None], (HEIGHT, WIDTH, 4)).copy()
    assert compared(ramp, expected(ramp, below=0.05, above=0.05)).wide == 0
    assert compared(ramp, expected(ramp, below=0.07, above=0.07)).wide == 1000


def test_a_picture_of_one_colour_is_judged_by_its_magnitude() -> None:
    assert compared(picture(), expected(picture(), below=0.003, above=0.003)).wide == 0
    assert compared(picture(), expected(picture(), below=0.03, above=0.03)).wide == 1000


def test_of_a_black_picture_tiny_bounds_say_enough() -> None:
    black = np.zeros((HEIGHT, WIDTH, 4))
    assert compared(black, expected(black, below=0.0, above=1e-40)).wide == 0
    assert compared(black, expected(black, below=0.5, above=0.5)).wide == 1000


def test_too_many_pixels_without_proof_prove_little() -> None:
    most = max(FEW, round((1.0 - PROVEN_SHARE) * NOWHERE.size))
    wide = NOWHERE.copy()
    wide.flat[:most] = True
    assert not proves_little([compared(picture(), with_bounds(-math.inf, math.inf, wide=wide))])
    wide.flat[most] = True
    little = compared(picture(), with_bounds(-math.inf, math.inf, wide=wide))
    assert proves_little([little]) and little.agrees
    undecided = replace(expected(picture()), undecided=wide)
    assert proves_little([compared(picture(), undecided)])
    # What other cases prove counts, too.
    assert not proves_little([little, compared(picture())])


def test_where_nothing_is_seen_nothing_is_proven() -> None:
    clear = picture(CLEAR)
    found = compared(clear, expected(clear))
    assert found.agrees and found.worst is not None
    assert proves_little([found])
    undecided = compared(changed(2.0), replace(expected(picture()), undecided=~NOWHERE))
    assert undecided.worst is None and proves_little([undecided])


def test_the_bite_is_the_median_of_the_bounds_in_steps() -> None:
    assert compared(picture(), expected(picture(), below=0.01, above=0.01)).bite == (
        pytest.approx(10.0)
    )
    assert compared(picture(), expected(picture(), below=0.0, above=0.0)).bite == 0.0


def test_pixels_that_only_loose_bounds_hold_are_proven_by_these_alone() -> None:
    """A picture that leaves what was measured agrees only as far as the guarantee proves it."""
    tight = compared(picture(1.5))
    loose = compared(picture(1.5), expected(picture(), below=1e3, above=1e3))
    assert (tight.wrong, loose.wrong) == (tight.covered, 0)
    together = summed_up([tight, loose])
    assert together.proven == 0 and proves_little([together])
