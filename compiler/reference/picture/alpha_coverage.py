"""Alpha to coverage: the alpha of the first target says how many samples a fragment covers.

``drawing.py`` calls it with what has been shaded, before anything is drawn.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .canvas import Shades
from .scene import Ints, RasterRules

ALPHA = 3
"""The lane of a colour that says it."""


def covered_by_alpha(shades: Shades, number: Ints, rules: RasterRules) -> Shades:
    """The shades of samples, each by itself, of which those are discarded that alpha leaves out.

    ``number`` is that of each sample in its pixel. Every API covers no sample for an alpha of 0 or
    less, and all of them for 1 or more. Between these, devices choose how many and which they
    cover; here it is the first ones, by the share that is nearest, and all samples are undecided.
    """
    each = shades.only(np.arange(len(shades.of_sample)))
    alpha, low, high = each.colours[0][..., ALPHA]
    # An alpha that may be NaN is neither certainly 0 nor certainly 1.
    none, every = high <= 0, low >= 1
    count = np.floor(np.clip(np.nan_to_num(alpha), 0, 1) * rules.samples + 0.5)
    return replace(
        each,
        discarded=each.discarded | (number >= count),
        undecided=(each.undecided & ~none) | ~(none | every | (each.discarded & ~each.undecided)),
    )
