"""The visible fragment, if the depths of some fragments may differ more than those of others."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest

from burnish.compiler.ir.render_state import Compare, DepthState
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.picture.canvas import Canvas, Shades, nearest
from burnish.compiler.reference.picture.coverage import Fragments

from .test_drawing import BLUE, COLOURED, passing


@pytest.mark.parametrize(("off", "close"), [(0.1, []), (0.3, [0])])
def test_a_fragment_behind_the_second_may_be_the_nearest(off: float, close: list[int]) -> None:
    fragments = Fragments(np.arange(3), np.zeros(3, dtype=np.int64))
    winners, undecided = nearest(
        fragments, np.array([0.5, 0.6, 0.7]), np.array([0, 0, off]), np.arange(3)
    )
    assert winners.tolist() == [0]
    assert undecided.tolist() == close


@pytest.mark.parametrize(("off", "shaky"), [(0.001, False), (0.01, True)])
def test_what_may_be_discarded_may_be_nearer_than_its_depth(off: float, shaky: bool) -> None:
    given = passing(COLOURED, discard="discard when material.c.a < 0.5")
    written = [(row.state, row.value.type) for row in given.results_of(TARGET) if row.state]
    canvas = Canvas(1, [BLUE], written, rounds=False)
    first = np.array([True, False])
    shades = Shades([np.zeros((3, 2, 4))], None, first, first, np.arange(2))
    canvas.draw(
        np.zeros(2, dtype=np.int64),
        np.array([0.5, 0.495]),
        np.array([off, 0.0]),
        np.arange(2),
        shades,
        DepthState(),
    )
    assert canvas.shaky.tolist() == [shaky]


ALONE = np.zeros(1, dtype=np.int64)
"""The only fragment, of the only sample."""
HALF = 0.5
"""The depth of what is there before a fragment is drawn."""


def drawn_over_half(test: DepthState, depth: float, off: float = 0.0) -> Canvas:
    """A pixel with white at the depth ``HALF``, and then with another colour, drawn by a test."""
    given = passing(COLOURED)
    written = [(row.state, row.value.type) for row in given.results_of(TARGET) if row.state]
    canvas = Canvas(1, [BLUE], written, rounds=False)
    pixel, sure = np.zeros(1, dtype=np.int64), np.zeros(1, dtype=np.bool_)
    for place, (value, at, by, how) in enumerate(
        [(1.0, HALF, 0.0, DepthState()), (0.25, depth, off, test)]
    ):
        shades = Shades([np.full((3, 1, 4), value)], None, sure, sure, ALONE)
        canvas.draw(pixel, np.array([at]), np.array([by]), np.array([place]), shades, how)
    return canvas


@pytest.mark.parametrize("write", [True, False])
@pytest.mark.parametrize(
    ("compare", "nearer", "farther"),
    [
        ("never", False, False),
        ("less", True, False),
        ("equal", False, False),
        ("less_equal", True, False),
        ("greater", False, True),
        ("not_equal", True, True),
        ("greater_equal", False, True),
        ("always", True, True),
    ],
)
def test_what_the_depth_test_lets_through(
    compare: Compare, nearer: bool, farther: bool, write: bool
) -> None:
    for depth, passes in ((0.25, nearer), (0.75, farther)):
        canvas = drawn_over_half(DepthState(compare, write), depth, off=0.1)
        assert canvas.targets[0][0, 0, 0] == (0.25 if passes else 1.0)
        assert canvas.depth.tolist() == [depth if passes and write else HALF]
        assert not canvas.shaky.any()


@pytest.mark.parametrize("compare", get_args(Compare))
def test_depths_that_rounding_may_tip_are_undecided(compare: Compare) -> None:
    canvas = drawn_over_half(DepthState(compare), HALF + 0.01, off=0.1)
    assert canvas.shaky.tolist() == [compare not in ("never", "always")]


@pytest.mark.parametrize("compare", get_args(Compare))
def test_equal_depths_of_copies_are_compared(compare: Compare) -> None:
    """A face and its copy in another instance have the same depths on every device."""
    given = passing(COLOURED)
    written = [(row.state, row.value.type) for row in given.results_of(TARGET) if row.state]
    canvas = Canvas(1, [BLUE], written, rounds=False)
    sure = np.zeros(1, dtype=np.bool_)
    for value, test in ((1.0, DepthState()), (0.25, DepthState(compare))):
        shades = Shades([np.full((3, 1, 4), value)], None, sure, sure, ALONE)
        of_pixel = np.zeros(1, dtype=np.int64)
        canvas.draw(of_pixel, np.array([HALF]), np.array([0.1]), of_pixel, shades, test)
    passes = compare in ("equal", "less_equal", "greater_equal", "always")
    assert canvas.targets[0][0, 0, 0] == (0.25 if passes else 1.0)
    assert not canvas.shaky.any()


@pytest.mark.parametrize(
    ("test", "shaky"),
    [
        (DepthState(), False),
        (DepthState("always"), False),
        (DepthState("always", write=False), True),
        (DepthState("less", write=False), True),
        (DepthState("not_equal"), True),
    ],
)
def test_what_settles_an_undecided_pixel(test: DepthState, shaky: bool) -> None:
    """A fragment settles it if it is drawn in any case and its depth is kept.

    Then it does not matter any more whether another fragment was drawn there.
    """
    given = passing(COLOURED, discard="discard when material.c.a < 0.5")
    written = [(row.state, row.value.type) for row in given.results_of(TARGET) if row.state]
    canvas = Canvas(1, [BLUE], written, rounds=False)
    unsure = np.array([True, False])
    shades = Shades([np.zeros((3, 2, 4))], None, unsure & False, unsure, np.arange(2))
    depths, places = np.array([0.5, 0.25]), np.arange(2)
    first, second = (np.array([number]) for number in (0, 1))
    for number, how in ((first, DepthState()), (second, test)):
        pixel = np.zeros(1, dtype=np.int64)
        canvas.draw(pixel, depths[number], np.zeros(1), places[number], shades.only(number), how)
    assert canvas.shaky.tolist() == [shaky]


def test_a_fragment_behind_what_may_have_stayed_settles_nothing() -> None:
    """If a device has not drawn the undecided fragment, an earlier one may be nearer."""
    given = passing(COLOURED)
    written = [(row.state, row.value.type) for row in given.results_of(TARGET) if row.state]
    canvas = Canvas(1, [BLUE], written, rounds=False)
    pixel, sure = np.zeros(1, dtype=np.int64), np.zeros(1, dtype=np.bool_)
    rows = [
        (0.3, DepthState(), sure),
        (0.5, DepthState("greater"), ~sure),
        (0.4, DepthState(), sure),
    ]
    for place, (depth, test, undecided) in enumerate(rows):
        shades = Shades([np.zeros((3, 1, 4))], None, sure, undecided, ALONE)
        canvas.draw(pixel, np.array([depth]), np.zeros(1), np.array([place]), shades, test)
    assert canvas.shaky.tolist() == [True]
