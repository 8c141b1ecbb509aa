"""A device that filters textures as NVIDIA's do, simulated by the reference.

It was made after what an H200 draws (driver 580.159.04, by Vulkan, wgpu and OpenGL). Weights along
an axis are rounded to 1/256, and so are their products, the weights of texels. Levels follow from
the longer axis of the ellipse that both steps span, which is known only roughly, and are cut off to
1/256. Results have 16 bits. While ``sampling`` lasts, the reference reads textures like that, if it
draws without bounds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.bounds import Bounded, exact
from burnish.compiler.reference.picture import blending, filtering, levels, texels
from burnish.compiler.reference.picture.levels import CoordinateSteps
from burnish.compiler.reference.picture.scene import Floats
from burnish.compiler.reference.picture.texels import Image

WEIGHTS = 256.0
"""The number of weights between two texels or levels."""
FIXED = 65535.0
"""The steps of a result over texels in fixed point."""
MANTISSA = 16
"""The binary places of a result over floats."""
BELOW_AXIS, ABOVE_AXIS = 38 / 256, 22.5 / 256
"""How far below and above the logarithm of the ellipse's axis the level was seen."""
BELOW_STEP, BELOW_LANE, ABOVE_SUM = 22 / 256, 6 / 256, 1.5 / 256
"""How far below the longer step, and its largest lane, and above the sums of the lanes."""


def _lanes(values: Sequence[Bounded], sizes: Sequence[Any]) -> Floats:
    return np.stack(np.broadcast_arrays(*(x.value * n for x, n in zip(values, sizes, strict=True))))


def level(across: Floats, down: Floats) -> Floats:
    """The level for two steps in texels, (lanes, …)."""
    squares = [(step * step).sum(axis=0) for step in (across, down)]
    mixed = (across * down).sum(axis=0)
    axis = np.sqrt((sum(squares) + np.hypot(squares[0] - squares[1], 2 * mixed)) / 2)
    longer = np.sqrt(np.maximum(*squares))
    lane = np.maximum(np.abs(across).max(axis=0), np.abs(down).max(axis=0))
    diagonal = np.hypot(np.abs(across).sum(axis=0), np.abs(down).sum(axis=0))
    roughly = np.sin(40 * np.log2(_some(axis)) + 5 * mixed / _some(axis * axis))
    off = np.where(roughly > 0, ABOVE_AXIS, BELOW_AXIS) * roughly
    found = np.log2(_some(axis)) + off
    found = np.maximum(found, np.log2(_some(longer)) - BELOW_STEP)
    found = np.maximum(found, np.log2(_some(lane)) - BELOW_LANE)
    found = np.minimum(found, np.log2(_some(diagonal)) + ABOVE_SUM)
    return np.asarray(found)


def _some(length: Floats) -> Floats:
    return np.maximum(length, 2.0**-60)


def _of_steps(image: Image, steps: CoordinateSteps) -> Bounded:
    sizes = image.first_sizes
    found = level(_lanes(steps.across, sizes), _lanes(steps.down, sizes))
    return exact(np.clip(found, 0, image.levels - 1))


def _weight(share: Bounded, *, of_levels: bool) -> Bounded:
    scaled = share.value * WEIGHTS
    return exact((np.floor(scaled) if of_levels else np.floor(scaled + 0.5)) / WEIGHTS)


def _blended(
    corners: Sequence[Bounded],
    shares: Sequence[Bounded],
    _error: float | None,
    _product: float = 0.0,
) -> Bounded:
    of_levels = len(corners) == 2
    given = [_weight(share, of_levels=of_levels).value for share in shares]
    if of_levels:
        return _EXACTLY(corners, list(map(exact, given)), None)
    weights = _rounded_weights(np.broadcast_arrays(*given))
    return exact(np.asarray(sum(w * c.value for w, c in zip(weights, corners, strict=True))))


def _rounded_weights(shares: Sequence[Floats]) -> list[Floats]:
    """The weights of all texels, rounded so that those along each axis stay what they are."""
    if len(shares) == 1:
        return [1.0 - shares[0], shares[0]]
    first, *others = shares
    rest = _rounded_weights(others)
    second = [np.floor(first * weight * WEIGHTS + 0.5) / WEIGHTS for weight in rest[1:]]
    second.insert(0, first - sum(second))
    return [a - b for a, b in zip(rest, second, strict=True)] + second


_EXACTLY = blending.blended


def _kept(reader: Any, found: Bounded, blends_levels: bool) -> Bounded:
    if not blends_levels and reader._kind != "linear":
        return found
    value, stored = found.value, reader._image.stored
    if stored == "fixed":
        return exact(np.rint(value * FIXED) / FIXED)
    if stored == "half":
        return exact(value.astype(np.float16).astype(np.float64))
    mantissa, exponent = np.frexp(value)
    return exact(np.ldexp(np.rint(np.ldexp(mantissa, MANTISSA)), exponent - MANTISSA))


Change = Callable[[pytest.MonkeyPatch], None]


@dataclass(frozen=True)
class Wrong:
    """An error of a simulated device."""

    name: str
    change: Change = field(repr=False)

    def __str__(self) -> str:
        return self.name


@contextmanager
def sampling(wrong: Wrong | None = None) -> Iterator[None]:
    """Have the reference read textures as the device does, perhaps with an error besides."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(levels, "of_steps", _of_steps)
        patch.setattr(filtering, "blended", _blended)
        patch.setattr(filtering.Filter, "_kept", _kept)
        if wrong is not None:
            wrong.change(patch)
        yield


def _other_level(patch: pytest.MonkeyPatch) -> None:
    def higher(image: Image, steps: CoordinateSteps) -> Bounded:
        found = _of_steps(image, steps).value + 1
        return exact(np.clip(found, 0, image.levels - 1))

    patch.setattr(levels, "of_steps", higher)


def _half_a_texel(patch: pytest.MonkeyPatch) -> None:
    own = filtering.Filter._in_texels

    def moved(reader: Any, lane: Bounded, size: Any) -> Bounded:
        return exact(own(reader, lane, size).value + 0.5)

    patch.setattr(filtering.Filter, "_in_texels", moved)


def _other_wrap(patch: pytest.MonkeyPatch) -> None:
    others = {"repeat": "clamp", "clamp": "repeat", "mirror": "repeat"}
    own = texels._wrapped
    patch.setattr(texels, "_wrapped", lambda i, size, wrap: own(i, size, others[wrap]))


def _swapped_lanes(patch: pytest.MonkeyPatch) -> None:
    def swapped(reader: Any, found: Bounded, blends_levels: bool) -> Bounded:
        value = _kept(reader, found, blends_levels).value
        return exact(value[[2, 1, 0, 3]] if len(value) == 4 else value)

    patch.setattr(filtering.Filter, "_kept", swapped)


WRONG = (
    Wrong("a level too high", _other_level),
    Wrong("half a texel too far", _half_a_texel),
    Wrong("another wrap", _other_wrap),
    Wrong("red and blue swapped", _swapped_lanes),
)
"""The errors that are planted."""
