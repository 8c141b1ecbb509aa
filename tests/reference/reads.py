"""Reads a texture at single places, for tests of the reference's sampler."""

from __future__ import annotations

from typing import Any

import numpy as np

from burnish.compiler.ir.leaves import Texture
from burnish.compiler.ir.types import Dimension, Sample, TextureType
from burnish.compiler.reference.bounds import Bounded, exact
from burnish.compiler.reference.picture.sampler import TextureReader
from burnish.compiler.reference.picture.scene import RasterRules, Texels
from burnish.compiler.reference.picture.texels import Image

RULES = RasterRules(1, 1)
DEVICE = RasterRules(1, 1, subtexel_bits=8, mip_bits=8)
DEFAULTS = {"filter": "nearest", "mip": "nearest", "wrap": "clamp"}


class Read:
    """A texture that is read at single places."""

    def __init__(
        self,
        dimension: Dimension,
        sample: Sample,
        *levels: Any,
        rules: RasterRules = RULES,
        **state: str,
    ) -> None:
        whole = tuple(sorted({**DEFAULTS, **state}.items()))
        resource = Texture("t", TextureType(dimension, sample), "material", state=whole)
        arrays = tuple(np.asarray(level) for level in levels)
        self.reader = TextureReader(Image(Texels(arrays), resource, rules))

    def __call__(self, name: str, *operands: Any) -> list[Any]:
        """The exact lanes of a read."""
        return [
            np.ravel(lane.value if isinstance(lane, Bounded) else lane)[0].item()
            for lane in self.reader.read(name, tuple(map(_lanes, operands)))
        ]

    def hull(self, name: str, *operands: Any) -> tuple[float, float]:
        """The two numbers between which the first lane of a read may be."""
        lane = self.reader.read(name, tuple(map(_lanes, operands)))[0]
        return float(np.ravel(lane.low)[0]), float(np.ravel(lane.high)[0])


def _lanes(operand: Any) -> Any:
    """Whole numbers are constants; all else differs from pixel to pixel, of which there is one."""
    if isinstance(operand, int):
        return (operand,)
    given = operand if isinstance(operand, tuple) else (operand,)
    return tuple(_lane(lane) for lane in given)


def _lane(lane: Any) -> Any:
    if isinstance(lane, Bounded):
        return lane.spread((1, 1, 1))
    return exact(np.full((1, 1, 1), lane))


def near(value: float, off: float) -> Bounded:
    """A lane that may be off by so much."""
    return Bounded(np.float64(value), np.float64(value - off), np.float64(value + off))


def numbered(*shape: int) -> Any:
    """Texels whose first lane counts them, and whose others are that and 1000, 2000, 3000."""
    lanes = np.array([0.0, 1000.0, 2000.0, 3000.0])
    return np.arange(np.prod(shape)).reshape(*shape, 1) + lanes


def steps(layers: tuple[int, ...] = ()) -> list[Any]:
    """Four levels that tell their own numbers."""
    return [np.full((*layers, 8 >> n, 8 >> n, 4), float(n)) for n in range(4)]
