"""Devices that are lost: the job that notices it fails, and the next one is drawn again."""

from __future__ import annotations

import gc

import pytest

from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.opengl.driver import OpenGL
from burnish.targets.runner.drivers.opengl.frame import NO_ERROR
from burnish.targets.runner.drivers.opengl.renderer import Renderer
from burnish.targets.runner.drivers.wgpu.driver import Wgpu

from .frame_kit import back, job, texture


@pytest.fixture(name="cleared")
def cleared_texture() -> FrameJob:
    """A job that only reads a texture back."""
    return job([texture()], [], back(0))


def test_wgpu_opens_its_device_again(cleared: FrameJob) -> None:
    driver = Wgpu()
    expected = driver.draw_frame(cleared)
    assert driver._gpu is not None
    driver._gpu.device.destroy()
    with pytest.raises(DriverError, match="Parent device is lost"):
        driver.draw_frame(cleared)
    assert driver.draw_frame(cleared) == expected


def test_opengl_makes_its_context_again(cleared: FrameJob, monkeypatch: pytest.MonkeyPatch) -> None:
    """OpenGL tells no program that did not ask for it that a context is lost: it reports errors."""
    driver = OpenGL()
    expected = driver.draw_frame(cleared)
    lost = driver._renderer
    assert lost is not None
    monkeypatch.setattr(lost, "_functions", _Failing(lost._functions))
    with pytest.raises(DriverError) as error:
        driver.draw_frame(cleared)
    assert str(error.value) == "OpenGL reports GL_INVALID_ENUM"
    assert driver.draw_frame(cleared) == expected
    assert driver._renderer is not lost


def test_what_is_left_of_a_lost_context_does_no_harm() -> None:
    """Python drops it whenever it likes, and numbers of objects are the same in each context."""
    lost = Renderer(None)
    left = [lost._context.buffer(b"lost") for _ in range(8)]
    lost.release()
    renderer = Renderer(None)
    kept = [renderer._context.buffer(b"kept") for _ in range(8)]
    assert {each.glo for each in left} & {each.glo for each in kept}
    del left
    gc.collect()
    assert [each.read() for each in kept] == [b"kept"] * 8
    assert renderer._context.error == NO_ERROR
    renderer.release()


class _Failing:
    """OpenGL's functions, after a call that OpenGL refuses."""

    def __init__(self, functions: object) -> None:
        self._functions = functions

    def __getattr__(self, name: str) -> object:
        find = self._functions.__getattr__  # type: ignore[attr-defined]
        find("glEnable")(0xFFFF)
        return find(name)
