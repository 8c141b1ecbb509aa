"""Draws frames by any route: with frame jobs, or in a browser with the host for web pages.

``render`` and ``conform`` call ``draw_frames``.
"""

from __future__ import annotations

from ..runner.drivers.readback import layers_of
from ..runner.frames import by_route
from ..runner.frames.by_route import Floats
from ..runner.frames.counting import check_memory
from ..runner.frames.host import FrameHost
from ..runner.routes import EVERY_DRIVER, Route
from ..runner.runner import Runner
from ..toolchain import Toolchain
from .package import frame_package


def draw_frames(
    host: FrameHost, route: Route, runner: Runner, toolchain: Toolchain, count: int = 1
) -> list[dict[str, Floats]]:
    """The outputs of some frames, by name, with their top rows first: (layers, height, width, 4).

    Raises ``CodeError`` if a compiler refuses a text, ``DriverError``, and ``BudgetError`` for
    what takes too much memory.
    """
    check_memory(host, count)
    if EVERY_DRIVER[route.driver].draws_packages:
        return _by_package(host, route, runner, count)
    return by_route.draw_frames(host, route, runner, toolchain, count)


def _by_package(
    host: FrameHost, route: Route, runner: Runner, count: int
) -> list[dict[str, Floats]]:
    names = [row.name for row in host.plan.outputs if row.texture is not None]
    package = frame_package(host, [route.profile])
    found = iter(runner.draw_package(route, package, names, count))
    return [{name: layers_of(next(found)) for name in names} for _ in range(count)]
