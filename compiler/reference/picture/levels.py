"""Computes the level of detail of a texture read, for the sampler.

Source: Vulkan, "Scale Factor Operation, Level-of-Detail Operation".
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .cube import met
from .scene import Floats, Ints
from .texels import Image
from .variants import Variants

_TINY = 2.0**-60
"""The least change from pixel to pixel: smaller ones do not change the level."""


def given(image: Image, level: Floats, ways: Variants) -> Floats:
    """The level that a program names, (variants, quads, side, side)."""
    return _limited(image, np.broadcast_arrays(level, np.zeros((1, 1, 1, 1)))[0], ways)


def implicit(image: Image, coordinate: Sequence[Floats], ways: Variants) -> Floats:
    """The level for coordinates in quads of 2 × 2 pixels, (variants, quads, 2, 2) or (…, 1, 1)."""
    if coordinate[0].shape[-1] == 1 or has_one(image):
        return np.zeros((len(ways), 1, 1, 1))
    if image.type.dimension != "cube" or image.rules.projects_cubes:
        return by_changes(image, coordinate, *_differences(coordinate, ways), ways)
    largest = _at_least_tiny(np.abs(np.stack(coordinate)).max(axis=0))
    surface = [lane / largest / 2 for lane in coordinate]
    return _on_surface(image, *_differences(surface, ways), ways)


def by_changes(
    image: Image,
    coordinate: Sequence[Floats],
    across: Sequence[Floats],
    down: Sequence[Floats],
    ways: Variants,
) -> Floats:
    """The level if the coordinate changes by this much to the right and downwards."""
    if has_one(image):
        return np.zeros((len(ways), 1, 1, 1))
    if image.type.dimension != "cube":
        return _level(image, across, down, ways)
    where = met(coordinate)
    if image.rules.projects_cubes:
        return _level(image, where.change(across), where.change(down), ways)
    row = slice(-1, None) if image.rules.bottom_up else slice(1)
    out = where.out[..., row, :1]
    right, below = ([lane / out / 2 for lane in lanes] for lanes in (across, down))
    return _on_surface(image, right, below, ways)


def _differences(coordinate: Sequence[Floats], ways: Variants) -> tuple[list[Floats], list[Floats]]:
    """Differences between columns and between rows of quads; each variant chooses which ones."""
    across = [_chosen(t[..., :, 1] - t[..., :, 0], ways.row) for t in coordinate]
    down = [_chosen(t[..., 1, :] - t[..., 0, :], ways.column) for t in coordinate]
    return across, down


def _level(
    image: Image, across: Sequence[Floats], down: Sequence[Floats], ways: Variants
) -> Floats:
    """The level if the coordinate changes by this much, in units of the texture or face."""
    sizes = image.sizes(np.zeros((), dtype=np.int64))
    right, below = (
        _length([size * lane for size, lane in zip(sizes, lanes, strict=True)], ways.order)
        for lanes in (across, down)
    )
    footprint = np.maximum(right, below)
    power = image.rules.level_power
    exact = np.log2(_at_least_tiny(footprint))
    level = exact if power is None else _rough_logarithm(footprint, power)
    return _limited(image, level, ways)


def _on_surface(
    image: Image, across: Sequence[Floats], down: Sequence[Floats], ways: Variants
) -> Floats:
    """The level if a point on a cube's surface moves by this much, along three axes.

    Vulkan does not define this. SwiftShader adds the two axes with the largest changes, takes the
    logarithm from the bits of the square, and scales the gradients of a quad like those of its
    first pixel.
    """
    size = image.sizes(np.zeros((), dtype=np.int64))[0]
    changes = (np.abs(np.stack(np.broadcast_arrays(*lanes))) for lanes in (across, down))
    right, below = (size * (lanes.sum(axis=0) - lanes.min(axis=0)) for lanes in changes)
    return _limited(image, _rough_logarithm(np.maximum(right, below), 2), ways)


def _rough_logarithm(footprint: Floats, power: int) -> Floats:
    """The logarithm from a power's bits, which is too small by up to 0.086 divided by that power.

    A float's exponent is the integer part of its logarithm, and its mantissa is roughly the rest.
    """
    mantissa, exponent = np.frexp(_at_least_tiny(footprint) ** power)
    rough: Floats = (exponent + 2 * mantissa - 2) / power
    return rough


def _at_least_tiny(number: Floats) -> Floats:
    """The number, but not zero, so that one can divide by it or take its logarithm."""
    return np.maximum(number, _TINY)


def has_one(image: Image) -> bool:
    """Whether all reads use the same level."""
    return image.state["mip"] == "none" or image.levels == 1


def _limited(image: Image, level: Floats, ways: Variants) -> Floats:
    if has_one(image):
        return np.zeros((len(ways), 1, 1, 1))
    return np.clip(level + ways.level[:, None, None, None], 0, image.levels - 1)


def _chosen(differences: Floats, which: Ints) -> Floats:
    """Each variant's choice (variants, quads, 1, 1) between two differences (…, quads, 2)."""
    shape = (len(which), *differences.shape[-2:])
    chosen: Floats = np.broadcast_to(differences, shape)[
        np.arange(len(which)), :, np.maximum(which, 0)
    ]
    return chosen[..., None, None]


def _length(lanes: Sequence[Floats], order: Floats) -> Floats:
    """The norm of lanes (variants, quads, …), with each variant's order."""
    sizes = np.abs(np.stack(np.broadcast_arrays(*lanes)))
    order = order[:, None, None, None]
    euclidean = np.sqrt((sizes * sizes).sum(axis=0))
    length: Floats = np.where(
        order == 2, euclidean, np.where(order == 1, sizes.sum(axis=0), sizes.max(axis=0))
    )
    return length
