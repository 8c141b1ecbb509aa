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
    """A step for each draw, or for each of its layers, and one behind it that reads its targets.

    Raises ``DriverError`` for layers with several samples.
    """
    canvases: dict[tuple[int, int, int], _Canvas] = {}
    textures: list[FrameTexture] = []
    steps: list[FrameStep] = []
    for number, draw in enumerate(draws):
        kind = draw.width, draw.height, len(draw.layers)
        if kind not in canvases:
            canvases[kind] = _Canvas.of(pipeline, draw, textures)
        steps += canvases[kind].steps(pipeline, draw, f"draw {number}")
    return FrameJob(tuple(textures), (), (pipeline,), tuple(steps))


def pictures(job: FrameJob, found: Found) -> list[Picture]:
    """The picture of each draw of a job that ``draw_job`` has made."""
    (pipeline,), texels = job.pipelines, iter(found.texels)
    if pipeline.first_row == "bottom":
        texels = map(_turned_over, texels)
    return [tuple(next(texels) for _ in step.read) for step in job.steps if not step.draws]


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
    is_new: bool = True
    """True before the first draw."""

    @classmethod
    def of(cls, pipeline: Pipeline, draw: Draw, textures: list[FrameTexture]) -> _Canvas:
        """The textures that a draw needs, which are added to ``textures``."""
        if pipeline.layers and pipeline.samples > 1:
            raise DriverError("targets with layers have one sample for each pixel")
        target = _layered(FrameTexture("r8unorm", draw.width, draw.height), pipeline.layers)
        whole = _layered(target, len(draw.layers))
        read = [replace(whole, format=each.format) for each in pipeline.targets]
        several = [
            replace(target, format=each.format, samples=pipeline.samples)
            for each in (pipeline.targets if pipeline.samples > 1 else ())
        ]
        depth = replace(target, format=pipeline.depth_format, samples=pipeline.samples)
        first, count = len(textures), len(read)
        textures += [*read, *several, depth]
        numbers = tuple(range(first, len(textures) - 1))
        return cls(numbers[:count], numbers[-count:] if count else (), len(textures) - 1)

    def steps(self, pipeline: Pipeline, draw: Draw, name: str) -> Iterator[FrameStep]:
        """The steps that draw, and read the targets back; all have this name."""
        for layer, single in enumerate(_single_draws(draw)):
            yield self._drawing(pipeline, single, layer, name)
        reading = tuple(Barrier(number, self.use, "copied_from") for number in self.read)
        self.use = "copied_from"
        yield FrameStep(reading, read=self.read, name=name)

    def _drawing(self, pipeline: Pipeline, draw: Draw, layer: int, name: str) -> FrameStep:
        """The step that draws, to one layer of the textures that are read back or, with a geometry
        stage, to all of them."""
        several = [number for number in self.drawn if number not in self.read]
        barriers = [Barrier(number, self.use, "target") for number in self.read]
        for number in several:
            barriers.append(Barrier(number, "undefined" if self.is_new else "target", "target"))
        barriers.append(Barrier(self.depth, "undefined" if self.is_new else "depth", "depth"))
        layers = pipeline.layers or 1
        targets = tuple(
            Attachment(number, layer, layers, clear=clear)
            if number == read
            else Attachment(number, stores=False, clear=clear, resolve=Resolve(read, layer))
            # A wrong number of clear colours is told by the checks of the job.
            for number, read, clear in zip(self.drawn, self.read, draw.clear, strict=False)
        )
        depth = Attachment(
            self.depth, layers=layers, stores=False, stores_stencil=False,
            clear=(draw.clear_depth, 0.0, 0.0, 0.0),
        )  # fmt: skip
        self.use, self.is_new = "target", False
        return FrameStep(
            tuple(barriers), targets, depth, (_alone(pipeline, draw),),
            blend_constant=draw.blend_constant, name=name,
        )  # fmt: skip


def _single_draws(draw: Draw) -> list[Draw]:
    """A draw for each layer; the draw itself if there are none."""
    return [replace(draw, blocks=blocks, layers=()) for blocks in draw.layers] or [draw]


def _layered(texture: FrameTexture, layers: int) -> FrameTexture:
    """The texture with layers; without a change if there are none."""
    return replace(texture, layers=layers, dimension="2d_array") if layers else texture


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
        for step in job.steps
        if not step.draws
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
