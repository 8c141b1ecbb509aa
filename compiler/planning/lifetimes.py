"""Lifetimes of results: from which step to which a frame needs them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from ...support.frozen import fresh, record
from ..ir.frame import (
    Attachment,
    Elements,
    Frame,
    FromHost,
    KernelStep,
    Previous,
    RenderStep,
    Source,
    Step,
    StepTexture,
)

Left = StepTexture | Elements
"""A result of a step: an image or a buffer."""

ALWAYS = 1 << 30
"""A step after the last one: results that it needs live on."""


def sources_of(step: Step) -> Iterator[Source]:
    """The sources of a step's inputs; several inputs may have one source."""
    for use in step.uses:
        for given in use.given:
            yield given.source


def attachments_of(step: Step) -> tuple[Attachment, ...]:
    """The attachments that a pass draws to, its depths last."""
    return step.drawn_to if isinstance(step, RenderStep) else ()


def written_by(step: Step) -> Iterator[Left]:
    """Yields the results of a step."""
    if isinstance(step, KernelStep):
        yield from step.images.values()
        yield from step.buffers.values()
    else:
        yield from (each.image for each in attachments_of(step))


def read_by(step: Step) -> Iterator[Left]:
    """Yields the results of others in this frame that a step reads."""
    for source in sources_of(step):
        found = source.initially if isinstance(source, Previous) else source
        if isinstance(found, StepTexture | Elements):
            yield found


@record
class Lifetimes:
    """The first and the last step that need each thing that is left."""

    first: dict[Left, int] = fresh(factory=dict)
    last: dict[Left, int] = fresh(factory=dict)
    kept: dict[Left, None] = fresh(factory=dict)
    """The results that the next frame reads, in order."""

    @classmethod
    def of(cls, frame: Frame) -> Lifetimes:
        """The lifetimes of the results of a frame's steps, which are numbered in order."""
        found, rare = cls(), only_first(frame)
        for number, step in enumerate(frame.steps):
            for left in written_by(step):
                found.first.setdefault(left, number)
                found.last[left] = number
            for left in read_by(step):
                found.last[left] = number
            for attachment in attachments_of(step):
                if attachment.over is not None:
                    found.last[attachment.over] = number
            for source in sources_of(step):
                if not isinstance(source, Previous) or source.of is None:
                    continue
                # A step of the first frame only finds no last one.
                if step.name not in rare or source.initially is None:
                    found.kept[source.of] = None
        for output in frame.outputs:
            found.last[output.source] = ALWAYS
        return found

    def is_over(self, left: Left, step: int) -> bool:
        """True if no step behind this one needs a result."""
        return left not in self.kept and self.last[left] <= step


def only_first(frame: Frame) -> frozenset[str]:
    """The names of steps that are needed in the first frame only.

    ``previous`` reads their results before there is a last frame.
    """
    makers: dict[Left, list[Step]] = {}
    for step in frame.steps:
        for left in written_by(step):
            makers.setdefault(left, []).append(step)
    pending: list[Left] = [output.source for output in frame.outputs]
    needed: set[str] = set()
    while pending:
        step = makers[pending.pop()][-1]
        if step.name in needed:
            continue
        # All steps that draw into one image belong together.
        for other in chain.from_iterable(makers[left] for left in written_by(step)):
            if other.name not in needed or other is step:
                pending += _always_read(other)
                needed.add(other.name)
    return frozenset(step.name for step in frame.steps if step.name not in needed)


def _always_read(step: Step) -> Iterator[Left]:
    """Yields the results that a step needs in every frame."""
    for source in sources_of(step):
        if isinstance(source, Previous):
            if source.of is not None:
                yield source.of
        elif not isinstance(source, int | FromHost):
            yield source
    yield from (each.over for each in attachments_of(step) if each.over is not None)
