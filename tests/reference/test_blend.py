"""The bounds of ``mix`` with an open weight, and of sums of whole numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.bounds import Bounded, Bounds, exact
from burnish.compiler.reference.bounds.errors import Errors

BOUNDS = Bounds(Errors(("vulkan",)))
ONE = np.float32(1)
COUNT = 400
"""The number of blends that are tried at once."""


def _interval(random: np.random.Generator, least: float, most: float) -> Bounded:
    """Float32 numbers within a range, of which a part of it is left open."""
    ends = np.sort(random.uniform(least, most, (2, COUNT)).astype(np.float32).astype(float), axis=0)
    middle = 0.5 * (ends[0] + ends[1])
    return Bounded(middle, ends[0], ends[1])


def _somewhere(lane: Bounded, random: np.random.Generator) -> Any:
    """A float32 within an interval, often at an end."""
    share = np.clip(random.uniform(-0.5, 1.5, COUNT), 0, 1)
    place = (lane.low + share * (lane.high - lane.low)).clip(lane.low, lane.high)
    return place.astype(np.float32)


@pytest.mark.parametrize("most", [1.0, 3.0])
def test_both_formulas_are_within_the_bounds(most: float) -> None:
    """This holds also for weights outside of 0..1."""
    random = np.random.default_rng(int(most))
    x, y = _interval(random, -100, 100), _interval(random, -1, 1)
    a = _interval(random, 1 - most, most)
    found = BOUNDS.mix(x, y, a)
    for _ in range(40):
        one, other, weight = (_somewhere(lane, random) for lane in (x, y, a))
        for tried in (one * (ONE - weight) + other * weight, one + (other - one) * weight):
            assert tried.dtype == np.float32
            assert ((found.low <= tried) & (tried <= found.high)).all()


@pytest.mark.parametrize("end", [0, 1])
def test_the_uses_of_a_weight_may_be_rounded_differently(end: int) -> None:
    """If the weight is a product, ``y * a`` may be computed in another order than ``1 - a``."""
    random = np.random.default_rng(end)
    factors = random.uniform(1.0, 1.01, (FACTORS, 50 * COUNT)).astype(np.float32)
    spread = np.array([0.99, 1.0])[:, None] * factors[0]
    spread = spread.astype(np.float32).astype(float)
    weight = Bounded(spread[end], *spread)
    for factor in factors[1:]:
        weight = weight * exact(factor.astype(float))
    one = exact(np.ones(50 * COUNT))
    found = BOUNDS.mix(one, exact(np.ones(50 * COUNT)), weight)
    for toward in (-np.inf, np.inf):
        near, far = (_directed(spread[end], factors[1:], way) for way in (toward, -toward))
        tried = (ONE - near) + far
        assert tried.dtype == np.float32
        assert ((found.low <= tried) & (tried <= found.high)).all()


FACTORS = 16


def _directed(first: Any, factors: Any, toward: float) -> Any:
    """A product in float32, each time rounded to the same side."""
    product = first.astype(np.float32)
    for factor in factors:
        exactly = product.astype(float) * factor.astype(float)
        nearest = exactly.astype(np.float32)
        beyond = np.nextafter(nearest, np.float32(toward))
        wrong = (nearest < exactly) if toward > 0 else (nearest > exactly)
        product = np.where(wrong, beyond, nearest)
    return product


def test_a_choice_by_an_open_weight_is_between_both() -> None:
    """``mix(x, y, step(e, z))`` where the step may tip: not between 0 and ``x + y``."""
    weight = Bounded(np.array([1.0]), np.array([0.0]), np.array([1.0]))
    found = BOUNDS.mix(exact(np.array([0.75])), exact(np.array([0.5])), weight)
    assert found.low[0] == pytest.approx(0.5, abs=1e-6)
    assert found.high[0] == pytest.approx(0.75, abs=1e-6)


def test_whole_numbers_are_counted_exactly_in_any_order() -> None:
    """Noise adds up whole numbers as floats, and floors the sums. Other elements are inexact."""
    places = np.array([288.0, 16777216.0, 7.5, 12.0])
    off = np.array([0.0, 0.0, 0.0, 1e-6])
    lane = Bounded(places, places - off, places + off)
    widths = ((lane + exact(np.full(4, 288.0))) + exact(np.full(4, 1.0)) + lane).radius
    assert widths[0] == 0
    assert (widths[1:] > 0).all()
