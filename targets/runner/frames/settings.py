"""Values that a step sets for all its draws: viewport, scissor, blend constant and clears.

``FrameHost`` asks for it, for the reference and for drivers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from ....compiler.documents.plan import AttachmentRow, DrawStep, FramePlan
from ....compiler.ir.image_sizes import outside
from ....compiler.reference.picture.scene import Area
from ..scene_state import CLEAR, Color
from .checks.rows import fail
from .sizes import Size

FAR: Color = (1.0, 0.0, 0.0, 0.0)
"""The clear value of depths, in the first number, if the plan has none."""

Number = Callable[[int], Any]
"""Returns the value of a plan with a number."""


@dataclass(frozen=True, slots=True)
class StepState:
    """The dynamic state of a step."""

    viewport: Area | None
    scissor: Area | None
    """The scissor; ``None``: the whole of the targets."""
    blend_constant: Color


def step_state(plan: FramePlan, step: DrawStep, size: Size, number: Number) -> StepState:
    """The state of a step whose targets have this size.

    Raises ``PlanError`` for a viewport that is not within these.
    """
    viewport, scissor = (
        None if value is None else _area(number(value)) for value in (step.viewport, step.scissor)
    )
    if viewport is not None and (reason := outside(viewport, size)):
        fail(plan, step.name, f"the viewport of {reason}")
    constant = step.blend_constant
    return StepState(viewport, scissor, CLEAR if constant is None else _color(number(constant)))


def cleared(plan: FramePlan, target: AttachmentRow, number: Number) -> Color:
    """The clear value of a target; for depths, the first number, which lies between 0 and 1."""
    is_depth = plan.textures[target.texture].format.startswith("depth")
    if target.clear is None:
        return FAR if is_depth else CLEAR
    value = number(target.clear)
    return (min(max(float(value), 0.0), 1.0), 0.0, 0.0, 0.0) if is_depth else _color(value)


def _area(lanes: Sequence[int]) -> Area:
    left, top, width, height = (int(lane) for lane in lanes)
    return left, top, width, height


def _color(lanes: Sequence[float]) -> Color:
    red, green, blue, alpha = (float(lane) for lane in lanes)
    return red, green, blue, alpha
