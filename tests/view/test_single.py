"""Single materials as frames: the plan is one by the schema, and draws what the material draws."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish.compiler.documents.plan import FramePlan, SizeRow, WrittenBuffer
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.writing import to_json
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.checking import PlanError
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.single import single_frame, single_scenery
from burnish.targets.runner.frames.single_plan import SIZE
from burnish.targets.runner.meshes import MESHES
from burnish.targets.runner.reference import expected
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import set_up

EXAMPLES = Path(__file__).parents[2] / "examples"
WIDTH, HEIGHT = 24, 16


@pytest.mark.parametrize("name", ["plastic", "sprites", "cube_map"])
def test_it_draws_the_same(name: str) -> None:
    """Lights of a rig, a parameter called `size`, and layers."""
    material = burnish.compile(EXAMPLES / f"{name}.burnish", ("wgsl",)).materials[0]
    frame = single_frame(material)
    assert read(FramePlan, json.loads(json.dumps(to_json(frame.plan)))) == frame.plan

    host = FrameHost(frame, single_scenery(frame, "sphere", 2), (WIDTH, HEIGHT))
    assert host.values.get(SIZE) == (WIDTH, HEIGHT)
    drawing = ReferenceFrames(host)
    drawing.draw()
    found = drawing.output(material.reflection.targets[0].name).levels[0][0]

    mesh = with_inputs(material.reflection, MESHES["sphere"](), 2)
    state = set_up(material.instance(), mesh, Scene(), (WIDTH, HEIGHT))
    wanted, *_others = expected(material.shader, state, RasterRules(WIDTH, HEIGHT)).targets
    layers = wanted if wanted.ndim == 4 else wanted[np.newaxis]
    assert found.shape == layers.shape
    assert np.abs(found - layers).max() <= 1 / 255  # One of them is rounded to the format.
    assert len(np.unique(found)) > 10


def test_a_kernel_over_images_is_run() -> None:
    (kernel,) = burnish.compile(EXAMPLES / "ray_tracer.burnish", ("wgsl",)).materials
    plan = single_frame(kernel).plan
    assert [step.kind for step in plan.steps] == ["run"]
    assert plan.textures[0].size == SizeRow(value=None, extent_of="shown", level=0)
    assert plan.models == ()


def test_a_kernel_over_buffers_is_run() -> None:
    """Each of its results is an output that is a buffer."""
    kernel = burnish.compile(EXAMPLES / "cloth.burnish", ("wgsl",))["Hung"]
    plan = single_frame(kernel).plan
    (step,) = plan.steps
    assert step.buffers == (
        WrittenBuffer(name="now", result="shown.now"),
        WrittenBuffer(name="before", result="shown.before"),
    )
    assert [(row.name, row.texture) for row in plan.outputs] == [
        ("now", None), ("before", None),
    ]  # fmt: skip
    assert plan.textures == ()


def test_what_leaves_nothing_has_no_frame() -> None:
    """A stream output leaves its vertices in no result."""
    file = EXAMPLES / "particles.burnish"
    step = burnish.compile(file, ("glsl:vulkan",), pass_="Step", native_stages=True).materials[0]
    with pytest.raises(PlanError, match="Sparks draws no picture"):
        single_frame(step)


def test_a_target_called_depth_is_beside_the_depths() -> None:
    source = """
        material Half { color = #ffffff }
        pass Both : Forward { target depth : r32f = 0.5 }
    """
    material = burnish.compile(source, ("wgsl",), pass_="Both").materials[0]
    frame = single_frame(material)
    drawing = ReferenceFrames(FrameHost(frame, single_scenery(frame, "sphere", 1), (8, 8)))
    drawing.draw()
    assert drawing.output("depth").levels[0][0, 0, 4, 4, 0] == 0.5


def test_lights_have_the_names_by_which_they_are_set() -> None:
    """A parameter of the material has the name of a light of the rig."""
    source = """
        import std.lights.{Point}
        import std.terms.{lambert}
        material Wall { param lamp : float = 1  color = lambert(vec3(lamp)) }
        rig Street { lamp : Point }
    """
    material = burnish.compile(source, ("wgsl",)).materials[0]
    frame = single_frame(material)
    host = FrameHost(frame, single_scenery(frame, "sphere", 1), (8, 8))
    host.set_text("Street.lamp.diffuse_color", "1,0,0")
    host.set_text("lamp", "0.5")
    drawing = ReferenceFrames(host)
    drawing.draw()
    pixels = drawing.output("color").levels[0][0, 0]
    assert pixels[..., 0].max() > 0
    assert pixels[..., 1].max() == 0
