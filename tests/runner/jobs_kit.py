"""Frame jobs of draws with one hand-written pipeline, for tests of single drivers."""

from __future__ import annotations

from collections.abc import Sequence

from burnish.compiler.documents.plan import TextureState
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.frame_job import (
    BLACK,
    OWN,
    Attachment,
    Barrier,
    Found,
    FrameDraw,
    FrameJob,
    FrameStep,
    FrameTexture,
)
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.frames.by_route import Floats, upright

Color = tuple[float, float, float, float]
Picture = tuple[Floats, ...]
"""The targets of a draw, each of shape (height, width, 4), with their top rows first."""


def draw_job(
    pipeline: Pipeline,
    draws: Sequence[Draw],
    *,
    clear: Sequence[Color] | None = None,
    clear_depth: float = 1.0,
    blend_constant: Color = BLACK,
) -> FrameJob:
    """A step for each draw, and one behind it that reads its targets.

    Draws of one size share targets, which are cleared before each of them: to black if ``clear``
    does not say a colour for each. The steps are called ``draw 0``, ``draw 1`` and so on.
    """
    textures: list[FrameTexture] = []
    drawn_to: dict[tuple[int, int], Sequence[int]] = {}
    steps: list[FrameStep] = []
    colours = [BLACK] * len(pipeline.targets) if clear is None else clear
    for number, draw in enumerate(draws):
        size = draw.width, draw.height
        before: TextureState = "copied_from" if size in drawn_to else "undefined"
        if size not in drawn_to:
            first = len(textures)
            textures += [FrameTexture(target.format, *size) for target in pipeline.targets]
            textures.append(FrameTexture(pipeline.depth_format, *size))
            drawn_to[size] = range(first, len(textures))
        *targets, depth = drawn_to[size]
        own = (OWN,) * len(pipeline.textures), (OWN,) * len(pipeline.buffers)
        steps.append(
            FrameStep(
                (
                    *(Barrier(target, before, "target") for target in targets),
                    Barrier(depth, "undefined" if before == "undefined" else "depth", "depth"),
                ),
                tuple(
                    Attachment(target, clear=colour)
                    for target, colour in zip(targets, colours, strict=True)
                ),
                Attachment(
                    depth, stores=False, stores_stencil=False, clear=(clear_depth, 0.0, 0.0, 0.0)
                ),
                (FrameDraw(0, *own, draw=draw),),
                blend_constant=blend_constant,
                name=f"draw {number}",
            )
        )
        reading = tuple(Barrier(target, "target", "copied_from") for target in targets)
        steps.append(FrameStep(reading, read=tuple(targets), name=f"draw {number}"))
    return FrameJob(tuple(textures), (), (pipeline,), tuple(steps))


def pictures(job: FrameJob, found: Found) -> list[Picture]:
    """The picture of each draw of such a job."""
    targets = upright(job, found)
    return [tuple(next(targets)[0] for _ in step.read) for step in job.steps if not step.draws]
