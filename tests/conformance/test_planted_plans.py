"""Errors in plans that these alone cannot tell: pictures of what the source means tell them."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

import burnish
from burnish.compiler.documents import plan as documents
from burnish.compiler.documents.plan import AttachmentRow, PlanStep
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.writing import to_json
from burnish.targets.conformance.frames import FrameTrial
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.frame_job import Attachment, Barrier
from burnish.targets.runner.frames import by_route, job_resources
from burnish.targets.runner.frames.by_route import draw_frames
from burnish.targets.runner.frames.checking import PlanError
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.job_resources import JobResources
from burnish.targets.runner.frames.plan_files import read_frame
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.frames.subjects import FrameSubject
from burnish.targets.runner.routes import ROUTES

from .kit import Studio

ROUTE = ROUTES["lavapipe:glsl"]
SIZE = (8, 8)
FRAME = """
import std.frames.{FullScreen}
pass Filled : FullScreen blend add {
    param one : float = 0
    param two : float = 0
    target value : rgba16f = vec4(one, two, uv.x, 1)
}
pass Read : FullScreen {
    map first : texture2d with { filter = nearest, mip = none }
    map other : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = first.load(ivec2(0)) - 2 * other.load(ivec2(0))
}
frame F {
    param small : int in 1..64 = 8
    a = Filled(screen, small) with { one = 3, two = 5 }
    b = Filled(screen, 2 * small) with { one = 7, two = 11, clear.value = vec4(2) }
    c = Filled(screen, a) with { one = 1, two = 1, viewport = ivec4(0, 0, small / 2, small) }
    read = Read(screen) with { first = c.value, other = b.value }
    output value = read.value
    output filled = b.value
    output before = a.value
}
"""
Plan = dict[str, Any]


def _inputs(plan: Plan, step: str) -> list[dict[str, Any]]:
    (row,) = [row for row in plan["steps"] if row.get("name") == step]
    found: list[dict[str, Any]] = row["draws"][0]["uses"][0]["inputs"]
    return found


def _swap(plan: Plan, step: str, key: str) -> None:
    """Exchange something of the two inputs of a step."""
    one, other = _inputs(plan, step)
    one[key], other[key] = other[key], one[key]


def _swapped_textures(plan: Plan) -> None:
    _swap(plan, "read", "source")


def _swapped_numbers(plan: Plan) -> None:
    _swap(plan, "a", "source")


def _swapped_names(plan: Plan) -> None:
    _swap(plan, "b", "name")


def _drawn_twice(plan: Plan) -> None:
    plan["steps"][0]["draws"] *= 2


def _without_a_number(plan: Plan) -> None:
    del _inputs(plan, "a")[0]


def _other_constant(plan: Plan) -> None:
    value = plan["values"][_inputs(plan, "b")[0]["source"]["value"]]
    value["steps"][-1]["value"] += 1


def _step(plan: Plan, name: str) -> dict[str, Any]:
    found: dict[str, Any] = next(row for row in plan["steps"] if row.get("name") == name)
    return found


def _cleared_to_black(plan: Plan) -> None:
    _step(plan, "b")["targets"][0]["clear"] = None


def _all_over(plan: Plan) -> None:
    _step(plan, "c")["viewport"] = None


def _cut_instead(plan: Plan) -> None:
    row = _step(plan, "c")
    row["viewport"], row["scissor"] = None, row["viewport"]


def _nothing(_plan: Plan) -> None:
    pass


def _half_the_size(plan: Plan) -> None:
    (row,) = [row for row in plan["textures"] if "b.value" in row["results"]]
    row["size"]["level"] = 1


def _results(studio: Studio, change: Callable[[Plan], None]) -> list[bool]:
    """For each output, true if it agrees."""
    (frame,) = burnish.compile(FRAME, (ROUTE.profile,)).frames
    document = to_json(frame.plan)
    change(document)
    planted = SimpleNamespace(
        name="F",
        shaders=frame.shaders,
        plan=read(documents.FramePlan, document),
        plan_of_reference=frame.plan_of_reference,
    )
    drawn = FrameTrial("F", cast(FrameSubject, planted), SIZE)
    device = studio.runner.device(ROUTE)
    results = list(drawn.results(ROUTE, device, studio.runner, studio.toolchain))
    return [not result.comparison.wrong for result in results]


def test_the_frame_itself_agrees(studio: Studio) -> None:
    assert _results(studio, _nothing) == [True, True, True]


@pytest.mark.parametrize(
    "change",
    [
        _swapped_textures, _swapped_numbers, _swapped_names, _drawn_twice, _without_a_number,
        _other_constant, _cleared_to_black, _all_over, _cut_instead,
    ],
)  # fmt: skip
def test_another_meaning_is_found(studio: Studio, change: Callable[[Plan], None]) -> None:
    assert False in _results(studio, change)


def test_another_size_is_told(studio: Studio) -> None:
    with pytest.raises(PlanError, match="filled has 8 x 8 texels, and should have 16 x 16 texels"):
        _results(studio, _half_the_size)


def test_files_are_drawn_as_what_they_were_written_of(studio: Studio, tmp_path: Path) -> None:
    (frame,) = burnish.compile(FRAME, (ROUTE.profile,)).frames
    (tmp_path / "F.plan.json").write_text(json.dumps(to_json(frame.plan)), "utf-8")
    for shader in frame.shaders:
        reflection = json.dumps(to_json(shader.reflection))
        (tmp_path / f"{shader.name}.json").write_text(reflection, "utf-8")
        for file in shader.files:
            (tmp_path / file.name).write_text(file.text, "utf-8")
    stored = read_frame(tmp_path / "F.plan.json", (ROUTE.profile,))
    scenery = in_a_row([], {}, "sphere")
    one, other = (
        draw_frames(FrameHost(each, scenery, SIZE), ROUTE, studio.runner, studio.toolchain)
        for each in (frame, stored)
    )
    assert {name: array.tolist() for name, array in one[0].items()} == {
        name: array.tolist() for name, array in other[0].items()
    }


# --- the runner ----------------------------------------------------------------------------------


def _never_loads(job: Any, target: AttachmentRow, *layers: int) -> Attachment:
    return replace(ATTACHMENT(job, target, *layers), loads=False)


def _never_stores(job: Any, target: AttachmentRow, *layers: int) -> Attachment:
    return replace(ATTACHMENT(job, target, *layers), stores=False)


def _other_textures(job: Any, draw: Any) -> tuple[tuple[int, ...], tuple[int, ...]]:
    textures, buffers = BOUND(job, draw)
    return textures[::-1], buffers


def _without_barriers(
    resources: JobResources, step: PlanStep, *, is_first: bool
) -> tuple[Barrier, ...]:
    return BARRIERS(resources, step, is_first=is_first)[1:]


def _all_in_one_place(_plan: documents.FramePlan, needed: Mapping[int, int]) -> list[list[int]]:
    return [sorted(needed)]


ATTACHMENT, BOUND = by_route.HostSteps._attachment, by_route.HostSteps._bound
BARRIERS = JobResources.barriers


@pytest.mark.parametrize(
    ("place", "name", "planted", "told"),
    [
        (by_route.HostSteps, "_attachment", _never_loads, ""),
        (by_route.HostSteps, "_bound", _other_textures, ""),
        (by_route.HostSteps, "_attachment", _never_stores,
         "is read, but nothing has drawn its layer 0, level 0"),
        (JobResources, "barriers", _without_barriers,
         "is used as 'target', but its use is 'undefined'"),
        (job_resources, "taking_turns", _all_in_one_place, "but its use is 'undefined'"),
    ],
)  # fmt: skip
def test_errors_of_the_runner_are_found(
    studio: Studio,
    place: object,
    name: str,
    planted: object,
    told: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(place, name, planted)
    if not told:
        assert False in _results(studio, _nothing)
        return
    with pytest.raises(DriverError, match=told):
        _results(studio, _nothing)
