"""Measures of how far two pictures are apart, as image tests of engines have them.

Pictures are arrays of shape (height, width, 4). ``codes`` are what a file of 8 bits holds, 0 to
255; the colours of these are sRGB.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burnish.compiler.reference.transfer import decode_srgb, encode_srgb

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

LARGEST = 255.0
"""The largest code of 8 bits."""
_MOST_UNLIKE = 35215.0
"""The largest difference of two colours, as pixelmatch measures it."""


def codes_of(picture: Floats) -> Floats:
    """The codes of a float picture: colours in sRGB, alpha as it is; NaN becomes 0."""
    within = np.clip(np.nan_to_num(picture, nan=0.0), 0.0, 1.0)
    encoded = np.concatenate([encode_srgb(within[..., :3]), within[..., 3:]], axis=-1)
    return np.rint(encoded * LARGEST)


def share_beyond(one: Floats, other: Floats, most: float) -> float:
    """The share of the pixels of which some lane is further apart than ``most``; NaN is."""
    return float((~(np.abs(one - other) <= most)).any(axis=-1).mean())


def largest_difference(one: Floats, other: Floats) -> float:
    """The largest difference of a lane."""
    return float(np.abs(one - other).max())


def mean_difference(one: Floats, other: Floats) -> float:
    """The mean absolute difference of all lanes."""
    return float(np.abs(one - other).mean())


def root_mean_square(one: Floats, other: Floats) -> float:
    """The root of the mean squared difference of all lanes."""
    return float(np.sqrt(np.square(one - other).mean()))


def peak_signal_to_noise(one: Floats, other: Floats) -> float:
    """The peak signal-to-noise ratio of codes in decibels; infinite for equal pictures."""
    error = root_mean_square(one, other)
    return float(20 * np.log10(LARGEST / error)) if error else float("inf")


# --- structural similarity -----------------------------------------------------------------------

_WINDOW = 8
_STEADY_MEAN, _STEADY_SPREAD = (0.01 * LARGEST) ** 2, (0.03 * LARGEST) ** 2
"""What keeps the quotients steady where both pictures are dark, or of one colour."""


def structural_similarity(one: Floats, other: Floats) -> float:
    """The mean structural similarity (Wang et al. 2004) of the colours' codes, in windows of 8 × 8
    pixels; 1 for equal pictures."""
    one, other = one[..., :3], other[..., :3]
    mean_one, mean_other = _means(one), _means(other)
    spread = _means(one * one) - mean_one**2 + _means(other * other) - mean_other**2
    common = _means(one * other) - mean_one * mean_other
    likeness = (
        (2 * mean_one * mean_other + _STEADY_MEAN) * (2 * common + _STEADY_SPREAD)
        / ((mean_one**2 + mean_other**2 + _STEADY_MEAN) * (spread + _STEADY_SPREAD))
    )  # fmt: skip
    return float(likeness.mean())


def _means(lanes: Floats) -> Floats:
    """The means of all windows, by sums over the rectangles above and to the left."""
    sums = np.pad(lanes, ((1, 0), (1, 0), (0, 0))).cumsum(axis=0).cumsum(axis=1)
    upper, lower = sums[:-_WINDOW], sums[_WINDOW:]
    bands = lower - upper
    means: Floats = (bands[:, _WINDOW:] - bands[:, :-_WINDOW]) / _WINDOW**2
    return means


# --- pixelmatch ----------------------------------------------------------------------------------

_YIQ = np.array(
    [
        [0.29889531, 0.58662247, 0.11448223],
        [0.59597799, -0.27417610, -0.32180189],
        [0.21147017, -0.52261711, 0.31114694],
    ]
).T
_YIQ_WEIGHTS = np.array([0.5053, 0.299, 0.1957])
_NEIGHBOURS = [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1) if (x, y) != (0, 0)]
_WHOLE = 256.0 ** np.arange(4)
"""What makes one number of the four codes of a pixel."""
_MANY = 2
"""The number of equal neighbours that an edge that was smoothed has at most."""


def mismatched(one: Floats, other: Floats, threshold: float) -> float:
    """The share of the pixels that pixelmatch counts, with its default of leaving out those that
    look like smoothed edges."""
    apart = np.square(_yiq(one) - _yiq(other)) @ _YIQ_WEIGHTS > _MOST_UNLIKE * threshold**2
    if apart.any():
        apart &= ~(_smoothed(one, other) | _smoothed(other, one))
    return float(apart.mean())


def _yiq(codes: Floats) -> Floats:
    """Brightness and two colours, over white where a pixel is not opaque."""
    opacity = codes[..., 3:] / LARGEST
    shown: Floats = (LARGEST + (codes[..., :3] - LARGEST) * opacity) @ _YIQ
    return shown


def _smoothed(picture: Floats, other: Floats) -> Bools:
    """The pixels that have darker and brighter neighbours and few equal ones, where the darkest or
    the brightest lies in an area of one colour in both pictures."""
    brightness = _yiq(picture)[..., 0]
    slopes = np.nan_to_num(brightness - _around(brightness), nan=0.0)
    equal = (brightness == _around(brightness)).sum(axis=0) + _at_border(brightness)
    flat = _in_one_colour(picture) & _in_one_colour(other)
    beside = _around(flat.astype(np.float64)) == 1
    found: Bools = np.zeros(flat.shape, np.bool_)
    for ends in (slopes.argmin(axis=0), slopes.argmax(axis=0)):
        found |= np.take_along_axis(beside, ends[None], axis=0)[0]
    both = (slopes.min(axis=0) < 0) & (slopes.max(axis=0) > 0)
    smoothed: Bools = found & both & (equal <= _MANY)
    return smoothed


def _in_one_colour(picture: Floats) -> Bools:
    """The pixels that have more than two neighbours of the same colour."""
    colours = picture @ _WHOLE
    many: Bools = (colours == _around(colours)).sum(axis=0) + _at_border(colours) > _MANY
    return many


def _around(lanes: Floats) -> Floats:
    """The eight neighbours of each pixel, NaN outside of the picture."""
    height, width = lanes.shape
    padded = np.pad(lanes, 1, constant_values=np.nan)
    shifted = [
        padded[1 + y : 1 + y + height, 1 + x : 1 + x + width] for x, y in _NEIGHBOURS
    ]  # fmt: skip
    return np.stack(shifted)


def _at_border(lanes: Floats) -> Bools:
    border = np.ones(lanes.shape, np.bool_)
    border[1:-1, 1:-1] = False
    return border


# --- by parts, and as people see it --------------------------------------------------------------

_PARTS = 10


def worst_part(one: Floats, other: Floats, most: float) -> float:
    """The largest share of pixels beyond ``most`` in a part of the picture: a hundredth of it, a
    tenth of each side."""
    beyond = (np.abs(one - other) > most).any(axis=-1)
    height, width = (max(1, round(side / _PARTS)) for side in beyond.shape)
    rows, columns = (np.arange(side) // part for side, part in zip(
        beyond.shape, (height, width), strict=True
    ))  # fmt: skip
    counts = np.zeros((rows[-1] + 1, columns[-1] + 1))
    np.add.at(counts, (rows[:, None], columns[None]), beyond)
    return float(counts.max() / (height * width))


_TO_XYZ = (
    100
    * np.array(
        [
            [0.4124564, 0.3575761, 0.1804375],
            [0.2126729, 0.7151522, 0.0721750],
            [0.0193339, 0.1191920, 0.9503041],
        ]
    ).T
)
_TO_CONES = np.array(
    [
        [0.41478372, 0.579999, 0.0146480],
        [-0.2015100, 1.120649, 0.0531008],
        [-0.0166008, 0.264800, 0.6684799],
    ]
).T
_TO_OPPONENTS = np.array(
    [[0.5, 0.5, 0.0], [3.524000, -4.066708, 0.542708], [0.199076, 1.096799, -1.295875]]
).T


def mean_seen_difference(one: Floats, other: Floats, ignored: float) -> float:
    """The mean of how far colours of codes are apart in JzAzBz (Safdar et al. 2017), beyond what is
    ``ignored`` of each pixel."""
    between = np.linalg.norm(_seen(one) - _seen(other), axis=-1)
    return float(np.maximum(between - ignored, 0.0).mean())


def _seen(codes: Floats) -> Floats:
    return jzazbz(decode_srgb(codes[..., :3] / LARGEST) @ _TO_XYZ)


def jzazbz(xyz: Floats) -> Floats:
    """Lightness and two opponent colours of light, which is in candela per square metre."""
    x, y, z = np.moveaxis(xyz, -1, 0)
    cones = np.stack([1.15 * x - 0.15 * z, 0.66 * y + 0.34 * x, z], axis=-1) @ _TO_CONES
    curve = np.maximum(cones / 10000, 0.0) ** 0.15930175781
    answers = ((0.8359375 + 18.8515625 * curve) / (1 + 18.6875 * curve)) ** 134.034375
    lightness, *colour = np.moveaxis(answers @ _TO_OPPONENTS, -1, 0)
    return np.stack([0.44 * lightness / (1 - 0.56 * lightness), *colour], axis=-1)
