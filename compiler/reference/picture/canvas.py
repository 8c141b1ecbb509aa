"""The targets while a picture is drawn: depth test, discarding and blending, in drawing order.

``drawing.py`` draws its fragments on a ``Canvas``, and ``resolve.py`` makes a picture of that. All
of this is done for each sample; a fragment has one colour for all that it covers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...budget import check
from ...ir.blending import REPLACES
from ...ir.render_state import DepthState, StencilState
from ...ir.shader import RenderTarget
from ...ir.types import Type, width
from .comparing import compared
from .compositing import composed
from .copies import Places
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
NOWHERE = -1
"""The place of samples where no face was drawn, and of fragments with depths of their own."""
_OF_A_SAMPLE = 80
"""Bytes of a canvas for each sample: depths, stencil values, and undecided states."""
_OF_A_TARGET = 200
"""Bytes for each sample of a target: four lanes with their ends, and again in the picture."""
_OF_A_LAYER = 10**6
"""Operations of drawing once at some samples, or at only one."""
_AT_ONCE = 1 << 16
"""The number of samples drawn at once, so that a large picture needs no more memory."""


@dataclass(frozen=True, slots=True)
class Shades:
    """The results of shading some fragments."""

    colours: Sequence[Ends]
    """The colours of each target, (3, fragments, 4)."""
    depth: Ends | None
    """The depths of the fragments, (3, fragments), if they have their own."""
    discarded: Bools
    undecided: Bools
    of_sample: Ints
    """(samples,): the fragment that each sample which is covered belongs to."""

    def only(self, samples: Ints) -> Shades:
        """The shades of some samples, each by itself."""
        which = self.of_sample[samples]
        colours = [colour[:, which] for colour in self.colours]
        depth = None if self.depth is None else self.depth[:, which]
        each = np.arange(len(which))
        return Shades(colours, depth, self.discarded[which], self.undecided[which], each)

    def own_depths(self) -> tuple[Floats, Floats]:
        """The own depths of all samples, and by how much those of a device may differ."""
        assert self.depth is not None
        depth, low, high = self.depth[:, self.of_sample]
        return depth, np.maximum(high - depth, depth - low)


def size_of(samples: int, targets: int) -> int:
    """About how many bytes a canvas takes, and the picture that is made of it."""
    return samples * (_OF_A_SAMPLE + targets * _OF_A_TARGET)


class Canvas:
    """The targets and the depth buffer, with the samples in one axis.

    Several shaders may draw on one canvas, one after the other.
    """

    def __init__(
        self,
        samples: int,
        clear: Sequence[Sequence[float]],
        written: Sequence[tuple[RenderTarget, Type]],
        *,
        rounds: bool,
        has_depth: bool = True,
        depth: float = 1.0,
        blend_constant: Sequence[float] = BLACK,
        places: Places | None = None,
    ) -> None:
        """``samples`` is the number of samples in the picture.

        ``written`` are the render targets with the types of the values that are written to them. If
        the device ``rounds``, its values lie between those of their formats. Without depths, later
        draws are in front; ``depth`` is their initial value. ``places`` have numbers for faces
        whose depths may be there.
        """
        self.rounds = rounds
        self.has_depth = has_depth
        self._lanes = [width(type_) for _, type_ in written]
        self._states = [target for target, _ in written]
        self.targets = [
            np.tile(np.asarray(with_missing(colour, count), dtype=np.float64), (3, samples, 1))
            for colour, count in zip(clear, self._lanes, strict=True)
        ]
        for target, state in zip(self.targets, self._states, strict=True):
            target[:] = self._rounded(state, target)
        self.depth = np.full(samples, float(np.float32(depth)))
        self.depth_off = np.zeros(samples)
        """The possible error of a device's depth."""
        self.places = places or Places()
        self.place = np.full(samples, NOWHERE)
        """The number of the place of the face whose depth is there."""
        self._may_hide = np.ones(samples)
        """The nearest depth that a device may have where it is unsure if a fragment was drawn."""
        self.stencil = Stencil(samples)
        self.counted: Counted = frozenset()
        """The rare rules on which the content depends so far."""
        self.layers = np.zeros(samples, dtype=np.int64)
        """The number of fragments drawn at each sample."""
        self.undecided = np.zeros(samples, dtype=np.bool_)
        """Samples that are undecided because their coverage is."""
        self.shaky = np.zeros(samples, dtype=np.bool_)
        """Samples that are undecided because of fragments drawn there so far."""
        self.is_opaque = all(state.is_replaced for state in self._states)
        constant = np.asarray(blend_constant, np.float32).astype(np.float64)
        self._constants = [clamped(state.format, constant).tolist() for state in self._states]
        """The value of the factor ``constant`` in each target."""

    @property
    def formats(self) -> Sequence[str]:
        """The formats of the targets."""
        return [state.format for state in self._states]

    def draw(
        self,
        sample: Ints,
        depth: Floats,
        off: Floats,
        place: Ints,
        shades: Shades,
        test: DepthState,
        stencil: StencilTest | None = None,
    ) -> None:
        """Draw at samples in this order, several times at the same one or not.

        ``off`` says by how much a device's depths may differ, except between fragments of the same
        ``place`` that are somewhere.
        """
        tested = StencilTest(StencilState(), sample >= 0) if stencil is None else stencil
        for layer in in_layers(sample):
            for begin in range(0, len(layer), _AT_ONCE):
                members = layer[begin : begin + _AT_ONCE]
                part = tested.part(members)
                self._draw_layer(sample, depth, off, place, shades, members, test, part)

    def doubt(self, sample: Ints, test: DepthState, stencil: StencilState) -> None:
        """Notes samples whose fragments are undecided before a draw, and behind it."""
        if self._shows(test):
            self.undecided[sample] = True
        if stencil.writes:
            self.stencil.unsure[sample] = True

    def _shows(self, test: DepthState) -> bool:
        """True if a draw changes more than stencil values."""
        return bool(self.targets) or test.write

    def _draw_layer(
        self,
        sample: Ints,
        depth: Floats,
        off: Floats,
        place: Ints,
        shades: Shades,
        members: Ints,
        test: DepthState,
        stencil: StencilTest,
    ) -> None:
        """Draw at most once at each sample."""
        at, fragment = sample[members], shades.of_sample[members]
        before, new = self.depth[at], depth[members]
        margin = off[members] + self.depth_off[at]
        same = (place[members] == self.place[at]) & (place[members] != NOWHERE)
        new = np.where(same, before, new)
        nearer = Outcomes(*self._tested(test, new, before, margin, same))
        through = self.stencil.tested(stencil, at)
        there = Outcomes(~shades.discarded[fragment], shades.undecided[fragment])
        self.stencil.change(stencil, at, there, through, nearer)
        drawing = there.both(through.both(nearer))
        unsure = drawing.open
        if self.is_opaque and (test.write or not self.has_depth):
            # A fragment that certainly wins hides all before it, so the pixel is decided again.
            wins = drawing.holds & ~unsure
            wins &= self._passes_in_any_case(test, new + off[members], at)
            self.shaky[at[wins]] = False
        if self._shows(test):
            self.shaky[at] |= unsure
        # An unsure fragment may be drawn or not, so that either of the two depths may be there.
        nearest_there = np.minimum(new - off[members], before - self.depth_off[at])
        self._may_hide[at[unsure]] = np.minimum(self._may_hide[at[unsure]], nearest_there[unsure])
        drawn, fragment = members[drawing.holds], fragment[drawing.holds]
        at = sample[drawn]
        if test.write:
            self.depth[at] = depth[drawn]
            self.depth_off[at] = off[drawn]
            self.place[at] = place[drawn]
        self.layers[at] += 1
        for number, (target, colours) in enumerate(zip(self.targets, shades.colours, strict=True)):
            target[:, at] = self.mixed(number, colours[:, fragment], target[:, at])

    def mixed(self, target: int, colours: Ends, behind: Ends) -> Ends:
        """The content of one of the targets after colours have been drawn over ``behind``."""
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
        """The fragments that pass the depth test, and those for which a device may differ.

        ``same`` says which of them are of the place whose depth is stored, so that these depths are
        equal on every device.
        """
        if not self.has_depth or test.compare in ("always", "never"):
            passes = not self.has_depth or test.compare == "always"
            return np.full(len(new), passes), np.zeros(len(new), np.bool_)
        close: Bools = (np.abs(new - before) <= margin) & ~same
        return compared(test.compare, new, before), close

    def may_pass(self, test: DepthState, sample: Ints, depth: Floats, off: Floats) -> Bools:
        """The fragments that the depth test may let through on some device.

        This is as far as the current content is known.
        """
        nowhere = np.zeros(len(sample), np.bool_)
        before, margin = self.depth[sample], off + self.depth_off[sample]
        passes, close = self._tested(test, depth, before, margin, nowhere)
        unsure: Bools = self.undecided[sample] | self.shaky[sample]
        return passes | close | unsure

    def _passes_in_any_case(self, test: DepthState, farthest: Floats, at: Ints) -> Bools:
        """The fragments that pass the depth test, whatever was drawn of the undecided ones.

        ``farthest`` is the largest depth that a device may have for each of them.
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
        if not self.rounds and state.is_replaced:
            return colours
        value = clamped(state.format, colours[0])
        if not self.rounds:
            return np.stack([value, value, value])
        low, high = rounded(state.format, colours[1], colours[2])
        return np.stack([value, np.minimum(low, value), np.maximum(high, value)])


def nearest(fragments: Fragments, depth: Floats, off: Floats, place: Ints) -> tuple[Ints, Ints]:
    """The fragments that win their sample, and the samples where another one is nearly as close.

    ``off`` says by how much a device's depths may differ, except between fragments of the same
    ``place``, of which the first one wins.
    """
    order = np.lexsort((depth, fragments.sample))
    sample, sorted_depth = fragments.sample[order], depth[order]
    first = np.ones(len(order), dtype=np.bool_)
    first[1:] = sample[1:] != sample[:-1]
    winner = np.maximum.accumulate(np.where(first, np.arange(len(order)), 0))
    # Not only the second one may be as close: one farther behind may be off by more.
    sorted_off = off[order]
    apart = place[order] != place[order][winner]
    close = apart & (sorted_depth - sorted_depth[winner] <= sorted_off + sorted_off[winner])
    return np.sort(order[first]), np.unique(sample[close])


def with_missing(lanes: Sequence[float], count: int) -> tuple[float, ...]:
    """Four lanes, of which a format has only the first ``count``."""
    return (*tuple(lanes)[:count], *_MISSING[count:])


def check_layers(sample: Ints) -> None:
    """Checks that not too many fragments are drawn over each other at one of these samples.

    Each is blended with the colour behind it. Raises ``BudgetError`` for so many that nobody would
    wait for it.
    """
    _, counts = np.unique(sample, return_counts=True)
    most = int(counts.max(initial=0))
    check("operations", most * _OF_A_LAYER, f"what {most:,} faces draw over each other takes")


def in_layers(sample: Ints) -> Iterator[Ints]:
    """The numbers of fragments in drawing order, in portions with at most one of each sample.

    Raises ``BudgetError`` for too many.
    """
    check_layers(sample)
    order = np.argsort(sample, kind="stable")
    starts = np.flatnonzero(np.diff(sample[order], prepend=-1))
    counts = np.diff(starts, append=len(sample))
    rank = np.arange(len(sample)) - np.repeat(starts, counts)
    by_rank = np.argsort(rank, kind="stable")
    ends = np.cumsum(np.bincount(rank, minlength=1))
    for part in np.split(order[by_rank], ends[:-1]):
        yield np.sort(part)
