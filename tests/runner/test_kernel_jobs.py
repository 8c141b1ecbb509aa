"""Jobs of kernels: how many work groups run, and what is refused before a driver sees it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import pytest

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import Codes
from burnish.targets.runner.drivers.checks import check_groups
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.draws import Dispatch, Sides
from burnish.targets.runner.drivers.frame_checks import check_frame
from burnish.targets.runner.drivers.frame_job import (
    OWN,
    BufferBarrier,
    Found,
    FrameBuffer,
    FrameDraw,
    FrameJob,
    FrameStep,
)
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.drivers.slots import BufferSlot, Place
from burnish.targets.runner.frames.job_resources import WORD
from burnish.targets.runner.frames.states import outcomes, states_job
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.kernels import dispatch_of, elements_state
from burnish.targets.runner.routes import ROUTES

PLACE = Place("r", 0, 0)
PIPELINE = Pipeline({}, (), (), (), (), buffers=(BufferSlot(PLACE, 8, written=True),))
READING = replace(PIPELINE, buffers=(BufferSlot(PLACE, 8, written=False),))
SOURCE = """
kernel K {
    work_group of 32
    param n : int in 0..99 = 3
    buffer before : vec3[]
    result after : vec3[n] = before[index]
    result count : float[n] = 1
}
"""


def dispatch(extent: Sides = (1, 1, 1), data: bytes = bytes(8)) -> Dispatch:
    return Dispatch(extent, (), (), (data,))


def kernel_job(pipeline: Pipeline, work_group: Sides, dispatches: Sequence[Dispatch]) -> FrameJob:
    """A step for each dispatch, whose only buffer is the job's own if the kernel writes it."""
    (slot,) = pipeline.buffers
    buffers, steps = [], []
    for number, each in enumerate(dispatches):
        run = FrameDraw(0, (), (OWN,), dispatch=each)
        barriers: tuple[BufferBarrier, ...] = ()
        if slot.written:
            run = FrameDraw(0, (), (number,), dispatch=replace(each, buffers=()))
            barriers = (BufferBarrier(number, "undefined", "written"),)
            buffers.append(FrameBuffer(len(each.buffers[0]) // WORD))
        groups = each.groups(work_group)
        steps.append(
            FrameStep(
                draws=(run,), groups=groups, buffer_barriers=barriers, name=f"dispatch {number}"
            )
        )
    return FrameJob((), tuple(buffers), (pipeline,), tuple(steps))


@pytest.mark.parametrize(
    ("extent", "work_group", "groups"),
    [
        ((0, 1, 1), (64, 1, 1), (0, 1, 1)),
        ((1, 1, 1), (64, 1, 1), (1, 1, 1)),
        ((64, 1, 1), (64, 1, 1), (1, 1, 1)),
        ((65, 1, 1), (64, 1, 1), (2, 1, 1)),
        ((65, 1, 1), (32, 1, 1), (3, 1, 1)),
        ((17, 8, 1), (8, 8, 1), (3, 1, 1)),
        ((16, 9, 2), (8, 8, 1), (2, 2, 2)),
    ],
)
def test_work_groups_cover_all_elements(extent: Sides, work_group: Sides, groups: Sides) -> None:
    assert dispatch(extent).groups(work_group) == groups
    (run,) = kernel_job(PIPELINE, work_group, [dispatch(extent)]).steps
    assert run.groups == groups


def test_more_work_groups_than_a_device_runs_are_refused() -> None:
    def check(extent: Sides, most: Sides, work_group: Sides = (64, 1, 1)) -> None:
        check_groups(kernel_job(PIPELINE, work_group, [dispatch(extent)]), lambda: most)

    most = (65535, 65535, 65535)
    check((64 * 65535, 1, 1), most)
    with pytest.raises(DriverError) as error:
        check((64 * 65535 + 1, 1, 1), most)
    assert str(error.value) == (
        "dispatch 0: 65536 work groups along x, and the device runs at most 65535 at once: "
        "compute fewer elements, or declare larger work groups"
    )
    with pytest.raises(DriverError, match="9 work groups along y"):
        check((1, 65, 1), (8, 8, 8), (8, 8, 1))


@pytest.mark.parametrize("written", [True, False])
def test_buffers_of_another_size_are_refused(written: bool) -> None:
    made = PIPELINE if written else READING
    check_frame(kernel_job(made, (64, 1, 1), [dispatch()]))
    with pytest.raises(DriverError) as error:
        check_frame(kernel_job(made, (64, 1, 1), [dispatch(), dispatch(data=bytes(12))]))
    assert str(error.value) == (
        "dispatch 1: storage buffer 'r' is given 12 bytes, and its elements have 8"
    )


def test_buffers_that_are_missing_are_refused() -> None:
    lacking = Dispatch((1, 1, 1), (), (), ())
    with pytest.raises(DriverError) as error:
        check_frame(kernel_job(READING, (64, 1, 1), [lacking]))
    assert str(error.value) == "dispatch 0: 0 storage buffers are given, and the pipeline has 1"


def bound(kernel: CompiledMaterial) -> Pipeline:
    """The pipeline of a kernel, without its code."""
    return pipeline(kernel.reflection, ROUTES["lavapipe:glsl"], Codes({}))


def elements(kernel: CompiledMaterial, instance: Instance) -> Mapping[str, bytes]:
    """The elements of a kernel's results, if it writes nothing."""
    states = [elements_state(instance)]
    job = states_job(kernel, states, bound(kernel))
    found = Found(buffers=tuple(each.contents for each in job.buffers))
    (there,) = outcomes(job, found, states)
    return there.elements


def test_a_dispatch_is_what_the_reflection_says() -> None:
    (kernel,) = burnish.compile(SOURCE, "glsl:vulkan")
    instance = Instance(kernel.reflection)
    instance.set("before", [(1, 2, 3)])
    made = dispatch_of(instance)
    assert made.extent == (3, 1, 1)
    assert [len(data) for data in made.buffers] == [16, 48, 12]
    assert {name: len(data) for name, data in elements(kernel, instance).items()} == {
        "after": 48, "count": 12,
    }  # fmt: skip
    instance.set("n", 33)
    run = states_job(kernel, [elements_state(instance)], bound(kernel)).steps[0]
    assert run.groups == (2, 1, 1)


def test_results_without_elements_are_bound_with_one_that_nobody_reads() -> None:
    (kernel,) = burnish.compile(SOURCE, "glsl:vulkan")
    instance = Instance(kernel.reflection)
    instance.set("n", 0)
    made = dispatch_of(instance)
    assert [len(data) for data in made.buffers] == [16, 16, 4]
    assert set(elements(kernel, instance).values()) == {b""}


@pytest.mark.parametrize("profile", ["glsl:gl450", "glsl:es310"])
def test_opengl_numbers_storage_buffers_on_their_own(profile: str) -> None:
    """ES 3.1 guarantees four places for them, and uniform blocks take none of these."""
    (kernel,) = burnish.compile(SOURCE, profile)
    backend = kernel.reflection.backends[profile]
    assert [row.binding for row in backend.blocks.values()] == [8]  # behind those of other groups
    assert [row.binding for row in backend.buffers.values()] == [0, 1, 2]
