"""Jobs of kernels: how many work groups run, and what is refused before a driver sees it."""

from __future__ import annotations

from dataclasses import replace

import pytest

import burnish
from burnish.targets.runner.drivers.checks import check_groups
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.draws import Dispatch, Sides
from burnish.targets.runner.drivers.frame_checks import check_frame
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.drivers.slots import BufferSlot, Place
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.kernels import dispatch_of, elements_of, job_of
from burnish.targets.runner.pipeline_jobs import Written, kernel_job

PLACE = Place("r", 0, 0)
PIPELINE = Pipeline({}, (), (), (), (), buffers=(BufferSlot(PLACE, 4, written=True),))
READING = replace(PIPELINE, buffers=(BufferSlot(PLACE, 4, written=False),))
SOURCE = """
kernel K {
    work_group of 32
    param n : int in 0..99 = 3
    buffer before : vec3[]
    result after : vec3[n] = before[index]
    result count : float[n] = 1
}
"""


def dispatch(extent: Sides = (1, 1, 1), data: bytes = bytes(4)) -> Dispatch:
    return Dispatch(extent, (), (), (data,))


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
    run, _ = kernel_job(PIPELINE, work_group, [dispatch(extent)]).steps
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
    pipeline = PIPELINE if written else READING
    check_frame(kernel_job(pipeline, (64, 1, 1), [dispatch()]))
    with pytest.raises(DriverError) as error:
        check_frame(kernel_job(pipeline, (64, 1, 1), [dispatch(), dispatch(data=bytes(6))]))
    assert str(error.value) == (
        "dispatch 1: storage buffer 'r' is given 6 bytes, and its elements have 4"
    )


def test_buffers_that_are_missing_are_refused() -> None:
    (run, read) = kernel_job(READING, (64, 1, 1), [dispatch()]).steps
    (drawn,) = run.draws
    lacking = replace(run, draws=(replace(drawn, dispatch=Dispatch((1, 1, 1), (), (), ())),))
    with pytest.raises(DriverError) as error:
        check_frame(FrameJob((), (), (READING,), (lacking, read)))
    assert str(error.value) == "dispatch 0: 0 storage buffers are given, and the pipeline has 1"


def test_a_dispatch_is_what_the_reflection_says() -> None:
    (kernel,) = burnish.compile(SOURCE, "glsl:vulkan")
    instance = Instance(kernel.reflection)
    instance.set("before", [(1, 2, 3)])
    made = dispatch_of(instance)
    assert made.extent == (3, 1, 1)
    assert [len(data) for data in made.buffers] == [16, 48, 12]
    instance.set("n", 33)
    made = replace(dispatch_of(instance), buffers=(bytes(4),))
    run, _ = job_of(kernel.reflection, PIPELINE, [made]).steps
    assert run.groups == (2, 1, 1)
    instance.set("n", 3)
    written = Written((bytes(range(48)), bytes(12)))
    found = elements_of(instance, written)
    assert {name: len(data) for name, data in found.items()} == {"after": 48, "count": 12}


def test_results_without_elements_are_bound_with_one_that_nobody_reads() -> None:
    (kernel,) = burnish.compile(SOURCE, "glsl:vulkan")
    instance = Instance(kernel.reflection)
    instance.set("n", 0)
    made = dispatch_of(instance)
    assert [len(data) for data in made.buffers] == [16, 16, 4]
    found = elements_of(instance, Written((bytes(16), bytes(4))))
    assert set(found.values()) == {b""}


@pytest.mark.parametrize("profile", ["glsl:gl450", "glsl:es310"])
def test_opengl_numbers_storage_buffers_on_their_own(profile: str) -> None:
    """ES 3.1 guarantees four places for them, and uniform blocks take none of these."""
    (kernel,) = burnish.compile(SOURCE, profile)
    backend = kernel.reflection.backends[profile]
    assert [row.binding for row in backend.blocks.values()] == [0, 1]
    assert [row.binding for row in backend.buffers.values()] == [0, 1, 2]
