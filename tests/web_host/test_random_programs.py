"""Random programs, drawn as packages of frames of one step, and as jobs.

Both draw the same text with the same renderer of the host. So their pictures are equal to the last
bit, if the host fills blocks, makes geometries and binds as Python's runtime does.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.compiler.documents.plan import DrawStep
from burnish.targets.conformance.sample import sample_buffers, sample_textures, sample_values
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.single import single_frame, single_scenery
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.frames.step_draws import StepDraws
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain
from burnish.targets.web_host.drawing import draw_frames

from ..fuzz.programs import program

ROUTE = ROUTES["chromium:webgpu"]
SIZE = (16, 12)
PROGRAMS = 8
SEED = "host"


@pytest.fixture(scope="module")
def runner() -> Iterator[Runner]:
    with Runner([ROUTE], reuse=False) as opened:
        yield opened


def materials() -> Iterator[tuple[int, CompiledMaterial]]:
    """Some that draw pictures."""
    found, number = 0, 0
    while found < PROGRAMS:
        number += 1
        try:
            result = burnish.compile(str(program(f"{SEED}:{number}")), ("wgsl",), partial=True)
        except burnish.CompileError:
            continue
        material = result.materials[-1]
        reflection = material.reflection
        if reflection.capture is None and reflection.extent is None:
            found += 1
            yield number, material


def test_random_programs_draw_as_jobs_do(runner: Runner) -> None:
    covered = 0
    with Toolchain() as toolchain:
        for number, material in materials():
            frame = single_frame(material)
            host = FrameHost(frame, single_scenery(frame, "cube", 3), SIZE)
            for instance in (host.instances[0], host.values):
                sample_values(instance, number, missing=instance is host.values)
                sample_buffers(instance, number)
                sample_textures(instance, number)
            (step,) = host.plan.steps
            assert isinstance(step, DrawStep)
            (drawn,) = StepDraws(host).of(step, is_first=True)
            codes = compile_one(ROUTE, material.files, toolchain)
            made = pipeline(material.reflection, ROUTE, codes)
            (wanted,) = draw_states(material, [drawn.state], ROUTE, made, runner)
            (found,) = draw_frames(host, ROUTE, runner, toolchain)
            for (name, texels), target in zip(found.items(), wanted.pictures, strict=True):
                rows = texels.reshape(-1, *texels.shape[2:])
                assert np.array_equal(rows, target, equal_nan=True), f"{SEED}:{number}, {name}"
                covered += int(np.ptp(rows) > 0)
    assert covered >= PROGRAMS // 2
