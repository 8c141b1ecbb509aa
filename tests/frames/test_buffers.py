"""Plans of frames whose kernels leave buffers, which others and the next frame read."""

from __future__ import annotations

from typing import Any

import pytest

from burnish.api import CompiledFrame
from burnish.compiler.reflection.schema import PLAN, validate
from burnish.targets.runner.frames.checking import PlanError, check_plan

from .changes import changes
from .kit import of_text
from .test_planted import MEANING, is_refused

SWARM = """
import std.frames.{FullScreen}
kernel Begun { result after : vec2[64] = vec2(float(index) / 64, 0.5) }
kernel Moved {
    buffer before : vec2[]
    result after : vec2[before.count] = before[index] + vec2(0.01, 0)
}
pass Shown : FullScreen {
    buffer places : vec2[]
    target color : rgba8 = vec4(places[int(frag_coord.x) mod 64], 0, 1)
}
pass Over : FullScreen blend add {
    buffer places : vec2[]
    target color : rgba8 = vec4(places[int(frag_coord.y) mod 64], 0, 1)
}
frame Swarm {
    begun = Begun()
    moved = Moved() with { before = previous(moved.after, begun.after) }
    ahead = Moved() with { before = moved.after }
    shown = Shown(screen) with { places = moved.after }
    both  = Over(screen, shown) with { places = ahead.after }
    again = Over(screen, both) with { places = moved.after }
    output picture = again.color
    output places = ahead.after
}
"""


@pytest.fixture(scope="module")
def swarm() -> CompiledFrame:
    """A frame of particles."""
    return of_text(SWARM)


def waits(place: dict[str, Any]) -> dict[str, tuple[str, str, bool]]:
    """The buffers that are waited for in one place."""
    return {
        row["result"]: (row["from"], row["to"], row["only_first"])
        for row in place["buffer_barriers"]
    }


def test_a_buffer_is_waited_for_where_it_is_used_in_another_way(swarm: CompiledFrame) -> None:
    validate(swarm.plan, PLAN)
    steps = {step.name: step for step in swarm.plan.steps}
    assert {name: waits(step) for name, step in steps.items()} == {
        "begun": {"begun.after": ("undefined", "written", True)},
        "moved": {
            # Later frames read what the last one has left, which is ready.
            "begun.after": ("written", "read", True),
            "moved.after": ("undefined", "written", False),
        },
        "ahead": {
            "moved.after": ("written", "read", False),
            "ahead.after": ("undefined", "written", False),
        },
        "shown": {},
        "both": {"ahead.after": ("written", "read", False)},
        "again": {},
    }
    assert waits(swarm.plan.end) == {}


def test_what_the_host_and_the_next_frame_read_is_ready_at_the_end() -> None:
    text = SWARM.replace(
        "{ before = moved.after }", "{ before = previous(moved.after, begun.after) }"
    )
    text = text.replace("places = ahead.after }", "places = moved.after }")
    plan = of_text(
        text.replace("places = moved.after", "places = previous(moved.after, begun.after)")
    ).plan
    check_plan(plan)
    assert waits(plan.end) == {
        "ahead.after": ("written", "read", False),
        "moved.after": ("written", "read", False),
    }
    (barrier,) = plan.end.barriers
    assert (barrier["from"], barrier["to"]) == ("target", "sampled")


def test_a_step_that_waits_for_a_buffer_begins_a_render_pass(swarm: CompiledFrame) -> None:
    steps = {step.name: step for step in swarm.plan.steps}
    assert [steps[name].continues for name in ("shown", "both", "again")] == [False, False, True]


def test_changed_plans_are_refused(swarm: CompiledFrame) -> None:
    found = [each for each in changes(swarm.plan) if not MEANING.match(each.name)]
    of_waiting = [each for each in found if "barriers" in each.name]
    assert len(of_waiting) > 100
    assert [each.name for each in of_waiting if not is_refused(swarm, each.made(swarm.plan))] == []


@pytest.mark.parametrize(
    ("step", "row", "changed", "message"),
    [
        (1, 1, {"from": "read"}, "moved: the buffer of `moved.after` is undefined before"),
        (2, 0, {"to": "written"}, "ahead: it waits for the buffer of `moved.after`, which was"),
        (4, 0, {"result": "begun.after"}, "both: the buffer of `begun.after` is read before"),
        (4, 0, {"result": "shown.color"}, "both: there is no buffer `shown.color`"),
        (1, 0, {"only_first": False}, "moved: the buffer of `begun.after` is undefined before"),
    ],
)
def test_what_is_said_of_a_wrong_barrier(
    swarm: CompiledFrame, step: int, row: int, changed: dict[str, Any], message: str
) -> None:
    rows = list(swarm.plan.steps[step].buffer_barriers)
    rows[row] = {**rows[row], **changed}
    steps = list(swarm.plan.steps)
    steps[step] = {**steps[step], "buffer_barriers": rows}
    with pytest.raises(PlanError) as error:
        check_plan({**swarm.plan, "steps": steps})
    assert str(error.value).startswith(f"Swarm, {message}")
