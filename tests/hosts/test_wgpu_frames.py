"""The host of frames for wgpu that bindings in Python bring: kernels, and what a frame keeps."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np
import wgpu

import burnish
from burnish.targets.runner.frames.by_route import draw_frames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import Scenery
from burnish.targets.runner.pictures import to_image
from burnish.targets.toolchain import Toolchain

from .expecting import APART, ROUTE, runner
from .projects import HOSTS

REACTION = HOSTS.parent / "frames" / "reaction.burnish"
SIZE = (64, 64)
COUNT = 3


def test_a_frame_of_kernels_goes_on_from_the_last_one() -> None:
    module: Any = ModuleType("reaction")
    exec(burnish.bind(REACTION, "python", "wgsl", embed=True), module.__dict__)

    class Host(module.WgpuFrameHost):  # type: ignore[misc]  # what it is made of is text
        def models(self, _tag: str) -> list[Any]:
            return []

        def material(self, _model: Any) -> str:
            raise AssertionError("there are no models")

        def set_blocks(self, _blocks: Any, model: Any) -> None:
            assert model is None

        def draw_mesh(self, _drawing: Any, _shader: Any, _model: Any) -> None:
            raise AssertionError("there are no models")

    host = Host(wgpu.gpu.request_adapter_sync().request_device_sync())
    for _ in range(COUNT):
        module.draw_reaction(host, module.ReactionParameters(size=SIZE))
    texture = host.output("picture")
    layout = {"bytes_per_row": 4 * SIZE[0], "rows_per_image": SIZE[1]}
    data = host.device.queue.read_texture({"texture": texture}, layout, (*SIZE, 1))
    found = np.frombuffer(data, np.uint8).reshape(*SIZE, 4)[..., :3]

    (frame,) = burnish.compile(REACTION, (ROUTE.profile,)).frames
    with runner() as drawing, Toolchain() as toolchain:
        own = FrameHost(frame, Scenery(()), SIZE)
        *_, last = draw_frames(own, ROUTE, drawing, toolchain, COUNT)
    wanted = np.array(to_image(last["picture"][0]))
    assert len(np.unique(wanted)) > 10
    assert np.abs(found.astype(int) - wanted).max() <= APART
