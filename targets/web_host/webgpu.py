"""Makes what packages say of a shader's pipeline in the words of WebGPU.

``package.py`` calls ``webgpu_pipeline``. A page hands these descriptors to the browser as they are.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from ...compiler.documents.plan import DrawStep, FramePlan, FrameTextureRow, RunStep
from ...compiler.documents.reading import read
from ...compiler.documents.reflection import Reflection
from ...compiler.ir.formats import DEPTH_WORDS
from ...compiler.ir.stages import COMPUTE
from ..runner.binding import FORMATS, pipeline
from ..runner.codes import Codes
from ..runner.drivers import webgpu
from ..runner.drivers.pipeline import Pipeline
from ..runner.drivers.slots import BlockSlot, BufferSlot, ImageSlot, TextureSlot
from ..runner.routes import ROUTES
from .serving.packages import PackagedShader, PipelineRow, WebGPUPipeline

_ROUTE = ROUTES["chromium:webgpu"]
WGSL = _ROUTE.profile
"""The profile whose texts WebGPU takes."""


def webgpu_pipeline(reflection: Reflection, stages: Collection[str]) -> WebGPUPipeline:
    """The descriptors of the pipeline of a shader with texts for these stages, and what is bound in
    its groups."""
    made = _with_anisotropies(pipeline(reflection, _ROUTE, Codes({})), reflection)
    visibility = webgpu.COMPUTED if COMPUTE.name in stages else webgpu.DRAWN
    return read(WebGPUPipeline, webgpu.for_pages(made, visibility, _names(reflection)))


def _with_anisotropies(made: Pipeline, reflection: Reflection) -> Pipeline:
    """The pipeline with the filters that a page has for people, beside those that are compared."""
    said = {row.texture: row.state.anisotropy or 1 for row in reflection.samplers}
    names = _names(reflection)[TextureSlot]
    slots = zip(names, made.textures, strict=True)
    return replace(made, textures=tuple(
        replace(slot, anisotropy=said.get(name, 1)) for name, slot in slots
    ))  # fmt: skip


def pipelines(plan: FramePlan, shaders: Sequence[PackagedShader]) -> Iterator[PipelineRow]:
    """The formats of what steps draw to, once for each pipeline that they use."""
    found: dict[tuple[int, tuple[str, ...], str | None], None] = {}
    for step in plan.steps:
        if isinstance(step, DrawStep):
            targets = tuple(_format(plan, row.texture) for row in step.targets)
            depth = None if step.depth is None else _format(plan, step.depth.texture)
            for drawn in step.draws:
                found |= {(use.shader, targets, depth): None for use in drawn.uses}
        elif isinstance(step, RunStep):
            is_computed = COMPUTE.name in shaders[step.use.shader].texts.get(WGSL, ())
            images = () if is_computed else step.images
            found[step.use.shader, tuple(_format(plan, row.texture) for row in images), None] = None
    for shader, targets, depth in found:
        if shaders[shader].webgpu is not None:
            yield PipelineRow(shader=shader, targets=targets, depth=depth)


def _format(plan: FramePlan, texture: int) -> str:
    return format_of(plan.textures[texture])


def format_of(texture: FrameTextureRow) -> str:
    """The format of a texture of a plan."""
    name = texture.format
    return DEPTH_WORDS.get(name) or FORMATS[name]


def _names(reflection: Reflection) -> webgpu.Names:
    """The reflection's names of the slots of each kind, in the order of the slots."""

    def read(kind: str) -> list[str]:
        return [row.name for row in getattr(reflection, kind) if row.stages]

    def all_of(kind: str) -> list[str]:
        return [row.name for row in getattr(reflection, kind)]

    return {
        BlockSlot: all_of("blocks"),
        BufferSlot: [*read("buffers"), *all_of("results")],
        ImageSlot: all_of("targets"),
        TextureSlot: read("textures"),
    }
