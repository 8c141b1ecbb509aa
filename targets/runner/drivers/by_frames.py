"""Draws, dispatches and captures as steps of frame jobs, for drivers that do frame jobs.

A ``Job`` has one pipeline and a picture for each draw. As a frame job, each draw is a step of its
own that clears its targets, and behind it they are read back; draws of one size share targets.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .capture_job import Captured, CaptureJob
from .checks import check, check_capture, check_kernel
from .device import DriverError
from .draw_job import Draw, Job, Picture
from .frame_job import (
    OWN,
    Attachment,
    Barrier,
    BufferBarrier,
    Found,
    FrameBuffer,
    FrameDraw,
    FrameJob,
    FrameStep,
    FrameTexels,
    FrameTexture,
    Resolve,
    TextureUse,
)
from .kernel_job import Dispatch, KernelJob, Written
from .pipeline import Pipeline
from .slots import BufferSlot


class DrawsByFrames(ABC):
    """The part of a driver that draws, computes and captures by frame jobs."""

    @abstractmethod
    def draw_frame(self, job: FrameJob) -> Found:
        """Do a frame job: returns what it reads back. Raises ``DriverError``."""

    def accept_job(self, job: Job) -> None:  # noqa: B027
        """Raise ``DriverError`` if the device cannot draw a job that is consistent."""

    def accept_kernel(self, job: KernelJob) -> None:  # noqa: B027
        """Raise ``DriverError`` if the device cannot run a kernel job that is consistent."""

    def draw(self, job: Job) -> Sequence[Picture]:
        """A picture for each draw of the job. Raises ``DriverError``."""
        check(job)
        self.accept_job(job)
        found = self.draw_frame(frame_of_draws(job))
        count = len(job.pipeline.targets)
        return [
            _picture(job.pipeline, draw, found.texels[number * count : (number + 1) * count])
            for number, draw in enumerate(job.draws)
        ]

    def compute(self, job: KernelJob) -> Sequence[Written]:
        """Do a kernel job: returns what each dispatch writes. Raises ``DriverError``."""
        check_kernel(job)
        self.accept_kernel(job)
        found = self.draw_frame(frame_of_dispatches(job))
        buffers, texels = iter(found.buffers), iter(found.texels)
        written = [slot for slot in job.pipeline.buffers if slot.written]
        return [
            Written(
                tuple(next(buffers) for _ in written),
                tuple(next(texels).texels for _ in job.pipeline.images),
            )
            for _ in job.dispatches
        ]

    def capture(self, job: CaptureJob) -> Sequence[Captured]:
        """The vertices that each draw of the job captures. Raises ``DriverError``."""
        check_capture(job)
        self.accept_job(Job(job.pipeline, job.draws))
        return self.draw_frame(frame_of_captures(job)).captured


# --- draws ---------------------------------------------------------------------------------------


def frame_of_draws(job: Job) -> FrameJob:
    """A step for each draw, and one behind it that reads its targets."""
    canvases: dict[tuple[int, int], _Canvas] = {}
    textures: list[FrameTexture] = []
    steps: list[FrameStep] = []
    for draw in job.draws:
        size = draw.width, draw.height
        if size not in canvases:
            canvases[size] = _Canvas.of(job.pipeline, size, textures)
        steps += canvases[size].steps(job.pipeline, draw)
    return FrameJob(tuple(textures), (), (job.pipeline,), tuple(steps))


@dataclass(slots=True)
class _Canvas:
    """Textures of one size, to which draws with a pipeline draw in turn."""

    read: tuple[int, ...]
    """The numbers of the textures that are read back."""
    drawn: tuple[int, ...]
    """The numbers of the render targets: other textures if the targets have several samples."""
    depth: int
    use: TextureUse = "undefined"
    """The use of the textures that are read back, before the next draw."""

    @classmethod
    def of(cls, pipeline: Pipeline, size: tuple[int, int], textures: list[FrameTexture]) -> _Canvas:
        """The textures that a pipeline needs, which are added to ``textures``."""
        if pipeline.layers and pipeline.samples > 1:
            raise DriverError("targets with layers have one sample for each pixel")
        one = FrameTexture("r8unorm", *size)
        if pipeline.layers:
            one = replace(one, layers=pipeline.layers, dimension="2d_array")
        read = [replace(one, format=target.format) for target in pipeline.targets]
        several = [replace(each, samples=pipeline.samples) for each in read]
        depth = replace(one, format=pipeline.depth_format, samples=pipeline.samples)
        first, count = len(textures), len(read)
        textures += [*read, *(several if pipeline.samples > 1 else []), depth]
        numbers = tuple(range(first, len(textures) - 1))
        return cls(numbers[:count], numbers[-count:] if count else (), len(textures) - 1)

    def steps(self, pipeline: Pipeline, draw: Draw) -> Iterator[FrameStep]:
        """The steps that draw, and read the targets back."""
        is_first = self.use == "undefined"
        several = [number for number in self.drawn if number not in self.read]
        barriers = [Barrier(number, self.use, "target") for number in self.read]
        for number in several:
            barriers.append(Barrier(number, "undefined" if is_first else "target", "target"))
        barriers.append(Barrier(self.depth, "undefined" if is_first else "depth", "depth"))
        layers = pipeline.layers or 1
        targets = tuple(
            Attachment(
                number, layers=layers, stores=number == read, clear=clear,
                resolve=None if number == read else Resolve(read),
            )
            for number, read, clear in zip(self.drawn, self.read, draw.clear, strict=True)
        )  # fmt: skip
        depth = Attachment(
            self.depth, layers=layers, stores=False, stores_stencil=False,
            clear=(draw.clear_depth, 0.0, 0.0, 0.0),
        )  # fmt: skip
        yield FrameStep(
            tuple(barriers), targets, depth, (_alone(draw),), blend_constant=draw.blend_constant
        )
        self.use = "copied_from"
        reading = tuple(Barrier(number, "target", self.use) for number in self.read)
        yield FrameStep(reading, read=self.read)


def _alone(draw: Draw) -> FrameDraw:
    """A draw that carries all textures and buffers that it reads."""
    return FrameDraw(0, (OWN,) * len(draw.textures), (OWN,) * len(draw.buffers), draw=draw)


def _picture(pipeline: Pipeline, draw: Draw, found: Sequence[FrameTexels]) -> Picture:
    height = draw.height * (pipeline.layers or 1)
    targets = [each.texels for each in found]
    if pipeline.first_row == "bottom":
        targets = [_turned_over(each) for each in found]
    return Picture(draw.width, height, tuple(targets))


def _turned_over(found: FrameTexels) -> bytes:
    """Texels whose first row is the bottom one, turned so that the top row comes first."""
    rows = np.frombuffer(found.texels, np.uint8).reshape(found.layers, found.height, -1)
    return rows[:, ::-1].tobytes()


# --- kernels -------------------------------------------------------------------------------------


def frame_of_dispatches(job: KernelJob) -> FrameJob:
    """A step for each dispatch, over buffers and images of its own, and one that reads these."""
    textures: list[FrameTexture] = []
    buffers: list[FrameBuffer] = []
    steps: list[FrameStep] = []
    for dispatch in job.dispatches:
        width, height, _ = dispatch.extent
        images = range(len(textures), len(textures) + len(job.pipeline.images))
        textures += [
            FrameTexture(slot.format, width, height, is_black=True) for slot in job.pipeline.images
        ]
        given = list(zip(job.pipeline.buffers, dispatch.buffers, strict=True))
        written = list(_numbered(job.pipeline.buffers, len(buffers)))
        buffers += [FrameBuffer(0, data=data) for slot, data in given if slot.written]
        own = tuple(data for slot, data in given if not slot.written)
        steps += _run(job, replace(dispatch, buffers=own), tuple(images), written)
    return FrameJob(tuple(textures), tuple(buffers), (job.pipeline,), tuple(steps))


def _numbered(slots: Sequence[BufferSlot], first: int) -> Iterator[int]:
    """For each storage buffer of a pipeline, the number of the frame's buffer for it."""
    for slot in slots:
        yield first if slot.written else OWN
        first += slot.written


def _run(
    job: KernelJob, dispatch: Dispatch, images: tuple[int, ...], buffers: Sequence[int]
) -> Iterator[FrameStep]:
    written = [number for number in buffers if number != OWN]
    textures = (OWN,) * len(dispatch.textures)
    yield FrameStep(
        tuple(Barrier(number, "sampled", "image") for number in images),
        draws=(FrameDraw(0, textures, tuple(buffers), dispatch=dispatch),),
        images=images,
        groups=job.groups(dispatch),
        buffer_barriers=tuple(BufferBarrier(each, "undefined", "written") for each in written),
    )
    yield FrameStep(
        tuple(Barrier(number, "image", "copied_from") for number in images),
        read=images,
        buffer_barriers=tuple(BufferBarrier(each, "written", "read") for each in written),
        read_buffers=tuple(written),
    )


# --- captures ------------------------------------------------------------------------------------


def frame_of_captures(job: CaptureJob) -> FrameJob:
    """A step for each draw, which captures its vertices."""
    steps = (
        FrameStep(draws=(_alone(draw),), captures=most)
        for draw, most in zip(job.draws, job.most, strict=True)
    )
    return FrameJob((), (), (job.pipeline,), tuple(steps))
