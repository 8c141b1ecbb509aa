"""The bounds of a read contain all that a device may read, and are not much wider than that.

Devices are made up: they read exactly, but at random places within the bounds of a coordinate, with
random weights and levels that their bits allow.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.ir.leaves import Texture
from burnish.compiler.ir.types import TextureType
from burnish.compiler.reference.bounds import Bounded, exact
from burnish.compiler.reference.picture.sampler import TextureReader
from burnish.compiler.reference.picture.scene import RasterRules, Texels
from burnish.compiler.reference.picture.texels import Image

from .reads import DEFAULTS, DEVICE, RULES, Read

Array = NDArray[np.float64]

SUBTEXEL, MIP = 2.0**-8, 2.0**-8
QUADS = 60
TRIES = 40


def textures(
    dimension: Any, *, size: int = 8, rules: RasterRules = DEVICE, **state: str
) -> tuple[Read, Read]:
    """A texture of random texels as a device reads it, and as it is read exactly."""
    random = np.random.default_rng(7)
    levels = []
    while size:
        shape = {"cube": (6, size, size), "3d": (size, size, size)}.get(dimension, (size, size))
        levels.append(random.uniform(-1, 1, (*shape, 4)))
        size //= 2
    states = {"filter": "linear", "mip": "linear", "wrap": "repeat", **state}
    exact_rules = RasterRules(
        1, 1, level_power=rules.level_power, projects_cubes=rules.projects_cubes
    )
    device, ideal = (
        Read(dimension, "float", *levels, rules=each, **states) for each in (rules, exact_rules)
    )
    return device, ideal


def around(values: Array, off: float, random: np.random.Generator) -> Bounded:
    """Lanes whose intervals contain these values somewhere, and are about so wide."""
    return Bounded(
        values,
        values - off * random.uniform(0, 1, values.shape),
        values + off * random.uniform(0, 1, values.shape),
    )


def somewhere(lane: Bounded, random: np.random.Generator) -> Array:
    """A value that a device may have: often one of the ends."""
    share = np.clip(random.uniform(-0.5, 1.5, np.shape(lane.value)), 0, 1)
    found: Array = lane.low + share * (lane.high - lane.low)
    return found


class Seen:
    """The results of one read on devices, beside its bounds."""

    def __init__(self, lanes: tuple[Bounded, ...]) -> None:
        shape = lanes[0].shape
        self.low, self.high = (
            np.stack([np.broadcast_to(getattr(lane, end), shape) for lane in lanes])
            for end in ("low", "high")
        )
        self.value = np.stack([np.broadcast_to(lane.value, shape) for lane in lanes])
        self._least, self._greatest = self.value.copy(), self.value.copy()

    def see(self, lanes: tuple[Bounded, ...]) -> None:
        """Check that what a device reads is within the bounds."""
        read = np.stack([np.broadcast_to(lane.value, self.low.shape[1:]) for lane in lanes])
        assert (read >= self.low).all()
        assert (read <= self.high).all()
        self._least = np.minimum(self._least, read)
        self._greatest = np.maximum(self._greatest, read)

    @property
    def excess(self) -> float:
        """The width of the bounds divided by the width of the results, in the median."""
        seen = self._greatest - self._least
        return float(np.median((self.high - self.low)[seen > 0] / seen[seen > 0]))


def places(dimension: str, off: float, random: np.random.Generator) -> tuple[Bounded, ...]:
    """Coordinates in quads, about a texel apart; of a cube, directions."""
    count = 2 if dimension == "2d" else 3
    start = random.uniform(-1.5, 1.5, (count, QUADS, 1, 1))
    right, below = random.uniform(-0.2, 0.2, (2, count, QUADS, 1, 1))
    steps = np.array([0, 1])
    found = start + right * steps + below * steps[:, None]
    return tuple(around(lane, off, random) for lane in found)


@pytest.mark.parametrize("off", [1e-6, 1e-3, 0.03])
@pytest.mark.parametrize(
    ("dimension", "wrap"), [("2d", "repeat"), ("2d", "mirror"), ("3d", "clamp"), ("cube", "repeat")]
)
def test_filtered_reads_of_a_level(dimension: str, wrap: str, off: float) -> None:
    random = np.random.default_rng(int(1e6 * off))
    device, ideal = textures(dimension, wrap=wrap)
    where = places(dimension, off, random)
    level = around(random.uniform(-0.5, 3.5, (QUADS, 2, 2)), off, random)
    seen = Seen(device.reader.read("sample_level", (where, (level,))))
    for _ in range(TRIES):
        lanes = [somewhere(x, random) for x in where]
        if dimension != "cube":
            # A step of the largest level, the first one, is allowed in all of them.
            lanes = [x + SUBTEXEL / 8 * random.uniform(-1, 1, x.shape) for x in lanes]
        steps = somewhere(level, random) / MIP
        tried = np.where(random.uniform(0, 1, steps.shape) < 0.5, np.floor(steps), np.ceil(steps))
        seen.see(ideal.reader.read("sample_level", (_exact(lanes), (exact(tried * MIP),))))
    assert seen.excess < (6 if off > 1e-5 else 60)


def _exact(lanes: Iterable[Array]) -> tuple[Bounded, ...]:
    return tuple(map(exact, lanes))


@pytest.mark.parametrize("off", [1e-6, 1e-3, 0.03])
@pytest.mark.parametrize("mip", ["none", "nearest", "linear"])
@pytest.mark.parametrize("dimension", ["2d", "3d", "cube"])
def test_nearest_reads_of_a_level(dimension: str, mip: str, off: float) -> None:
    random = np.random.default_rng(int(1e6 * off))
    device, ideal = textures(dimension, filter="nearest", mip=mip)
    where = places(dimension, off, random)
    level = around(random.uniform(-0.5, 3.5, (QUADS, 2, 2)), off, random)
    seen = Seen(device.reader.read("sample_level", (where, (level,))))
    for _ in range(TRIES):
        lanes = _exact(somewhere(x, random) for x in where)
        seen.see(ideal.reader.read("sample_level", (lanes, (exact(somewhere(level, random)),))))


@pytest.mark.parametrize("off", [1e-6, 1e-3])
@pytest.mark.parametrize("dimension", ["2d", "3d", "cube"])
@pytest.mark.parametrize("level_power", [None, 2])
def test_reads_of_the_level_that_follows_from_differences(
    dimension: str, level_power: int | None, off: float
) -> None:
    rules = RasterRules(1, 1, subtexel_bits=8, mip_bits=8, level_power=level_power)
    random = np.random.default_rng(int(1e6 * off))
    device, ideal = textures(dimension, size=16, rules=rules)
    where = places(dimension, off, random)
    seen = Seen(device.reader.read("sample", (where,)))
    for _ in range(TRIES):
        lanes = np.stack([somewhere(x, random) for x in where])
        row, column = random.integers(0, 2, 2)
        across = (lanes[..., 1] - lanes[..., 0])[..., row][..., None, None]
        down = (lanes[..., 1, :] - lanes[..., 0, :])[..., column][..., None, None]
        operands = tuple(map(_exact, (lanes, across, down)))
        seen.see(ideal.reader.read("sample_grad", operands))


@pytest.mark.parametrize("order", [1, 2, np.inf])
def test_a_step_has_any_length_from_its_largest_lane_to_their_sum(order: float) -> None:
    random = np.random.default_rng(3)
    device, ideal = textures("2d", size=16)
    where = tuple(exact(lane.value) for lane in places("2d", 0, random))
    seen = Seen(device.reader.read("sample", (where,)))
    lanes = np.stack([x.value for x in where])
    across, down = lanes[..., :1, 1:] - lanes[..., :1, :1], lanes[..., 1:, :1] - lanes[..., :1, :1]
    length = np.maximum(*(np.linalg.norm(16 * x, order, axis=0) for x in (across, down)))
    seen.see(ideal.reader.read("sample_level", (where, (exact(np.log2(length)),))))


@pytest.mark.parametrize("off", [1e-6, 1e-3, 0.03])
@pytest.mark.parametrize("dimension", ["2d", "cube"])
def test_gathered_texels(dimension: str, off: float) -> None:
    random = np.random.default_rng(int(1e6 * off))
    device, ideal = textures(dimension)
    where = places(dimension, off, random)
    seen = Seen(device.reader.read("gather", (where, (2,))))
    for _ in range(TRIES):
        lanes = _exact(somewhere(x, random) for x in where)
        seen.see(ideal.reader.read("gather", (lanes, (2,))))


@pytest.mark.parametrize("off", [1e-6, 1e-3, 0.03])
@pytest.mark.parametrize("filter_", ["nearest", "linear"])
@pytest.mark.parametrize("dimension", ["2d", "cube"])
def test_comparisons(dimension: Any, filter_: str, off: float) -> None:
    random = np.random.default_rng(int(1e6 * off))
    shape = (6, 8, 8, 1) if dimension == "cube" else (8, 8, 1)
    depths = np.float32(random.uniform(0, 1, shape)).astype(np.float64)
    state = {"filter": filter_, "mip": "none", "wrap": "repeat", "compare": "less"}
    device, ideal = (
        Read(dimension, "depth", depths, rules=rules, **state) for rules in (DEVICE, RULES)
    )
    where = places(dimension, off, random)
    reference = around(random.uniform(0, 1, (QUADS, 2, 2)), off, random)
    seen = Seen(device.reader.read("compare", (where, (reference,))))
    for _ in range(TRIES):
        lanes = _exact(somewhere(x, random) for x in where)
        given = exact(somewhere(reference, random))
        seen.see(ideal.reader.read("compare", (lanes, (given,))))


@pytest.mark.parametrize(
    ("depths", "low", "high"),
    [((0.2, 0.2, 0.2), 0, 0), ((0.8, 0.8, 0.8), 1, 1), ((0.2, 0.8, 0.8), 0.5, 0.75)],
)
def test_a_depth_beyond_a_cubes_corner_may_be_any_unless_all_three_are_the_same(
    depths: tuple[float, float, float], low: float, high: float
) -> None:
    """Devices take the mean of the three results, or that of the depths, or something else."""
    texels = np.zeros((6, 1, 1, 1))
    texels[[0, 2, 4], 0, 0, 0] = depths
    state = {"filter": "linear", "mip": "none", "wrap": "clamp", "compare": "less"}
    device = Read("cube", "depth", texels, rules=DEVICE, **state)
    corner = tuple(exact(np.array([1.0])) for _ in range(3))
    (read,) = device.reader.read("compare", (corner, (exact(np.array([0.5])),)))
    assert read.low[0] == pytest.approx(low, abs=0.02)
    assert read.high[0] == pytest.approx(high, abs=0.02)


def test_a_coordinate_that_is_anything_reads_anything() -> None:
    device, _ = textures("2d", mip="none")
    low, high = device.hull("sample", (Bounded(np.nan, np.nan, np.nan), 0.5))
    image = device.reader._image
    assert (low, high) == pytest.approx((image.hull(np.zeros(1, int))[0][0, 0],
                                         image.hull(np.zeros(1, int))[1][0, 0]))  # fmt: skip


@pytest.mark.parametrize("implicit", [False, True])
def test_a_cube_reads_anything_in_the_direction_zero(implicit: bool) -> None:
    """No API says what a device reads there, nor in which level its neighbours read."""
    device, _ = textures("cube")
    direction = np.array([[[1.0, 0.0], [0.3, 0.5]], [[1.0, 0.4], [0.3, 0.5]]])
    lanes = tuple(exact(scale * direction) for scale in (1.0, 0.5, -0.2))
    operands = (lanes,) if implicit else (lanes, (exact(0.0),))
    found = device.reader.read("sample" if implicit else "sample_level", operands)
    level = np.zeros(1, dtype=int)
    least, greatest = (end[0, 0] for end in device.reader._image.hull(level, every_level=True))
    widths = found[0].high - found[0].low
    assert (found[0].low[0, 0, 1], found[0].high[0, 0, 1]) == (least, greatest)
    assert (widths[0] == greatest - least).all()
    assert (widths[1] < 0.9 * (greatest - least)).all()


def test_a_texture_of_one_colour() -> None:
    """The weights of a filter add up to 1, but for rounding; black and single texels are exact."""
    texel = np.array([1.0, 1.0, 0.5, 0.0])
    for filter_, off in (("linear", 1e-6), ("nearest", 0.0)):
        plain = Read(
            "2d", "float", np.tile(texel, (4, 4, 1)), rules=DEVICE, filter=filter_, mip="none"
        )
        lanes = plain.reader.read("sample", ((exact(np.full((5, 2, 2), 0.3)), exact(0.5)),))
        assert [float(lane.value) for lane in lanes] == texel.tolist()
        assert all(lane.high - lane.low <= 2 * off * lane.value for lane in lanes)
        assert all((lane.low < lane.high) == (off * lane.value > 0) for lane in lanes)


def test_a_device_decodes_srgb_to_within_half_a_step() -> None:
    """Encoded, the bounds are half a step to either side; alpha is not encoded."""
    codes = np.arange(256) / 255
    linear = np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)
    resource = Texture("t", TextureType("2d", "float"), "material", state=tuple(DEFAULTS.items()))
    for code in range(256):
        texel = np.array([[[linear[code], 0.0, 1.0, codes[code]]]])
        reader = TextureReader(Image(Texels((texel,), is_srgb=True), resource, DEVICE))
        red, green, blue, alpha = reader.read("load", ((0, 0), (0,)))
        half = 0.5 / 255
        for lane, encoded in ((red, codes[code]), (green, 0.0), (blue, 1.0)):
            ends = np.array([lane.low, lane.high]).ravel()
            found = np.where(ends <= 0.0031308, ends * 12.92,
                             1.055 * np.maximum(ends, 0) ** (1 / 2.4) - 0.055)  # fmt: skip
            assert found[0] <= max(encoded - half, 0)
            assert encoded + half <= found[1] <= encoded + 1.2 * half
        assert alpha.high - alpha.low < 1e-6
