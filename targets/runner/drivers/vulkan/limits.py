"""Finds the parts of a job that a device does not support, before the job reaches the device."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import vulkan as vk

from ....toolchain.spirv import SpirvError
from ..checks import check_block_size, check_groups
from ..device import DriverError
from ..frame_job import OWN, FrameDraw, FrameJob, FrameStep
from ..pipeline import Pipeline
from ..slots import TextureSlot
from ..texels import Image
from .blocks import block_sizes
from .descriptor_sets import sampler_places
from .device import Gpu
from .formats import DEPTHS, TARGETS, TEXTURES

LINEAR = vk.VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT


def check_limits(gpu: Gpu, job: FrameJob) -> None:
    """Raise ``DriverError`` unless the device can do the whole job."""
    problems: list[str] = []
    for pipeline in job.pipelines:
        check_blocks(pipeline)
        problems += _pipeline_problems(gpu, pipeline)
    check_groups(job, lambda: gpu.properties.limits.maxComputeWorkGroupCount)
    for number, step in enumerate(job.steps):
        found = (problem for drawn in step.draws for problem in _problems(gpu, job, step, drawn))
        problems += (f"{job.called(number)}: {problem}" for problem in found)
    if problems:
        raise DriverError("\n".join(problems))


def _problems(gpu: Gpu, job: FrameJob, step: FrameStep, drawn: FrameDraw) -> Iterator[str]:
    """All that the device does not support of a draw or a dispatch."""
    pipeline, draw = job.pipelines[drawn.pipeline], drawn.draw
    if draw is not None:
        yield from _size_problems(gpu, "the picture", draw.width, draw.height)
    yield from _buffer_problems(gpu, job, pipeline, drawn)
    for written, number in zip(pipeline.images, step.images, strict=True):
        image = job.textures[number]
        name = f"image {written.place.identifier!r}"
        yield from _size_problems(gpu, name, image.width, image.height)
    own = drawn.own(pipeline).textures
    for slot, texture in zip(own, drawn.values.textures, strict=True):
        yield from _texture_problems(gpu, slot, texture)


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
    places = [slot.place for slot in pipeline.blocks if not slot.pushed]
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
    counts = {
        "textures": (len(pipeline.textures), limits.maxPerStageDescriptorSampledImages),
        "samplers": (len(sampler_places(pipeline)), limits.maxPerStageDescriptorSamplers),
    }
    for what, (count, most) in counts.items():
        if count > most:
            yield f"there are {count} {what}, and the device reads at most {most} in a stage"
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
    if pipeline.view_mask and not gpu.multiview:
        yield "the device cannot draw several views at once"


def _buffer_problems(
    gpu: Gpu, job: FrameJob, pipeline: Pipeline, drawn: FrameDraw
) -> Iterator[str]:
    most, own = gpu.properties.limits.maxStorageBufferRange, iter(drawn.values.buffers)
    for slot, number in zip(pipeline.buffers, drawn.buffers, strict=True):
        size = len(next(own)) if number == OWN else job.buffers[number].size
        if size > most:
            yield (
                f"storage buffer {slot.place.identifier!r} has {size} bytes, and the device "
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
    if image.dimension == "cube_array" and not gpu.cube_arrays:
        yield f"the device has no arrays of cubes, as texture {name} is one"
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
