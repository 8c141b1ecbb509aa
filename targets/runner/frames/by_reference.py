"""Draws a frame with the reference: step by step, in double precision.

What a step leaves is a texture or a buffer with bounds, if bounds are asked for: between which
numbers those of a device are. Of a pixel that is undecided, these contain all that a device may
have drawn there, so that what reads it is as uncertain as it should be.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ....compiler.ir.image_sizes import halved
from ....compiler.ir.shader import Shader
from ....compiler.reference.bounds.errors import Errors
from ....compiler.reference.picture import (
    NOWHERE,
    Canvas,
    Expected,
    Hulls,
    Places,
    RasterRules,
    Texels,
    draw_onto,
    expected_on,
    formats,
    written_by,
)
from ....compiler.reference.storage_buffers import Contents
from ..instances.instance import Instance
from ..kernels import drawable, full_screen_state, has_images
from ..reference import geometry_for, texels_of, values_for
from ..reference_kernels import elements_by_reference
from .host import FrameDraw, FrameHost, Row

Floats = NDArray[np.float64]
Progress = Callable[[float], None]

DEPTHS, STENCILS = "depth", "stencil8"
"""What the formats of depths begin with, and end with if there are stencil values."""
_ENDS = 3
"""A value, and between which numbers that of a device is."""


@dataclass(eq=False, slots=True)
class Drawn:
    """A texture while a frame is drawn."""

    format: str
    dimension: str
    levels: list[Floats]
    """Of each level (3, layers, height, width, lanes): values, and their lower and upper ends."""
    undecided: list[NDArray[np.bool_]]
    """Of each level (layers, height, width): the pixels that hang on rounding."""
    stencil: list[NDArray[np.int64]]
    """Of each level (layers, height, width): the values beside depths; empty if there are none."""
    stencil_unsure: list[NDArray[np.bool_]]
    """Likewise: where a device may have another one."""
    places: list[NDArray[np.int64]]
    """Of each level of depths (layers, height, width): the number of the place of the face that
    each is the depth of; empty if there are none."""

    @classmethod
    def empty(cls, row: Row, size: tuple[int, int]) -> Drawn:
        """Transparent black, or as far away as can be."""
        lanes, value = (1, 1.0) if row["format"].startswith(DEPTHS) else (4, 0.0)
        levels = [
            np.full((_ENDS, row["layers"], *reversed(_halved(size, level)), lanes), value)
            for level in range(row["levels"])
        ]
        undecided = [np.zeros(level.shape[1:4], np.bool_) for level in levels]
        beside = undecided if row["format"].endswith(STENCILS) else []
        stencil = [np.zeros(level.shape, np.int64) for level in beside]
        unsure = [level.copy() for level in beside]
        deep = undecided if row["format"].startswith(DEPTHS) else []
        places = [np.full(level.shape, NOWHERE) for level in deep]
        return cls(row["format"], row["dimension"], levels, undecided, stencil, unsure, places)

    @property
    def lanes(self) -> int:
        """How many lanes its format has."""
        return 1 if self.format.startswith(DEPTHS) else formats.lanes_of(self.format)

    def texels(self) -> Texels:
        """The texture as a shader reads it."""
        flat = self.dimension == "2d"
        value, low, high = (
            tuple(level[end, 0] if flat else level[end] for level in self.levels)
            for end in range(_ENDS)
        )
        return Texels(value, self.format.endswith("srgb"), low, high)

    def copy(self) -> Drawn:
        """The same contents in a texture of its own."""
        return deepcopy(self)


@dataclass(slots=True)
class ReferenceFrames:
    """Draws one frame after the other."""

    host: FrameHost
    rules: RasterRules = field(default_factory=lambda: RasterRules(1, 1))
    """But for the sizes, which are those of the steps."""
    errors: Errors | None = None
    shader_of: Callable[[int], Shader] | None = None
    """What the shader of a number computes, if that is not what it means: what a profile's text
    does."""
    frames: int = 0
    """How many have been drawn."""
    textures: dict[int, Drawn] = field(default_factory=dict)
    places: Places = field(default_factory=Places)
    buffers: dict[str, Contents] = field(default_factory=dict)
    """By the name of the result."""

    def draw(self, progress: Progress | None = None) -> None:
        """Draw the next frame."""
        plan = self.host.plan
        is_first = self.frames == 0
        self.host.begin(self.frames)
        self._keep()
        steps = plan["steps"]
        for number, step in enumerate(steps):
            if is_first or not step.get("only_first", False):
                self._step(step, is_first)
            if progress is not None:
                progress((number + 1) / len(steps))
        for row in plan["kept"]:
            self._exchange(row)
        self.frames += 1

    def output(self, name: str) -> Drawn:
        """What an output of the last frame shows."""
        row = next(row for row in self.host.plan["outputs"] if row["name"] == name)
        kept = {row["result"]: row["previous"] for row in self.host.plan["kept"]}
        return self.textures[kept.get(row["result"], row["texture"])]

    # --- steps -----------------------------------------------------------------------------------

    def _keep(self) -> None:
        """Make the textures that the first frame finds as the last one would have left them."""
        for row in self.host.plan["kept"]:
            previous = row["previous"]
            if previous is not None and previous not in self.textures:
                self._make(previous)

    def _exchange(self, row: Row) -> None:
        if row["texture"] is None:
            self.buffers[f"previous({row['result']})"] = self.buffers[row["result"]]
            return
        one, other = row["texture"], row["previous"]
        if one in self.textures:
            self.textures[one], self.textures[other] = self.textures[other], self.textures[one]

    def _make(self, texture: int) -> Drawn:
        row = self.host.plan["textures"][texture]
        made = Drawn.empty(row, self.host.size_of(texture))
        self.textures[texture] = made
        return made

    def _step(self, step: Row, is_first: bool) -> None:
        match step["kind"]:
            case "copy":
                source, target = step["from"]["texture"], step["to"]["texture"]
                self.textures[target] = self.textures[source].copy()
            case "run":
                self._run(step, self.host.kernel(step, is_first=is_first))
            case _:
                self._draw(step, is_first)

    def _draw(self, step: Row, is_first: bool) -> None:
        draws = list(self.host.draws(step, is_first=is_first))
        targets = [*step["targets"], *([step["depth"]] if step["depth"] else [])]
        for target in targets:
            is_new = target["load"] == "clear" and target["layer"] in (0, None)
            if target["texture"] not in self.textures or (is_new and target["level"] == 0):
                self._make(target["texture"])
        layers = (
            1
            if targets[0]["layer"] is not None
            else (self.host.plan["textures"][targets[0]["texture"]]["layers"])
        )
        for layer in range(layers):
            self._draw_layer(step, draws, layer)

    def _draw_layer(self, step: Row, draws: list[FrameDraw], layer: int) -> None:
        shader = drawable(self._shader(step["draws"][0]["uses"][0]["shader"]))
        width, height = self.host.drawn_size(step)
        state, depth = self.host.state_of(step), step["depth"]
        rules = replace(
            self.rules, width=width, height=height, viewport=state.viewport,
            scissor=state.scissor, samples=shader.render_state.samples,
        )  # fmt: skip
        canvas = Canvas(
            rules.sample_count, [self.host.clear_of(target) for target in step["targets"]],
            written_by(shader), rounds=self.errors is not None, has_depth=depth is not None,
            depth=1.0 if depth is None else self.host.clear_of(depth)[0],
            blend_constant=state.blend_constant, places=self.places,
        )  # fmt: skip
        self._load(canvas, step, layer)
        hulls = Hulls(canvas)
        self._load_hulls(hulls, step, layer)
        for draw in draws:
            self._onto(canvas, hulls, draw, rules, layer)
        self._store(canvas, hulls, step, layer, rules)

    def _shader(self, number: int) -> Shader:
        if self.shader_of is not None:
            return self.shader_of(number)
        return self.host.shaders[number].shader

    def _onto(
        self, canvas: Canvas, hulls: Hulls, draw: FrameDraw, rules: RasterRules, layer: int
    ) -> None:
        """Draw on a canvas; where a shader draws each layer by itself, this one."""
        state = draw.state.layers[layer] if draw.state.layers else draw.state
        shader = drawable(self._shader(draw.shader))
        written = self._give_buffers(state.instance, draw)
        draw_onto(
            canvas, shader, values_for(shader, state.instance, written), self._texels(draw),
            geometry_for(shader, state.geometry()), rules, self.errors,
            hulls=None if self.errors is None else hulls,
        )  # fmt: skip

    def _texels(self, draw: FrameDraw) -> Mapping[str, Texels]:
        found = texels_of(draw.state.instance)
        for name, read in draw.reads.items():
            if read.texture is not None:
                found[name] = self.textures[read.texture].texels()
        return found

    def _give_buffers(self, instance: Instance, draw: FrameDraw) -> Mapping[str, Contents]:
        """Give an instance the buffers that steps have written, whose contents are returned."""
        written = {
            name: self.buffers[read.result]
            for name, read in draw.reads.items()
            if read.texture is None
        }
        for name, contents in written.items():
            instance.set_bytes(name, contents.data)
        return written

    # --- contents --------------------------------------------------------------------------------

    def _load(self, canvas: Canvas, step: Row, layer: int) -> None:
        """Put what is there before on a canvas."""
        for number, target in enumerate(step["targets"]):
            if target["load"] == "load":
                canvas.targets[number][:] = self._pixels(target, layer)
        depth = step["depth"]
        if depth is not None and depth["load"] == "load":
            value, low, high = self._pixels(depth, layer)[..., 0]
            canvas.depth[:] = value
            canvas.depth_off[:] = np.maximum(high - value, value - low)
            texture, at, level = _place(depth, layer)
            canvas.place[:] = self.textures[texture].places[level][at].ravel()
            self._load_stencil(canvas, depth, layer)
        for target in self._loaded(step):
            texture, at, level = _place(target, layer)
            canvas.shaky |= self.textures[texture].undecided[level][at].ravel()

    def _load_stencil(self, canvas: Canvas, depth: Row, layer: int) -> None:
        texture, at, level = _place(depth, layer)
        kept = self.textures[texture]
        if kept.stencil:
            canvas.stencil.values[:] = kept.stencil[level][at].ravel()
            canvas.stencil.unsure[:] = kept.stencil_unsure[level][at].ravel()

    def _loaded(self, step: Row) -> Iterator[Row]:
        for target in [*step["targets"], *([step["depth"]] if step["depth"] else [])]:
            if target["load"] == "load":
                yield target

    def _pixels(self, target: Row, layer: int) -> Floats:
        """What is there of a layer and level: (3, pixels, lanes)."""
        texture, at, level = _place(target, layer)
        found = self.textures[texture].levels[level][:, at]
        return found.reshape(_ENDS, -1, found.shape[-1])

    def _load_hulls(self, hulls: Hulls, step: Row, layer: int) -> None:
        """What undecided pixels may be of what is there before."""
        for number, target in enumerate(step["targets"]):
            if target["load"] == "load":
                hulls.targets[number][:] = self._pixels(target, layer)[1:]
        if step["depth"] is not None and step["depth"]["load"] == "load":
            hulls.depth[:] = self._pixels(step["depth"], layer)[1:, :, 0]

    def _store(
        self, canvas: Canvas, hulls: Hulls, step: Row, layer: int, rules: RasterRules
    ) -> None:
        """Keep what was drawn."""
        picture = expected_on(canvas, rules)
        for number, target in enumerate(step["targets"]):
            ends = np.stack([picture.targets[number], picture.low[number], picture.high[number]])
            self._keep_pixels(target, layer, ends, hulls.targets[number], picture)
        if step["depth"] is not None:
            value = canvas.depth.reshape(rules.height, rules.width, 1)
            off = canvas.depth_off.reshape(value.shape)
            ends = np.stack([value, value - off, value + off])
            self._keep_pixels(step["depth"], layer, ends, hulls.depth[..., None], picture)
            texture, at, level = _place(step["depth"], layer)
            self.textures[texture].places[level][at] = canvas.place.reshape(value.shape[:2])
            self._keep_stencil(step["depth"], layer, canvas)

    def _keep_pixels(
        self, target: Row, layer: int, ends: Floats, hull: Floats, picture: Expected
    ) -> None:
        """Keep values between their ends; what is undecided may be all that its hull contains."""
        texture, at, level = _place(target, layer)
        drawn = self.textures[texture]
        for end, extreme in zip(ends[1:], hull, strict=True):
            end[picture.undecided] = extreme.reshape(end.shape)[picture.undecided]
        if drawn.format.startswith(DEPTHS):
            ends = np.clip(ends, 0.0, 1.0)
        else:
            ends = np.stack([formats.clamped(drawn.format, end) for end in ends])
        drawn.levels[level][:, at] = ends
        drawn.undecided[level][at] = picture.undecided

    def _keep_stencil(self, depth: Row, layer: int, canvas: Canvas) -> None:
        texture, at, level = _place(depth, layer)
        drawn = self.textures[texture]
        if drawn.stencil:
            shape = drawn.stencil[level][at].shape
            drawn.stencil[level][at] = canvas.stencil.values.reshape(shape)
            drawn.stencil_unsure[level][at] = canvas.stencil.unsure.reshape(shape)

    # --- kernels ---------------------------------------------------------------------------------

    def _run(self, step: Row, draw: FrameDraw) -> None:
        instance = draw.state.instance
        given = self._give_buffers(instance, draw)
        if not has_images(instance.reflection):
            written = elements_by_reference(
                self._shader(draw.shader), instance, self._texels(draw), given, self.rules,
                self.errors,
            )  # fmt: skip
            self.buffers |= {row["result"]: written[row["name"]] for row in step["buffers"]}
            return
        rows = [
            {
                "texture": row["texture"],
                "layer": 0,
                "level": 0,
                "load": "clear",
                "clear": None,
                "result": row["result"],
            }
            for row in step["images"]
        ]
        for row in rows:
            self._make(row["texture"])
        drawn = replace(draw, state=full_screen_state(instance))
        self._draw_layer(
            {
                "name": step["name"], "targets": rows, "depth": None, "viewport": None,
                "scissor": None, "blend_constant": None,
                "draws": [{"uses": [{"shader": draw.shader}]}],
            },
            [drawn], 0,
        )  # fmt: skip


def _place(target: Row, layer: int) -> tuple[int, int, int]:
    at = layer if target["layer"] is None else target["layer"]
    return target["texture"], at, target["level"]


def _halved(size: tuple[int, int], times: int) -> tuple[int, int]:
    width, height = size
    return halved(width, times), halved(height, times)
