"""Planted errors between named values and drivers: blocks, derived values, textures, pipelines."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from burnish.compiler.ir.render_state import StencilState
from burnish.support.frozen import changed
from burnish.targets.runner.drivers.checks import level_size
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.frame_job import BLACK, FrameJob
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.drivers.texels import Image
from burnish.targets.runner.instances import blocks, derived, instance, shapes
from burnish.targets.runner.instances.shapes import Numbers, Shape
from burnish.targets.runner.textures.texture import Texture

from ...runner.blends import named
from ..kit import redrawn
from .planting import QUICKEST, Plant, Planted, job, replaced

write, write_numbers = blocks.write, blocks._write_numbers
image = Texture.image
step = derived.compute
elements = derived.compute_elements


def _shifted(block: bytearray, offset: int, shape: Shape, value: Any) -> None:
    """Write one lane too far, if there is room."""
    whole = bytearray(len(block) + 4)
    write(whole, offset + 4, shape, value)
    held = whole[: len(block)]
    block[:] = bytes(a | b for a, b in zip(block, held, strict=True))


def _rows(block: bytearray, offset: int, shape: Numbers, lanes: Any) -> None:
    """Write rows instead of columns."""
    turned = tuple(zip(*lanes, strict=True)) if shape.columns else lanes
    write_numbers(block, offset, shape, turned)


def _tight(block: bytearray, offset: int, shape: Numbers, lanes: Any) -> None:
    """Write columns without the gaps between them."""
    write_numbers(block, offset, replace(shape, column_stride=4 * shape.lanes), lanes)


def _big_endian(block: bytearray, offset: int, shape: Numbers, lanes: Any) -> None:
    scratch = bytearray(len(block))
    write_numbers(scratch, offset, shape, lanes)
    changed = np.frombuffer(scratch, "<u4").byteswap().tobytes()
    block[:] = bytes(a | b for a, b in zip(block, changed, strict=True))


def _inverted(block: bytearray, offset: int, shape: Numbers, lanes: Any) -> None:
    """Write the opposite of each bool."""
    values = tuple(not lane for lane in lanes) if shape.kind == "bool" else lanes
    write_numbers(block, offset, shape, values)


def _without_stride(shape: Shape, position: int) -> tuple[str, int, Shape]:
    """Place elements directly after each other."""
    name, offset, inner = shapes.part(shape, position)
    size = 4 * inner.lanes if isinstance(inner, Numbers) and not inner.columns else None
    return name, offset if size is None else position * size, inner


def _of_the_operand(steps: Any, inputs: Any) -> Any:
    """Store the value before the last step."""
    last = steps[-1]
    alike = [number for number in last.args if steps[number].type == last.type]
    return step(steps[: alike[0] + 1] if alike else steps, inputs)


def _of_the_next(steps: Any, inputs: Any, count: int) -> Any:
    """Store the value of the next element."""
    first, *others = elements(steps, inputs, count)
    return (*others, first)


class Stale:
    """Compute derived values once, and keep them while parameters change."""

    def __init__(self) -> None:
        self._first: dict[int, Any] = {}

    def __call__(self, steps: Any, inputs: Any) -> Any:
        return self._first.setdefault(id(steps), step(steps, inputs))


def _mirrored(texture: Texture) -> Image:
    """Put the first row at the bottom."""
    whole = image(texture)
    row = len(whole.levels[0]) // whole.height
    first = whole.levels[0]
    turned = b"".join(first[at : at + row] for at in range(len(first) - row, -1, -row))
    return replace(whole, levels=(turned, *whole.levels[1:]))


def _levels_of_another(texture: Texture) -> Image:
    """Put the texels of smaller levels into the wrong order."""
    whole = image(texture)
    others = (np.frombuffer(level, "<u4")[::-1].tobytes() for level in whole.levels[1:])
    return replace(whole, levels=(whole.levels[0], *others))


def _backwards(texture: Texture) -> Image:
    """Put the last layer, slice or face first."""
    whole = image(texture)
    sizes = (level_size(whole, number)[2] for number in range(len(whole.levels)))
    turned = (
        b"".join(part.tobytes() for part in np.split(np.frombuffer(level, "u1"), depth)[::-1])
        for level, depth in zip(whole.levels, sizes, strict=True)
    )
    return replace(whole, levels=tuple(turned))


def _draws(change: Callable[[Draw], Draw]) -> Plant:
    return job(lambda asked: redrawn(asked, change))


def _pipelines(change: Callable[[Pipeline], Pipeline]) -> Plant:
    return job(lambda asked: replace(asked, pipelines=tuple(map(change, asked.pipelines))))


def _last_vertex_first(draw: Draw) -> Draw:
    turned = np.roll(np.frombuffer(draw.indices, "<u4").reshape(-1, 3), 1, axis=1)
    return replace(draw, indices=turned.tobytes())


def _samplers(**state: Any) -> Plant:
    """With some of the state of all samplers set to something else."""
    return _pipelines(
        lambda made: replace(made, textures=tuple(replace(slot, **state) for slot in made.textures))
    )


def _targets(**state: Any) -> Plant:
    """With some of the state of all targets set to something else."""
    return _pipelines(
        lambda made: replace(
            made, targets=tuple(replace(target, **state) for target in made.targets)
        )
    )


def _states(**state: Any) -> Plant:
    """With some of a pipeline's state set to something else."""
    return _pipelines(lambda made: replace(made, **state))


def _depths(**state: Any) -> Plant:
    """With some of a pipeline's depth test set to something else."""
    return _pipelines(lambda made: replace(made, depth=changed(made.depth, **state)))


def _stencils(**state: Any) -> Plant:
    """With some of a pipeline's stencil test set to something else."""
    return _stencil(lambda stencil: changed(stencil, **state))


def _sides_exchanged(stencil: StencilState) -> StencilState:
    return changed(stencil, front=stencil.back, back=stencil.front)


def _stencil(change: Callable[[StencilState], StencilState]) -> Plant:
    def made(pipeline: Pipeline) -> Pipeline:
        assert pipeline.stencil is not None
        return replace(pipeline, stencil=change(pipeline.stencil))

    return _pipelines(made)


def _without_constant(asked: FrameJob) -> FrameJob:
    """With black for the colour by which targets are blended."""
    return replace(asked, steps=tuple(replace(each, blend_constant=BLACK) for each in asked.steps))


def _textures_exchanged(draw: Draw) -> Draw:
    return replace(draw, textures=draw.textures[::-1])


GLSL, HLSL, WGSL = QUICKEST["glsl"], QUICKEST["hlsl"], QUICKEST["wgsl"]


def _buffers_turned(whole: Draw) -> Draw:
    """With the words of every storage buffer in the opposite order."""
    turned = (np.frombuffer(data, "<u4")[::-1].tobytes() for data in whole.buffers)
    return replace(whole, buffers=tuple(turned))


PLANTED = [
    Planted("blocks a lane too far", "storage: Plain", GLSL, replaced(instance, "write", _shifted)),
    Planted("matrices by rows", "storage: Products", HLSL,
            replaced(blocks, "_write_numbers", _rows)),
    Planted("columns without gaps", "storage: Products", WGSL,
            replaced(blocks, "_write_numbers", _tight)),
    Planted("big-endian", "storage: Plain", GLSL, replaced(blocks, "_write_numbers", _big_endian)),
    Planted("bools inverted", "storage: Plain", HLSL,
            replaced(blocks, "_write_numbers", _inverted)),
    Planted("elements without gaps", "storage: Elements", WGSL,
            replaced(blocks, "part", _without_stride)),
    Planted("a step too few", "storage: Plain", GLSL,
            replaced(derived, "compute", _of_the_operand)),
    Planted("stale values", "storage: Plain", HLSL, replaced(derived, "compute", Stale())),
    Planted("values of the next element", "tables: Sums", GLSL,
            replaced(derived, "compute_elements", _of_the_next)),
    Planted("rows from below", "textures: Wraps", HLSL, replaced(Texture, "image", _mirrored)),
    Planted("wrong smaller levels", "textures: Levels", WGSL,
            replaced(Texture, "image", _levels_of_another)),
    Planted("faces in another order", "kinds: Shapes", GLSL,
            replaced(Texture, "image", _backwards)),
    Planted("layers of depths in another order", "kinds: Compared", WGSL,
            replaced(Texture, "image", _backwards)),
    Planted("slices of integers in another order", "kinds: Loaded", HLSL,
            replaced(Texture, "image", _backwards)),
    Planted("all compare likewise", "kinds: Compared", HLSL,
            _samplers(compare="less")),
    Planted("textures exchanged", "textures: Wraps", GLSL, _draws(_textures_exchanged)),
    Planted("buffers exchanged", "buffers: Shapes", WGSL, _draws(_buffers_turned)),
    Planted("all repeat", "textures: Wraps", GLSL, _samplers(wrap="repeat")),
    Planted("all mirror", "textures: Wraps", HLSL, _samplers(wrap="mirror")),
    Planted("all smooth", "textures: Wraps", WGSL, _samplers(filter="linear")),
    Planted("all coarse", "textures: Wraps", GLSL, _samplers(filter="nearest")),
    Planted("nearest levels", "textures: Levels", HLSL, _samplers(mip="nearest")),
    Planted("no levels", "textures: Levels", WGSL, _samplers(mip="none")),
    Planted("flat from the last vertex", "pipeline: Crossing", GLSL,
            _draws(_last_vertex_first)),
    Planted("clockwise front faces", "pipeline: Crossing", HLSL, _states(front_face="cw")),
    Planted("both sides drawn", "pipeline: Backs", GLSL, _states(cull="none")),
    Planted("the other side drawn", "pipeline: Backs", WGSL, _states(cull="back")),
    Planted("depths written", "pipeline: Layers", HLSL, _depths(write=True)),
    Planted("the nearest drawn", "pipeline: Latest", GLSL, _depths(compare="less")),
    Planted("another reference", "pipeline: Counted", GLSL, _stencils(reference=1)),
    Planted("fewer bits written", "pipeline: Counted", HLSL, _stencils(write_mask=6)),
    Planted("sides counted the other way round", "pipeline: Sided", WGSL,
            _stencil(_sides_exchanged)),
    Planted("no stencil test", "pipeline: Sided", GLSL, _states(stencil=None)),
    Planted("nothing moved", "pipeline: Biased", GLSL, _depths(bias=0, slope_bias=0.0)),
    Planted("clamped no more", "pipeline: Biased", HLSL, _depths(bias_clamp=0.0)),
    Planted("fronts as usual", "pipeline: Clockwise", WGSL, _states(front_face="ccw")),
    Planted("masked lanes written", "pipeline: Stained", WGSL, _targets(mask="rgba")),
    Planted("blended by nothing", "pipeline: Stained", GLSL,
            job(_without_constant)),
    Planted("added instead of blended", "pipeline: Veil", GLSL, _targets(blend=named("add"))),
    Planted("whole triangles", "pipeline: Edges", GLSL, _states(fill="faces")),
]  # fmt: skip
