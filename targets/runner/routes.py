"""The routes by which a material is drawn here: an emitted text, a compiler, a driver.

Direct3D is not among them, because nothing here runs it; its texts are drawn on Vulkan, and DXC
compiles them to DXIL, which is not drawn.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from itertools import chain

from ...compiler.diagnostics.nearest import suggestion
from ..toolchain.checkers import CHECKERS
from ..toolchain.tools import ToolState, inspect_all, tool_named


@dataclass(frozen=True, slots=True)
class DriverRow:
    """What draws, and the worker process that it is driven from."""

    name: str
    title: str
    module: str
    """The worker's: ``python -m MODULE ARGUMENTS…``."""
    needs: tuple[str, ...]
    """Names of tools, all of which it needs."""
    arguments: tuple[str, ...] = ()
    """Of the worker; ``{name}`` becomes the path of that tool's first file."""
    one_worker: bool = False
    """Whether one process is enough, because it is slow to start and draws on all cores anyway."""

    def command(self, states: Mapping[str, ToolState]) -> list[str]:
        """What starts a worker, where ``states`` have all the tools that it needs."""
        paths = {name: state.paths[0] for name, state in states.items() if state.paths}
        arguments = (argument.format_map(paths) for argument in self.arguments)
        return [sys.executable, "-m", f"{_PACKAGE}.drivers.{self.module}", *arguments]


@dataclass(frozen=True, slots=True)
class Route:
    """One way from a material to a picture."""

    name: str
    """``lavapipe:glsl``: the driver and the way to it."""
    title: str
    profile: str
    """The text that is drawn: ``glsl:vulkan``."""
    driver: str
    """A key of ``DRIVERS``."""
    compiler: str | None = None
    """The key in ``CHECKERS`` of what makes SPIR-V of it; None where the driver takes the text."""
    flags: tuple[str, ...] = ()
    """What the compiler has to be told besides."""

    @property
    def needs(self) -> tuple[str, ...]:
        """Names of tools, all of which it needs."""
        compiler = CHECKERS[self.compiler].needs if self.compiler else ()
        return (*compiler, *DRIVERS[self.driver].needs, *_EVERYTHING)


@dataclass(frozen=True, slots=True)
class _Way:
    """A way to any Vulkan driver."""

    name: str
    title: str
    profile: str
    compiler: str
    flags: tuple[str, ...] = ()


_PACKAGE = __name__.rpartition(".")[0]
_EVERYTHING = ("numpy", "pillow")
"""What drawing needs on every route, for meshes and textures."""
_VULKAN = ("vulkan", "vulkan-validation")

DRIVERS: Mapping[str, DriverRow] = {
    row.name: row
    for row in (
        DriverRow(
            "lavapipe", "Vulkan on Mesa's lavapipe", "vulkan",
            ("lavapipe", *_VULKAN), ("{lavapipe}",),
        ),
        DriverRow(
            "swiftshader", "Vulkan on SwiftShader", "vulkan",
            ("swiftshader", *_VULKAN), ("{swiftshader}",),
        ),
        DriverRow("llvmpipe", "OpenGL on Mesa's llvmpipe", "opengl", ("llvmpipe", "moderngl")),
        DriverRow(
            "webgpu", "WebGPU in Chromium, on SwiftShader", "browser",
            ("chromium", "playwright"), ("webgpu",), one_worker=True,
        ),
        DriverRow(
            "webgl2", "WebGL 2 in Chromium, on SwiftShader", "browser",
            ("chromium", "playwright"), ("webgl2",), one_worker=True,
        ),
    )
}  # fmt: skip

# HLSL text means Direct3D, where SV_Position.w is the reciprocal of Vulkan's: both compilers have
# to be told. DXC lays blocks out by Direct3D's rules, too, if it is asked to. naga's command line
# turns the picture over unless it is told not to.
_TO_VULKAN = (
    _Way("glsl", "GLSL by glslang", "glsl:vulkan", "glslang-vulkan"),
    _Way("hlsl-glslang", "HLSL by glslang", "hlsl:sm6", "glslang-hlsl", ("--hlsl-dx-position-w",)),
    _Way(
        "hlsl-dxc", "HLSL by DXC", "hlsl:sm6", "dxc-spirv",
        ("-fvk-use-dx-position-w", "-fvk-use-dx-layout"),
    ),
    _Way("wgsl-naga", "WGSL by naga", "wgsl:webgpu", "naga", ("--keep-coordinate-space",)),
)  # fmt: skip

ROUTES: Mapping[str, Route] = {
    route.name: route
    for route in (
        *(
            Route(
                f"{driver}:{way.name}", f"{way.title}, {DRIVERS[driver].title}",
                way.profile, driver, way.compiler, way.flags,
            )
            for driver in ("lavapipe", "swiftshader")
            for way in _TO_VULKAN
        ),
        Route(
            "llvmpipe:gl330", f"GLSL 3.30, {DRIVERS['llvmpipe'].title}",
            "glsl:gl330", "llvmpipe",
        ),
        Route(
            "chromium:webgpu", f"WGSL, {DRIVERS['webgpu'].title}",
            "wgsl:webgpu", "webgpu",
        ),
        Route(
            "chromium:webgl2", f"GLSL ES 3.00, {DRIVERS['webgl2'].title}",
            "glsl:es300", "webgl2",
        ),
    )
}  # fmt: skip

ALL = "all"


class UnknownRouteError(ValueError):
    """Somebody asked for a route that there is not; the text names the nearest."""


def select(names: Iterable[str]) -> tuple[Route, ...]:
    """The routes that people mean, in the order of the table and none twice.

    A name is a route's, or either half of one, for all that have it (``lavapipe``, ``hlsl-dxc``),
    or a pattern with ``*``, or ``all``; or several of them with commas. Raises
    ``UnknownRouteError``.
    """
    wanted = [part.strip() for name in names for part in name.split(",")]
    chosen = set(chain.from_iterable(_meant(name) for name in wanted if name))
    return tuple(route for name, route in ROUTES.items() if name in chosen)


def _meant(name: str) -> list[str]:
    found = [
        route for route in ROUTES
        if name == ALL or any(fnmatchcase(part, name) for part in (route, *route.split(":")))
    ]  # fmt: skip
    if not found:
        halves = chain.from_iterable(route.split(":") for route in ROUTES)
        known = (*ROUTES, *halves, ALL)
        hint = suggestion(name, known) or f"there are {', '.join(ROUTES)}, and all"
        raise UnknownRouteError(f"there is no route `{name}`; {hint}")
    return found


def inspect_tools(routes: Iterable[Route]) -> dict[str, ToolState]:
    """What is known of all the tools that some routes need, by name; asks each for its version."""
    needed = dict.fromkeys(chain.from_iterable(route.needs for route in routes))
    return inspect_all(tool_named(name) for name in needed)


def problem(route: Route, states: Mapping[str, ToolState]) -> str | None:
    """Why a route cannot be drawn, tool by tool; None when it can."""
    problems = (states[name].problem for name in route.needs)
    return "; ".join(text for text in problems if text) or None


def versions(route: Route, states: Mapping[str, ToolState]) -> dict[str, str]:
    """The versions of a route's tools, as far as they are known."""
    found = {name: states[name].version for name in route.needs}
    return {name: version for name, version in found.items() if version}


def routes_needing(tool: str) -> tuple[str, ...]:
    """The names of the routes that cannot be drawn without a tool."""
    return tuple(name for name, route in ROUTES.items() if tool in route.needs)
