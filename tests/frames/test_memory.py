"""Textures of a frame that take turns in the same memory, by hand and for the examples."""

from __future__ import annotations

import pytest

from burnish.compiler.documents.plan import DrawStep, FramePlan
from burnish.support.frozen import changed
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.frame_job import (
    Attachment,
    Barrier,
    FrameJob,
    FrameStep,
    FrameTexture,
)
from burnish.targets.runner.drivers.frame_order import check_order
from burnish.targets.runner.frames.memory import bytes_of, taking_turns, total

from .kit import EXAMPLES, compiled, memory_share, of_text

pytestmark = pytest.mark.xdist_group("plans")  # One process compiles all examples.

SMALL = of_text("""
import std.frames.{FullScreen}
pass Filled : FullScreen { target value : rgba16f = vec4(uv, 0, 1) }
frame Small {
    filled = Filled(screen)
    output picture = filled.value
}
""").plan
"""A plan whose rows are changed to those that a test needs."""


def planned(*spans: tuple[int, int], kept: int = -1, once: int | None = None) -> FramePlan:
    """A plan with a texture for each result, which is needed from one step to another; one is kept
    for the next frame, and one is drawn once."""
    (step,), (texture,), (result,) = SMALL.steps, SMALL.textures, SMALL.results
    assert isinstance(step, DrawStep)
    drawn = changed(step, only_first=True, targets=(changed(step.targets[0], texture=once),))
    return changed(
        SMALL,
        steps=() if once is None else (drawn,),
        textures=tuple(changed(texture, kept=number == kept) for number in range(len(spans))),
        results=tuple(
            changed(result, texture=number, first=first, last=last)
            for number, (first, last) in enumerate(spans)
        ),
    )


def test_textures_take_turns_that_no_step_needs_together() -> None:
    plan = planned((0, 1), (1, 2), (2, 3), (3, 4))
    needed = {0: 100, 1: 60, 2: 80, 3: 10}
    groups = taking_turns(plan, needed)
    assert groups == [[0, 2], [1, 3]]
    assert total(groups, needed) == 160


def test_what_is_kept_takes_no_turns() -> None:
    assert taking_turns(planned((0, 1), (2, 3), kept=0), {0: 4, 1: 4}) == [[1], [0]]
    assert taking_turns(planned((0, 1), (2, 3), once=0), {0: 4, 1: 4}) == [[1], [0]]


def test_bytes_are_those_of_all_levels_layers_and_samples() -> None:
    (plain,) = SMALL.textures
    cube = changed(plain, format="rgba16f", levels=3, layers=6)
    assert bytes_of(cube, (8, 8)) == 8 * 6 * (64 + 16 + 4)
    assert bytes_of(changed(plain, format="depth32f"), (5, 3)) == 60
    assert bytes_of(changed(plain, format="r8", levels=2), (5, 1)) == 7
    assert bytes_of(changed(plain, format="rgba8", samples=4), (5, 3)) == 4 * 4 * 15


def test_the_example_with_the_most_steps_needs_at_most_60_percent() -> None:
    frame = max(map(compiled, EXAMPLES), key=lambda frame: len(frame.plan.steps))
    assert memory_share(frame) <= 0.6


def test_what_took_turns_is_gone() -> None:
    """A job in which the second texture gets the memory of the first, which is then read."""
    first, second = (FrameTexture("rgba8unorm", 4, 4, memory=0) for _ in range(2))
    drawn = [
        FrameStep((Barrier(number, "undefined", "target"),), (Attachment(number),))
        for number in (0, 1)
    ]
    read = FrameStep((Barrier(0, "target", "copied_from"),), read=(0,))
    check_order(FrameJob((first, second), (), (), (drawn[0], read, drawn[1])))
    with pytest.raises(DriverError, match="step 2: a barrier takes texture 0 from 'target'"):
        check_order(FrameJob((first, second), (), (), (*drawn, read)))
