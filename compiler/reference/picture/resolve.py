"""Makes a picture of the samples on a canvas: each pixel is the mean of its samples.

``drawing.py`` calls ``expected_on`` when a draw is done, and ``targets/runner/frames`` behind the
last draw of a step. Where pixels have one sample, nothing is changed. Sources: Vulkan, "Resolving
Multisample Images"; Direct3D 11.3 functional specification, "Resolve"; OpenGL 4.6, 18.3.1.
"""

from __future__ import annotations

import numpy as np

from ..bounds.rounding import lost, relative_error
from . import formats
from .canvas import Canvas, Ends
from .hulls import Hulls
from .scene import Bools, Expected, Floats, RasterRules


def expected_on(canvas: Canvas, rules: RasterRules, hulls: Hulls | None = None) -> Expected:
    """The picture on a canvas. ``hulls`` has the bounds of undecided samples, if known."""
    shape = rules.height, rules.width, rules.samples
    undecided = canvas.undecided | canvas.shaky
    targets = [
        _mean(
            samples_on(canvas, number, hulls).reshape(3, *shape, 4), format_, rounds=canvas.rounds
        )
        for number, format_ in enumerate(canvas.formats)
    ]
    layers = canvas.layers.reshape(shape).max(axis=-1)
    uncertain: Bools = np.asarray(undecided.reshape(shape).any(axis=-1))
    return Expected(
        targets=tuple(target[0] for target in targets),
        covered=layers > 0,
        undecided=uncertain,
        low=tuple(target[1] for target in targets),
        high=tuple(target[2] for target in targets),
        layers=layers,
        counted=canvas.counted,
    )


def depths_on(canvas: Canvas, rules: RasterRules) -> Expected:
    """The depths on a canvas as the only target: the picture of a pass that has no targets.

    Each pixel has one sample, since nobody can read the depths of several.
    """
    assert rules.samples == 1, "a pixel has one depth"
    shape = rules.height, rules.width
    value, low, high = (
        np.stack([end, *np.broadcast_to([[0.0], [0.0], [1.0]], (3, len(end)))], axis=-1)
        for end in depth_ends(canvas)
    )
    undecided: Bools = (canvas.undecided | canvas.shaky).reshape(shape)
    layers = canvas.layers.reshape(shape)
    return Expected(
        targets=(value.reshape(*shape, 4),),
        covered=layers > 0,
        undecided=undecided,
        low=(low.reshape(*shape, 4),),
        high=(high.reshape(*shape, 4),),
        layers=layers,
        counted=canvas.counted,
    )


def depth_ends(canvas: Canvas, hulls: Hulls | None = None) -> Ends:
    """The depths of all samples with their ends, (3, samples), as an attachment can hold them.

    Undecided samples may have all depths that their hulls contain.
    """
    value, off = canvas.depth, canvas.depth_off
    low, high = value - off, value + off
    if hulls is not None:
        undecided = canvas.undecided | canvas.shaky
        low = np.where(undecided, hulls.depth[0], low)
        high = np.where(undecided, hulls.depth[1], high)
    ends: Ends = np.clip(np.stack([value, low, high]), 0.0, 1.0)
    return ends


def samples_on(canvas: Canvas, target: int, hulls: Hulls | None = None) -> Ends:
    """The samples of one of the targets, (3, samples, 4).

    Undecided samples may have all values that their hulls contain.
    """
    found: Ends = canvas.targets[target].copy()
    low, high = found[1:]
    low[np.isnan(low)], high[np.isnan(high)] = -np.inf, np.inf
    if hulls is not None:
        undecided = (canvas.undecided | canvas.shaky)[:, None]
        np.copyto(found[1:], hulls.targets[target], where=undecided)
    return found


def _mean(samples: Ends, format_: str, *, rounds: bool) -> Ends:
    """The mean of the samples of each pixel, from (3, height, width, samples, 4).

    A device adds floats in any order, and rounds the mean to the format as it rounds drawn colours.
    No mean of rounded numbers is beyond the least and the largest of them.
    """
    count = samples.shape[-2]
    if count == 1:
        return samples[..., 0, :]
    value: Floats = formats.clamped(format_, samples[0]).mean(axis=-2)
    if not rounds:
        return np.stack([value, value, value])
    ends = samples[1:]
    magnitude = np.abs(ends).max(axis=0).sum(axis=-2)
    off = relative_error(count) * (magnitude / count) + lost(magnitude)
    low, high = ends.mean(axis=-2)
    low, high = formats.rounded(format_, low - off, high + off)
    low = np.maximum(low, ends[0].min(axis=-2))
    high = np.minimum(high, ends[1].max(axis=-2))
    return np.stack([value, np.minimum(low, value), np.maximum(high, value)])
