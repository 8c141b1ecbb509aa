"""Creates WebGPU's pipeline from that of a job."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import wgpu

from ..checks import lane_count
from ..device import DriverError
from ..pipeline import Pipeline, VertexInput
from ..render_state import BlendEquation, RenderTarget, StencilSide
from ..slots import BlockSlot, BufferSlot, ImageSlot, TextureSlot
from .device import Gpu

DEPTH = "depth32float"
FLOAT32_TARGETS = {"r32float", "rg32float", "rgba32float"}
VIEWS = {"2d": "2d", "2d_array": "2d-array", "3d": "3d", "cube": "cube"}

LANES: Mapping[str, int] = {
    "r": wgpu.ColorWrite.RED,
    "g": wgpu.ColorWrite.GREEN,
    "b": wgpu.ColorWrite.BLUE,
    "a": wgpu.ColorWrite.ALPHA,
}


@dataclass(frozen=True, slots=True)
class Bound:
    """What is bound at one place: a block, a buffer, an image, a texture, or the sampler of a
    texture."""

    slot: BlockSlot | BufferSlot | ImageSlot | TextureSlot
    number: int
    """The slot's place in the pipeline's blocks, buffers, images or textures."""
    is_sampler: bool = False


Groups = list[dict[int, Bound]]
"""What is bound, by group and binding."""


@dataclass(frozen=True, slots=True)
class Buffer:
    """A vertex buffer: all attributes that advance at the same time."""

    step: str
    stride: int
    members: tuple[tuple[int, VertexInput, int], ...]
    """The number of each attribute, the attribute, and its offset."""


@dataclass(frozen=True, slots=True)
class Made:
    """A pipeline, and what is needed to draw with it."""

    handle: Any
    groups: Groups
    layouts: Sequence[Any]
    buffers: Sequence[Buffer]


def make_pipeline(gpu: Gpu, pipeline: Pipeline) -> Made:
    """The pipeline of a job."""
    device, stages = gpu.device, pipeline.stages
    groups, buffers = bound(pipeline), vertex_buffers(pipeline.inputs)
    both = wgpu.ShaderStage.VERTEX | wgpu.ShaderStage.FRAGMENT
    layouts = [
        device.create_bind_group_layout(entries=layout_entries(group, both)) for group in groups
    ]
    modules = {name: device.create_shader_module(code=code.text) for name, code in stages.items()}
    handle = device.create_render_pipeline(
        layout=device.create_pipeline_layout(bind_group_layouts=layouts),
        vertex={
            "module": modules["vertex"],
            "entry_point": stages["vertex"].entry,
            "buffers": [_buffer_layout(buffer) for buffer in buffers],
        },
        fragment={
            "module": modules["fragment"],
            "entry_point": stages["fragment"].entry,
            "targets": [_target(gpu, target) for target in pipeline.targets],
        },
        primitive={
            "topology": f"{pipeline.primitive}-list",
            "cull_mode": pipeline.cull,
            "front_face": pipeline.front_face,
        },
        depth_stencil=_depth_stencil(gpu, pipeline),
        multisample={"count": pipeline.samples},
    )
    return Made(handle, groups, layouts, buffers)


def _depth_stencil(gpu: Gpu, pipeline: Pipeline) -> Mapping[str, Any]:
    """The words of a pipeline are WebGPU's, with other dashes."""
    state: dict[str, Any] = {
        "format": pipeline.depth_format,
        "depth_write_enabled": pipeline.depth_write,
        "depth_compare": pipeline.depth_compare.replace("_", "-"),
    }
    if pipeline.has_bias:
        bias = pipeline.depth_bias
        state |= {
            "depth_bias": bias.constant,
            "depth_bias_slope_scale": bias.slope,
            "depth_bias_clamp": bias.clamp,
        }
    if (stencil := pipeline.stencil) is not None:
        if pipeline.depth_format not in gpu.features:
            raise DriverError(f"{gpu.description.name} has no {pipeline.depth_format}")
        state |= {
            "stencil_front": _stencil_side(stencil.front),
            "stencil_back": _stencil_side(stencil.back),
            "stencil_read_mask": stencil.read_mask,
            "stencil_write_mask": stencil.write_mask,
        }
    return state


def _stencil_side(side: StencilSide) -> Mapping[str, str]:
    words = {
        "compare": side.compare,
        "fail_op": side.fail,
        "depth_fail_op": side.depth_fail,
        "pass_op": side.passed,
    }
    return {name: word.replace("_", "-") for name, word in words.items()}


def vertex_buffers(inputs: Sequence[VertexInput]) -> list[Buffer]:
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
            found.append(Buffer(step, offset, tuple(members)))
    return found


def _buffer_layout(buffer: Buffer) -> Mapping[str, Any]:
    attributes = [
        {"format": each.format, "offset": offset, "shader_location": each.location}
        for _, each, offset in buffer.members
    ]
    return {"array_stride": buffer.stride, "step_mode": buffer.step, "attributes": attributes}


def _target(gpu: Gpu, target: RenderTarget) -> Mapping[str, Any]:
    blend = target.blend
    mask = sum(bit for lane, bit in LANES.items() if target.writes(lane))
    state = {"format": target.format, "write_mask": mask}
    if blend is None:
        return state
    if target.format in FLOAT32_TARGETS and "float32-blendable" not in gpu.features:
        raise DriverError(f"{gpu.description.name} cannot blend {target.format}")
    return {**state, "blend": {"color": _equation(blend.color), "alpha": _equation(blend.alpha)}}


def _equation(equation: BlendEquation) -> Mapping[str, str]:
    """An equation in WebGPU's words."""
    return {
        "operation": equation.operation.replace("_", "-"),
        "src_factor": equation.source.replace("_", "-"),
        "dst_factor": equation.destination.replace("_", "-"),
    }


def bound(pipeline: Pipeline) -> Groups:
    """What is bound where, with an empty group for each unused number."""
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
    """An explicit layout: ``auto`` would leave out what the shaders do not use."""
    return [{"binding": at, "visibility": visibility, **_entry(what)} for at, what in group.items()]


def _entry(what: Bound) -> Mapping[str, Any]:
    slot = what.slot
    if isinstance(slot, BlockSlot):
        # A block that is larger in the shader than here is an error.
        return {"buffer": {"type": "uniform", "min_binding_size": slot.size}}
    if isinstance(slot, BufferSlot):
        kind = "storage" if slot.written else "read-only-storage"
        return {"buffer": {"type": kind, "min_binding_size": slot.stride}}
    if isinstance(slot, ImageSlot):
        return {"storage_texture": {"access": "write-only", "format": slot.format}}
    if what.is_sampler:
        return {"sampler": {"type": slot.sampling}}
    return {"texture": {"view_dimension": VIEWS[slot.dimension], "sample_type": slot.sample}}
