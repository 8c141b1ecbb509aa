"""Writes a frame job for the page, which executes it with the host for web pages.

``driver.py`` calls ``document_of``, and ``jobs.mjs`` reads the document. Its shaders have the
fields that the host's renderers read of a package; a slot is named by its number in the pipeline.
Textures that several draws carry are written once.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, cast

from .....compiler.documents.drawing import TOPOLOGY_WORDS, SamplerState
from .....compiler.documents.writing import to_json as document_json
from .....compiler.ir.formats import VERTEX_FORMATS
from .....compiler.ir.stages import COMPUTE, INSTANCES, VERTICES
from .....compiler.ir.types import DIMENSION_WORDS
from ..device import DriverError
from ..draws import Dispatch, Draw
from ..frame_job import OWN, Attachment, FrameDraw, FrameJob, FrameStep
from ..pipeline import Pipeline
from ..render_state import RenderTarget
from ..slots import BlockSlot, BufferSlot, ImageSlot, TextureSlot
from ..texels import Image
from ..webgpu import COMPUTED, DRAWN, for_pages, interleaved, vertex_buffers
from ..wire import to_json

WGSL = "wgsl:webgpu"
"""The profile whose pipelines are described in the words of WebGPU."""

_REPRESENTATIONS = {format: name for name, format in VERTEX_FORMATS.items()}


def document_of(job: FrameJob, profile: str) -> dict[str, Any]:
    """The document of a job whose pipelines have texts for a profile.

    Raises ``DriverError`` for targets of several layers, which no page can draw to at once.
    """
    pictures: dict[Image, int] = {}
    steps = [_step(job, step, pictures) for step in job.steps]
    return {
        "shaders": [_shader(*each, profile) for each in enumerate(job.pipelines)],
        "pipelines": list(_formats(job)),
        "pictures": [_as_in_documents(to_json(each)) for each in pictures],
        "textures": list(_textures(job)),
        "buffers": [to_json(each.contents) for each in job.buffers],
        "steps": steps,
    }


# --- shaders -------------------------------------------------------------------------------------


def _shader(number: int, pipeline: Pipeline, profile: str) -> dict[str, Any]:
    texts = {stage: {"text": c.text, "entry": c.entry} for stage, c in pipeline.stages.items()}
    visibility = COMPUTED if COMPUTE.name in pipeline.stages else DRAWN
    names = {
        BlockSlot: _names(pipeline.blocks),
        BufferSlot: _names(pipeline.buffers),
        ImageSlot: _names(pipeline.images),
        TextureSlot: _names(pipeline.textures),
    }
    return {
        "reflection": _reflection(number, pipeline, profile),
        "texts": {profile: texts},
        "webgpu": for_pages(pipeline, visibility, names) if profile == WGSL else None,
    }


def _names(slots: Sequence[object]) -> list[str]:
    return [str(number) for number in range(len(slots))]


def _reflection(number: int, pipeline: Pipeline, profile: str) -> dict[str, Any]:
    """The part of a reflection that the renderers read."""
    textures = list(zip(_names(pipeline.textures), pipeline.textures, strict=True))
    return {
        "material": f"pipeline {number}",
        "blocks": [
            {"name": name, "size": slot.size}
            for name, slot in zip(_names(pipeline.blocks), pipeline.blocks, strict=True)
        ],
        "textures": [
            {"name": name, "layout": {"sampler": slot.sampling}} for name, slot in textures
        ],
        "samplers": [
            {"texture": name, "state": _sampler(slot)}
            for name, slot in textures
            if slot.sampling is not None
        ],
        "vertex_inputs": [
            {
                "name": each.identifier, "representation": _REPRESENTATIONS[each.format],
                "step": each.step, "buffer": None,
            }
            for each in pipeline.inputs
        ],
        "targets": [_target(target) for target in pipeline.targets],
        "capture": _capture(pipeline),
        "draw": {"topology": TOPOLOGY_WORDS[pipeline.primitive]},
        "render_state": _render_state(pipeline),
        "backends": {profile: _backend(pipeline)},
    }  # fmt: skip


def _sampler(slot: TextureSlot) -> Mapping[str, Any]:
    state = SamplerState(
        filter=slot.filter, mip=slot.mip, wrap=slot.wrap, wrap_u=slot.wrap_u, wrap_v=slot.wrap_v,
        wrap_w=slot.wrap_w, border=slot.border, compare=slot.compare,
    )  # fmt: skip
    return cast(Mapping[str, Any], document_json(state))


def _target(target: RenderTarget) -> Mapping[str, Any]:
    return {
        "format": target.format, "blend": document_json(target.blend), "mask": target.mask,
    }  # fmt: skip


def _capture(pipeline: Pipeline) -> Mapping[str, Any] | None:
    if (stream := pipeline.stream_output) is None:
        return None
    members = [{"name": each.identifier} for each in stream.outputs]
    topology = TOPOLOGY_WORDS[stream.primitive]
    return {"topology": topology, "stride": stream.stride, "members": members}


def _render_state(pipeline: Pipeline) -> Mapping[str, Any]:
    return {
        "samples": pipeline.samples,
        "alpha_to_coverage": pipeline.alpha_to_coverage,
        "cull": pipeline.cull,
        "fill": pipeline.fill,
        "depth": document_json(pipeline.depth),
        "stencil": document_json(pipeline.stencil),
    }


def _backend(pipeline: Pipeline) -> Mapping[str, Any]:
    stream = pipeline.stream_output

    def by_number(identifiers: Sequence[str]) -> Mapping[str, Any]:
        return {str(at): {"identifier": name} for at, name in enumerate(identifiers)}

    def by_name(identifiers: Sequence[str]) -> Mapping[str, Any]:
        return {name: {"identifier": name} for name in identifiers}

    return {
        "front_face": pipeline.front_face,
        "blocks": by_number([slot.place.identifier for slot in pipeline.blocks]),
        "textures": by_number([slot.texture.identifier for slot in pipeline.textures]),
        "vertex_inputs": by_name([each.identifier for each in pipeline.inputs]),
        "captures": by_name([each.identifier for each in stream.outputs] if stream else []),
        "host_uniforms": list(pipeline.host_uniforms),
    }


def _formats(job: FrameJob) -> Iterator[dict[str, Any]]:
    """The formats of the attachments of steps, once for each pipeline that they use."""
    found: dict[tuple[int, tuple[str, ...], str | None], None] = {}
    for step in job.steps:
        targets = tuple(job.textures[each.texture].format for each in step.targets)
        depth = None if step.depth is None else job.textures[step.depth.texture].format
        found |= {(drawn.pipeline, targets, depth): None for drawn in step.draws}
    for shader, formats, depths in found:
        yield {"shader": shader, "targets": list(formats), "depth": depths}


# --- textures and steps --------------------------------------------------------------------------


def _textures(job: FrameJob) -> Iterator[Mapping[str, Any]]:
    written = {number for step in job.steps for number in step.images}
    for number, texture in enumerate(job.textures):
        uses = ["image"] if number in written else []
        yield {**_as_in_documents(to_json(texture)), "uses": uses}


def _as_in_documents(texture: Mapping[str, Any]) -> Mapping[str, Any]:
    """A texture with the word that documents have for its dimension."""
    return {**texture, "dimension": DIMENSION_WORDS[texture["dimension"]]}


def _step(job: FrameJob, step: FrameStep, pictures: dict[Image, int]) -> dict[str, Any]:
    is_run = any(drawn.dispatch is not None for drawn in step.draws)
    return {
        "targets": [_attachment(each) for each in step.targets],
        "depth": None if step.depth is None else _depth(step.depth),
        "calls": [_call(job.pipelines[each.pipeline], each, pictures) for each in step.draws],
        "groups": list(step.groups) if is_run else None,
        **{
            name: to_json(getattr(step, name))
            for name in (
                "viewport", "scissor", "blend_constant", "images", "copied", "read",
                "read_buffers", "captures",
            )
        },
    }  # fmt: skip


def _attachment(attachment: Attachment) -> dict[str, Any]:
    if attachment.layers > 1:
        raise DriverError("a browser draws to one layer at a time")
    return {
        "texture": attachment.texture,
        "layer": attachment.layer,
        "level": attachment.level,
        "load": _load(attachment),
        "store": attachment.stores,
        "clear": list(attachment.clear),
        "resolve": to_json(attachment.resolve),
    }


def _depth(attachment: Attachment) -> dict[str, Any]:
    stencil = {"load": _load(attachment), "store": attachment.stores_stencil, "clear": 0}
    return {**_attachment(attachment), "clear": [attachment.clear[0]], "stencil": stencil}


def _load(attachment: Attachment) -> str:
    return "load" if attachment.loads else "clear"


def _call(pipeline: Pipeline, drawn: FrameDraw, pictures: dict[Image, int]) -> dict[str, Any]:
    given = drawn.values
    return {
        "shader": drawn.pipeline,
        "mesh": None if drawn.draw is None else _geometry(pipeline, drawn.draw),
        "blocks": to_json(given.blocks),
        "textures": list(_read_textures(drawn, given, pictures)),
        "buffers": list(_read_buffers(drawn, given)),
    }


def _read_textures(
    drawn: FrameDraw, given: Draw | Dispatch, pictures: dict[Image, int]
) -> Iterator[Mapping[str, Any]]:
    own = iter(given.textures)
    for number in drawn.textures:
        if number == OWN:
            yield {"own": True, "number": pictures.setdefault(next(own), len(pictures))}
        else:
            yield {"own": False, "number": number}


def _read_buffers(drawn: FrameDraw, given: Draw | Dispatch) -> Iterator[int | str]:
    """The numbers of the frame's storage buffers, and the bytes of the draw's own ones."""
    own = iter(given.buffers)
    for number in drawn.buffers:
        yield to_json(next(own)) if number == OWN else number


def _geometry(pipeline: Pipeline, draw: Draw) -> dict[str, Any]:
    """The mesh as packages have it (``GeometryRow``)."""
    streams = {
        buffer.step: to_json(interleaved(buffer, draw.vertices))
        for buffer in vertex_buffers(pipeline.inputs)
    }
    return {
        "vertices": streams.get(VERTICES, ""),
        "instances": streams.get(INSTANCES, ""),
        "indices": to_json(draw.indices),
        "count": len(draw.indices) // 4,
        "instance_count": draw.instance_count,
        "elements": [],
    }
