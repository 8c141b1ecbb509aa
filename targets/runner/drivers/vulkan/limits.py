"""Finds the parts of a job that a device does not support, before the job reaches the device."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import vulkan as vk

from ....toolchain.spirv import SpirvError
from ..checks import check_block_size, check_groups
from ..device import DriverError
from ..draw_job import Draw, Job
from ..kernel_job import Dispatch, KernelJob
from ..pipeline import Pipeline
from ..slots import TextureSlot
from ..texels import Image
from .blocks import block_sizes
from .device import Gpu
from .formats import DEPTHS, TARGETS, TEXTURES

LINEAR = vk.VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT


def check_limits(gpu: Gpu, job: Job) -> None:
    """Raise ``DriverError`` unless the device can draw the whole job."""
    check_blocks(job.pipeline)
    problems = list(_pipeline_problems(gpu, job.pipeline))
    for number, draw in enumerate(job.draws):
        found = list(_size_problems(gpu, "the picture", draw.width, draw.height))
        found += _buffer_problems(gpu, job.pipeline, draw)
        for slot, image in zip(job.pipeline.textures, draw.textures, strict=True):
            found += _texture_problems(gpu, slot, image)
        problems += (f"draw {number}: {problem}" for problem in found)
    if problems:
        raise DriverError("\n".join(problems))


def check_dispatches(gpu: Gpu, job: KernelJob) -> None:
    """Raise ``DriverError`` unless the device can run the whole job."""
    check_blocks(job.pipeline)
    check_groups(job, list(gpu.properties.limits.maxComputeWorkGroupCount))
    problems: list[str] = []
    for number, dispatch in enumerate(job.dispatches):
        found = list(_buffer_problems(gpu, job.pipeline, dispatch))
        for image in job.pipeline.images:
            width, height, _ = dispatch.extent
            found += _size_problems(gpu, f"image {image.place.identifier!r}", width, height)
        for slot, texture in zip(job.pipeline.textures, dispatch.textures, strict=True):
            found += _texture_problems(gpu, slot, texture)
        problems += (f"dispatch {number}: {problem}" for problem in found)
    if problems:
        raise DriverError("\n".join(problems))


def check_blocks(pipeline: Pipeline) -> None:
    """Raise ``DriverError`` if a stage reads more bytes of a block than are bound."""
    slots = {(slot.place.group, slot.place.binding): slot for slot in pipeline.blocks}
    for stage, code in pipeline.stages.items():
        try:
            sizes = block_sizes(code.spirv)
        except SpirvError as error:
            raise DriverError(f"the {stage} shader: {error}") from error
        for place, size in sizes.items():
            if place in slots:
                check_block_size(slots[place], size)


def _pipeline_problems(gpu: Gpu, pipeline: Pipeline) -> Iterator[str]:
    limits = gpu.properties.limits
    for slot in pipeline.blocks:
        if slot.size > limits.maxUniformBufferRange:
            yield (
                f"uniform block {slot.place.identifier!r} has {slot.size} bytes, and the device "
                f"takes at most {limits.maxUniformBufferRange}"
            )
    places = [slot.place for slot in pipeline.blocks]
    places += [slot.place for slot in pipeline.buffers]
    places += [slot.texture for slot in pipeline.textures]
    places += [slot.sampler for slot in pipeline.textures if slot.sampler is not None]
    for place in places:
        if place.group is None or place.binding is None:
            yield f"{place.identifier!r} has no descriptor set and binding"
        elif place.group >= limits.maxBoundDescriptorSets:
            yield (
                f"{place.identifier!r} is in descriptor set {place.group}, and the device has "
                f"{limits.maxBoundDescriptorSets}"
            )
    yield from _target_problems(gpu, pipeline)
    yield from _state_problems(gpu, pipeline)


def _state_problems(gpu: Gpu, pipeline: Pipeline) -> Iterator[str]:
    limits = gpu.properties.limits
    counts = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts
    if not counts & pipeline.samples:
        yield f"the device has no targets with {pipeline.samples} samples"
    if pipeline.samples > 1 and not limits.standardSampleLocations:
        yield "the device has its samples at other places than those of the standard"
    depths = _features(gpu, DEPTHS[pipeline.depth_format])
    if not depths & vk.VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT:
        yield f"the device has no {pipeline.depth_format}"
    if pipeline.fill == "lines" and not gpu.draws_lines:
        yield "the device cannot draw the edges of triangles"
    if pipeline.has_bias and pipeline.depth.bias_clamp and not gpu.clamps_bias:
        yield "the device cannot limit a depth bias"


def _buffer_problems(gpu: Gpu, pipeline: Pipeline, values: Draw | Dispatch) -> Iterator[str]:
    most = gpu.properties.limits.maxStorageBufferRange
    for slot, data in zip(pipeline.buffers, values.buffers, strict=True):
        if len(data) > most:
            yield (
                f"storage buffer {slot.place.identifier!r} has {len(data)} bytes, and the device "
                f"takes at most {most}"
            )


def _target_problems(gpu: Gpu, pipeline: Pipeline) -> Iterator[str]:
    count, most = len(pipeline.targets), gpu.properties.limits.maxColorAttachments
    if count > most:
        yield f"there are {count} targets, and the device has at most {most}"
    for target in pipeline.targets:
        features = _features(gpu, TARGETS[target.format])
        blends = features & vk.VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT
        if not features & vk.VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT:
            yield f"the device cannot draw to {target.format}"
        elif target.blend is not None and not blends:
            yield f"the device cannot blend in {target.format}"
    states = {(target.blend, target.mask) for target in pipeline.targets}
    if len(states) > 1 and not gpu.independent_blend:
        yield "the device can only blend all targets alike"


def _texture_problems(gpu: Gpu, slot: TextureSlot, image: Image) -> Iterator[str]:
    name, limits = repr(slot.texture.identifier), gpu.properties.limits
    if image.dimension == "3d":
        most = limits.maxImageDimension3D
        if max(image.width, image.height, image.depth) > most:
            size = f"{image.width} × {image.height} × {image.depth}"
            yield f"texture {name} is {size}, and the device takes no side over {most}"
    else:
        yield from _size_problems(gpu, f"texture {name}", image.width, image.height)
        if image.depth > limits.maxImageArrayLayers:
            yield (
                f"texture {name} has {image.depth} layers, and the device takes at most "
                f"{limits.maxImageArrayLayers}"
            )
    features = _features(gpu, TEXTURES[image.format])
    if not features & vk.VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT:
        yield f"the device cannot read {image.format}, as texture {name} wants it"
    elif _filters(slot) and not features & LINEAR:
        yield f"the device cannot filter {image.format} linearly, as texture {name} wants it"


def _filters(slot: TextureSlot) -> bool:
    """True if texels are filtered; results of comparisons may be filtered with any format."""
    return slot.sampling == "filtering" and "linear" in (slot.filter, slot.mip)


def _size_problems(gpu: Gpu, what: str, width: int, height: int) -> Iterator[str]:
    most = gpu.properties.limits.maxImageDimension2D
    if not (1 <= width <= most and 1 <= height <= most):
        yield f"{what} is {width} × {height}, and the device takes 1 × 1 to {most} × {most}"


def _features(gpu: Gpu, vk_format: int) -> Any:
    """The ``VK_FORMAT_FEATURE`` bits of a format: what the device can do with its images."""
    return vk.vkGetPhysicalDeviceFormatProperties(gpu.physical, vk_format).optimalTilingFeatures
