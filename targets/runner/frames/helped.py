"""Draws a frame with the reference while other processes help: each draws some layers of steps.

``burnish conform`` draws frames so. A process that judges a frame offers the layers of steps that
are independent of each other. Then it draws them itself, one after the other, but for those with
which other processes have begun meanwhile, because they had nothing else to do. Whatever these have
not finished, for any reason, it draws in the end, too. So help only saves time.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ....compiler.budget import holding
from ....compiler.documents.plan import DrawStep
from ....compiler.reference.picture import Counted
from .by_reference import Progress, ReferenceFrames
from .independent import independent_steps, textures_needed
from .reference_textures import DrawnTexture, place_of, size_of_drawn
from .step_draws import StepDraw

Arrays = tuple[NDArray[Any], ...]

MOST_SENT = 1 << 28
"""The most bytes of textures that are sent to other processes, and that they send back, for some
independent steps: there are a few copies of them on the way, and processes have limits."""


class Offered(Protocol):
    """Parts of some work that were offered to others."""

    def take(self) -> int | None:
        """The number of a part with which nobody has begun, and which nobody else gets any more;
        or ``None``."""

    def gather(self) -> Sequence[bytes | None]:
        """What others have made of each part, once they have ended; ``None`` for all others."""


class Helpers(Protocol):
    """Other processes, which may have time to help."""

    def offer(self, common: bytes, count: int) -> Offered:
        """Offer parts that are numbered from 0. Helpers get what is ``common`` to all of them."""


class LayerOf(NamedTuple):
    """A part of the work: one layer of a step."""

    step: int
    """The number of the step."""
    layer: int


class Given(NamedTuple):
    """All that a process has to know of the drawing of another one to draw layers for it."""

    frames: int
    """The number of frames that have been drawn."""
    textures: Mapping[int, DrawnTexture]
    """The contents of textures that the steps need."""
    layers: Sequence[LayerOf]


class DrawnLayer(NamedTuple):
    """All that the drawing of a layer leaves."""

    places: Sequence[Arrays]
    """The contents of each place to which the step draws."""
    counted: Counted
    broken: Mapping[int, frozenset[int]]


@dataclass(slots=True)
class HelpedFrames(ReferenceFrames):
    """Frames whose steps may be drawn by several processes."""

    helpers: Helpers | None = None
    pays: Callable[[Sequence[int]], bool] = lambda _numbers: True
    """True if it is worth while to offer independent steps of these numbers."""
    common: Callable[[bytes], bytes] = lambda given: given
    """Puts beside a pickled ``Given`` all that others need to draw like this drawing."""

    def _draw_steps(
        self, numbers: Sequence[int], progress: Progress | None, is_first: bool
    ) -> None:
        """Draw some steps, and offer those that are independent of each other."""
        for group in independent_steps(self.host.plan, numbers):
            if self.helpers is not None and self.pays(group) and self._sent(group) <= MOST_SENT:
                self._draw_with(self.helpers, group, is_first)
            else:
                ReferenceFrames._draw_steps(self, group, progress, is_first)

    def _draw_with(self, helpers: Helpers, numbers: Sequence[int], is_first: bool) -> None:
        """Draw independent steps with the help of others."""
        needed = frozenset().union(*(textures_needed(self._step_of(n)) for n in numbers))
        before = {texture: self.textures[texture] for texture in needed if texture in self.textures}
        work = list(self._layers(numbers, is_first))
        layers = [layer for layer, _draws in work]
        given = pickle.dumps(Given(self.frames, before, layers))
        offered = helpers.offer(self.common(given), len(work))
        own = set()
        while (part := offered.take()) is not None:
            own.add(part)
            self._draw_one(*work[part])
        for part, data in zip(range(len(work)), offered.gather(), strict=True):
            if data is not None:
                self._put(layers[part], pickle.loads(data))
            elif part not in own:
                self._draw_one(*work[part])

    def _sent(self, numbers: Sequence[int]) -> int:
        """The bytes of the textures that some steps need or draw to."""
        steps = [self._step_of(number) for number in numbers]
        found = {texture for step in steps for texture in textures_needed(step)}
        found |= {
            place.texture for step in steps for row in step.attachments for place in row.places
        }
        rows = self.host.plan.textures
        return sum(size_of_drawn(rows[each], self.host.size_of(each)) for each in found)

    def _step_of(self, number: int) -> DrawStep:
        step = self.host.plan.steps[number]
        assert isinstance(step, DrawStep), "others are never offered"
        return step

    def _layers(
        self, numbers: Sequence[int], is_first: bool
    ) -> Iterator[tuple[LayerOf, list[StepDraw]]]:
        """All layers of some steps, whose textures are made."""
        for number in numbers:
            draws, layers = self._prepared(self._step_of(number), is_first)
            for layer in range(layers):
                yield LayerOf(number, layer), draws

    def _draw_one(self, layer: LayerOf, draws: list[StepDraw]) -> None:
        self._draw_layer(self._step_of(layer.step), draws, layer.layer)

    # --- for others ------------------------------------------------------------------------------

    def drawn_for(self, given: Given, part: int) -> DrawnLayer:
        """A part of another process's drawing of the same frame.

        Raises what ``draw`` raises.
        """
        layer = given.layers[part]
        step = self._step_of(layer.step)
        self.frames, self.textures = given.frames, {**given.textures}
        self.counted, self.broken = frozenset(), {}
        self.host.begin(self.frames)
        with holding(self._size(), f"the frame `{self.host.plan.frame}` needs"):
            draws, _layers = self._prepared(step, self.frames == 0)
            self._draw_one(layer, draws)
        places = [tuple(map(np.ascontiguousarray, views)) for views in self._views(layer)]
        return DrawnLayer(places, self.counted, self.broken)

    def _views(self, layer: LayerOf) -> Iterator[Arrays]:
        """What is kept of each place to which a layer of a step is drawn."""
        for target in self._step_of(layer.step).attachments:
            for place in target.places:
                texture, at, level = place_of(place, layer.layer)
                yield tuple(self.textures[texture].arrays(at, level))

    def _put(self, layer: LayerOf, drawn: DrawnLayer) -> None:
        """Keep what another process has drawn, as if this one had."""
        for views, arrays in zip(self._views(layer), drawn.places, strict=True):
            for view, array in zip(views, arrays, strict=True):
                view[:] = array
        self.counted |= drawn.counted
        for shader, broken in drawn.broken.items():
            self.broken[shader] = self.broken.get(shader, frozenset()) | broken
