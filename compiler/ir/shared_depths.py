"""Finds the steps of a frame that draw to the same depths, one over the result of another.

These depths have one format, and are compared with each other. ``semantics/frames`` and
``compiler/planning`` ask.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...support.frozen import frozen
from .frame import RenderStep, Step, StepTexture


@frozen(eq=False)
class SharedDepths:
    """Depths that belong together."""

    images: tuple[StepTexture, ...]
    steps: tuple[RenderStep, ...]
    """The steps that draw to them, in order."""


def shared_depths(steps: Iterable[Step]) -> Iterator[SharedDepths]:
    """All depths that steps draw to, together with those that they are drawn over."""
    drawing: dict[StepTexture, list[RenderStep]] = {}
    for step in steps:
        if isinstance(step, RenderStep):
            for image in _depths_of(step):
                drawing.setdefault(image, []).append(step)
    seen: set[StepTexture] = set()
    for first in drawing:
        if first in seen:
            continue
        images, together = {first: None}, dict[RenderStep, None]()
        pending = [first]
        for image in pending:  # The list grows on the way.
            together.update(dict.fromkeys(drawing[image]))
            beside = {each for step in drawing[image] for each in _depths_of(step)}
            pending += (new := [each for each in beside if each not in images])
            images.update(dict.fromkeys(new))
        seen.update(images)
        yield SharedDepths(tuple(images), tuple(together))


def _depths_of(step: RenderStep) -> tuple[StepTexture, ...]:
    """The image that a step draws its depths to, and the one that it draws them over."""
    if step.depth is None:
        return ()
    return (step.depth.image,) if step.depth.over is None else (step.depth.image, step.depth.over)
