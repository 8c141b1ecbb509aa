"""The level that a footprint leads to, and how precise the results of filters are."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest

from burnish.compiler.ir.leaves import Texture
from burnish.compiler.ir.types import TextureType
from burnish.compiler.reference.bounds import exact
from burnish.compiler.reference.picture.sampler import TextureReader
from burnish.compiler.reference.picture.scene import Footprint, RasterRules, Stored, Texels
from burnish.compiler.reference.picture.texels import Image

from .reads import DEFAULTS, Read, steps

Step = tuple[float, float]

ERROR = 2.0**-6
SLACK = 1e-4
LINEAR = {"filter": "linear", "mip": "linear", "wrap": "repeat"}


def level(footprint: Footprint, across: Step, down: Step) -> tuple[float, float]:
    """The ends of the level for two steps, in texels of eight."""
    rules = RasterRules(1, 1, subtexel_bits=8, mip_bits=8, lod_error=ERROR, footprint=footprint)
    read = Read("2d", "float", *steps(), rules=rules, **LINEAR)
    first, second = ((x / 8, y / 8) for x, y in (across, down))
    return read.hull("sample_grad", (0.3, 0.7), first, second)


def singular(across: Step, down: Step) -> float:
    """The logarithm of the longer axis of the ellipse that two steps span."""
    return float(np.log2(np.linalg.norm(np.array([across, down]), 2)))


@pytest.mark.parametrize(
    ("across", "down"),
    [
        ((2.0, 0.0), (0.0, 2.0)),
        ((2.0, 0.0), (1.5, 0.5)),
        ((1.0, 2.0), (-2.0, 1.0)),
        ((1.0, 2.0), (1.0, 2.0)),
        ((2.0, 1.0), (2.0, -0.75)),
        ((3.0, 0.5), (0.0, 0.0)),
    ],
)
def test_a_level_is_between_the_longer_step_and_the_axis_of_the_ellipse(
    across: Step, down: Step
) -> None:
    longer = float(np.log2(max(np.hypot(*across), np.hypot(*down))))
    low, high = level("ellipse", across, down)
    assert low == pytest.approx(longer - ERROR, abs=SLACK)
    assert high == pytest.approx(singular(across, down) + ERROR, abs=SLACK)
    # Where the steps are known, the longer one counts; where nothing is, all of this may be.
    assert level("euclidean", across, down) == pytest.approx(
        (longer - ERROR, longer + ERROR), abs=SLACK
    )
    widest = level("any", across, down)
    assert widest[0] <= low
    assert widest[1] >= high - SLACK


def test_the_ellipse_of_steps_with_bounds_contains_those_of_all_steps_in_them() -> None:
    random = np.random.default_rng(5)
    rules = RasterRules(1, 1, subtexel_bits=8, mip_bits=8, lod_error=0.0, footprint="ellipse")
    read = Read("2d", "float", *steps(), rules=rules, **LINEAR)
    for _ in range(20):
        ends = np.sort(random.uniform(-2, 2, (2, 4, 2)) / 8, axis=-1)[0]
        lanes = [_between(*pair) for pair in ends]
        low, high = read.hull("sample_grad", (0.3, 0.7), tuple(lanes[:2]), tuple(lanes[2:]))
        for _ in range(20):
            across, down = random.uniform(ends[:, 0], ends[:, 1]).reshape(2, 2) * 8
            assert (
                low - SLACK <= np.clip(singular(tuple(across), tuple(down)), 0, 3) <= high + SLACK
            )


def _between(low: float, high: float) -> Any:
    lane = exact(np.float64((low + high) / 2))
    return type(lane)(lane.value, np.float64(low), np.float64(high))


def _width(stored: Stored, rules: RasterRules, filter_: str = "linear") -> float:
    """The width of the bounds of a read half way between four texels that are nearly the same."""
    texels = np.full((2, 2, 4), 0.5)
    texels[0, 0] = 0.5 + 2.0**-20
    state = tuple(sorted({**DEFAULTS, "filter": filter_, "mip": "none"}.items()))
    resource = Texture("t", TextureType("2d", "float"), "material", state=state)
    reader = TextureReader(Image(Texels((texels,), stored=stored), resource, rules))
    (lane, *_) = reader.read("sample", ((exact(np.full((1, 1, 1), 0.5)), exact(0.5)),))
    return float((lane.high - lane.low).max())


@pytest.mark.parametrize(
    ("stored", "rule", "blends"), [("fixed", 10, 1), ("half", 10, 2), ("float", 10, 2)]
)
def test_a_result_is_as_precise_as_the_format_is_filtered(
    stored: Stored, rule: int, blends: int
) -> None:
    given: dict[str, Any] = {f"{stored}_bits": rule}
    rules = RasterRules(1, 1, subtexel_bits=8, **given)
    step = 2.0**-rule if stored == "fixed" else 0.5 * 2.0**-rule
    assert _width(stored, rules) == pytest.approx(2 * blends * step, rel=0.01)
    # Texels that are not blended are read as they are, and the other formats are not concerned.
    assert _width(stored, rules, "nearest") < 1e-5
    assert all(_width(other, rules) < 1e-5 for other in get_args(Stored) if other != stored)


@pytest.mark.parametrize("dimension", ["2d", "3d"])
def test_weights_of_texels_may_be_rounded_while_those_along_an_axis_stay(dimension: Any) -> None:
    """A device rounds the weight of the last texel, and gives the rest to its neighbours."""
    random = np.random.default_rng(4)
    axes = int(dimension[0])
    texels = random.uniform(-1, 1, (*(2,) * axes, 4))
    rules = RasterRules(1, 1, subtexel_bits=30, product_bits=6)
    read = Read(dimension, "float", texels, rules=rules, filter="linear", mip="none")
    widest = 0.0
    for _ in range(50):
        shares = random.uniform(0, 1, axes)
        low, high = read.hull("sample_level", tuple(0.25 + shares / 2), 0)
        weights = _weights(shares, 2.0**-6)
        device = sum(w * texels[place][0] for place, w in weights.items())
        assert low - 1e-6 <= device <= high + 1e-6
        widest = max(widest, high - low)
    assert widest < 3 * 2 * 2.0**-6 * 4


def _weights(shares: Any, step: float) -> dict[tuple[int, ...], float]:
    """The weights of texels by their place, the one along the first axis last."""
    found: dict[tuple[int, ...], float] = {(): 1.0}
    for share in shares:
        wider: dict[tuple[int, ...], float] = {}
        parts = {place: np.rint(share * w / step) * step for place, w in found.items()}
        last = max(found)
        parts[last] = share - sum(w for place, w in parts.items() if place != last)
        for place, w in found.items():
            wider[(0, *place)], wider[(1, *place)] = w - parts[place], parts[place]
        found = wider
    return found


def test_a_result_in_fixed_point_is_between_0_and_1() -> None:
    texels = np.zeros((2, 2, 4))
    texels[0] = 1.0
    state = tuple(sorted({**DEFAULTS, "filter": "linear", "mip": "none"}.items()))
    resource = Texture("t", TextureType("2d", "float"), "material", state=state)
    rules = RasterRules(1, 1, subtexel_bits=8, fixed_bits=4)
    reader = TextureReader(Image(Texels((texels,), stored="fixed"), resource, rules))
    rows = exact(np.array([0.1, 0.9]).reshape(2, 1, 1))
    lane = reader.read("sample", ((exact(0.5), rows),))[0]
    assert lane.high.max() <= 1.0 + 1e-6
    assert lane.low.min() >= -1e-6
    assert (lane.high - lane.low >= 1 / 16).all()


def test_reading_exactly_leaves_only_what_decides_the_meaning() -> None:
    rules = RasterRules(
        1, 1, subtexel_bits=8, mip_bits=8, lod_error=0.1, fixed_bits=6, half_bits=8, float_bits=8,
        mixing_bits=8, footprint="ellipse", level_power=2,
    )  # fmt: skip
    assert rules.reading_exactly == RasterRules(1, 1, footprint="ellipse", level_power=2)
