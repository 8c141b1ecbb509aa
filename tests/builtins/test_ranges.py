"""Range rules allow for what any platform may return, as the rows of ``accuracy.py`` promise it."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.reference.bounds import Bounds, as_bounded, given
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.functions import evaluate
from burnish.stdlib.builtins import BUILTINS, Builtin
from burnish.stdlib.builtins.accuracy import PLATFORMS, Platform
from burnish.stdlib.builtins.exponential import INVERSE_ROOT, ROOT_ERROR
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL, UNIT_SLACK, Fact
from burnish.stdlib.builtins.row import anything
from burnish.stdlib.builtins.weakest import ROUNDING, relative

from ..reference.chosen import Chosen
from ..reference.device import HABITS, Device

BOXES, POINTS = 160, 12
LARGEST = {"tanh": 16.0}
"""The largest operand of each builtin, if not 300: from there on, an expansion takes over.

Sines of far larger operands are off by more than is promised, but not above 1.
"""
OF_DOUBLES = 1 - Fraction(2.0**-50)
"""The accuracy of the computation of ranges."""
VECTORS = {"dot": 4, "length": 4, "distance": 4, "cross": 3, "normalize": 4, "reflect": 4}
LOOSE = ("smoothstep", "asin", "tan")
"""Bounds forget that two factors depend on each other, that a root is never negative, or that only
one end of a quotient is large. So devices that choose at random compute these."""
OF_FLOATS = [
    row
    for row in BUILTINS.values()
    if row.range is not anything
    and row.name not in LOOSE
    and row.of_group is None
    and (row.name in VECTORS or any(set(s) <= set("TNS ,->") for s in row.signatures))
]
"""Builtins of floats with a range rule.

Builtins that join work groups are not among them: ``tests/reference/test_in_groups.py`` has their
ranges.
"""

Floats = NDArray[np.float64]


def boxes(chance: np.random.Generator, row: Builtin) -> tuple[Floats, Floats, Floats]:
    """The ends of operands' ranges, and points within them, the ends among them."""
    count = row.signatures[0].split("->")[0].count(",") + 1
    middle = chance.uniform(-1.0, 1.0, (count, BOXES, 1)) * 10.0 ** chance.integers(
        -3, 3, (count, BOXES, 1)
    )
    width = np.abs(middle) * 10.0 ** chance.integers(-8, 1, (count, BOXES, 1))
    # Many functions have an extreme, or the end of a domain, at 0 or at 1.
    from_zero = chance.random((count, BOXES, 1))
    low = np.where(from_zero < 0.2, 0.0, np.where(from_zero < 0.4, 1.0, middle - width))
    high = np.maximum(middle + width, low)
    at = chance.random((count, BOXES, POINTS))
    at[..., 0], at[..., 1] = 0.0, 1.0
    largest = LARGEST.get(row.name, 300.0)
    exact = np.clip(low + (high - low) * at, -largest, largest)
    points: Floats = exact.astype(np.float32).astype(np.float64)
    least: Floats = points.min(axis=-1)
    most: Floats = points.max(axis=-1)
    return least, most, points


@pytest.mark.parametrize("row", OF_FLOATS, ids=lambda row: row.name)
@pytest.mark.parametrize("platform", PLATFORMS)
def test_no_platform_leaves_a_range(row: Builtin, platform: Platform) -> None:
    low, high, points = boxes(np.random.default_rng(7), row)
    width = VECTORS.get(row.name, 1)
    operands: list[tuple[Any, ...]] = [
        tuple(given(np.roll(values, lane, axis=-1)) for lane in range(width)) for values in points
    ]
    with np.errstate(all="ignore"):
        lanes = evaluate(row.name, operands, Bounds(Errors((platform,))), "float")
    for box in range(BOXES):
        facts = tuple(
            Fact(float(lo[box]), float(hi[box])) for lo, hi in zip(low, high, strict=True)
        )
        claimed = row.range(facts, False)
        for lane in map(as_bounded, lanes):
            shape = points[0].shape
            least, most = (np.broadcast_to(end, shape)[box] for end in (lane.low, lane.high))
            known = np.isfinite(least) & np.isfinite(most)
            assert (upwards(least[known]) >= claimed.lo).all(), (facts, least.min(), claimed)
            assert (-upwards(-most[known]) <= claimed.hi).all(), (facts, most.max(), claimed)


@pytest.mark.parametrize("name", LOOSE)
@pytest.mark.parametrize("platform", PLATFORMS)
@pytest.mark.parametrize("number", range(len(HABITS)))
def test_no_device_leaves_a_range(name: str, platform: Platform, number: int) -> None:
    row = BUILTINS[name]
    low, high, points = boxes(np.random.default_rng(7), row)
    device = Device(Errors((platform,)), HABITS[number], seed=number)
    with np.errstate(all="ignore"):
        found = computed(device, name, [(device.lane(values),) for values in points])
    for box in range(BOXES):
        ends = zip(low, high, strict=True)
        claimed = row.range(tuple(Fact(float(lo[box]), float(hi[box])) for lo, hi in ends), False)
        values = found[box][np.isfinite(found[box])]
        assert (values >= claimed.lo).all(), (values.min(), claimed)
        assert (values <= claimed.hi).all(), (values.max(), claimed)


def computed(device: Device, name: str, operands: list[tuple[Chosen]]) -> Floats:
    """The results of a builtin, by its definition where its row has one."""
    if name == "asin":
        ((x,),) = operands
        x = device.minimum(device.maximum(x, -1.0), 1.0)
        return np.asarray(device.arctan2(x, device.sqrt(1.0 - x * x)).value)
    (lane,) = evaluate(name, operands, device, "float")
    return np.asarray(device.lane(lane).value)


def upwards(ends: Floats) -> Floats:
    """The least numbers that a device can return which are not below these."""
    nearest = np.float32(ends)
    found = np.where(nearest < ends, np.nextafter(nearest, np.float32(np.inf)), nearest)
    return np.where(np.abs(found) < SMALLEST_NORMAL, 0.0, found).astype(np.float64)


def test_a_normalised_vector_is_of_length_one_on_all_platforms() -> None:
    root_of_squares = 4 * ROUNDING / 2
    by_product = relative(INVERSE_ROOT) + ROUNDING
    by_quotient = ROOT_ERROR + relative(BUILTINS["div"].accuracy)
    assert root_of_squares + max(by_product, by_quotient) < UNIT_SLACK / 4


def test_errors_of_operations_in_turn_multiply() -> None:
    """A device may return the most if each operation has its largest allowed error."""
    one, step = Fact(1.0, 1.0), Fraction(ROUNDING)
    assert highest("dot", one, one) >= 4 * (1 + step) ** 4 * OF_DOUBLES
    quotient = Fraction(relative(BUILTINS["div"].accuracy))
    inverse = Fraction(relative(INVERSE_ROOT))
    assert highest("sqrt", one) >= (1 + quotient) / (1 - inverse) * OF_DOUBLES
    # Where a quotient is off, all of the divisor may be left, and more: 41 of 123 mod 41, say.
    for x, y in ((123.0, 41.0), (1e6, 3.0), (-7.0, 7.0)):
        another = quotient * abs(Fraction(x))
        product = abs(Fraction(x)) + another + Fraction(y)
        left = (Fraction(y) + another + product * step) * (1 + step)
        assert highest("mod", Fact(x, x), Fact(y, y)) >= left * OF_DOUBLES
        assert highest("mod", Fact(x, x), Fact(y, y)) >= y


def highest(name: str, *facts: Fact) -> Fraction:
    return Fraction(BUILTINS[name].range(facts, False).hi)


def test_a_sum_of_products_that_are_flushed_may_be_zero() -> None:
    tiny = Fact(2.0**-63 * 0.9, 2.0**-63)
    assert BUILTINS["dot"].range((tiny, tiny), False).lo <= 0
    short = Fact(0.0, 1.0, length=2.0**-62)
    assert BUILTINS["dot"].range((short, short), True).lo <= 2.0**-124 - 4 * 2.0**-126
