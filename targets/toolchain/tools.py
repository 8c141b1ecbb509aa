"""The table of external tools, and functions that look for them on this machine.

A tool is whatever Burnish uses but does not contain: compilers, drivers, a browser, and the Python
packages that talk to them. ``doctor``, the checkers and the routes look tools up here, and
``install.py`` installs them. A tool is looked for in Burnish's cache folder first (the variable
``BURNISH_TOOLS`` moves it), if no other user can change that, then where systems have it; but
nowhere in the current folder, which may be somebody else's.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from ...compiler import cache
from .places import (
    AnyProgram,
    FolderFiles,
    Paths,
    Place,
    Programs,
    PythonPackage,
    SystemFiles,
    is_trusted,
    libraries,
    vulkan_files,
)
from .sources import Debian, Extra, OwnInstaller, Source, Unstable
from .versions import (
    Version,
    browser_beside,
    in_folder_name,
    of_debian_package,
    of_python_package,
    says,
    says_by_rustup,
    stated,
    written_in,
)

DXC_LIBRARY = "libdxcompiler.so"
TINT_PACKAGE = "node_modules/webgpu/package.json"
PYODIDE = ("node_modules/pyodide/package.json", "node_modules/pyodide/pyodide.mjs")
VITE = ("node_modules/vite/package.json", "node_modules/vite/bin/vite.js")
THREE = ("node_modules/three/package.json", "node_modules/three/build/three.webgpu.js")
THREE_TYPES = (
    "node_modules/@types/three/package.json", "node_modules/@types/three/build/three.webgpu.d.ts",
)  # fmt: skip
TYPESCRIPT = ("node_modules/typescript/package.json", "node_modules/typescript/bin/tsc")
BEVY = ("bevy-composer", "modules/bevy_pbr/render/pbr.wgsl")

CARGO_PACKAGES = ("cargo-web", "gcc", "libc6-dev")
"""Debian's own ``cargo`` is too old for naga; ``cargo-web`` is as new as the browsers built with
it.
"""

VULKAN_LOADER = libraries("libvulkan.so.1")
MESA_SAYS = rb"Mesa (\d+\.\d+\.\d+)"
CHROMIUMS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
CHROMIUM_FOLDERS = (
    "usr/lib/chromium", "usr/lib64/chromium", "usr/lib/chromium-browser",
    "usr/lib64/chromium-browser", "opt/google/chrome",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Tool:
    """One row: an external tool."""

    name: str
    purpose: str
    place: Place
    """The places to look for its files."""
    version: Version
    """Reads the version from its files."""
    source: Source
    """The source to get it from."""
    minimum: tuple[int, ...] = ()
    """The oldest version that works; empty if any does."""

    def __reduce__(self) -> tuple[Callable[[str], Tool], tuple[str]]:
        """Pickled, a tool is its name: another process of Burnish has the same table."""
        return tool_named, (self.name,)

    @property
    def install(self) -> str:
        """The command that installs it."""
        return self.source.command(self.name)

    @property
    def folder(self) -> str:
        """The name of its folder in the cache; a new version gets a new folder."""
        if isinstance(self.source, OwnInstaller):
            return f"{self.name}-{self.source.pinned}"
        return self.name

    @property
    def may_be_missing(self) -> bool:
        """True if it cannot always be installed; nothing fails then but what was asked for it."""
        return isinstance(self.source, Unstable)

    def find(self) -> Paths | None:
        """The paths of all its files, in the cache or on the system; ``None`` if one is missing."""
        return self.find_installed() or self.place.outside()

    def find_installed(self) -> Paths | None:
        """The paths of all its files in the cache, if no other user can change them."""
        folder = cache_folder()
        return self.find_in(folder / self.folder) if is_trusted(folder) else None

    def find_in(self, folder: Path) -> Paths | None:
        """The paths of all its files in a folder with the cache's layout; ``None`` if one is
        missing.
        """
        return self.place.inside(folder)


@dataclass(frozen=True, slots=True)
class ToolState:
    """The state of a tool on this machine."""

    tool: Tool
    paths: Paths
    """The paths of the tool's files, in their order; empty if it is missing."""
    version: str | None
    problem: str | None
    """The reason why the tool cannot be used; ``None`` if it can."""


def _python_package(name: str, extra: str, purpose: str) -> Tool:
    return Tool(name, purpose, PythonPackage(name), of_python_package(name), Extra(extra))


TOOLS: tuple[Tool, ...] = (
    Tool(
        name="glslang",
        purpose="compiles GLSL, and HLSL, to SPIR-V",
        place=Programs(("glslangValidator",)),
        version=says("--version", r"Glslang Version: (?:\d+:)?(\S+)"),
        source=Debian(("glslang-tools",)),
    ),
    Tool(
        name="spirv-tools",
        purpose="validates, optimises and prints SPIR-V",
        place=Programs(("spirv-val", "spirv-opt", "spirv-dis")),
        version=says("--version", r"SPIRV-Tools v(\S+)"),
        source=Debian(("spirv-tools",)),
    ),
    Tool(
        name="dxc",
        purpose="compiles HLSL to DXIL and to SPIR-V",
        place=FolderFiles((DXC_LIBRARY,)),
        version=in_folder_name,
        source=OwnInstaller("3.7"),
    ),
    Tool(
        name="naga",
        purpose="validates WGSL and compiles it to SPIR-V; the WebGPU front end of Firefox",
        place=Programs(("naga",)),
        version=says("--version", r"(\d+\.\d+\.\d+)"),
        source=OwnInstaller("30.0.1"),
        minimum=(30,),
    ),
    Tool(
        name="node",
        purpose="runs tint, typescript, pyodide and vite",
        place=Programs(("node",)),
        version=says("--version", r"v(\S+)"),
        source=Debian(("nodejs", "npm")),
    ),
    Tool(
        name="tint",
        purpose="validates WGSL; the WebGPU front end of Chromium",
        place=FolderFiles((TINT_PACKAGE,)),
        version=stated("version"),
        source=OwnInstaller("0.6.2"),
    ),
    Tool(
        name="typescript",
        purpose="checks the types of the host for web pages; only tests need it",
        place=FolderFiles(TYPESCRIPT),
        version=stated("version"),
        source=OwnInstaller("6.0.3"),
    ),
    Tool(
        name="vite",
        purpose="bundles web pages with the plugin; only tests need it",
        place=FolderFiles(VITE),
        version=stated("version"),
        source=OwnInstaller("6.4.6"),  # the last that runs on the Node.js of Debian 12
    ),
    Tool(
        name="three",
        purpose="three.js, in which tests draw what is made for it",
        place=FolderFiles(THREE),
        version=stated("version"),
        source=OwnInstaller("0.187.0"),
    ),
    Tool(
        name="three-types",
        purpose="the types of three.js, by which tests check those of materials for it",
        place=FolderFiles(THREE_TYPES),
        version=stated("version"),
        source=OwnInstaller("0.187.0"),
    ),
    Tool(
        name="pyodide",
        purpose="CPython 3.14, with which tests try wheels that another Python built",
        place=FolderFiles(PYODIDE),
        version=stated("version"),
        source=OwnInstaller("314.0.7"),
    ),
    Tool(
        name="clang",
        purpose="type-checks MSL, never compiled by Apple's compiler; compiles C++ for tests",
        place=Programs(("clang",)),
        version=says("--version", r"clang version (\d+\.\d+\.\d+)"),
        source=Debian(("clang",)),
        minimum=(14,),  # the oldest that was tried
    ),
    Tool(
        name="rustc",
        purpose="compiles the comparer in Rust; only tests need it",
        place=Programs(("rustc",)),
        version=says_by_rustup("--version", r"rustc (\d+\.\d+\.\d+)"),
        source=Debian(("rustc-web", "gcc", "libc6-dev")),
        minimum=(1, 63),  # the one of Debian 12
    ),
    Tool(
        name="cargo",
        purpose="builds naga; runs the build script of the crate in tests",
        place=Programs(("cargo",)),
        version=says_by_rustup("--version", r"cargo (\d+\.\d+\.\d+)"),
        source=Debian(CARGO_PACKAGES),
    ),
    Tool(
        name="cmake",
        purpose="builds with materials by the CMake function; only tests need it",
        place=Programs(("cmake",)),
        version=says("--version", r"cmake version (\d+\.\d+\.\d+)"),
        source=Debian(("cmake",)),
        minimum=(3, 25),  # the one of Debian 12, which the function needs
    ),
    Tool(
        name="ninja",
        purpose="builds what CMake and `burnish build` have described; only tests need it",
        place=Programs(("ninja",)),
        version=says("--version", r"(\d+\.\d+\.\d+)"),
        source=Debian(("ninja-build",)),
        minimum=(1, 10),  # the first that reads several outputs of one rule from a file
    ),
    Tool(
        name="vulkan-headers",
        purpose="headers of Vulkan, JSON and PNG for the host in C++; only tests need it",
        place=SystemFiles(
            (
                ("usr/include/vulkan/vulkan_core.h",),
                ("usr/include/nlohmann/json.hpp",),
                ("usr/include/stb/stb_image_write.h",),
                libraries("libvulkan.so"),
            )
        ),
        version=written_in(0, rb"define VK_HEADER_VERSION (\d+)"),
        source=Debian(("libvulkan-dev", "nlohmann-json3-dev", "libstb-dev")),
        minimum=(204,),  # the first of Vulkan 1.3
    ),
    Tool(
        name="lavapipe",
        purpose="Mesa's Vulkan driver that draws on the CPU",
        place=SystemFiles(
            (
                (
                    *vulkan_files("icd.d/lvp_icd.{machine}.json"),
                    *vulkan_files("icd.d/lvp_icd.json"),
                ),
                libraries("libvulkan_lvp.so"),
                VULKAN_LOADER,
            )
        ),
        version=written_in(1, MESA_SAYS),
        source=Debian(("mesa-vulkan-drivers", "libvulkan1")),
        minimum=(22, 3),  # the oldest that was tried
    ),
    # The driver has no version of its own: it is built with the browser.
    Tool(
        name="swiftshader",
        purpose="Chromium's Vulkan driver that draws on the CPU",
        place=SystemFiles(
            (
                tuple(f"{folder}/vk_swiftshader_icd.json" for folder in CHROMIUM_FOLDERS),
                VULKAN_LOADER,
            )
        ),
        version=browser_beside(CHROMIUMS),
        source=Debian(("chromium", "libvulkan1")),
    ),
    Tool(
        name="vulkan-validation",
        purpose="the Khronos validation layers, which say what is wrong in calls of Vulkan",
        place=SystemFiles((vulkan_files("explicit_layer.d/VkLayer_khronos_validation.json"),)),
        version=stated("layer", "api_version"),
        source=Debian(("vulkan-validationlayers",)),
    ),
    Tool(
        name="llvmpipe",
        purpose="Mesa's OpenGL driver that draws on the CPU, without a window by EGL",
        place=SystemFiles(
            (
                (*libraries("libgallium-*.so"), *libraries("dri/swrast_dri.so")),
                libraries("libEGL.so.1"),
                libraries("libEGL_mesa.so.0"),
            )
        ),
        version=written_in(0, MESA_SAYS),
        source=Debian(("libegl1", "libegl-mesa0", "libgl1-mesa-dri")),
    ),
    Tool(
        name="chromium",
        purpose="a browser, for WebGPU and WebGL 2 as they are on the web",
        place=AnyProgram(CHROMIUMS),
        version=says("--version", r"Chrom\w* (\d+(?:\.\d+)+)"),
        source=Debian(("chromium",)),
        minimum=(113,),  # the first with WebGPU
    ),
    Tool(
        name="filament",
        purpose="compiles materials of Filament; only tests need it",
        place=Programs(("matc",)),
        # It says no version of its own, but that of the materials that it writes.
        version=says("--version", r"^(\d+)"),
        source=Debian(("libfilament-tools",)),
        minimum=(10,),  # the one of Debian 12, which is Filament 1.9.25
    ),
    Tool(
        name="bevy",
        purpose="composes shaders with the modules of the engine Bevy; only tests need it",
        place=FolderFiles(BEVY),
        version=in_folder_name,
        source=OwnInstaller("0.19.1"),
    ),
    Tool(
        name="godot",
        purpose="the engine Godot 4, which compiles and draws its shaders; only tests need it",
        place=Programs(("godot",)),
        version=says("--version", r"(\d+\.\d+(?:\.\d+)?)"),
        source=Unstable("godot"),
        minimum=(4, 4),  # the first whose shading language has all that is written for it
    ),
    Tool(
        name="xvfb",
        purpose="a display without a screen, on which godot draws",
        place=Programs(("Xvfb",)),
        version=of_debian_package("xvfb"),
        source=Debian(("xvfb",)),
    ),
    _python_package("numpy", "render", "arrays, for the reference pictures"),
    _python_package("pillow", "render", "writes and reads pictures"),
    _python_package("vulkan", "run", "calls Vulkan from Python"),
    _python_package("moderngl", "run", "calls OpenGL from Python"),
    _python_package("playwright", "run", "drives the browser"),
    _python_package("wgpu", "wgpu", "calls Direct3D 12, Metal or Vulkan, by wgpu's WebGPU"),
)


def cache_folder() -> Path:
    """The folder that has a sub-folder for each tool that Burnish has installed itself."""
    moved = Path(os.environ.get("BURNISH_TOOLS", ""))
    return moved if moved.is_absolute() else Path(cache.folder()) / "tools"


def tool_named(name: str) -> Tool:
    """The row of a tool. Raises ``KeyError`` for any other name."""
    return {tool.name: tool for tool in TOOLS}[name]


def inspect(tool: Tool) -> ToolState:
    """Look for a tool and determine its version."""
    return judge(tool, tool.find())


def inspect_all(tools: Iterable[Tool] = TOOLS) -> dict[str, ToolState]:
    """The states of several tools by name, in their order; looks for all of them at once."""
    threads = ThreadPoolExecutor()
    try:
        return {state.tool.name: state for state in threads.map(inspect, tools)}
    finally:  # After Ctrl-C, nobody waits for a program that does not say its version.
        threads.shutdown(wait=False, cancel_futures=True)


def judge(tool: Tool, paths: Paths | None) -> ToolState:
    """The state of a tool that was found at ``paths``; ``None`` means that it was not found."""
    if paths is None:
        return ToolState(tool, (), None, f"{tool.name} is missing; to install it: {tool.install}")
    version = tool.version(paths)
    return ToolState(tool, paths, version, _version_problem(tool, version))


def _version_problem(tool: Tool, version: str | None) -> str | None:
    if version is None:
        return f"{tool.name} does not say its version; to install it anew: {tool.install}"
    numbers = tuple(int(digits) for digits in re.findall(r"\d+", version))
    if numbers < tool.minimum:
        wanted = ".".join(map(str, tool.minimum))
        return f"{tool.name} {version} is older than {wanted}; to install it: {tool.install}"
    return None


def program(tool: str, name: str) -> Path | None:
    """The path of one program of a tool, ``spirv-opt`` of ``spirv-tools``; ``None`` if it is
    missing.
    """
    paths = tool_named(tool).find() or ()
    return next((path for path in paths if path.name == name), None)
