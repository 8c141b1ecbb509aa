"""Errors that are planted in the drivers which execute frames: each is refused, or shows."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

import burnish
from burnish.targets.conformance.frames import FrameTrial
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.routes import ROUTES, DriverRow
from burnish.targets.runner.runner import Runner

from .kit import Studio

SIZE = (8, 8)
FRAME = """
import std.frames.{FullScreen}
pass Filled : FullScreen blend add { target value : rgba16f = vec4(uv, 0.5, 1) }
pass Wide : FullScreen {
    depth { compare = always, write = true }
    target value : rgba32f = vec4(1, uv, 1)
}
pass Faced : FullScreen {
    param face : float
    target value : rgba8 = vec4(face / 8, uv, 1)
}
pass Joined : FullScreen {
    map first : texture2d with { filter = nearest, mip = none }
    map cube  : texture_cube with { filter = nearest, mip = none }
    target value : rgba8 = first.load(ivec2(frag_coord.xy)) / 4 + cube.level(vec3(0, 0, -1), 0) / 4
}
pass Last : FullScreen {
    map joined : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = joined.load(ivec2(frag_coord.xy)) - vec4(uv, 0, 0)
}
frame F {
    wide   = Wide(screen)
    mid    = Last(screen) with { joined = wide.value }
    one    = Filled(screen) with { clear.value = vec4(0.25) }
    two    = Filled(screen, one)
    sky    = each face in cube : Faced(screen, 4) with { face = float(face) }
    joined = Joined(screen) with { first = mid.value, cube = sky.value }
    last   = Last(screen) with { joined = joined.value }
    output value = last.value
    output before = one.value
    output after = two.value
}
"""


@dataclass(frozen=True)
class Error:
    """A text of a module of a driver, and what it is instead."""

    route: str
    module: str
    before: str
    after: str

    def __str__(self) -> str:
        return f"{self.module}: {self.after}"


VULKAN, OPENGL = "lavapipe:glsl", "llvmpipe:gl450"
FRAMES, TEXTURES = "vulkan.frame", "vulkan.frame_textures"
PASSES, UPLOADS = "vulkan.render_passes", "vulkan.uploads"
READ = "textures[number].view"
SHARED = "return vk.VK_ACCESS_MEMORY_WRITE_BIT if is_shared else 0"
BEFORE = 'srcAccessMask=self._writes if before == "undefined" else USES[before].access'
BOUND = "self._textures[number] for number in drawn.textures"
ERRORS = [
    Error(VULKAN, PASSES, "loadOp=_LOADS[attachment.loads]", "loadOp=_LOADS[False]"),
    Error(VULKAN, FRAMES, "record(commands, self._textures, step.barriers)", "pass"),
    Error(VULKAN, UPLOADS, f"else {READ}", "else textures[0].view"),
    Error(VULKAN, PASSES, "float32=list(attachment.clear)", "float32=[0.0] * 4"),
    Error(VULKAN, TEXTURES, SHARED, "return 0"),
    Error(VULKAN, TEXTURES, BEFORE, "srcAccessMask=0"),
    Error(VULKAN, FRAMES, "_wait_for_host(commands)\n        self", "self"),
    Error(OPENGL, "opengl.frame", "if not target.loads", "if True"),
    Error(OPENGL, "opengl.frame", f"else {BOUND}", f"else {BOUND.replace('number]', '0]', 1)}"),
    Error(OPENGL, "opengl.frame_textures", "at.level, at.layer", "0, 0"),
]


def _agrees(studio: Studio, name: str) -> bool:
    """True if all results of the frame on a route agree with their meaning."""
    route = ROUTES[name]
    (frame,) = burnish.compile(FRAME, (route.profile,)).frames
    # A store would hand back what the driver without the error has drawn.
    with Runner([route], reuse=False) as runner:
        drawn = FrameTrial("F", frame, SIZE)
        results = drawn.results(route, runner.device(route), runner, studio.toolchain)
        return not any(result.comparison.wrong for result in results)


@pytest.mark.parametrize("route", [VULKAN, OPENGL])
def test_without_errors_it_agrees(studio: Studio, route: str) -> None:
    assert _agrees(studio, route)


@pytest.mark.parametrize("error", ERRORS, ids=str)
def test_errors_are_found(studio: Studio, error: Error, monkeypatch: pytest.MonkeyPatch) -> None:
    own = DriverRow.command

    def command(row: DriverRow, *arguments: object) -> list[str]:
        python, flags, launcher, folders, module, *more = own(row, *arguments)  # type: ignore[arg-type]
        wrong = f"burnish.targets.runner.drivers.{error.module}"
        planted = "burnish.tests.conformance.planted.driver"
        start = [python, flags, launcher, folders, planted]
        return [*start, module, wrong, error.before, error.after, *more]

    monkeypatch.setattr(DriverRow, "command", command)
    try:
        assert not _agrees(studio, error.route)
    except DriverError as refused:
        assert "does not say" not in str(refused)
