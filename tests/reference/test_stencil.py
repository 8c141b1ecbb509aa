"""Stencil values: what they let through, and what becomes of them, by values worked out by hand.

Where a device may draw a fragment or not, the value is only known if that does not matter to it.
"""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest

from burnish.compiler.ir.render_state import (
    Compare,
    StencilOperation,
    StencilSide,
    StencilState,
)
from burnish.compiler.reference.picture.stencil import (
    Outcomes,
    Stencil,
    StencilTest,
    operated,
)

PIXEL = np.zeros(1, np.int64)


def sure(*, holds: bool) -> Outcomes:
    """Something that is so, or not so, on every device."""
    return Outcomes(np.array([holds]), np.array([False]))


def unsure(*, holds: bool) -> Outcomes:
    """Something of which a device may say the opposite."""
    return Outcomes(np.array([holds]), np.array([True]))


YES, NO = sure(holds=True), sure(holds=False)
PERHAPS = unsure(holds=True)


def left(value: int, known: bool = True) -> Stencil:
    """The stencil of a picture of one pixel."""
    stencil = Stencil(1)
    stencil.values[:] = value
    stencil.unsure[:] = not known
    return stencil


def of_both(side: StencilSide, **state: int) -> StencilTest:
    """A test of a front, where both sides are alike."""
    return StencilTest(StencilState(side, side, **state), np.array([True]))


@pytest.mark.parametrize(
    ("operation", "results"),
    [
        ("keep", [0, 1, 254, 255]),
        ("zero", [0, 0, 0, 0]),
        ("replace", [7, 7, 7, 7]),
        ("invert", [255, 254, 1, 0]),
        ("increment_clamp", [1, 2, 255, 255]),
        ("decrement_clamp", [0, 0, 253, 254]),
        ("increment_wrap", [1, 2, 255, 0]),
        ("decrement_wrap", [255, 0, 253, 254]),
    ],
)
def test_operations(operation: StencilOperation, results: list[int]) -> None:
    assert operated(operation, np.array([0, 1, 254, 255]), 7).tolist() == results


def test_every_operation_is_tried() -> None:
    (mark,) = test_operations.pytestmark  # type: ignore[attr-defined]
    assert [row[0] for row in mark.args[1]] == list(get_args(StencilOperation))


@pytest.mark.parametrize(
    ("compare", "passes"),
    [
        ("never", [False, False, False]),
        ("less", [False, False, True]),
        ("equal", [False, True, False]),
        ("less_equal", [False, True, True]),
        ("greater", [True, False, False]),
        ("not_equal", [True, False, True]),
        ("greater_equal", [True, True, False]),
        ("always", [True, True, True]),
    ],
)
def test_the_reference_stands_on_the_left(compare: Compare, passes: list[bool]) -> None:
    """The masked values are 1, 2 and 3, and the reference is 2."""
    stencil = Stencil(3)
    stencil.values[:] = [0x11, 0x22, 0x33]
    side = StencilSide(compare)
    test = StencilTest(StencilState(side, side, 0x42, read_mask=15), np.ones(3, np.bool_))
    found = stencil.tested(test, np.arange(3))
    assert found.holds.tolist() == passes
    assert not found.open.any()
    stencil.unsure[:] = True
    assert stencil.tested(test, np.arange(3)).open.all() == (compare not in ("never", "always"))


COUNTING = StencilSide(fail_op="zero", depth_fail_op="increment_wrap", pass_op="replace")


@pytest.mark.parametrize(
    ("there", "passes", "nearer", "value", "known"),
    [
        (YES, NO, YES, 0, True),
        (YES, NO, NO, 0, True),
        (YES, YES, NO, 6, True),
        (YES, YES, YES, 9, True),
        (NO, YES, YES, 5, True),
        (PERHAPS, YES, YES, 9, False),
        (YES, PERHAPS, YES, 9, False),
        (YES, YES, PERHAPS, 9, False),
        (YES, NO, PERHAPS, 0, True),
    ],
    ids=[
        "fails", "fails behind", "behind", "passes", "discarded", "perhaps discarded",
        "perhaps fails", "perhaps behind", "fails, and perhaps behind",
    ],
)  # fmt: skip
def test_what_happens_to_a_value(
    there: Outcomes, passes: Outcomes, nearer: Outcomes, value: int, known: bool
) -> None:
    stencil = left(5)
    stencil.change(of_both(COUNTING, reference=9), PIXEL, there, passes, nearer)
    assert stencil.values.tolist() == [value]
    assert stencil.unsure.tolist() == [not known]


def test_it_does_not_matter_what_hangs_on_rounding_if_both_come_to_the_same() -> None:
    side = StencilSide(depth_fail_op="invert", pass_op="invert")
    stencil = left(5)
    stencil.change(of_both(side), PIXEL, YES, YES, PERHAPS)
    assert (stencil.values.tolist(), stencil.unsure.tolist()) == ([250], [False])


@pytest.mark.parametrize(
    ("operation", "mask", "known"),
    [("replace", 255, True), ("zero", 255, True), ("replace", 127, False), ("invert", 255, False)],
)
def test_what_makes_a_value_known_again(
    operation: StencilOperation, mask: int, known: bool
) -> None:
    stencil = left(5, known=False)
    test = of_both(StencilSide(pass_op=operation), reference=9, write_mask=mask)
    stencil.change(test, PIXEL, YES, YES, YES)
    assert stencil.unsure.tolist() == [not known]


def test_only_some_bits_are_written() -> None:
    stencil = left(0b1010_1010)
    stencil.change(of_both(StencilSide(pass_op="invert"), write_mask=0b1111), PIXEL, YES, YES, YES)
    assert stencil.values.tolist() == [0b1010_0101]


def test_either_side_has_a_test_of_its_own() -> None:
    state = StencilState(StencilSide(pass_op="increment_wrap"), StencilSide("never", "invert"))
    stencil = Stencil(2)
    test = StencilTest(state, np.array([True, False]))
    both, at = Outcomes(np.ones(2, np.bool_), np.zeros(2, np.bool_)), np.arange(2)
    passes = stencil.tested(test, at)
    assert passes.holds.tolist() == [True, False]
    stencil.change(test, at, both, passes, both)
    assert stencil.values.tolist() == [1, 255]


def test_a_state_that_writes_nothing_changes_nothing() -> None:
    stencil = left(5)
    stencil.change(of_both(COUNTING, write_mask=0), PIXEL, PERHAPS, YES, YES)
    assert (stencil.values.tolist(), stencil.unsure.tolist()) == ([5], [False])
