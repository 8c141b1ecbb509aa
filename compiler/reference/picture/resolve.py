"""Combines fragments into the picture: depth test, discarding and blending, in drawing order.

``drawing.py`` draws its fragments on a ``Canvas``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...ir.blending import REPLACES
from ...ir.render_state import DepthState, StencilState
from ...ir.shader import RenderTarget
from ...ir.types import Type, width
from .comparing import compared
from .compositing import composed
from .coverage import Fragments
from .formats import clamped, rounded
from .scene import Bools, Counted, Floats, Ints
from .stencil import Outcomes, Stencil, StencilTest

LANES = "rgba"
BLACK = (0.0, 0.0, 0.0, 0.0)
_MISSING = (0.0, 0.0, 0.0, 1.0)
"""The values of lanes that a format lacks."""

Ends = Floats
"""Colours (3, …, 4): their values, and between which numbers those of a device are."""


@dataclass(frozen=True, slots=True)
class Shades:
    """The results of shading some fragments."""

    colours: Sequence[Ends]
    """For each target, (3, fragments, 4)."""
    discarded: Bools
    undecided: Bools


class Canvas:
    """The targets and the depth buffer, with the pixels in one axis, row after row.

    Several shaders may draw on one canvas, one after the other.
    """

    def __init__(
        self,
        pixels: int,
        clear: Sequence[Sequence[float]],
        written: Sequence[tuple[RenderTarget, Type]],
        *,
        rounds: bool,
        has_depth: bool = True,
        depth: float = 1.0,
        blend_constant: Sequence[float] = BLACK,
    ) -> None:
        """``written`` are the render targets with the types of the values that are written to
        them. If the device ``rounds``, its values lie between those of their formats. Without
        depths, what is drawn later is in front; ``depth`` is what they are at first."""
        self._rounds = rounds
        self.has_depth = has_depth
        self._lanes = [width(type_) for _, type_ in written]
        self._states = [target for target, _ in written]
        self.targets = [
            np.tile(np.asarray(with_missing(colour, count), dtype=np.float64), (3, pixels, 1))
            for colour, count in zip(clear, self._lanes, strict=True)
        ]
        for target, state in zip(self.targets, self._states, strict=True):
            target[:] = self._rounded(state, target)
        self.depth = np.full(pixels, float(np.float32(depth)))
        self.depth_off = np.zeros(pixels)
        """By how much a device's depth may differ."""
        self.places = 0
        """How many places of faces have been drawn at: whoever draws next begins to count here."""
        self._place = np.full(pixels, -1)
        """The number of the place of the face that was drawn last (``copies.py``)."""
        self._may_hide = np.ones(pixels)
        """The nearest depth that a device may have where it is unsure whether a fragment was
        drawn."""
        self.stencil = Stencil(pixels)
        self.counted: Counted = frozenset()
        """The rare rules on which it hangs what has been drawn so far."""
        self.layers = np.zeros(pixels, dtype=np.int64)
        """How many fragments were drawn."""
        self.undecided = np.zeros(pixels, dtype=np.bool_)
        """Pixels that are undecided because their coverage is."""
        self.shaky = np.zeros(pixels, dtype=np.bool_)
        """Pixels that are undecided because of what has been drawn there so far."""
        self.is_opaque = all(state.is_replaced for state in self._states)
        constant = np.asarray(blend_constant, np.float32).astype(np.float64)
        self._constants = [clamped(state.format, constant).tolist() for state in self._states]
        """What the factor ``constant`` means in each target."""

    def draw(
        self,
        pixel: Ints,
        depth: Floats,
        off: Floats,
        place: Ints,
        shades: Shades,
        test: DepthState,
        stencil: StencilTest | None = None,
    ) -> None:
        """Draw fragments in their order; several may be of the same pixel.

        ``off`` says by how much a device's depths may differ, except between fragments of the same
        ``place``.
        """
        tested = StencilTest(StencilState(), pixel >= 0) if stencil is None else stencil
        for members in in_layers(pixel):
            self._draw_layer(pixel, depth, off, place, shades, members, test, tested.part(members))

    def doubt(self, pixel: Ints, test: DepthState, stencil: StencilState) -> None:
        """At these pixels it is unsure which fragments there are, before a draw and behind it."""
        if self._shows(test):
            self.undecided[pixel] = True
        if stencil.writes:
            self.stencil.unsure[pixel] = True

    def _shows(self, test: DepthState) -> bool:
        """Whether a draw changes more than stencil values."""
        return bool(self.targets) or test.write

    def _draw_layer(
        self,
        pixel: Ints,
        depth: Floats,
        off: Floats,
        place: Ints,
        shades: Shades,
        members: Ints,
        test: DepthState,
        stencil: StencilTest,
    ) -> None:
        """Draw at most one fragment of each pixel."""
        at = pixel[members]
        before, new = self.depth[at], depth[members]
        margin = off[members] + self.depth_off[at]
        same = place[members] == self._place[at]
        nearer = Outcomes(*self._tested(test, new, before, margin, same))
        through = self.stencil.tested(stencil, at)
        there = Outcomes(~shades.discarded[members], shades.undecided[members])
        self.stencil.change(stencil, at, there, through, nearer)
        drawing = there.both(through.both(nearer))
        unsure = drawing.open
        if self.is_opaque and (test.write or not self.has_depth):
            # Whatever is behind a fragment that certainly wins is not undecided any more.
            wins = drawing.holds & ~unsure
            wins &= self._passes_in_any_case(test, new + off[members], at)
            self.shaky[pixel[members[wins]]] = False
        if self._shows(test):
            self.shaky[at] |= unsure
        # It may have been drawn or not, so that either of the two depths may be there.
        nearest_there = np.minimum(new - off[members], before - self.depth_off[at])
        self._may_hide[at[unsure]] = np.minimum(self._may_hide[at[unsure]], nearest_there[unsure])
        drawn = members[drawing.holds]
        at = pixel[drawn]
        if test.write:
            self.depth[at] = depth[drawn]
            self.depth_off[at] = off[drawn]
            self._place[at] = place[drawn]
        self.layers[at] += 1
        for number, (target, colours) in enumerate(zip(self.targets, shades.colours, strict=True)):
            target[:, at] = self.mixed(number, colours[:, drawn], target[:, at])

    def mixed(self, target: int, colours: Ends, behind: Ends) -> Ends:
        """What one of the targets holds after colours have been drawn over what is there."""
        state = self._states[target]
        # A device may blend as precisely as the target's format is, so that it rounds the colour
        # before. If the target is in fixed point, the colour is clamped, too.
        colour = self._rounded(state, colours)
        if state.blend != REPLACES:
            made = composed(state.blend, colour, behind, self._constants[target])
            colour = self._rounded(state, made)
        kept = behind.copy()
        for lane in self.written_lanes(target):
            kept[..., lane] = colour[..., lane]
        return kept

    def written_lanes(self, target: int) -> list[int]:
        """The numbers of the lanes that are written of one of the targets."""
        mask = self._states[target].mask
        return [lane for lane in range(self._lanes[target]) if LANES[lane] in mask]

    def _tested(
        self, test: DepthState, new: Floats, before: Floats, margin: Floats, same: Bools
    ) -> tuple[Bools, Bools]:
        """Which fragments the depth test lets through, and of which a device may say otherwise.

        ``same`` says which of them are of the place whose depth is there, so that these depths are
        equal on every device.
        """
        if not self.has_depth or test.compare in ("always", "never"):
            passes = not self.has_depth or test.compare == "always"
            return np.full(len(new), passes), np.zeros(len(new), np.bool_)
        close: Bools = (np.abs(new - before) <= margin) & ~same
        return compared(test.compare, new, before), close

    def _passes_in_any_case(self, test: DepthState, farthest: Floats, at: Ints) -> Bools:
        """Which fragments the depth test lets through, whatever was drawn of what is unsure.

        ``farthest`` is how far away a device may have each of them.
        """
        if not self.has_depth or test.compare == "always":
            return np.ones(len(at), np.bool_)
        passes: Bools = farthest < self._may_hide[at]
        return passes & (test.compare in ("less", "less_equal"))

    def stored(self, target: int, colours: Ends) -> Ends:
        """Colours as one of the targets stores them, with all lanes."""
        lanes = self._lanes[target]
        found = self._rounded(self._states[target], colours)
        for missing, value in enumerate(_MISSING[lanes:], start=lanes):
            found[..., missing] = value
        return found

    def _rounded(self, state: RenderTarget, colours: Ends) -> Ends:
        """Colours in the range of a target's format, with ends that this format has."""
        if not self._rounds and state.is_replaced:
            return colours
        value = clamped(state.format, colours[0])
        if not self._rounds:
            return np.stack([value, value, value])
        low, high = rounded(state.format, colours[1], colours[2])
        return np.stack([value, np.minimum(low, value), np.maximum(high, value)])


def nearest(fragments: Fragments, depth: Floats, off: Floats, place: Ints) -> tuple[Ints, Ints]:
    """The fragments that win their pixel, and the pixels where another one is nearly as close.

    ``off`` says by how much a device's depths may differ, except between fragments of the same
    ``place``, of which the first one wins.
    """
    order = np.lexsort((depth, fragments.pixel))
    pixel, sorted_depth = fragments.pixel[order], depth[order]
    first = np.ones(len(order), dtype=np.bool_)
    first[1:] = pixel[1:] != pixel[:-1]
    winner = np.maximum.accumulate(np.where(first, np.arange(len(order)), 0))
    # Not only the second one may be as close: one farther behind may be off by more.
    sorted_off = off[order]
    apart = place[order] != place[order][winner]
    close = apart & (sorted_depth - sorted_depth[winner] <= sorted_off + sorted_off[winner])
    return np.sort(order[first]), np.unique(pixel[close])


def with_missing(lanes: Sequence[float], count: int) -> tuple[float, ...]:
    """Four lanes, of which a format has only the first ``count``."""
    return (*tuple(lanes)[:count], *_MISSING[count:])


def in_layers(pixel: Ints) -> Iterator[Ints]:
    """The numbers of fragments in the order of drawing, in portions with at most one of each
    pixel."""
    order = np.argsort(pixel, kind="stable")
    starts = np.flatnonzero(np.diff(pixel[order], prepend=-1))
    counts = np.diff(starts, append=len(pixel))
    rank = np.arange(len(pixel)) - np.repeat(starts, counts)
    by_rank = np.argsort(rank, kind="stable")
    ends = np.cumsum(np.bincount(rank, minlength=1))
    for part in np.split(order[by_rank], ends[:-1]):
        yield np.sort(part)
