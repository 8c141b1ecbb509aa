"""Checks that draws and dispatches fit their pipelines, before a device sees them.

``frame_checks.py`` calls this for every job, and drivers for what only they know.

A driver may read past the end of a short buffer, or silently read zeros where nothing is bound, so
the driver itself cannot be relied on.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence, Set

from ....compiler.ir.stages import VERTEX
from .device import DriverError
from .draws import Dispatch, Draw
from .frame_job import FrameJob
from .pipeline import Pipeline
from .slots import BlockSlot, BufferSlot, TextureSlot
from .texels import FACES, TEXELS, Image


def check_dispatch(pipeline: Pipeline, dispatch: Dispatch) -> None:
    """Raise ``DriverError`` if the bytes of a dispatch do not fit the pipeline."""
    _same_number("uniform blocks", dispatch.blocks, pipeline.blocks)
    _same_number("storage buffers", dispatch.buffers, pipeline.buffers)
    _same_number("textures", dispatch.textures, pipeline.textures)
    for block, data in zip(pipeline.blocks, dispatch.blocks, strict=True):
        _same_size(f"uniform block {block.place.identifier!r}", data, block.size)
    _check_buffers(pipeline.buffers, dispatch.buffers)
    for slot, image in zip(pipeline.textures, dispatch.textures, strict=True):
        _check_texture(f"texture {slot.texture.identifier!r}", slot, image)


def check_groups(job: FrameJob, most: Callable[[], Sequence[int]]) -> None:
    """Raise ``DriverError`` if a kernel takes more work groups than the device runs at once.

    ``most`` asks for how many these are, along x, y and z; only if there are kernels, as not every
    device has a number.
    """
    runs = {number: step.groups for number, step in enumerate(job.steps) if any(step.groups)}
    limits = most() if runs else ()
    for number, groups in runs.items():
        for axis, count, limit in zip("xyz", groups, limits, strict=True):
            if count > limit:
                raise DriverError(
                    f"{job.called(number)}: {count} work groups along {axis}, and the device runs "
                    f"at most {limit} at once: compute fewer elements, or declare larger work "
                    "groups"
                )


def check_names(job: FrameJob) -> None:
    """Raise ``DriverError`` if a name by which a draw binds is not in the text.

    A driver cannot distinguish this from a block or texture that its linker has removed.
    """
    for pipeline in job.pipelines:
        if VERTEX.name in pipeline.stages:
            _check_names(pipeline)


def _check_names(pipeline: Pipeline) -> None:
    inputs = [slot.identifier for slot in pipeline.inputs]
    blocks = [slot.place.identifier for slot in pipeline.blocks if not slot.uniforms]
    loose = [each.identifier for slot in pipeline.blocks for each in slot.uniforms]
    textures = [slot.texture.identifier for slot in pipeline.textures]
    everything = _words(*(code.text for code in pipeline.stages.values()))
    _find("vertex attribute", inputs, _words(pipeline.stages[VERTEX.name].text))
    _find("uniform block", blocks, everything)
    _find("texture", textures, everything)
    _find("uniform", pipeline.host_uniforms, everything)
    _find("uniform", [re.split(r"\W", name)[0] for name in loose], everything)


def _words(*texts: str) -> Set[str]:
    return {word for text in texts for word in re.findall(r"\w+", text)}


def _find(what: str, identifiers: Sequence[str], words: Set[str]) -> None:
    for identifier in identifiers:
        if identifier not in words:
            raise DriverError(f"the shader has no {what} {identifier!r}")


def check_block_size(slot: BlockSlot, in_shader: int) -> None:
    """Raise ``DriverError`` if the block in the shader, as its driver lays it out, is larger."""
    if in_shader > slot.size:
        raise DriverError(
            f"uniform block {slot.place.identifier!r} has {in_shader} bytes in the shader,"
            f" but only {slot.size} are bound"
        )


def lane_count(format: str) -> int:
    """The number of lanes of a ``VertexFormat``."""
    return int(format.partition("x")[2] or 1)


def check_draw(pipeline: Pipeline, draw: Draw) -> None:
    """Raise ``DriverError`` if the bytes of a draw do not fit the pipeline."""
    if draw.instance_count < 1:
        raise DriverError(f"{draw.instance_count} instances are none")
    if draw.width < 1 or draw.height < 1:
        raise DriverError(f"a picture of {draw.width} x {draw.height} pixels has none")
    _same_number("vertex buffers", draw.vertices, pipeline.inputs)
    _same_number("uniform blocks", draw.blocks, pipeline.blocks)
    _same_number("storage buffers", draw.buffers, pipeline.buffers)
    _same_number("textures", draw.textures, pipeline.textures)
    for vertex_input, data in zip(pipeline.inputs, draw.vertices, strict=True):
        steps = {"vertex": draw.vertex_count, "instance": draw.instance_count}
        size = 4 * lane_count(vertex_input.format) * steps[vertex_input.step]
        _same_size(f"vertex attribute {vertex_input.identifier!r}", data, size)
    for block, data in zip(pipeline.blocks, draw.blocks, strict=True):
        _same_size(f"uniform block {block.place.identifier!r}", data, block.size)
    _check_buffers(pipeline.buffers, draw.buffers)
    for texture, image in zip(pipeline.textures, draw.textures, strict=True):
        _check_texture(f"texture {texture.texture.identifier!r}", texture, image)
    _check_indices(pipeline, draw)


def _check_buffers(slots: Sequence[BufferSlot], contents: Sequence[bytes]) -> None:
    for slot, data in zip(slots, contents, strict=True):
        check_buffer(slot, len(data))


def check_buffer(slot: BufferSlot, size: int) -> None:
    """Raise ``DriverError`` if a storage buffer of ``size`` bytes has no whole elements."""
    if not size or size % slot.stride:
        raise DriverError(
            f"storage buffer {slot.place.identifier!r} is given {size} bytes, and its elements "
            f"have {slot.stride}"
        )


def _same_number(what: str, given: Sequence[object], wanted: Sequence[object]) -> None:
    if len(given) != len(wanted):
        raise DriverError(f"{len(given)} {what} are given, and the pipeline has {len(wanted)}")


def _same_size(what: str, data: bytes, size: int) -> None:
    if len(data) != size:
        raise DriverError(f"{what} is given {len(data)} bytes, and takes {size}")


def _check_texture(what: str, slot: TextureSlot, image: Image) -> None:
    if image.format not in TEXELS:
        raise DriverError(f"{what} has the unknown format {image.format!r}")
    wanted = slot.sample.removeprefix("unfilterable-")
    if (image.dimension, TEXELS[image.format].sample) != (slot.dimension, wanted):
        given = f"{image.dimension} picture of {image.format}"
        raise DriverError(f"{what} is given a {given}, and is {slot.dimension} of {wanted}")
    _check_image(what, image)


def _check_image(what: str, image: Image) -> None:
    size = f"{image.width} x {image.height} x {image.depth}"
    is_square = image.width == image.height
    if image.dimension == "cube" and not (is_square and image.depth == FACES):
        raise DriverError(f"{what} of {size} texels is no cube, which has six square faces")
    if image.dimension == "cube_array" and not (
        is_square and image.depth and not image.depth % FACES
    ):
        raise DriverError(f"{what} of {size} texels has no cubes, each of six square faces")
    if image.dimension == "2d" and image.depth != 1:
        raise DriverError(f"{what} of {size} texels has one layer only")
    sides = (image.width, image.height, *([image.depth] if image.dimension == "3d" else []))
    if not 0 < len(image.levels) <= max(sides).bit_length():
        raise DriverError(f"{what} of {size} texels cannot have {len(image.levels)} mip levels")
    for level, data in enumerate(image.levels):
        width, height, depth = level_size(image, level)
        texels = width * height * depth
        _same_size(f"{what}, level {level},", data, texels * TEXELS[image.format].size)


def level_size(image: Image, level: int) -> tuple[int, int, int]:
    """The width and height of a mip level, and its number of layers, faces or slices."""
    depth = max(image.depth >> level, 1) if image.dimension == "3d" else image.depth
    return max(image.width >> level, 1), max(image.height >> level, 1), depth


def _check_indices(pipeline: Pipeline, draw: Draw) -> None:
    if len(draw.indices) % (4 * pipeline.corners):
        whole = f"whole primitives of {pipeline.corners} vertices"
        raise DriverError(f"{len(draw.indices)} bytes of indices are not {whole}")
    largest = max(memoryview(draw.indices).cast("I"), default=-1)
    if largest >= draw.vertex_count:
        raise DriverError(f"index {largest} is beyond the {draw.vertex_count} vertices")
