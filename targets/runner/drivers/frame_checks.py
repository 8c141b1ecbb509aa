"""Checks that a frame job is consistent, before a driver sees it; ``serve`` calls this first.

A job is made of a plan, and a plan may be wrong: one that names another texture than it should
must not draw another picture without a word.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import get_args

from .checks import check_buffer, check_dispatch, check_draw
from .device import DriverError
from .frame_job import OWN, Attachment, FrameDraw, FrameJob, FrameStep, FrameTexture
from .frame_order import check_order
from .render_state import TargetFormat
from .slots import TextureSlot


def check_frame(job: FrameJob) -> None:
    """Raise ``DriverError`` if a step does not fit its pipelines, its textures, or the steps
    before it."""
    _check_formats(job)
    for number, step in enumerate(job.steps):
        try:
            _check_numbers(job, step)
            _check_captures(job, step)
            _check_attachments(job, step)
            for draw in step.draws:
                _check_drawn(job, step, draw)
        except DriverError as error:
            raise DriverError(f"{job.called(number)}: {error}") from None
    check_order(job)


def _check_formats(job: FrameJob) -> None:
    """Check that drivers know the formats of all that pipelines write."""
    for pipeline in job.pipelines:
        for what, slots in (("render target", pipeline.targets), ("image", pipeline.images)):
            for slot in slots:
                if slot.format not in get_args(TargetFormat):
                    raise DriverError(f"there is no {what} of the format {slot.format!r}")


def _check_numbers(job: FrameJob, step: FrameStep) -> None:
    """Check that everything that a step names exists."""
    drawn_to = [each.texture for each in step.drawn_to]
    drawn_to += [each.resolve.texture for each in step.targets if each.resolve is not None]
    named = [*(each.texture for each in step.barriers), *drawn_to, *step.images, *step.copied]
    _all_in("texture", [*named, *step.read], job.textures)
    waiting = [each.buffer for each in step.buffer_barriers]
    _all_in("buffer", [*waiting, *step.read_buffers], job.buffers)
    for draw in step.draws:
        _all_in("pipeline", [draw.pipeline], job.pipelines)
        _all_in("texture", [each for each in draw.textures if each != OWN], job.textures)
        _all_in("buffer", [each for each in draw.buffers if each != OWN], job.buffers)


def _all_in(what: str, numbers: Sequence[int], there: Sequence[object]) -> None:
    for number in numbers:
        if not 0 <= number < len(there):
            raise DriverError(f"there is no {what} {number}; the job has {len(there)}")


def _check_captures(job: FrameJob, step: FrameStep) -> None:
    """Check that a step that captures has one draw with a stream output, and no targets."""
    if step.captures is None:
        return
    streams = [job.pipelines[each.pipeline].stream_output for each in step.draws]
    if step.drawn_to or len(streams) != 1 or streams[0] is None or not streams[0].outputs:
        raise DriverError("it captures vertices, and is not one draw with a stream output")


def _check_attachments(job: FrameJob, step: FrameStep) -> None:
    """Check that everything that a step draws to, or copies, exists and has one size."""
    for attachment in step.drawn_to:
        made = job.textures[attachment.texture]
        last = attachment.layer + attachment.layers
        if attachment.level >= made.levels or last > made.layers:
            raise DriverError(
                f"texture {attachment.texture} has no layer {last - 1}, level {attachment.level}"
            )
        if made.is_depth != (attachment is step.depth):
            raise DriverError(
                f"texture {attachment.texture} of {made.format} cannot be drawn to as "
                f"{'depths' if attachment is step.depth else 'a target'}"
            )
    for attachment in step.targets:
        _check_resolve(job, attachment)
    sizes = {_size(job.textures[each.texture], each.level) for each in step.drawn_to}
    if len(sizes) > 1:
        found = " and ".join(f"{width} x {height}" for width, height in sorted(sizes))
        raise DriverError(f"its targets have different sizes: {found}")
    copied = {replace(job.textures[number], is_black=False, memory=None) for number in step.copied}
    if len(copied) > 1:
        source, target = step.copied
        raise DriverError(
            f"texture {source} cannot be copied to {target}, which is of another kind"
        )


def _check_resolve(job: FrameJob, target: Attachment) -> None:
    """Check that a resolve target has the attachment's format and size, and one sample."""
    if target.resolve is None:
        return
    drawn, resolve = job.textures[target.texture], target.resolve
    made = job.textures[resolve.texture]
    if resolve.level >= made.levels or resolve.layer >= made.layers:
        raise DriverError(
            f"texture {resolve.texture} has no layer {resolve.layer}, level {resolve.level}"
        )
    size = _size(made, resolve.level)
    if (made.format, size, made.samples) != (drawn.format, _size(drawn, target.level), 1):
        raise DriverError(
            f"the samples of texture {target.texture} cannot be resolved to {resolve.texture}, "
            "which is of another kind"
        )


def _size(texture: FrameTexture, level: int) -> tuple[int, int]:
    return max(texture.width >> level, 1), max(texture.height >> level, 1)


def _check_drawn(job: FrameJob, step: FrameStep, drawn: FrameDraw) -> None:
    """Check that a draw fits its pipeline."""
    pipeline = job.pipelines[drawn.pipeline]
    _same_number("textures", drawn.textures, pipeline.textures)
    _same_number("storage buffers", drawn.buffers, pipeline.buffers)
    own = drawn.own(pipeline)
    if drawn.draw is not None:
        check_draw(own, drawn.draw)
    if drawn.dispatch is not None:
        check_dispatch(own, drawn.dispatch)
    if pipeline.stencil is not None:
        depths = None if step.depth is None else job.textures[step.depth.texture]
        if depths is None or not depths.has_stencil:
            raise DriverError("its pipeline tests stencil values, and there are none")
    for attachment in step.drawn_to:
        number, made = attachment.texture, job.textures[attachment.texture]
        if made.samples != pipeline.samples:
            raise DriverError(
                f"texture {number} has {made.samples} samples, and the pipeline {pipeline.samples}"
            )
    targets = [job.textures[each.texture].format for each in step.targets]
    _same_formats("target", targets, [each.format for each in pipeline.targets])
    images = [job.textures[number].format for number in step.images]
    _same_formats("image", images, [each.format for each in pipeline.images])
    for slot, number in zip(pipeline.textures, drawn.textures, strict=True):
        if number != OWN:
            _check_texture(slot, number, job.textures[number])
    for place, number in zip(pipeline.buffers, drawn.buffers, strict=True):
        if number != OWN:
            check_buffer(place, job.buffers[number].size)


def _check_texture(slot: TextureSlot, number: int, made: FrameTexture) -> None:
    if slot.dimension != made.dimension or (slot.sample == "depth") != made.is_depth:
        raise DriverError(
            f"texture {slot.texture.identifier!r} is given texture {number}, which is "
            f"{made.dimension} of {made.format}, and is {slot.dimension} of {slot.sample}"
        )


def _same_formats(what: str, given: Sequence[str], wanted: Sequence[str]) -> None:
    if given != wanted:
        found, expected = (", ".join(names) or "none" for names in (given, wanted))
        raise DriverError(f"{what} formats are {found}, and the pipeline has {expected}")


def _same_number(what: str, given: Sequence[object], wanted: Sequence[object]) -> None:
    if len(given) != len(wanted):
        raise DriverError(f"{len(given)} {what} are named, and the pipeline has {len(wanted)}")
