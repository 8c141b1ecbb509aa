"""A pipeline in the words of WebGPU: descriptors of its state, and its bind groups.

The driver of wgpu makes pipelines with them. Keys are written with underscores, as Python's library
for WebGPU has them; ``for_pages`` writes them as web pages do, for packages of frames and for the
driver of browsers.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from ....compiler.documents.drawing import ADDRESS_MODES, TOPOLOGY_WORDS
from ....compiler.documents.writing import to_json
from ....compiler.ir.blending import BlendEquation
from ....compiler.ir.render_state import COMPARE_WORDS, StencilSide
from ....compiler.ir.types import AXES, DIMENSION_WORDS
from .checks import lane_count
from .pipeline import Pipeline, VertexInput
from .render_state import RenderTarget
from .slots import BlockSlot, BufferSlot, ImageSlot, TextureSlot

DEPTH = "depth32float"
FLOAT32_TARGETS = {"r32float", "rg32float", "rgba32float"}
"""The formats of render targets that not every device can blend."""

DRAWN, COMPUTED = 0x3, 0x4
"""The bits of GPUShaderStage: of the two stages that draw, and of kernels."""
_LANES = {"r": 0x1, "g": 0x2, "b": 0x4, "a": 0x8}
"""The bits of GPUColorWrite."""


@dataclass(frozen=True, slots=True)
class Bound:
    """One entry of a bind group: a block, buffer, image or texture, or the sampler of a texture."""

    slot: BlockSlot | BufferSlot | ImageSlot | TextureSlot
    number: int
    """The slot's place in the pipeline's blocks, buffers, images or textures."""
    is_sampler: bool = False


Groups = list[dict[int, Bound]]
"""The bind groups: the entries by binding."""


@dataclass(frozen=True, slots=True)
class VertexBuffer:
    """A vertex buffer: all attributes that advance at the same time."""

    step: str
    stride: int
    members: tuple[tuple[int, VertexInput, int], ...]
    """The number of each attribute, the attribute, and its offset."""


def primitive(pipeline: Pipeline) -> Mapping[str, Any]:
    """The primitive state: topology, culling and winding."""
    return {
        "topology": TOPOLOGY_WORDS[pipeline.primitive],
        "cull_mode": pipeline.cull,
        "front_face": pipeline.front_face,
    }


def depth_stencil(pipeline: Pipeline) -> Mapping[str, Any]:
    """The tests of depths and of stencil values, without the format."""
    state: dict[str, Any] = {
        "depth_write_enabled": pipeline.depth.write,
        "depth_compare": COMPARE_WORDS[pipeline.depth.compare],
    }
    if pipeline.has_bias:
        state |= {
            "depth_bias": pipeline.depth.bias,
            "depth_bias_slope_scale": pipeline.depth.slope_bias,
            "depth_bias_clamp": pipeline.depth.bias_clamp,
        }
    if (stencil := pipeline.stencil) is not None:
        state |= {
            "stencil_front": _stencil_side(stencil.front),
            "stencil_back": _stencil_side(stencil.back),
            "stencil_read_mask": stencil.read_mask,
            "stencil_write_mask": stencil.write_mask,
        }
    return state


def _stencil_side(side: StencilSide) -> Mapping[str, str]:
    return cast(Mapping[str, str], to_json(side))


def color_target(target: RenderTarget) -> Mapping[str, Any]:
    """The format, the blend state and the write mask of a target."""
    mask = sum(bit for lane, bit in _LANES.items() if target.writes(lane))
    state = {"format": target.format, "write_mask": mask}
    if (blend := target.blend) is None:
        return state
    return {**state, "blend": {"color": _equation(blend.color), "alpha": _equation(blend.alpha)}}


def _equation(equation: BlendEquation) -> Mapping[str, str]:
    words = to_json(equation)
    return {
        "operation": words["operation"],
        "src_factor": words["source"],
        "dst_factor": words["destination"],
    }


def sampler(slot: TextureSlot) -> Mapping[str, Any]:
    """The sampler of a texture."""
    state: dict[str, Any] = {
        **{
            f"address_mode_{axis}": ADDRESS_MODES[wrap]
            for axis, wrap in zip(AXES, slot.wraps, strict=True)
        },
        "mag_filter": slot.filter,
        "min_filter": slot.filter,
        "mipmap_filter": "nearest" if slot.mip == "none" else slot.mip,
        # A sampler cannot ignore mip levels, but it can stay on the first one.
        "lod_max_clamp": 0.0 if slot.mip == "none" else 32.0,
    }
    if slot.anisotropy > 1:
        state["max_anisotropy"] = slot.anisotropy
    return state if slot.compare is None else {**state, "compare": COMPARE_WORDS[slot.compare]}


def vertex_buffers(inputs: Sequence[VertexInput]) -> list[VertexBuffer]:
    """One buffer for the attributes of vertices and one for those of instances.

    WebGPU guarantees 16 attributes, but only 8 buffers.
    """
    found = []
    for step in ("vertex", "instance"):
        offset, members = 0, []
        for number, each in enumerate(inputs):
            if each.step == step:
                members.append((number, each, offset))
                offset += 4 * lane_count(each.format)
        if members:
            found.append(VertexBuffer(step, offset, tuple(members)))
    return found


def buffer_layout(buffer: VertexBuffer) -> Mapping[str, Any]:
    attributes = [
        {"format": each.format, "offset": offset, "shader_location": each.location}
        for _, each, offset in buffer.members
    ]
    return {"array_stride": buffer.stride, "step_mode": buffer.step, "attributes": attributes}


def interleaved(buffer: VertexBuffer, vertices: Sequence[bytes]) -> bytes:
    """The attributes of one buffer, one vertex, or instance, after the other. ``vertices`` has the
    values of each attribute of the pipeline."""
    columns = [
        np.frombuffer(vertices[number], np.uint8).reshape(-1, 4 * lane_count(each.format))
        for number, each, _ in buffer.members
    ]
    return np.concatenate(columns, axis=1).tobytes()


def bound(pipeline: Pipeline) -> Groups:
    """The bind groups of a pipeline, with an empty one for each unused number."""
    groups: Groups = []

    def add(group: int | None, binding: int | None, what: Bound) -> None:
        assert group is not None
        assert binding is not None
        groups.extend({} for _ in range(len(groups), group + 1))
        groups[group][binding] = what

    for number, block in enumerate(pipeline.blocks):
        add(block.place.group, block.place.binding, Bound(block, number))
    for number, buffer in enumerate(pipeline.buffers):
        add(buffer.place.group, buffer.place.binding, Bound(buffer, number))
    for number, image in enumerate(pipeline.images):
        add(image.place.group, image.place.binding, Bound(image, number))
    for number, slot in enumerate(pipeline.textures):
        add(slot.texture.group, slot.texture.binding, Bound(slot, number))
        if slot.sampler is not None:
            add(slot.sampler.group, slot.sampler.binding, Bound(slot, number, is_sampler=True))
    return groups


def layout_entries(group: Mapping[int, Bound], visibility: int) -> list[Mapping[str, Any]]:
    """An explicit layout: ``auto`` would leave out bindings that the shaders do not use."""
    return [{"binding": at, "visibility": visibility, **_entry(what)} for at, what in group.items()]


def _entry(what: Bound) -> Mapping[str, Any]:
    slot = what.slot
    if isinstance(slot, BlockSlot):
        # WebGPU reports an error if the block is larger in the shader than here.
        return {"buffer": {"type": "uniform", "min_binding_size": slot.size}}
    if isinstance(slot, BufferSlot):
        kind = "storage" if slot.written else "read-only-storage"
        return {"buffer": {"type": kind, "min_binding_size": slot.stride}}
    if isinstance(slot, ImageSlot):
        return {"storage_texture": {"access": "write-only", "format": slot.format}}
    if what.is_sampler:
        return {"sampler": {"type": slot.sampling}}
    return {
        "texture": {"view_dimension": DIMENSION_WORDS[slot.dimension], "sample_type": slot.sample}
    }


# --- for web pages -------------------------------------------------------------------------------

Names = Mapping[type, Sequence[str]]
"""The names of the slots of each class, in the order of the pipeline."""


def for_pages(pipeline: Pipeline, visibility: int, names: Names) -> dict[str, Any]:
    """The descriptors and bindings of a pipeline, as a page hands them to the browser.

    See ``WebGPUPipeline`` in ``web_host/serving/packages.py``.
    """
    found: dict[str, Any] = _camel({
        "groups": [list(_named_slots(group, visibility, names)) for group in bound(pipeline)],
        "buffers": [buffer_layout(each) for each in vertex_buffers(pipeline.inputs)],
        "targets": [color_target(target) for target in pipeline.targets],
        "primitive": primitive(pipeline),
        "depth_stencil": depth_stencil(pipeline),
    })  # fmt: skip
    return found


def _named_slots(
    group: Mapping[int, Bound], visibility: int, names: Names
) -> Iterator[dict[str, Any]]:
    for layout, what in zip(layout_entries(group, visibility), group.values(), strict=True):
        (kind,) = layout.keys() - {"binding", "visibility"}
        name = names[type(what.slot)][what.number]
        slot = {"kind": kind, "name": name, "number": what.number, "layout": layout}
        if what.is_sampler:
            assert isinstance(what.slot, TextureSlot)
            slot["sampler"] = sampler(what.slot)
        elif isinstance(what.slot, BlockSlot):
            slot["kind"] = "block"
        yield slot


def _camel(value: Any) -> Any:
    """The value with keys in JavaScript's spelling."""
    if isinstance(value, Mapping):
        return {_camel_word(key): _camel(each) for key, each in value.items()}
    return [_camel(each) for each in value] if isinstance(value, list | tuple) else value


def _camel_word(text: str) -> str:
    return re.sub("_(.)", lambda match: match[1].upper(), text)
