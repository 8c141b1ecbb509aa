"""Estimates how long the reference takes for a subject, so that the longest ones begin first.

``burnish conform`` gives subjects to several processes by it. The numbers are the operations of
``compiler/reference/cost.py``: only their proportions matter, and only roughly.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...compiler.documents.plan import DrawStep, PlanStep
from ...compiler.documents.reflection import Reflection
from ...compiler.ir.shader import Shader
from ...compiler.reference.cost import CALL, operations
from ..runner.frames.checking import PlanError
from ..runner.frames.host import FrameHost
from ..runner.frames.subjects import FrameSubject, is_frame, is_shader
from ..runner.kernels import has_images, is_over_buffers
from ..runner.subject import Subject
from .cases import DRAWN_CASES, ELEMENT_CASES, IMAGE_CASES, SIZE, Size
from .frames import frames_of, judged_host
from .refusals import REFUSALS

_SUBJECT = 8000 * CALL
"""The cost of what every subject takes beside evaluation: compilers, drivers and comparisons."""
_USUAL_TURNS = 16
"""The number of turns that loops usually have whose number is not known before they run."""


def cost_of(subject: Subject | FrameSubject) -> float:
    """The estimated cost of a subject; one that cannot be drawn costs as much as any other."""
    if is_shader(subject):
        return _SUBJECT + _cases_of(subject.reflection) * _cost(subject.shader, SIZE)
    assert is_frame(subject)
    try:
        return _SUBJECT + _frame_cost(judged_host(subject, SIZE))
    except REFUSALS:
        return _SUBJECT


def _frame_cost(host: FrameHost) -> float:
    """The cost of all pictures of a frame. Raises the exceptions of ``REFUSALS``."""
    steps = [step for step in host.plan.steps if step.uses]
    costs = (cost for step in steps for cost in _costs_of(step, host))
    return frames_of(host.plan) * sum(costs)


def _cases_of(reflection: Reflection) -> int:
    """The number of pictures of a single shader."""
    if has_images(reflection):
        return len(IMAGE_CASES)
    return len(ELEMENT_CASES if is_over_buffers(reflection) else DRAWN_CASES)


def _cost(shader: Shader, size: Size) -> float:
    """The cost of one picture."""
    roots = [result.value for result in shader.results]
    return operations(roots, _USUAL_TURNS) * (CALL + size[0] * size[1])


def _costs_of(step: PlanStep, host: FrameHost) -> Iterator[float]:
    """The costs of a step's draws, or of its kernel."""
    layers = 1
    try:
        size = host.drawn_size(step) if step.attachments else SIZE
    except PlanError:  # A kernel says how large it is, which is not run here.
        size = SIZE
    if isinstance(step, DrawStep):
        target = step.attachments[0]
        layers = 1 if target.layer is not None else host.plan.textures[target.texture].layers
    for use in step.uses:
        yield layers * _cost(host.shaders[use.shader].shader, size)
