"""The rules by which pictures are accepted or refused: those that others use, with their sources.

Each looks at the picture that was drawn and at the one that is kept as right. Bounds are not among
them: they come from ``conform`` itself.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from . import measures

Floats = NDArray[np.float64]


class Shown:
    """A picture as rules look at it: as floats, and as the codes of a file of 8 bits."""

    def __init__(self, drawn: Floats, clear: float) -> None:
        """``drawn`` has ``clear`` in all lanes where nothing was drawn, which is black in files."""
        empty = (drawn == clear).all(axis=-1, keepdims=True)
        self.floats: Floats = np.where(empty, 0.0, drawn)

    @cached_property
    def codes(self) -> Floats:
        """The codes of 8 bits."""
        return measures.codes_of(self.floats)


Measure = Callable[[Shown, Shown], float]
"""How far the picture that was drawn, which comes first, is from the one that is kept as right."""


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule: pictures are called wrong if a measure is larger than this; and who uses it."""

    name: str
    measure: Measure
    most: float
    used_by: str = ""
    source: str = ""
    """The file or page in which those who use it say so."""


def _of_codes(measure: Callable[[Floats, Floats], float]) -> Measure:
    return lambda one, other: measure(one.codes, other.codes)


def _noise(one: Shown, other: Shown) -> float:
    return -measures.peak_signal_to_noise(one.codes, other.codes)


def _unlike(one: Shown, other: Shown) -> float:
    return 1 - measures.structural_similarity(one.codes, other.codes)


def _largest_of_floats(one: Shown, other: Shown) -> float:
    found = measures.largest_difference(one.floats, other.floats)
    return np.inf if np.isnan(found) else found


def _in_parts(one: Shown, other: Shown) -> float:
    """The larger share of pixels off by more than 16 codes: of the whole, or of the worst part."""
    colours = one.codes[..., :3], other.codes[..., :3]
    return max(measures.share_beyond(*colours, 16), measures.worst_part(*colours, 16))


PERCENT = measures.LARGEST / 100
"""A hundredth of the range of codes."""

_LARGEST = _of_codes(measures.largest_difference)
_BEYOND = _of_codes(partial(measures.share_beyond, most=2 * PERCENT))
_MEAN = _of_codes(measures.mean_difference)
_SQUARES = _of_codes(measures.root_mean_square)
_MATCH = _of_codes(partial(measures.mismatched, threshold=0.1))
_LOOSE_MATCH = _of_codes(partial(measures.mismatched, threshold=0.2))
_BLENDER = _of_codes(partial(measures.share_beyond, most=0.016 * measures.LARGEST))
_SEEN = _of_codes(partial(measures.mean_seen_difference, ignored=0.001))

RULES: Sequence[Rule] = (
    Rule("floats: no lane off by more than 1 %", _largest_of_floats, 0.01),
    Rule("floats: no lane off by more than 2 %", _largest_of_floats, 0.02),
    Rule("8 bits: no lane off by more than 1 %", _LARGEST, PERCENT),
    Rule("8 bits: no lane off by more than 2 %", _LARGEST, 2 * PERCENT),
    Rule("8 bits: at most 0.1 % of the pixels off by more than 2 %", _BEYOND, 0.001),
    Rule("8 bits: the same", _LARGEST, 0.0, "Skia Gold, unless a test asks for less",
         "https://chromium.googlesource.com/chromium/src/+/main/ui/base/test/"
         "skia_gold_matching_algorithm.h"),
    Rule("PSNR of at least 30 dB", _noise, -30.0),
    Rule("PSNR of at least 40 dB", _noise, -40.0),
    Rule("PSNR of at least 50 dB", _noise, -50.0),
    Rule("mean difference of at most 1 %", _MEAN, PERCENT),
    Rule("root mean square of at most 2 codes", _SQUARES, 2.0,
         "pytest-mpl (default)", "https://matplotlib.org/pytest-mpl/latest/configuration.html"),
    Rule("SSIM of at least 0.95", _unlike, 0.05),
    Rule("SSIM of at least 0.99", _unlike, 0.01),
    Rule("pixelmatch 0.1, at most 0.1 % of the pixels", _MATCH, 0.001, "three.js",
         "https://github.com/mrdoob/three.js/blob/dev/test/e2e/puppeteer.js"),
    Rule("pixelmatch 0.1, at most 2.5 % of the pixels", _MATCH, 0.025, "Babylon.js",
         "https://github.com/BabylonJS/Babylon.js/blob/master/packages/tools/tests/test/"
         "visualization/visualization.utils.ts"),
    Rule("pixelmatch 0.2, no pixel", _LOOSE_MATCH, 0.0, "Playwright (default)",
         "https://playwright.dev/docs/api/class-pageassertions"),
    Rule("at most 1 % of the pixels off by more than 0.016", _BLENDER, 0.01, "Blender",
         "https://github.com/blender/blender/blob/main/tests/python/modules/render_report.py"),
    Rule("at most 2 % of the pixels, of the whole and of each of 100 parts, off by more than 16",
         _in_parts, 0.02, "Unreal Engine (`DefaultIgnoreLess`)",
         "https://dev.epicgames.com/documentation/en-us/unreal-engine/API/Developer/"
         "ScreenShotComparisonTools/FImageTolerance"),
    Rule("mean of ΔE beyond 0.001 in JzAzBz of at most 0.005", _SEEN, 0.005,
         "Unity (as its own tests set it)",
         "https://docs.unity3d.com/Packages/com.unity.testframework.graphics@7.2/api/"
         "UnityEngine.TestTools.Graphics.ImageComparisonSettings.html"),
)  # fmt: skip
"""All rules, in the order of tables. Where a rule names nobody, it is the usual one of tests that
people write by hand."""

MEASURES: Mapping[str, Measure] = {
    "largest difference of a lane, as floats": _largest_of_floats,
    "largest difference of a lane, in steps of 8 bits": _LARGEST,
    "share of pixels off by more than 2 %": _BEYOND,
    "PSNR": _noise,
    "mean difference, in steps of 8 bits": _MEAN,
    "root mean square, in steps of 8 bits": _SQUARES,
    "SSIM": _unlike,
    "share of pixels by pixelmatch 0.1": _MATCH,
    "share of pixels, of the whole or a part, off by more than 16": _in_parts,
    "mean of ΔE beyond 0.001": _SEEN,
}
"""The measures for which the threshold is looked for that would have been the best."""
