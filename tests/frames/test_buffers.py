"""Plans of frames whose kernels leave buffers, which others and the next frame read."""

from __future__ import annotations

import pytest

from burnish.api.entry_points import CompiledFrame
from burnish.compiler.documents.plan import DrawStep, FramePlan, PlanStep, RunStep, WaitingRow
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.writing import to_json
from burnish.support.frozen import changed
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


def waits(place: PlanStep | WaitingRow) -> dict[str, tuple[str, str, bool]]:
    """The buffers that are waited for in one place."""
    return {row.result: (row.before, row.after, row.only_first) for row in place.buffer_barriers}


def test_a_buffer_is_waited_for_where_it_is_used_in_another_way(swarm: CompiledFrame) -> None:
    assert read(FramePlan, to_json(swarm.plan)) == swarm.plan
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
    assert (barrier.before, barrier.after) == ("target", "sampled")


def test_a_step_that_waits_for_a_buffer_begins_a_render_pass(swarm: CompiledFrame) -> None:
    steps = {step.name: step for step in swarm.plan.steps if isinstance(step, DrawStep)}
    assert [steps[name].continues for name in ("shown", "both", "again")] == [False, False, True]


def test_changed_plans_are_refused(swarm: CompiledFrame) -> None:
    plan = to_json(swarm.plan)
    found = [each for each in changes(plan) if not MEANING.match(each.name)]
    of_waiting = [each for each in found if "barriers" in each.name]
    assert len(of_waiting) > 100
    assert [each.name for each in of_waiting if not is_refused(swarm, each.made(plan))] == []


@pytest.mark.parametrize(
    ("step", "row", "wrong", "message"),
    [
        (1, 1, {"before": "read"}, "moved: the buffer of `moved.after` is undefined before"),
        (2, 0, {"after": "written"}, "ahead: it waits for the buffer of `moved.after`, which was"),
        (4, 0, {"result": "begun.after"}, "both: the buffer of `begun.after` is read before"),
        (4, 0, {"result": "shown.color"}, "both: there is no buffer `shown.color`"),
        (1, 0, {"only_first": False}, "moved: the buffer of `begun.after` is undefined before"),
    ],
)
def test_what_is_said_of_a_wrong_barrier(
    swarm: CompiledFrame, step: int, row: int, wrong: dict[str, object], message: str
) -> None:
    rows = list(swarm.plan.steps[step].buffer_barriers)
    rows[row] = changed(rows[row], **wrong)
    steps = list(swarm.plan.steps)
    steps[step] = changed(steps[step], buffer_barriers=tuple(rows))
    with pytest.raises(PlanError) as error:
        check_plan(changed(swarm.plan, steps=tuple(steps)))
    assert str(error.value).startswith(f"Swarm, {message}")


def test_a_kernel_is_run_for_no_material(swarm: CompiledFrame) -> None:
    begun, *others = swarm.plan.steps
    assert isinstance(begun, RunStep)
    wrong = changed(begun, use=changed(begun.use, material="Clay"))
    with pytest.raises(PlanError) as error:
        check_plan(changed(swarm.plan, steps=(wrong, *others)))
    assert str(error.value) == "Swarm, begun: it is a kernel, and has the material `Clay`"
