"""The jobs of single shaders in several states, and what they share."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.targets.conformance.cases import UNCOVERED
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import Codes
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.pipeline import Code
from burnish.targets.runner.frames.by_route import frame_job
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.frames.states import states_job
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.kernels import full_screen_state
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import SceneState, set_up

KERNEL = """
kernel K {
    param size : int in 1..64 = 8
    param shade : float = 0
    result made : image2d<rgba8>[ivec2(size, 4)] = vec4(shade)
}
"""
LAYERED = """
material M { map picture : texture2d, color = picture(uv).rgb }
pass P {
    layers of 5
    layer : int
    target one : rgba32f = vec4(uv, float(layer), 1)
    expand triangle { list of 3 as i { layer = int(primitive_index mod 5u) } }
}
"""
KEPT = """
kernel Begun { result after : vec2[64] = vec2(0.5) }
kernel Moved {
    buffer before : vec2[]
    result after : vec2[before.count] = before[index] + vec2(0.01, 0)
}
frame Swarm {
    begun = Begun()
    moved = Moved() with { before = previous(moved.after, begun.after) }
    output places = moved.after
    output others = begun.after
}
"""


def codes(shader: CompiledMaterial) -> Codes:
    """Texts that nobody reads."""
    found = {
        stage: Code(name) for file in shader.files for stage, name in file.entry_points.items()
    }
    return Codes(found)


def job_of(kernel: CompiledMaterial, route: str, sizes: list[int]) -> FrameJob:
    """The job that runs a kernel for each of these widths of its image."""
    bound = pipeline(kernel.reflection, ROUTES[route], codes(kernel))
    states = []
    for size in sizes:
        instance = Instance(kernel.reflection)
        instance.set("size", size)
        states.append(full_screen_state(instance, UNCOVERED))
    return states_job(kernel, states, bound)


def test_images_that_a_route_draws_are_cleared_as_the_state_says() -> None:
    """A texel that the pass leaves out is none that a kernel has written."""
    (kernel,) = burnish.compile(KERNEL, "glsl:gl330")
    job = job_of(kernel, "llvmpipe:gl330", [8, 8, 16])
    targets = [target for step in job.steps for target in step.targets]
    assert [target.clear for target in targets] == [UNCOVERED] * 3
    assert [target.loads for target in targets] == [False] * 3
    assert [(made.width, made.height) for made in job.textures] == [(8, 4), (16, 4)]


def test_each_run_of_a_kernel_writes_to_images_that_start_black() -> None:
    (kernel,) = burnish.compile(KERNEL, "glsl:vulkan")
    job = job_of(kernel, "lavapipe:glsl", [8, 8, 16])
    written = [step.images for step in job.steps if step.images]
    assert written == [(0,), (1,), (2,)]
    assert all(made.is_black for made in job.textures)
    assert [step.read for step in job.steps if step.read] == [(0,), (1,), (2,)]


def layered_state(material: CompiledMaterial) -> SceneState:
    return set_up(material.instance(), plane(2), Scene(), (8, 8))


def test_layers_share_all_but_their_blocks() -> None:
    (material,) = burnish.compile(LAYERED, "glsl:vulkan", pass_="P")
    state = layered_state(material)
    draws = state.draws()
    assert len(draws) == 5
    for layer, draw in zip(state.layers, draws, strict=True):
        assert draw == layer.draw()
        assert draw.vertices is draws[0].vertices
        assert draw.textures is draws[0].textures
    assert len({draw.blocks for draw in draws}) == 5


def test_a_state_without_layers_is_one_draw() -> None:
    (material,) = burnish.compile("material M { color = vec3(uv, 0) }", "glsl:vulkan")
    state = set_up(material.instance(), plane(2), Scene(), (8, 8))
    assert state.draws() == (state.draw(),)
    assert np.array_equal(state.triangles, layered_state(material).triangles)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_buffer_that_the_next_frame_reads_is_read_back(count: int) -> None:
    """It is that of the frame's own run of the kernel, wherever the exchange has put it."""
    (frame,) = burnish.compile(KEPT, "glsl:vulkan").frames
    host = FrameHost(frame, in_a_row([], {}, "cube"), (8, 8))
    texts = [codes(shader) for shader in frame.shaders]
    job = frame_job(host, ROUTES["lavapipe:glsl"], texts, ["places", "others"], count)
    written = [step.draws[0].buffers[-1] for step in job.steps if step.draws]
    read = [step.read_buffers for step in job.steps if step.read_buffers]
    assert read == list(zip(written[1::2], written[::2], strict=True))
    assert len(read) == count
