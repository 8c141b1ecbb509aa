"""Makes the frame job that draws a setting with a generated text, for the driver for OpenGL."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from ...compiler.ir.formats import VertexFormat
from ...targets.runner.drivers.draws import Draw
from ...targets.runner.drivers.frame_job import (
    OWN,
    Attachment,
    Barrier,
    FrameDraw,
    FrameJob,
    FrameStep,
    FrameTexture,
)
from ...targets.runner.drivers.pipeline import Code, Pipeline, VertexInput
from ...targets.runner.drivers.render_state import RenderTarget
from .images import Images
from .records import FidelityError, Generated, Stream
from .settings import BACKGROUND, Floats, Setting, whole
from .uniforms import uniform_block

_FORMATS: Mapping[str, VertexFormat] = {
    "float": "float32", "vector2": "float32x2", "vector3": "float32x3", "vector4": "float32x4",
    "color3": "float32x3", "color4": "float32x4", "integer": "sint32", "boolean": "sint32",
}  # fmt: skip
_LANES = {
    "float": 1, "vector2": 2, "vector3": 3, "vector4": 4, "color3": 3, "color4": 4,
    "integer": 1, "boolean": 1,
}  # fmt: skip
_CHANNELS = {
    "i_position": "position", "i_normal": "normal", "i_tangent": "tangent", "i_color_0": "color",
}  # fmt: skip
_COORDINATES = {"i_texcoord_0": "uv", "i_texcoord_1": "uv2"}
_PRIMVAR = "i_geomprop_"

_TARGET, _DEPTH = 0, 1


def foreign_job(generated: Generated, setting: Setting, images: Images) -> FrameJob:
    """The job that draws a generated text, and reads its picture back. Raises ``FidelityError``."""
    width, height = setting.size
    slot, data = uniform_block(generated, setting)
    textures = [images.bound(use) for use in generated.images]
    pipeline = Pipeline(
        stages={
            "vertex": Code("main", generated.vertex),
            "fragment": Code("main", generated.pixel),
        },
        inputs=tuple(_inputs(generated)),
        blocks=(slot,) if slot.uniforms else (),
        textures=tuple(texture for texture, _image in textures),
        targets=(RenderTarget("rgba32float"),),
        # Where the front is discarded, the inside of the mesh would be seen through it.
        cull="back",
        first_row="bottom",
    )
    mesh = setting.mesh
    draw = Draw(
        width=width,
        height=height,
        vertex_count=len(mesh),
        vertices=tuple(_bytes(stream, setting) for stream in generated.streams),
        indices=mesh.triangles.astype("<u4").tobytes(),
        blocks=(data,) if slot.uniforms else (),
        textures=tuple(image for _slot, image in textures),
    )
    return _job(pipeline, FrameDraw(0, (OWN,) * len(textures), (), draw), setting)


def _job(pipeline: Pipeline, drawn: FrameDraw, setting: Setting) -> FrameJob:
    width, height = setting.size
    barriers = (Barrier(_TARGET, "undefined", "target"), Barrier(_DEPTH, "undefined", "depth"))
    return FrameJob(
        (FrameTexture("rgba32float", width, height), FrameTexture("depth32float", width, height)),
        (),
        (pipeline,),
        (
            FrameStep(
                barriers, (Attachment(_TARGET, clear=BACKGROUND),),
                Attachment(_DEPTH, clear=(1.0, 0.0, 0.0, 0.0)), (drawn,), name="MaterialX's text",
            ),
            FrameStep((Barrier(_TARGET, "target", "copied_from"),), read=(_TARGET,)),
        ),
    )  # fmt: skip


def _inputs(generated: Generated) -> Iterator[VertexInput]:
    for location, stream in enumerate(generated.streams):
        if stream.type not in _FORMATS:
            raise FidelityError(f"no mesh has `{stream.name}`, which is of type {stream.type}")
        yield VertexInput(stream.name, location, _FORMATS[stream.type])


def _bytes(stream: Stream, setting: Setting) -> bytes:
    values = stream_values(stream, setting)
    kind = "<i4" if _FORMATS[stream.type] == "sint32" else "<f4"
    return np.ascontiguousarray(values).astype(kind).tobytes()


def stream_values(stream: Stream, setting: Setting) -> Floats:
    """The values of an attribute at each vertex. MaterialX's v runs upwards."""
    lanes = _LANES[stream.type]
    if stream.name in _COORDINATES:
        uv = setting.channel(_COORDINATES[stream.name], 2)
        values = np.zeros((len(uv), lanes))
        values[:, 0], values[:, 1] = uv[:, 0], 1 - uv[:, 1]
        return values
    if stream.name in _CHANNELS:
        return setting.channel(_CHANNELS[stream.name], lanes)[:, :lanes]
    name = stream.name.removeprefix(_PRIMVAR)
    values = setting.channel(name, lanes)
    return whole(values) if stream.type in ("integer", "boolean") else values
