"""OpenGL's own: what is drawn upside down, llvmpipe's short cuts, and a missing package."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest

from burnish.targets.runner.drivers.draw import DriverError, Job
from burnish.targets.runner.drivers.opengl.driver import OpenGL

from . import textual_shaders as shaders
from .textual_kit import NEAREST, SIZE, full, image, pipeline, read, shoot


@pytest.mark.parametrize("api", ["opengl", "webgl2"])
def test_host_uniforms_are_the_height(api: str) -> None:
    """By which a shader turns ``gl_FragCoord`` the right way up."""
    glsl = shaders.PAINT_GLSL.replace(
        "target = color", "target = vec4(gl_FragCoord.x, height - gl_FragCoord.y, height, 1.0)"
    ).replace("|", "|uniform float height;\n")
    chosen = replace(pipeline(api, glsl), host_uniforms=("height",))
    picture = shoot(api, Job(chosen, (replace(full((0, 0, 0, 0)), height=2 * SIZE),)))
    assert (picture[..., 0] == np.arange(SIZE) + 0.5).all()
    assert (picture[..., 1] == np.arange(2 * SIZE)[:, None] + 0.5).all()
    assert (picture[..., 2] == 2 * SIZE).all()


@pytest.mark.parametrize("api", ["opengl", "webgl2"])
def test_uniform_that_the_job_lacks(api: str) -> None:
    glsl = shaders.PAINT_GLSL.replace("target = color", "target = color * height").replace(
        "|", "|uniform float height;\n"
    )
    with pytest.raises(DriverError, match="'height', which the job does not have"):
        shoot(api, Job(pipeline(api, glsl), (full((1, 1, 1, 1)),)))


def test_bytes_are_filtered_as_floats() -> None:
    """Which llvmpipe does only when asked: its short cut is 0.004 off."""
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
