"""The hull of an undecided sample: all that some fragment there may have drawn, or nothing.

Where rounding tips which fragments are drawn, a picture alone is not compared. But a later step of
a frame may read the pixel, and then it matters that it is one of few colours: between the least and
the largest of them. Where colours are blended, each fragment of which rounding decides may have
been blended with the colour before, or not.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .canvas import Canvas, Shades, in_layers
from .coverage import Fragments
from .scene import Bools, Floats, Ints


class Hulls:
    """For each sample of a canvas, the least and the largest of its possible values."""

    def __init__(self, canvas: Canvas) -> None:
        self._canvas = canvas
        self.targets = [target[1:].copy() for target in canvas.targets]
        """The hulls of each target, (2, samples, 4)."""
        self.depth = np.stack([canvas.depth - canvas.depth_off, canvas.depth + canvas.depth_off])
        """(2, samples)."""

    def extend(
        self,
        fragments: Fragments,
        certain: Bools,
        depths: Callable[[Fragments], tuple[Floats, Floats]],
        shaded: Callable[[Fragments], Shades],
    ) -> None:
        """Extends the hulls behind a draw.

        Decided samples get their values; others may keep those before, or what any of these
        fragments makes of them. The fragments are in the order of drawing. All devices draw those
        that are ``certain``, unless they discard them.
        """
        canvas = self._canvas
        undecided = canvas.undecided | canvas.shaky
        here = undecided[fragments.sample]
        several = fragments.only(here)
        depth, off = depths(several)
        now = np.stack([canvas.depth - canvas.depth_off, canvas.depth + canvas.depth_off])
        _join(self.depth, now, undecided)
        _include(self.depth, several.sample, np.stack([depth - off, depth + off]))
        shades = shaded(several).only(np.arange(len(several.sample)))
        for number, target in enumerate(canvas.targets):
            if canvas.is_opaque:
                _join(self.targets[number], target[1:], undecided)
                colours = canvas.stored(number, shades.colours[number])[1:]
                _include(self.targets[number], several.sample, _known(colours))
            else:
                self._blend(number, several.sample, certain[here], shades)
                self.targets[number][:, ~undecided] = target[1:, ~undecided]

    def _blend(self, number: int, sample: Ints, certain: Bools, shades: Shades) -> None:
        """Blend fragments with all that their samples may be, one after the other."""
        hull = self.targets[number]
        certain = certain & ~shades.undecided
        drawn = shades.undecided | ~shades.discarded
        for layer in in_layers(sample):
            members = layer[drawn[layer]]
            at = sample[members]
            behind = hull[:, at]
            mixed = _known(
                self._canvas.mixed(
                    number, shades.colours[number][:, members], np.stack([behind[0], *behind])
                )[1:]
            )
            sure = certain[members, None]
            hull[0, at] = np.where(sure, mixed[0], np.minimum(mixed[0], behind[0]))
            hull[1, at] = np.where(sure, mixed[1], np.maximum(mixed[1], behind[1]))


def _join(hull: Floats, now: Floats, undecided: Bools) -> None:
    """Updates a hull in place: undecided samples join their present value, others take it."""
    here = undecided if now.ndim == 2 else undecided[:, None]
    for least, before, new in zip((np.minimum, np.maximum), hull, now, strict=True):
        least(before, new, out=before, where=here)
        np.copyto(before, new, where=~here)


def _include(hull: Floats, sample: Ints, ends: Floats) -> None:
    np.minimum.at(hull[0], sample, ends[0])
    np.maximum.at(hull[1], sample, ends[1])


def _known(ends: Floats) -> Floats:
    """Ends without NaN, which says that nothing is known."""
    low = np.where(np.isnan(ends[0]), -np.inf, ends[0])
    return np.stack([low, np.where(np.isnan(ends[1]), np.inf, ends[1])])
