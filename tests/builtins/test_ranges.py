"""Range rules allow for what any platform may return, as the rows of ``accuracy.py`` promise it."""

from __future__ import annotations

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

BOXES, POINTS = 160, 12
LARGEST = {"tanh": 16.0}
"""Where expansions begin; elsewhere 300. Far beyond, sines are off by more, but not above 1."""
VECTORS = {"dot": 4, "length": 4, "distance": 4, "cross": 3, "normalize": 4, "reflect": 4}
LOOSE = {"smoothstep", "asin", "tan"}
"""Bounds forget that two factors depend on each other, that a root is never negative, or that only
one end of a quotient is large."""
OF_FLOATS = [
    row
    for row in BUILTINS.values()
    if row.range is not anything
    and row.name not in LOOSE
    and (row.name in VECTORS or any(set(s) <= set("TNS ,->") for s in row.signatures))
]

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
