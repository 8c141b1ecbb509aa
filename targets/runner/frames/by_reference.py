"""Draws a frame with the reference: step by step, in double precision.

A step leaves textures or buffers, with bounds if these are asked for: the range of a device's
values. The bounds of an undecided pixel contain everything that a device may have drawn there, so
that later steps, which read it, are as uncertain as they should be.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....compiler.budget import holding
from ....compiler.documents.plan import (
    AttachmentRow,
    CopyStep,
    DrawnRow,
    DrawStep,
    FramePlan,
    KeptRow,
    PlanStep,
    RunStep,
)
from ....compiler.ir.shader import Shader
from ....compiler.promises import promises
from ....compiler.reference.bounds.errors import Errors
from ....compiler.reference.kept_numbers import KeptNumbers
from ....compiler.reference.picture import (
    Canvas,
    Counted,
    Geometry,
    Hulls,
    Places,
    RasterRules,
    Texels,
    canvas_size,
    draw_onto,
    written_by,
)
from ....compiler.reference.storage_buffers import Contents
from ..instances.instance import Instance
from ..kernels import drawable, full_screen_state, has_images
from ..reference import geometry_for, texels_of, values_for
from ..reference_kernels import elements_by_reference
from .host import FrameHost
from .reference_textures import DrawnTexture, load, size_of_drawn, store
from .step_draws import StepDraw, StepDraws

Floats = NDArray[np.float64]
Progress = Callable[[float], None]


class ReferenceInputs(NamedTuple):
    """The values that the reference draws with."""

    shader: Shader
    values: Mapping[str, Any]
    texels: Mapping[str, Texels]
    geometry: Geometry


@dataclass(slots=True)
class ReferenceFrames:
    """Draws one frame after the other."""

    host: FrameHost
    rules: RasterRules = field(default_factory=lambda: RasterRules(1, 1))
    """The rules of the pictures, without the sizes, which are those of the steps."""
    errors: Errors | None = None
    shader_of: Callable[[int], Shader] | None = None
    """The shader of a number as it is computed, if that is not the meant one: a profile's text."""
    frames: int = 0
    """The number of frames that have been drawn."""
    textures: dict[int, DrawnTexture] = field(default_factory=dict)
    places: Places = field(default_factory=Places)
    buffers: dict[str, Contents] = field(default_factory=dict)
    """The buffers, by the name of the result."""
    counted: Counted = frozenset()
    """The rare rules on which the pictures so far depend."""
    broken: dict[int, frozenset[int]] = field(default_factory=dict)
    """The ids of promises that were broken so far, by the number of the shader."""
    kept: KeptNumbers = field(default_factory=KeptNumbers)
    """The numbers that draws have in common."""
    told: Progress | None = None
    """Called with the finished share of the present step, layer and draw."""
    _draws: StepDraws = field(init=False)

    def __post_init__(self) -> None:
        self._draws = StepDraws(self.host)

    def draw(self, progress: Progress | None = None) -> None:
        """Draw the next frame."""
        plan = self.host.plan
        is_first = self.frames == 0
        self.host.begin(self.frames)
        with holding(self._size(), f"the frame `{plan.frame}` needs"):
            self._draw_all(plan, progress, is_first=is_first)

    def _size(self) -> int:
        """The bytes of the frame's textures, as far as their sizes are known yet.

        Sizes of textures that kernels write are known when the kernels have run.
        """
        sizes = 0
        for number, row in enumerate(self.host.plan.textures):
            if row.size.value is not None:
                sizes += size_of_drawn(row, self.host.size_of(number))
        return sizes

    def _draw_all(self, plan: FramePlan, progress: Progress | None, *, is_first: bool) -> None:
        self._keep()
        wanted = [n for n, step in enumerate(plan.steps) if is_first or not step.only_first]
        self._draw_steps(wanted, progress, is_first)
        for row in plan.kept:
            self._exchange(row)
        self.frames += 1

    def output(self, name: str) -> DrawnTexture:
        """The texture that an output of the last frame shows."""
        texture = self.host.plan.output_texture(name)
        assert texture is not None, "it is no buffer"
        return self.textures[texture]

    def broken_promises(self) -> list[str]:
        """The values that were zero somewhere although they were promised not to be."""
        found = (
            kept.value
            for shader, broken in self.broken.items()
            for kept in promises(self._shader(shader))
            if kept.node.id in broken
        )
        return list(dict.fromkeys(found))

    # --- steps -----------------------------------------------------------------------------------

    def _draw_steps(
        self, numbers: Sequence[int], progress: Progress | None, is_first: bool
    ) -> None:
        """Draw some steps, by their numbers, one after the other."""
        steps = self.host.plan.steps
        for number in numbers:
            self.told = _part_of(progress, number, len(steps))
            self._step(steps[number], is_first)
            if progress is not None:
                progress((number + 1) / len(steps))

    def _keep(self) -> None:
        """Make the textures that the first frame reads, as the last frame would have left them."""
        for row in self.host.plan.kept:
            previous = row.previous
            if previous is not None and previous not in self.textures:
                self._make(previous)

    def _exchange(self, row: KeptRow) -> None:
        if row.texture is None or row.previous is None:
            self.buffers[f"previous({row.result})"] = self.buffers[row.result]
            return
        one, other = row.texture, row.previous
        if one in self.textures:
            self.textures[one], self.textures[other] = self.textures[other], self.textures[one]

    def _make(self, texture: int) -> DrawnTexture:
        row = self.host.plan.textures[texture]
        made = DrawnTexture.empty(row, self.host.size_of(texture))
        self.textures[texture] = made
        return made

    def _step(self, step: PlanStep, is_first: bool) -> None:
        match step:
            case CopyStep():
                source, target = step.copied.texture, step.into.texture
                self.textures[target] = self.textures[source].copy()
            case RunStep():
                self._run(step, self._draws.kernel(step, is_first=is_first))
            case DrawStep():
                self._draw(step, is_first)

    def _draw(self, step: DrawStep, is_first: bool) -> None:
        draws, layers = self._prepared(step, is_first)
        whole = self.told
        for layer in range(layers):
            self.told = _part_of(whole, layer, layers)
            self._draw_layer(step, draws, layer)

    def _prepared(self, step: DrawStep, is_first: bool) -> tuple[list[StepDraw], int]:
        """The draws of a step, and the number of layers in which each of them is drawn.

        The textures that it needs are made.
        """
        draws = list(self._draws.of(step, is_first=is_first))
        targets = list(step.attachments)
        for target in targets:
            for place in target.places:
                is_first_part = place.layer in (0, None) and place.level == 0
                is_new = target.load == "clear" and is_first_part
                if is_new or place.texture not in self.textures:
                    self._make(place.texture)
        first = targets[0]
        whole = first.layer is None
        return draws, self.host.plan.textures[first.texture].layers if whole else 1

    def _draw_layer(self, step: DrawStep, draws: list[StepDraw], layer: int) -> None:
        shader = drawable(self._shader(step.draws[0].uses[0].shader))
        rules = self._rules_of(step, shader)
        size = canvas_size(rules.sample_count, len(step.targets))
        with holding(size, f"the step `{step.name}` needs"):
            self._draw_on_canvas(step, draws, layer, shader, rules)

    def _draw_on_canvas(
        self, step: DrawStep, draws: list[StepDraw], layer: int, shader: Shader, rules: RasterRules
    ) -> None:
        depth = step.depth
        canvas = Canvas(
            rules.sample_count, [self.host.clear_of(target) for target in step.targets],
            written_by(shader), rounds=self.errors is not None, has_depth=depth is not None,
            depth=1.0 if depth is None else self.host.clear_of(depth)[0],
            blend_constant=self.host.state_of(step).blend_constant, places=self.places,
        )  # fmt: skip
        hulls = Hulls(canvas)
        load(canvas, hulls, step, layer, self.textures)
        whole = self.told
        for number, draw in enumerate(draws):
            self.told = _part_of(whole, number, len(draws))
            self._onto(canvas, hulls, draw, rules, layer)
        store(canvas, hulls, step, layer, rules, self.textures)
        self.counted |= canvas.counted

    def _rules_of(self, step: DrawStep, shader: Shader) -> RasterRules:
        """The rules for the pictures of one step."""
        width, height = self.host.drawn_size(step)
        state = self.host.state_of(step)
        return replace(
            self.rules, width=width, height=height, viewport=state.viewport,
            scissor=state.scissor, samples=shader.render_state.samples,
        )  # fmt: skip

    def _shader(self, number: int) -> Shader:
        if self.shader_of is not None:
            return self.shader_of(number)
        return self.host.shaders[number].shader

    def _onto(
        self, canvas: Canvas, hulls: Hulls, draw: StepDraw, rules: RasterRules, layer: int
    ) -> None:
        """Draw on a canvas; ``layer`` is for shaders that draw each layer by itself."""
        drawn = self._drawn_of(draw, layer)
        broken = draw_onto(
            canvas, drawn.shader, drawn.values, drawn.texels, drawn.geometry, rules, self.errors,
            self.told, hulls=None if self.errors is None else hulls, kept=self.kept,
        )  # fmt: skip
        self.broken[draw.shader] = self.broken.get(draw.shader, frozenset()) | broken

    def _drawn_of(self, draw: StepDraw, layer: int) -> ReferenceInputs:
        """The inputs of a draw; ``layer`` is for shaders that draw each layer by itself."""
        state = draw.state.layers[layer] if draw.state.layers else draw.state
        shader = drawable(self._shader(draw.shader))
        written = self._give_buffers(state.instance, draw)
        return ReferenceInputs(
            shader, values_for(shader, state.instance, written), self._texels(draw),
            geometry_for(shader, state.geometry()),
        )  # fmt: skip

    def _texels(self, draw: StepDraw) -> Mapping[str, Texels]:
        found = texels_of(draw.state.instance)
        for name, read in draw.reads.items():
            if read.texture is not None:
                found[name] = self.textures[read.texture].texels()
        return found

    def _give_buffers(self, instance: Instance, draw: StepDraw) -> Mapping[str, Contents]:
        """Give an instance the buffers that steps have written; returns their contents."""
        written = {
            name: self.buffers[read.result]
            for name, read in draw.reads.items()
            if read.texture is None
        }
        for name, contents in written.items():
            instance.set_bytes(name, contents.data)
        return written

    # --- kernels ---------------------------------------------------------------------------------

    def _run(self, step: RunStep, draw: StepDraw) -> None:
        instance = draw.state.instance
        given = self._give_buffers(instance, draw)
        if not has_images(instance.reflection):
            written = elements_by_reference(
                self._shader(draw.shader), instance, self._texels(draw), given, self.rules,
                self.errors,
            )  # fmt: skip
            self.buffers |= {row.result: written[row.name] for row in step.buffers}
            return
        for image in step.images:
            self._make(image.texture)
        drawn = replace(draw, state=full_screen_state(instance))
        self._draw_layer(_as_pass(step), [drawn], 0)


def _as_pass(step: RunStep) -> DrawStep:
    """A kernel over images as a pass that draws them."""
    targets = (
        AttachmentRow(
            name=image.name, result=image.result, texture=image.texture, layer=0, level=0,
            load="clear", clear=None, store=True, resolve=None, over=None, stencil=None,
        )
        for image in step.images
    )  # fmt: skip
    drawn = DrawnRow(models=None, vertices=None, light=None, uses=step.uses)
    return DrawStep(
        kind="draw", name=step.name, pass_="", barriers=(), buffer_barriers=(), only_first=False,
        targets=tuple(targets), depth=None, viewport=None, scissor=None, blend_constant=None,
        draws=(drawn,), source=step.source, continues=False,
    )  # fmt: skip


def _part_of(progress: Progress | None, number: int, total: int) -> Progress | None:
    """The progress of one of several parts of the work, as progress of all of it."""
    if progress is None:
        return None
    return lambda share: progress((number + share) / total)
