"""Which fragment is seen, where a device's depths may differ by more for some than for others."""

from __future__ import annotations

import numpy as np
import pytest

from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.picture.coverage import Fragments
from burnish.compiler.reference.picture.resolve import Canvas, Shades, nearest

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
    shades = Shades([np.zeros((3, 2, 4))], discarded=first, undecided=first)
    canvas.draw(
        np.zeros(2, dtype=np.int64),
        np.array([0.5, 0.495]),
        np.array([off, 0.0]),
        np.arange(2),
        shades,
    )
    assert canvas.shaky.tolist() == [shaky]
