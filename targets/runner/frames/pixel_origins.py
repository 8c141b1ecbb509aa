"""Draws a frame with the reference, and finds the origin of one pixel of an output.

``conform --explain`` asks for it. The pixel was left by the last step that drew to its texture, or
to a texture that was copied to it. To find the inputs of this step that carry the error, the step
is drawn once more for each of them, as if its texels or elements were exact.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ....compiler.documents.plan import AttachmentRow, CopyStep, DrawStep, KeptRow, PlanStep
from ....compiler.ir.shader import Shader
from ....compiler.ir.stages import TARGET
from ....compiler.reference.attribution import Explanation, UncoveredError, explain
from ....compiler.reference.storage_buffers import Contents
from ....support.frozen import changed
from .by_reference import ReferenceFrames
from .reference_textures import DEPTHS, DrawnTexture
from .step_draws import StepDraw

BEFORE = "what was there before"
"""The name for contents that a step finds in its own textures."""


@dataclass(frozen=True, slots=True)
class Carried:
    """An input of a step that other steps have made."""

    name: str
    """The name of the input in the step's shader; empty for ``BEFORE``."""
    result: str
    """The source of the contents: ``step.target``."""
    apart: float
    """The distance of the pixel's bounds if this input were exact."""


@dataclass(frozen=True, slots=True)
class Origin:
    """The origin of a pixel."""

    step: str
    apart: float
    """The distance of the pixel's bounds, in the lane where it is the largest."""
    carried: tuple[Carried, ...]
    """The inputs of the step; the one that carries most error comes first."""
    alone: float
    """The distance of the bounds if all inputs of the step were exact."""
    explanation: Explanation | None
    """The reasons for the shader's errors; ``None`` if the step has only cleared the pixel, and for
    depths, which no fragment shader computes."""


@dataclass(frozen=True, eq=False, slots=True)
class _Layer:
    """One layer of a step, as it was drawn."""

    step: DrawStep
    draws: list[StepDraw]
    layer: int
    before: Mapping[int, DrawnTexture]
    """The contents of the textures to which the step draws, before it draws."""


@dataclass(slots=True)
class FollowedFrames(ReferenceFrames):
    """Frames in which one pixel of a texture is followed, with the rounding of a device."""

    texture: int = 0
    """The number of the texture that the output shows, before the frame ends."""
    layer: int = 0
    pixel: tuple[int, int] = (0, 0)
    """The pixel's column and row in the first level."""
    made: dict[int, Origin] = field(default_factory=dict)
    """The origin of the pixel's present value in each texture."""

    @property
    def found(self) -> Origin | None:
        """The origin of the pixel in the last frame; ``None`` if no step has made it."""
        previous = {row.texture: row.previous for row in self.host.plan.kept}
        return self.made.get(previous.get(self.texture) or self.texture)

    def _step(self, step: PlanStep, is_first: bool) -> None:
        ReferenceFrames._step(self, step, is_first)
        if isinstance(step, CopyStep) and step.copied.texture in self.made:
            self.made[step.into.texture] = self.made[step.copied.texture]

    def _exchange(self, row: KeptRow) -> None:
        ReferenceFrames._exchange(self, row)
        one, other = row.texture, row.previous
        swapped = {} if one is None or other is None else {one: other, other: one}
        self.made = {swapped.get(number, number): made for number, made in self.made.items()}

    def _draw_layer(self, step: DrawStep, draws: list[StepDraw], layer: int) -> None:
        followed = list(self._followed(step, layer))
        before = {}
        if followed:
            places = [place for target in step.attachments for place in target.places]
            before = {at.texture: self.textures[at.texture].copy() for at in places}
        ReferenceFrames._draw_layer(self, step, draws, layer)
        for target in followed:
            self._follow(_Layer(step, draws, layer, before), target)

    def _followed(self, step: DrawStep, layer: int) -> Iterator[AttachmentRow]:
        """The attachments of a step that contain the pixel."""
        wanted = self._same_textures()
        for target in step.attachments:
            for place in target.places:
                at = layer if place.layer is None else place.layer
                if place.texture in wanted and (at, place.level) == (self.layer, 0):
                    yield target

    def _same_textures(self) -> set[int]:
        """The textures whose contents may become those of the followed one."""
        plan, found = self.host.plan, {self.texture}
        for row in plan.kept:
            if row.texture == self.texture and row.previous is not None:
                found.add(row.previous)
        for step in reversed(plan.steps):
            if isinstance(step, CopyStep) and step.into.texture in found:
                found.add(step.copied.texture)
        return found

    # --- one step --------------------------------------------------------------------------------

    def _follow(self, drawn: _Layer, target: AttachmentRow) -> None:
        """Note the origin of the pixel, unless a step has left the pixel as it was."""
        place = target.places[-1].texture
        explanation = self._explanation(drawn, target)
        is_depth = self.textures[place].format.startswith(DEPTHS)
        draws_over = target.load == "load"
        if explanation is None and draws_over and not is_depth:
            return
        read = {each.result: name for draw in drawn.draws for name, each in draw.reads.items()}
        if draws_over:
            read[BEFORE] = ""
        whole = self._apart(place)
        carried = [
            Carried(name, made, self._apart_without(drawn, place, {made}))
            for made, name in read.items()
        ]
        self.made[place] = Origin(
            drawn.step.name, whole, tuple(sorted(carried, key=lambda one: one.apart)),
            self._apart_without(drawn, place, read), explanation,
        )  # fmt: skip

    def _apart(self, texture: int) -> float:
        """The distance of the pixel's bounds in a texture."""
        x, y = self.pixel
        _, low, high = self.textures[texture].levels[0][:, self.layer, y, x]
        apart = high - low
        return float(np.where(np.isnan(apart), np.inf, apart).max())

    def _apart_without(self, drawn: _Layer, texture: int, exact: Collection[str]) -> float:
        """The distance of the pixel's bounds if these results were exact."""
        textures, buffers, counted = self.textures, self.buffers, self.counted
        reads = [read for draw in drawn.draws for read in draw.reads.values()]
        over = _exact if BEFORE in exact else DrawnTexture.copy
        self.textures = {
            **textures,
            **{
                read.texture: _exact(textures[read.texture])
                for read in reads
                if read.texture is not None and read.result in exact
            },
            **{number: over(one) for number, one in drawn.before.items()},
        }
        self.buffers = {
            name: Contents(contents.data) if name in exact else contents
            for name, contents in buffers.items()
        }
        try:
            ReferenceFrames._draw_layer(self, drawn.step, drawn.draws, drawn.layer)
            return self._apart(texture)
        finally:
            self.textures, self.buffers, self.counted = textures, buffers, counted

    def _explanation(self, drawn: _Layer, target: AttachmentRow) -> Explanation | None:
        """The reasons why that draw's shader makes errors which the pixel shows."""
        targets = drawn.step.targets
        if target not in targets or self.errors is None:
            return None
        x, y = self.pixel
        found = []
        for draw in drawn.draws:
            made = self._drawn_of(draw, drawn.layer)
            shader = _with_target(made.shader, targets.index(target))
            rules = self._rules_of(drawn.step, shader)
            with suppress(UncoveredError):
                found.append(explain(
                    shader, _as_stored(made.values), made.texels, made.geometry, rules,
                    self.errors, x, y,
                ))  # fmt: skip
        texture = self.textures[target.places[-1].texture]
        value = texture.levels[0][0, self.layer, y, x]

        def off(one: Explanation) -> float:
            return float(np.abs(value[: len(one.value)] - one.value).max())

        # Of blended draws, none may fit better than the others: then the last one counts.
        return min(reversed(found), key=off, default=None)


def _as_stored(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values with the elements of buffers as they are stored, without bounds."""
    return {
        name: Contents(value.data) if isinstance(value, Contents) else value
        for name, value in values.items()
    }


def _exact(drawn: DrawnTexture) -> DrawnTexture:
    """A texture with the same values, which no device rounds."""
    made = drawn.copy()
    for level, undecided in zip(made.levels, made.undecided, strict=True):
        level[1:] = level[0]
        undecided[:] = False
    return made


def _with_target(shader: Shader, number: int) -> Shader:
    """A shader that delivers one of its targets only."""
    wanted = shader.results_of(TARGET)[number]
    results = (one for one in shader.results if one.kind != TARGET or one is wanted)
    return changed(shader, results=tuple(results))
