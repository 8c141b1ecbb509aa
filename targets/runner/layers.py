"""Pictures whose layers are draws of their own, and the picture that is made of these.

``runner.py`` has drivers draw the layers, and ``reference.py`` draws them itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...compiler.reference.picture import Expected
from .drivers.draws import Draw
from .drivers.frame_job import Picture

Floats = NDArray[np.float64]


def single_draws(draw: Draw) -> tuple[Draw, ...]:
    """The draws that drivers make: one for each layer, or the draw itself if it has no layers."""
    if not draw.layers:
        return (draw,)
    return tuple(replace(draw, blocks=blocks, layers=()) for blocks in draw.layers)


def stacked(pictures: Sequence[Picture]) -> Picture:
    """One picture of the layers."""
    return tuple(
        replace(
            layers[0],
            layers=sum(each.layers for each in layers),
            texels=b"".join(each.texels for each in layers),
        )
        for layers in zip(*pictures, strict=True)
    )


def stacked_expected(pictures: Sequence[Expected]) -> Expected:
    """The reference's layers as one picture, the rows of the first one on top."""
    if len(pictures) == 1:
        return pictures[0]
    return Expected(
        _stacked_targets([picture.targets for picture in pictures]),
        np.concatenate([picture.covered for picture in pictures]),
        np.concatenate([picture.undecided for picture in pictures]),
        _stacked_targets([picture.low for picture in pictures]),
        _stacked_targets([picture.high for picture in pictures]),
        np.concatenate([picture.layers for picture in pictures]),
        frozenset().union(*(picture.broken for picture in pictures)),
        frozenset().union(*(picture.counted for picture in pictures)),
    )


def _stacked_targets(pictures: Sequence[Sequence[Floats]]) -> tuple[Floats, ...]:
    return tuple(np.concatenate(layers) for layers in zip(*pictures, strict=True))
