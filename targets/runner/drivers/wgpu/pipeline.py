"""Creates WebGPU's pipeline from the pipeline of a job."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..device import DriverError
from ..pipeline import Pipeline
from ..render_state import RenderTarget
from ..webgpu import (
    COMPUTED,
    DRAWN,
    FLOAT32_TARGETS,
    Groups,
    VertexBuffer,
    bound,
    buffer_layout,
    color_target,
    depth_stencil,
    layout_entries,
    primitive,
    vertex_buffers,
)
from .device import Gpu


@dataclass(frozen=True, slots=True)
class MadePipeline:
    """A pipeline, and the data that drawing with it needs."""

    handle: Any
    groups: Groups
    layouts: Sequence[Any]
    buffers: Sequence[VertexBuffer]


def make_pipeline(gpu: Gpu, pipeline: Pipeline, depths: str | None) -> MadePipeline:
    """A pipeline that draws with depths of a format, or without any. Raises ``DriverError``."""
    device, stages = gpu.device, pipeline.stages
    groups, buffers = bound(pipeline), vertex_buffers(pipeline.inputs)
    layouts = [
        device.create_bind_group_layout(entries=layout_entries(group, DRAWN)) for group in groups
    ]
    modules = {name: device.create_shader_module(code=code.text) for name, code in stages.items()}
    fragment = None
    if "fragment" in stages:
        fragment = {
            "module": modules["fragment"],
            "entry_point": stages["fragment"].entry,
            "targets": [_target(gpu, target) for target in pipeline.targets],
        }
    handle = device.create_render_pipeline(
        layout=device.create_pipeline_layout(bind_group_layouts=layouts),
        vertex={
            "module": modules["vertex"],
            "entry_point": stages["vertex"].entry,
            "buffers": [buffer_layout(buffer) for buffer in buffers],
        },
        fragment=fragment,
        primitive=primitive(pipeline),
        multisample={
            "count": pipeline.samples,
            "alpha_to_coverage_enabled": pipeline.alpha_to_coverage,
        },
        depth_stencil=depths and {"format": depths, **depth_stencil(pipeline)},
    )
    return MadePipeline(handle, groups, layouts, buffers)


def make_kernel(gpu: Gpu, pipeline: Pipeline) -> MadePipeline:
    """The pipeline of a kernel."""
    device, groups = gpu.device, bound(pipeline)
    (code,) = pipeline.stages.values()
    layouts = [
        device.create_bind_group_layout(entries=layout_entries(group, COMPUTED)) for group in groups
    ]
    handle = device.create_compute_pipeline(
        layout=device.create_pipeline_layout(bind_group_layouts=layouts),
        compute={
            "module": device.create_shader_module(code=code.text),
            "entry_point": code.entry,
        },
    )
    return MadePipeline(handle, groups, layouts, ())


def _target(gpu: Gpu, target: RenderTarget) -> Mapping[str, Any]:
    is_blended = target.blend is not None and target.format in FLOAT32_TARGETS
    if is_blended and "float32-blendable" not in gpu.features:
        raise DriverError(f"{gpu.description.name} cannot blend {target.format}")
    return color_target(target)
