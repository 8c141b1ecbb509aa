"""Makes a picture of what has been drawn on a canvas: each pixel is the mean of its samples.

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


def expected_on(
    canvas: Canvas,
    rules: RasterRules,
    broken: frozenset[int] = frozenset(),
    hulls: Hulls | None = None,
) -> Expected:
    """The picture on a canvas. ``hulls`` says what undecided samples may be, if that is known."""
    shape = rules.height, rules.width, rules.samples
    undecided = canvas.undecided | canvas.shaky
    targets = []
    for number, target in enumerate(canvas.targets):
        ends = target if hulls is None else _with_hull(target, hulls.targets[number], undecided)
        ends = np.stack([ends[0], _known(ends[1], -np.inf), _known(ends[2], np.inf)])
        several = ends.reshape(3, *shape, 4)
        targets.append(_mean(several, canvas.formats[number], rounds=canvas.rounds))
    layers = canvas.layers.reshape(shape).max(axis=-1)
    uncertain: Bools = np.asarray(undecided.reshape(shape).any(axis=-1))
    return Expected(
        targets=tuple(target[0] for target in targets),
        covered=layers > 0,
        undecided=uncertain,
        low=tuple(target[1] for target in targets),
        high=tuple(target[2] for target in targets),
        layers=layers,
        broken=broken,
        counted=canvas.counted,
    )


def _with_hull(ends: Ends, hull: Floats, undecided: Bools) -> Ends:
    """Samples that may be all that their hull contains, if they are undecided."""
    low, high = (np.where(undecided[:, None], *pair) for pair in zip(hull, ends[1:], strict=True))
    return np.stack([ends[0], low, high])


def _known(ends: Floats, otherwise: float) -> Floats:
    """The ends of intervals, or infinity where nothing is known."""
    known: Floats = np.where(np.isnan(ends), otherwise, ends)
    return known


def _mean(samples: Ends, format_: str, *, rounds: bool) -> Ends:
    """The mean of the samples of each pixel, from (3, height, width, samples, 4).

    A device adds floats in any order, and rounds the mean to the format as it rounds what is drawn.
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
