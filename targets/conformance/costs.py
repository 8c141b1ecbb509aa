"""Estimates how long the reference takes for a subject, so that the longest ones begin first.

``burnish conform`` gives subjects to several processes by it. The numbers are the operations of
``compiler/reference/cost.py``: only their proportions matter, and only roughly.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...compiler.documents.plan import DrawStep, PlanStep
from ...compiler.documents.reflection import Reflection
from ...compiler.ir.shader import Shader
from ...compiler.reference.cost import CALL, operations
from ..runner.frames.checking import PlanError
from ..runner.frames.host import FrameHost
from ..runner.frames.independent import can_be_sent, independent_steps
from ..runner.frames.subjects import FrameSubject, is_frame, is_shader
from ..runner.kernels import has_images, is_over_buffers
from ..runner.subject import Subject
from .cases import DRAWN_CASES, ELEMENT_CASES, IMAGE_CASES, SIZE, Size
from .judged_frames import frames_of, judged_host
from .refusals import REFUSALS

_SUBJECT = 8000 * CALL
"""The cost of what every subject takes beside evaluation: compilers, drivers and comparisons."""
_USUAL_TURNS = 16
"""The number of turns that loops usually have whose number is not known before they run."""


START = 100_000 * CALL
"""The cost that other processes have to save to be started: about two seconds. They import what
this process has imported already, and compile its files again."""
HELP = 50_000 * CALL
"""The cost of steps from which on the help of other processes pays, which have to compile the file
of the frame first: about a second."""


def cost_of(subject: Subject | FrameSubject) -> float:
    """The estimated cost of a subject; one that cannot be drawn costs as much as any other."""
    if is_shader(subject):
        return _SUBJECT + _cases_of(subject.reflection) * _cost(subject.shader, SIZE)
    assert is_frame(subject)
    try:
        return _SUBJECT + _frame_cost(judged_host(subject, SIZE))
    except REFUSALS:
        return _SUBJECT


def shared_cost_of(subject: Subject | FrameSubject) -> float:
    """The part of the estimated cost for which other processes can help."""
    if not is_frame(subject):
        return 0.0
    try:
        phases = frame_phases(judged_host(subject, SIZE))
    except REFUSALS:
        return 0.0
    return sum(sum(parts) for parts in phases if len(parts) > 1)


def frame_phases(host: FrameHost) -> list[tuple[float, ...]]:
    """The estimated costs of the steps of a frame, those together that several processes can draw.

    Raises the exceptions of ``REFUSALS``.
    """
    found: list[tuple[float, ...]] = []
    steps = host.plan.steps
    for group in independent_steps(host.plan, range(len(steps))):
        parts = [part for number in group for part in _parts_of(steps[number], host)]
        found.append(tuple(parts) if help_pays(host, group) else (sum(parts),))
    return found * frames_of(host.plan)


def help_pays(host: FrameHost, numbers: Sequence[int]) -> bool:
    """True if other processes are worth while to help with independent steps of these numbers.

    Raises the exceptions of ``REFUSALS``.
    """
    steps = [host.plan.steps[number] for number in numbers]
    if not all(can_be_sent(host.plan, step) for step in steps):
        return False
    parts = [part for step in steps for part in _parts_of(step, host)]
    return len(parts) > 1 and sum(parts) >= HELP


def _parts_of(step: PlanStep, host: FrameHost) -> list[float]:
    """The costs of each layer of a step."""
    layers = _layers_of(step, host)
    return [sum(_costs_of(step, host)) / layers] * layers


def _frame_cost(host: FrameHost) -> float:
    """The cost of all pictures of a frame. Raises the exceptions of ``REFUSALS``."""
    costs = (cost for step in host.plan.steps for cost in _costs_of(step, host))
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
    """The costs of a step's draws, or of its kernel; a copy has none."""
    if not step.uses:
        return
    try:
        size = host.drawn_size(step) if step.attachments else SIZE
    except PlanError:  # A kernel says how large it is, which is not run here.
        size = SIZE
    layers = _layers_of(step, host)
    for use in step.uses:
        yield layers * _cost(host.shaders[use.shader].shader, size)


def _layers_of(step: PlanStep, host: FrameHost) -> int:
    """The number of layers in which a step is drawn."""
    if not isinstance(step, DrawStep):
        return 1
    target = step.attachments[0]
    return 1 if target.layer is not None else host.plan.textures[target.texture].layers
