"""The table of routes by which a material can be drawn here: an emitted text, a compiler, a driver.

Direct3D is not among them, because nothing here runs it. Its texts are drawn on Vulkan; DXC also
compiles them to DXIL, which is not drawn.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from itertools import chain

from ...compiler.diagnostics.nearest import suggestion
from ...compiler.ir.stages import VIEW_INDEX
from ...stdlib.builtins.accuracy import Platform
from ...support.installing import install_command
from ..toolchain.checkers import CHECKERS
from ..toolchain.limits import BROWSERS, WORKERS, Limits
from ..toolchain.sources import Extra
from ..toolchain.surroundings import python_worker
from ..toolchain.tools import ToolState, inspect_all, tool_named


@dataclass(frozen=True, slots=True)
class DriverRow:
    """One row: a driver, and the worker process that drives it."""

    name: str
    title: str
    module: str
    """The worker's module, which is run with its ``arguments``."""
    needs: tuple[str, ...]
    """The names of the tools that it needs; all of them are required."""
    arguments: tuple[str, ...] = ()
    """The worker's arguments; ``{name}`` is replaced by the path of that tool's first file."""
    one_worker: bool = False
    """True if one process is enough, because it starts slowly and uses all cores anyway."""
    any_device: bool = False
    """True if the driver draws with any device of the machine, which ``--device`` names."""
    draws_packages: bool = False
    """True if the driver draws frames in a web page, from their packages."""
    limits: Limits = WORKERS
    """Limits of the worker's memory and time."""

    def command(self, states: Mapping[str, ToolState], device: str = "") -> list[str]:
        """The command that starts a worker; ``states`` has all the tools that it needs."""
        paths = {name: state.paths[0] for name, state in states.items() if state.paths}
        arguments = [argument.format_map(paths) for argument in self.arguments]
        if self.any_device:
            arguments.append(device)
        return python_worker(f"{_PACKAGE}.drivers.{self.module}", *arguments)


@dataclass(frozen=True, slots=True)
class Route:
    """One way from a material to a picture."""

    name: str
    """The driver and the way to it: ``lavapipe:glsl``."""
    title: str
    profile: str
    """The profile whose text is drawn: ``glsl:vulkan``."""
    driver: str
    """A key of ``DRIVERS``."""
    compiler: str | None = None
    """A key of ``CHECKERS``, whose compiler makes SPIR-V of the text; ``None`` if the driver takes
    text."""
    flags: tuple[str, ...] = ()
    """Further command-line arguments of the compiler."""
    unknown_inputs: frozenset[str] = frozenset()
    """The values of the pipeline that the compiler does not know, although the language has them,
    as ``PipelineInput.unknown_to`` says."""

    @property
    def platforms(self) -> tuple[Platform, ...]:
        """The specifications that define how accurate the route's pictures are.

        The weakest promise counts: if a text becomes SPIR-V, both the language and Vulkan may lose
        accuracy.
        """
        language = _PLATFORMS[self.profile]
        return tuple({language: None, "vulkan": None} if self.compiler else {language: None})

    @property
    def bottom_up(self) -> bool:
        """True if the picture's lowest row is drawn first."""
        return self.profile in _BOTTOM_UP

    @property
    def needs(self) -> tuple[str, ...]:
        """The names of all tools that it needs."""
        compiler = CHECKERS[self.compiler].needs if self.compiler else ()
        return (*compiler, *EVERY_DRIVER[self.driver].needs, *_EVERYTHING)


@dataclass(frozen=True, slots=True)
class _Way:
    """A text and a compiler by which every Vulkan driver can draw."""

    name: str
    title: str
    profile: str
    compiler: str
    flags: tuple[str, ...] = ()
    unknown_inputs: frozenset[str] = frozenset()


_PLATFORMS: Mapping[str, Platform] = {
    "glsl:vulkan": "vulkan",
    "hlsl:sm6": "direct3d",
    "wgsl:webgpu": "wgsl",
    "glsl:gl330": "opengl",
    "glsl:gl450": "opengl",
    "glsl:es100": "es",
    "glsl:es300": "es",
    "glsl:es310": "es",
}
"""The platform of each profile that is drawn."""
_BOTTOM_UP = frozenset({"glsl:gl330", "glsl:es100", "glsl:es300", "glsl:es310"})
"""The profiles whose rows count upwards."""

_PACKAGE = __name__.rpartition(".")[0]
_EVERYTHING = ("numpy", "pillow")
"""The tools that every route needs, for meshes and textures."""
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
            ("chromium", "playwright"), ("webgpu",), one_worker=True, draws_packages=True,
            limits=BROWSERS,
        ),
        DriverRow(
            "webgl2", "WebGL 2 in Chromium, on SwiftShader", "browser",
            ("chromium", "playwright"), ("webgl2",), one_worker=True, draws_packages=True,
            limits=BROWSERS,
        ),
    )
}  # fmt: skip
"""The drivers that draw the same on every machine, because they need no GPU."""

DEVICE_DRIVERS: Mapping[str, DriverRow] = {
    row.name: row
    for row in (
        DriverRow(
            "vulkan", "Vulkan on a device of this machine", "vulkan",
            _VULKAN, ("",), one_worker=True, any_device=True,
        ),
        DriverRow(
            "opengl", "OpenGL on a device of this machine", "opengl",
            ("moderngl",), one_worker=True, any_device=True,
        ),
        DriverRow(
            "wgpu", "wgpu's WebGPU on a device of this machine", "wgpu",
            ("wgpu",), one_worker=True, any_device=True,
        ),
    )
}  # fmt: skip
"""The drivers that draw with any device, real GPUs among them."""

EVERY_DRIVER: Mapping[str, DriverRow] = {**DRIVERS, **DEVICE_DRIVERS}

# HLSL is written for Direct3D, where SV_Position.w is the reciprocal of Vulkan's, so both compilers
# need a flag. DXC lays out blocks by Direct3D's rules only if it is asked to. naga's command line
# turns the picture upside down unless a flag forbids it.
_TO_VULKAN = (
    _Way("glsl", "GLSL by glslang", "glsl:vulkan", "glslang-vulkan"),
    _Way(
        "hlsl-glslang", "HLSL by glslang", "hlsl:sm6", "glslang-hlsl", ("--hlsl-dx-position-w",),
        frozenset({VIEW_INDEX.name}),
    ),
    _Way(
        "hlsl-dxc", "HLSL by DXC", "hlsl:sm6", "dxc-spirv",
        ("-fvk-use-dx-position-w", "-fvk-use-dx-layout"),
    ),
    _Way("wgsl-naga", "WGSL by naga", "wgsl:webgpu", "naga", ("--keep-coordinate-space",)),
)  # fmt: skip


def _vulkan_routes(driver: str) -> Iterator[Route]:
    """All ways to a Vulkan driver."""
    for way in _TO_VULKAN:
        title = f"{way.title}, {EVERY_DRIVER[driver].title}"
        name = f"{driver}:{way.name}"
        yield Route(name, title, way.profile, driver, way.compiler, way.flags, way.unknown_inputs)


def _opengl_routes(driver: str) -> Iterator[Route]:
    """The routes to a driver for OpenGL 4.5, which also takes texts of ES 3.1 as they are."""
    for version, words in (("gl330", "3.30"), ("gl450", "4.50"), ("es310", "ES 3.10")):
        title = f"GLSL {words}, {EVERY_DRIVER[driver].title}"
        yield Route(f"{driver}:{version}", title, f"glsl:{version}", driver)


ROUTES: Mapping[str, Route] = {
    route.name: route
    for route in (
        *_vulkan_routes("lavapipe"),
        *_vulkan_routes("swiftshader"),
        *_opengl_routes("llvmpipe"),
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
"""The routes that draw the same on every machine: those that ``all`` means."""

NARROW_ROUTES: Mapping[str, Route] = {
    route.name: route
    for route in (
        Route(
            "llvmpipe:es100", f"GLSL ES 1.00, {DRIVERS['llvmpipe'].title}",
            "glsl:es100", "llvmpipe",
        ),
    )
}  # fmt: skip
"""The routes of profiles that cannot express many programs. They draw the same on every machine,
too, and only if they are named, since drawing by all routes should not fail for that reason."""

DEVICE_ROUTES: Mapping[str, Route] = {
    route.name: route
    for route in (
        *_vulkan_routes("vulkan"),
        *_opengl_routes("opengl"),
        Route("wgpu:wgsl", f"WGSL, {DEVICE_DRIVERS['wgpu'].title}", "wgsl:webgpu", "wgpu"),
    )
}
"""The routes that draw with any device of the machine, and only if they are named."""

EVERY_ROUTE: Mapping[str, Route] = {**ROUTES, **NARROW_ROUTES, **DEVICE_ROUTES}

ALL = "all"


class UnknownRouteError(ValueError):
    """The route does not exist; the text suggests a similar one."""


def select(names: Iterable[str]) -> tuple[Route, ...]:
    """The routes that somebody names, each once, in the order of the table.

    A name is that of a route, or one half of it, which means all routes that have it (``lavapipe``,
    ``hlsl-dxc``), or a pattern with ``*``, or ``all``, or several of these separated by commas.
    Routes of narrow profiles, and those that draw with any device, are meant only by names that no
    other route has: ``es100``, ``vulkan``, ``vulkan:glsl``. Raises ``UnknownRouteError``.
    """
    wanted = [part.strip() for name in names for part in name.split(",")]
    chosen = set(chain.from_iterable(_meant(name) for name in wanted if name))
    return tuple(route for name, route in EVERY_ROUTE.items() if name in chosen)


def _meant(name: str) -> list[str]:
    tables = (ROUTES, NARROW_ROUTES, DEVICE_ROUTES)
    named = (found for table in tables if (found := _named(table, name)))
    found = list(ROUTES) if name == ALL else next(named, [])
    if not found:
        halves = chain.from_iterable(route.split(":") for route in EVERY_ROUTE)
        known = (*EVERY_ROUTE, *halves, ALL)
        hint = suggestion(name, known) or f"there are {', '.join(EVERY_ROUTE)}, and all"
        raise UnknownRouteError(f"there is no route `{name}`; {hint}")
    return found


def _named(routes: Iterable[str], name: str) -> list[str]:
    return [
        route for route in routes
        if any(fnmatchcase(part, name) for part in (route, *route.split(":")))
    ]  # fmt: skip


def inspect_tools(routes: Iterable[Route]) -> dict[str, ToolState]:
    """The states of all tools that some routes need, by name; determines the version of each."""
    needed = dict.fromkeys(chain.from_iterable(route.needs for route in routes))
    return inspect_all(tool_named(name) for name in needed)


def problem(route: Route, states: Mapping[str, ToolState]) -> str | None:
    """The reasons why a route cannot draw, tool by tool; ``None`` if it can."""
    needed = [states[name] for name in route.needs]
    missing = {
        state.tool.name: state.tool.source.name
        for state in needed
        if not state.paths and isinstance(state.tool.source, Extra)
    }
    others = [state.problem for state in needed if state.tool.name not in missing and state.problem]
    return "; ".join([*others, *_lacking_packages(missing)]) or None


def _lacking_packages(missing: Mapping[str, str]) -> Iterator[str]:
    """One sentence about all packages of Python that are missing, each with its extra."""
    if missing:
        verb, what = ("is", "it") if len(missing) == 1 else ("are", "them")
        command = install_command(missing.values())
        yield f"{', '.join(missing)} {verb} missing; to install {what}: {command}"


def versions(route: Route, states: Mapping[str, ToolState]) -> dict[str, str]:
    """The versions of a route's tools, as far as they are known."""
    found = {name: states[name].version for name in route.needs}
    return {name: version for name, version in found.items() if version}


def routes_needing(tool: str) -> tuple[str, ...]:
    """The names of the routes that cannot draw without a tool."""
    return tuple(name for name, route in EVERY_ROUTE.items() if tool in route.needs)
