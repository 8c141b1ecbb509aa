"""Finds steps of a frame that need nothing of each other: faces of a cube, levels, or passes.

The reference draws such steps in any order, so other processes can help it (``helped.py``). These
know the frame and its values, and nothing else; what a step finds in textures is sent to them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ....compiler.documents.plan import (
    DrawStep,
    FramePlan,
    PlanStep,
    PreviousSource,
    ResultSource,
    Source,
)


class Traffic(NamedTuple):
    """The textures that a step reads and writes, by their numbers."""

    read: frozenset[int]
    """Those whose contents are the source of an input."""
    written: frozenset[tuple[int, int | None, int]]
    """The places to which it draws, perhaps over what is there: texture, layer and level."""
    cleared: frozenset[int]
    """Those that it makes anew."""

    def is_independent_of(self, earlier: Traffic) -> bool:
        """True if this step finds and leaves the same, whether or not the earlier one is drawn.

        Whoever draws several such steps makes ready all textures that they clear before the first.
        """
        own = {texture for texture, _layer, _level in self.written}
        theirs = {texture for texture, _layer, _level in earlier.written}
        return not (
            (self.read & theirs) or (earlier.read & own) or (self.cleared & theirs)
            or any(_overlap(one, other) for one in self.written for other in earlier.written)
        )  # fmt: skip


def independent_steps(plan: FramePlan, numbers: Sequence[int]) -> list[list[int]]:
    """Some steps of a plan, by their numbers, in groups that follow each other.

    All steps of a group are independent of each other. A step that cannot be sent to another
    process is alone.
    """
    found: list[list[int]] = []
    group: list[Traffic] = []
    is_open = False
    for number in numbers:
        step = plan.steps[number]
        traffic = _traffic(step) if can_be_sent(plan, step) else None
        if is_open and traffic is not None and all(map(traffic.is_independent_of, group)):
            found[-1].append(number)
        else:
            found.append([number])
            group = []
        is_open = traffic is not None
        if traffic is not None:
            group.append(traffic)
    return found


def can_be_sent(plan: FramePlan, step: PlanStep) -> bool:
    """True if other processes can draw a step: they know all that it needs besides textures.

    They do not run kernels, which leave buffers and decide about the sizes of textures. Depths that
    a later step goes on with are told apart by faces, which each process numbers for itself.
    """
    if not isinstance(step, DrawStep):
        return False
    sizes_are_known = all(row.size.value is not None for row in plan.textures)
    goes_on = any(each.attachments and _goes_on_with_depths(each) for each in plan.steps)
    reads_buffers = any(_of_buffer(source) for source in _sources(step))
    return sizes_are_known and not reads_buffers and (step.depth is None or not goes_on)


def _goes_on_with_depths(step: PlanStep) -> bool:
    return isinstance(step, DrawStep) and step.depth is not None and step.depth.load == "load"


def _sources(step: PlanStep) -> list[Source]:
    found = [row.source for use in step.uses for row in use.inputs]
    first = [each.initially for each in found if isinstance(each, PreviousSource)]
    return [*found, *(each for each in first if each is not None)]


def _of_buffer(source: Source) -> bool:
    return isinstance(source, (ResultSource, PreviousSource)) and source.texture is None


def textures_needed(step: PlanStep) -> frozenset[int]:
    """The textures, by their numbers, whose contents a step needs."""
    drawn_over = {target.texture for target in step.attachments if target.load == "load"}
    return _traffic(step).read | drawn_over


def _traffic(step: PlanStep) -> Traffic:
    sources = _sources(step)
    read = {
        source.texture
        for source in sources
        if isinstance(source, (ResultSource, PreviousSource)) and source.texture is not None
    }
    places = [(target, place) for target in step.attachments for place in target.places]
    return Traffic(
        frozenset(read),
        frozenset((place.texture, place.layer, place.level) for _target, place in places),
        frozenset(
            place.texture
            for target, place in places
            if target.load == "clear" and place.layer in (0, None) and place.level == 0
        ),
    )


def _overlap(one: tuple[int, int | None, int], other: tuple[int, int | None, int]) -> bool:
    texture, layer, level = one
    return (texture, level) == (other[0], other[2]) and (
        layer is None or other[1] is None or layer == other[1]
    )
