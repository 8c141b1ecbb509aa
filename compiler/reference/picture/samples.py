"""The places of the samples of a picture, and their numbers.

All that is kept of a picture while it is drawn (coverage, depths, stencil values, colours) is kept
of samples. A pixel has one, at its centre, or several around it if its pass says so. Samples are
numbered pixel by pixel and row by row from the top, those of one pixel one after the other: where
each pixel has one, these are the numbers of pixels.

The places are those that Vulkan ("Multisampling") and Direct3D call the standard ones, and that
WebGPU demands.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .scene import Ints, RasterRules


@dataclass(frozen=True, slots=True)
class Location:
    """A place in every pixel, in pixels from its left and upper side."""

    x: Any
    y: Any


CENTRE = Location(0.5, 0.5)

_STANDARD: Mapping[int, Sequence[Location]] = {
    1: (CENTRE,),
    4: (
        Location(0.375, 0.125),
        Location(0.875, 0.375),
        Location(0.125, 0.625),
        Location(0.625, 0.875),
    ),
}
"""The samples of a pixel, by how many there are, for a device that counts rows from above."""


def locations(rules: RasterRules) -> Sequence[Location]:
    """The places of a pixel's samples."""
    found = _STANDARD[rules.samples]
    return [Location(at.x, 1.0 - at.y) for at in found] if rules.bottom_up else found


def pixels_of(sample: Ints, rules: RasterRules) -> Ints:
    """The numbers of the pixels that samples belong to."""
    return sample if rules.samples == 1 else sample // rules.samples


def location_of_depth(sample: Ints, rules: RasterRules) -> Location:
    """The locations in their pixels at which the depths of samples are computed."""
    if rules.samples == 1:
        return CENTRE
    number, every = sample % rules.samples, locations(rules)
    x, y = (np.array([getattr(at, axis) for at in every])[number] for axis in "xy")
    return Location(1.0 - x if rules.mirrors_sample_depths else x, y)
