"""Finds the depths of a frame that need stencil values beside them.

``plan.py`` asks once for each frame. A step's depths have stencil values if a pass uses them that
draws there, or draws over them: then all of these have one format.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain

from ...support.frozen import record
from ..ir.frame import Attachment, Frame, RenderStep, Step, StepTexture
from ..ir.shared_depths import shared_depths

STENCIL_FORMATS: Mapping[str, str] = {"depth32f": "depth32f_stencil8"}
"""The format with stencil values for each format of depths: depths stay the same numbers."""


@record
class Stencils:
    """The images that have stencil values, and how long steps need them."""

    frame: Frame
    images: frozenset[StepTexture]

    @classmethod
    def of(cls, frame: Frame) -> Stencils:
        """The stencils of a frame."""
        found = (d.images for d in shared_depths(frame.steps) if any(map(_uses_stencil, d.steps)))
        return cls(frame, frozenset(chain.from_iterable(found)))

    def format_of(self, image: StepTexture) -> str:
        """The format of the texture that holds an image."""
        return STENCIL_FORMATS[image.format] if image in self.images else image.format

    def are_needed(self, number: int, attachment: Attachment) -> bool:
        """True if a step after this number reads the stencil values that it leaves."""
        for step in self.frame.steps[number + 1 :]:
            depth = step.depth if isinstance(step, RenderStep) else None
            if depth is None:
                continue
            if depth.over is attachment.image or _place(depth) == _place(attachment):
                return True
        return False


def _place(depth: Attachment) -> tuple[StepTexture, int | None, int]:
    return depth.image, depth.layer, depth.level


def _uses_stencil(step: Step) -> bool:
    return any(use.shader.shader.render_state.stencil.is_used for use in step.uses)
