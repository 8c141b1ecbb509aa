"""The level of detail of a read: Vulkan, "Scale Factor Operation, Level-of-Detail Operation"."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .cube import met
from .scene import Floats, Ints
from .texels import Image
from .variants import Variants


def given(image: Image, level: Floats, ways: Variants) -> Floats:
    """A level that a program names, (variants, quads, side, side)."""
    return _limited(image, np.broadcast_arrays(level, np.zeros((1, 1, 1, 1)))[0], ways)


def implicit(image: Image, coordinate: Sequence[Floats], ways: Variants) -> Floats:
    """The level for coordinates in quads of 2 × 2 pixels, (variants, quads, 2, 2) or (…, 1, 1)."""
    if coordinate[0].shape[-1] == 1 or _has_one(image):
        return np.zeros((len(ways), 1, 1, 1))
    level = by_changes(image, coordinate, *_differences(coordinate, ways), ways)
    if image.type.dimension != "cube":
        return level
    # Some devices take the differences between the places on the cube that a quad's pixels meet,
    # and some of those add them up along the axes.
    largest = np.abs(np.stack(coordinate)).max(axis=0)
    surface = [lane / np.maximum(largest, np.finfo(np.float64).tiny) / 2 for lane in coordinate]
    between = _level(image, *_differences(surface, ways), ways)
    return np.where((ways.surface == 1)[:, None, None, None], between, level)


def by_changes(
    image: Image,
    coordinate: Sequence[Floats],
    across: Sequence[Floats],
    down: Sequence[Floats],
    ways: Variants,
) -> Floats:
    """The level where the coordinate changes so much to the right and downwards."""
    if _has_one(image):
        return np.zeros((len(ways), 1, 1, 1))
    if image.type.dimension != "cube":
        return _level(image, across, down, ways)
    where = met(coordinate)
    level = _level(image, where.change(across), where.change(down), ways)
    if not (ways.surface == 2).any():
        return level
    right, below = ([lane / where.out / 2 for lane in lanes] for lanes in (across, down))
    raw = _level(image, right, below, ways)
    return np.where((ways.surface == 2)[:, None, None, None], raw, level)


def _differences(coordinate: Sequence[Floats], ways: Variants) -> tuple[list[Floats], list[Floats]]:
    """Between the columns and between the rows of quads, in each variant's choice of them."""
    across = [_chosen(t[..., :, 1] - t[..., :, 0], ways.row) for t in coordinate]
    down = [_chosen(t[..., 1, :] - t[..., 0, :], ways.column) for t in coordinate]
    return across, down


def _level(
    image: Image, across: Sequence[Floats], down: Sequence[Floats], ways: Variants
) -> Floats:
    """The level where a place in the texture, or on a cube's surface, changes so much."""
    sizes = image.sizes(np.zeros((), dtype=np.int64))
    sizes += sizes[:1] * (len(across) - len(sizes))
    footprint = np.maximum(
        _length([size * lane for size, lane in zip(sizes, across, strict=True)], ways.order),
        _length([size * lane for size, lane in zip(sizes, down, strict=True)], ways.order),
    )
    return _limited(image, np.log2(np.maximum(footprint, np.finfo(np.float64).tiny)), ways)


def _has_one(image: Image) -> bool:
    return image.state["mip"] == "none" or image.levels == 1


def _limited(image: Image, level: Floats, ways: Variants) -> Floats:
    if _has_one(image):
        return np.zeros((len(ways), 1, 1, 1))
    return np.clip(level + ways.level[:, None, None, None], 0, image.levels - 1)


def _chosen(differences: Floats, which: Ints) -> Floats:
    """Each variant's choice (variants, quads, 1, 1) among two differences (…, quads, 2)."""
    shape = (len(which), *differences.shape[-2:])
    chosen: Floats = np.broadcast_to(differences, shape)[
        np.arange(len(which)), :, np.maximum(which, 0)
    ]
    return chosen[..., None, None]


def _length(lanes: Sequence[Floats], order: Floats) -> Floats:
    """The norm of lanes (variants, quads, …), of a variant's own order."""
    sizes = np.abs(np.stack(np.broadcast_arrays(*lanes)))
    order = order[:, None, None, None]
    euclidean = np.sqrt((sizes * sizes).sum(axis=0))
    length: Floats = np.where(
        order == 2, euclidean, np.where(order == 1, sizes.sum(axis=0), sizes.max(axis=0))
    )
    return length
