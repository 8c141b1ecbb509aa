"""Frame jobs of a single pipeline: several draws, dispatches or captures with it.

``Runner``, ``kernels.py`` and ``capturing.py`` make these jobs. Each draw is a step of its own that
clears its targets, and in the step behind it they are read back; draws of one size share targets.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .drivers.device import DriverError
from .drivers.draws import Dispatch, Draw, Sides
from .drivers.frame_job import (
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
    Picture,
    Resolve,
    TextureUse,
)
from .drivers.pipeline import Pipeline
from .drivers.slots import BufferSlot

# --- draws ---------------------------------------------------------------------------------------


def draw_job(pipeline: Pipeline, draws: Sequence[Draw]) -> FrameJob:
    """A step for each draw, and one behind it that reads its targets."""
    canvases: dict[tuple[int, int], _Canvas] = {}
    textures: list[FrameTexture] = []
    steps: list[FrameStep] = []
    for number, draw in enumerate(draws):
        size = draw.width, draw.height
        if size not in canvases:
            canvases[size] = _Canvas.of(pipeline, size, textures)
        steps += canvases[size].steps(pipeline, draw, f"draw {number}")
    return FrameJob(tuple(textures), (), (pipeline,), tuple(steps))


def pictures(job: FrameJob, found: Found) -> list[Picture]:
    """The picture of each draw of a job that ``draw_job`` has made."""
    (pipeline,), texels = job.pipelines, iter(found.texels)
    if pipeline.first_row == "bottom":
        texels = map(_turned_over, texels)
    return [tuple(next(texels) for _ in step.read) for step in job.steps[1::2]]


def _turned_over(found: FrameTexels) -> FrameTexels:
    """Texels whose first row is the bottom one, turned so that the top row comes first."""
    rows = np.frombuffer(found.texels, np.uint8).reshape(found.layers, found.height, -1)
    return replace(found, texels=rows[:, ::-1].tobytes())


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

    def steps(self, pipeline: Pipeline, draw: Draw, name: str) -> Iterator[FrameStep]:
        """The steps that draw, and read the targets back; both have this name."""
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
            # A wrong number of clear colours is told by the checks of the job.
            for number, read, clear in zip(self.drawn, self.read, draw.clear, strict=False)
        )  # fmt: skip
        depth = Attachment(
            self.depth, layers=layers, stores=False, stores_stencil=False,
            clear=(draw.clear_depth, 0.0, 0.0, 0.0),
        )  # fmt: skip
        yield FrameStep(
            tuple(barriers), targets, depth, (_alone(pipeline, draw),),
            blend_constant=draw.blend_constant, name=name,
        )  # fmt: skip
        self.use = "copied_from"
        reading = tuple(Barrier(number, "target", self.use) for number in self.read)
        yield FrameStep(reading, read=self.read, name=name)


def _alone(pipeline: Pipeline, draw: Draw) -> FrameDraw:
    """A draw that carries all textures and buffers that it reads."""
    own = (OWN,) * len(pipeline.textures), (OWN,) * len(pipeline.buffers)
    return FrameDraw(0, *own, draw=draw)


# --- kernels -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Written:
    """The output of a dispatch: all bytes of each buffer that the pipeline writes, in order."""

    buffers: tuple[bytes, ...]
    images: Picture = ()


def kernel_job(pipeline: Pipeline, work_group: Sides, dispatches: Sequence[Dispatch]) -> FrameJob:
    """A step for each dispatch, over buffers and images of its own, and one that reads these.

    ``work_group`` are the invocations in a work group, as the text declares them.
    """
    textures: list[FrameTexture] = []
    buffers: list[FrameBuffer] = []
    steps: list[FrameStep] = []
    for number, dispatch in enumerate(dispatches):
        width, height, _ = dispatch.extent
        images = range(len(textures), len(textures) + len(pipeline.images))
        textures += [
            FrameTexture(slot.format, width, height, is_black=True) for slot in pipeline.images
        ]
        given = list(zip(pipeline.buffers, dispatch.buffers, strict=True))
        numbers = tuple(_numbered(pipeline.buffers, len(buffers)))
        buffers += [FrameBuffer(0, data=data) for slot, data in given if slot.written]
        own = tuple(data for slot, data in given if not slot.written)
        read = (OWN,) * len(pipeline.textures)
        run = FrameDraw(0, read, numbers, dispatch=replace(dispatch, buffers=own))
        groups = dispatch.groups(work_group)
        steps += _run(run, tuple(images), groups, f"dispatch {number}")
    return FrameJob(tuple(textures), tuple(buffers), (pipeline,), tuple(steps))


def written(job: FrameJob, found: Found) -> list[Written]:
    """The output of each dispatch of a job that ``kernel_job`` has made."""
    buffers, texels = iter(found.buffers), iter(found.texels)
    return [
        Written(
            tuple(next(buffers) for _ in step.read_buffers),
            tuple(next(texels) for _ in step.read),
        )
        for step in job.steps[1::2]
    ]


def _numbered(slots: Sequence[BufferSlot], first: int) -> Iterator[int]:
    """For each storage buffer of a pipeline, the number of the frame's buffer for it."""
    for slot in slots:
        yield first if slot.written else OWN
        first += slot.written


def _run(run: FrameDraw, images: tuple[int, ...], groups: Sides, name: str) -> Iterator[FrameStep]:
    """The steps that run a kernel, and read what it has written; both have this name."""
    results = tuple(number for number in run.buffers if number != OWN)
    yield FrameStep(
        tuple(Barrier(number, "sampled", "image") for number in images),
        draws=(run,),
        images=images,
        groups=groups,
        buffer_barriers=tuple(BufferBarrier(each, "undefined", "written") for each in results),
        name=name,
    )
    yield FrameStep(
        tuple(Barrier(number, "image", "copied_from") for number in images),
        read=images,
        buffer_barriers=tuple(BufferBarrier(each, "written", "read") for each in results),
        read_buffers=results,
        name=name,
    )


# --- captures ------------------------------------------------------------------------------------


def capture_job(pipeline: Pipeline, draws: Sequence[Draw], most: Sequence[int]) -> FrameJob:
    """A step for each draw, which captures ``most`` of its vertices or fewer.

    The sizes of the draws' pictures do not matter.
    """
    steps = (
        FrameStep(draws=(_alone(pipeline, draw),), captures=count, name=f"draw {number}")
        for number, (draw, count) in enumerate(zip(draws, most, strict=True))
    )
    return FrameJob((), (), (pipeline,), tuple(steps))
