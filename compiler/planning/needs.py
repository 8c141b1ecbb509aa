"""Finds who needs a result behind a step: whether it is stored, resolved, or drawn over.

``plan.py`` asks for each target of each step, by the number of the step.
"""

from __future__ import annotations

from ...support.frozen import fresh, record
from ..ir.frame import Attachment, Frame, StepTexture
from .lifetimes import ALWAYS, Left, Lifetimes, attachments_of, read_by

DrawnPart = tuple[StepTexture, int | None, int]
"""A layer and a level of a result; ``None`` is all of its layers."""


def part_of(attachment: Attachment) -> DrawnPart:
    """The part of an image that an attachment draws to."""
    return attachment.image, attachment.layer, attachment.level


@record
class Needs:
    """The needs of a frame's steps."""

    frame: Frame
    lifetimes: Lifetimes
    last_use: dict[Left, int] = fresh(factory=dict)
    """The last step that reads something, or draws over it with one sample."""

    @classmethod
    def of(cls, frame: Frame, lifetimes: Lifetimes) -> Needs:
        """The needs of a frame's steps, of which each is looked at once here."""
        found = cls(frame, lifetimes)
        for number, step in enumerate(frame.steps):
            found.last_use.update(dict.fromkeys(read_by(step), number))
            for each in attachments_of(step):
                if each.over is not None and each.image.samples == 1:
                    found.last_use[each.over] = number
        found.last_use.update((output.source, ALWAYS) for output in frame.outputs)
        return found

    def is_needed(self, number: int, image: StepTexture) -> bool:
        """True if somebody reads an image behind a step that draws it."""
        return image in self.lifetimes.kept or self.last_use.get(image, -1) > number

    def is_resolved(self, number: int, image: StepTexture) -> bool:
        """True if somebody reads the means of a result's samples behind a step."""
        return not image.is_depth and self.is_needed(number, image)

    def resolves(self, number: int, attachment: Attachment) -> bool:
        """True if somebody reads a step's result before another one draws there, too."""
        image, part = attachment.image, part_of(attachment)
        if not self.is_resolved(number, image):
            return False
        for step in self.frame.steps[number + 1 :]:
            if image in set(read_by(step)):
                return True
            if any(part_of(each) == part for each in attachments_of(step)):
                return False
        return True

    def finds_samples(self, number: int, attachment: Attachment) -> bool:
        """True if a later step draws on where a step with several samples has drawn."""
        image, layer, level = part_of(attachment)
        return any(
            part_of(each) == (image, layer, level)
            or (
                each.image.samples > 1
                and (each.over, each.layer, each.level) == (image, layer, level)
            )
            for step in self.frame.steps[number + 1 :]
            for each in attachments_of(step)
        )

    def is_drawn_over(self, over: StepTexture, image: StepTexture, number: int) -> bool:
        """True if from a step on only those need ``over`` that draw ``image`` over it.

        There may be a step for each of its layers.
        """
        if over in self.lifetimes.kept or self.lifetimes.last[over] == ALWAYS:
            return False
        return all(
            over not in read_by(step)
            and all(each.image is image for each in attachments_of(step) if each.over is over)
            for step in self.frame.steps[number:]
        )
