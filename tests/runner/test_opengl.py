"""OpenGL's own: what is drawn upside down, llvmpipe's short cuts, and a missing package."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.opengl.driver import OpenGL
from burnish.targets.runner.drivers.pipeline import Code
from burnish.targets.runner.drivers.slots import BlockSlot

from . import textual_shaders as shaders
from .jobs_kit import draw_job
from .textual_kit import NEAREST, SIZE, Floats, floats, full, image, pipeline, place, read, shoot


@pytest.mark.parametrize("api", ["opengl", "webgl2"])
def test_host_uniforms_are_the_height(api: str) -> None:
    """A shader needs the height to turn ``gl_FragCoord`` the right way up."""
    glsl = shaders.PAINT_GLSL.replace(
        "target = color", "target = vec4(gl_FragCoord.x, height - gl_FragCoord.y, height, 1.0)"
    ).replace("|", "|uniform float height;\n")
    chosen = replace(pipeline(api, glsl), host_uniforms=("height",))
    picture = shoot(api, draw_job(chosen, (replace(full((0, 0, 0, 0)), height=2 * SIZE),)))
    assert (picture[..., 0] == np.arange(SIZE) + 0.5).all()
    assert (picture[..., 1] == np.arange(2 * SIZE)[:, None] + 0.5).all()
    assert (picture[..., 2] == 2 * SIZE).all()


@pytest.mark.parametrize("api", ["opengl", "webgl2"])
def test_uniform_that_the_job_lacks(api: str) -> None:
    glsl = shaders.PAINT_GLSL.replace("target = color", "target = color * height").replace(
        "|", "|uniform float height;\n"
    )
    with pytest.raises(DriverError, match=r"'height', which .* does not have"):
        shoot(api, draw_job(pipeline(api, glsl), (full((1, 1, 1, 1)),)))


PLACED = """#version 450 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 paint;
void main() { gl_Position = vec4(place, 1.0); }
|#version 450 core
layout(std140, binding = 5) uniform Tint { vec4 tint; };
layout(binding = 3) uniform sampler2D image;
layout(location = 0) out vec4 target;
void main() { target = tint + texture(image, vec2(0.5)) + vec4(gl_FragCoord.zzzz); }
"""


def _placed(block: int, texture: int, **options: Any) -> Floats:
    """The picture of a text that binds a block and a texture itself, if given these bindings."""
    vertex, fragment = PLACED.split("|")
    chosen = replace(
        pipeline("opengl"),
        stages={"vertex": Code("main", vertex), "fragment": Code("main", fragment)},
        blocks=(BlockSlot(place("Tint", 0, block), 16),),
        textures=(replace(NEAREST, texture=place("image", 0, texture)),),
        **options,
    )
    half = image(np.full((1, 1, 4), 0.5, np.float32))
    drawn = replace(full((0, 0, 0, 0)), blocks=(floats((1, 2, 3, 4)),), textures=(half,))
    return shoot("opengl", draw_job(chosen, (drawn,)))


def test_a_text_may_bind_blocks_and_textures_itself() -> None:
    assert (_placed(5, 3) == np.array((1, 2, 3, 4)) + 0.5 + 0.75).all()
    assert (_placed(4, 3) != _placed(5, 3)).any()
    assert (_placed(5, 2) != _placed(5, 3)).any()


def test_clip_space_is_that_of_the_pipeline_and_not_of_the_one_before() -> None:
    """The middle between 0 and 1 is at three quarters of the way from -1 to 1."""
    own = _placed(5, 3)
    told = _placed(5, 3, clip_control=("GL_UPPER_LEFT", "GL_ZERO_TO_ONE"), first_row="top")
    assert (own - told == 0.25).all()
    assert (_placed(5, 3) == own).all()


def test_bytes_are_filtered_as_floats() -> None:
    """llvmpipe does this only when it is asked: its short cut is off by 0.004."""
    texels = np.array([[[0, 0, 0, 0], [255, 1, 128, 3]]], np.uint8).repeat(2, 0)
    shown = read("opengl", replace(NEAREST, filter="linear"), image(texels), (0, 1))
    weights = np.clip((np.arange(SIZE) + 0.5) / SIZE * 2 - 0.5, 0, 1)[:, None]
    expected = np.broadcast_to(weights * texels[0, 1] / 255, shown.shape)
    np.testing.assert_allclose(shown, expected, atol=1e-6)


def test_missing_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "moderngl", None)
    for name in [name for name in sys.modules if ".drivers.opengl." in name]:
        monkeypatch.delitem(sys.modules, name)
    with pytest.raises(DriverError, match=r"moderngl.*to install it: .*pip install"):
        OpenGL().device()
