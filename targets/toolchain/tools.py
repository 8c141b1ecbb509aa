"""The external tools, one row each, and where they are found.

A tool is looked for in Burnish's cache folder first (``BURNISH_TOOLS`` moves it), then on PATH.
"""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from platformdirs import user_cache_path

from .process import run

VERSION_LIMIT = 20.0
"""Seconds a tool may take to say its version."""

DXC_LIBRARY = "libdxcompiler.so"
TINT_PACKAGE = "node_modules/webgpu/package.json"


def _says(option: str, pattern: str) -> Callable[[Path], str | None]:
    """A version read from what a program says."""

    def version(path: Path) -> str | None:
        outcome = run([str(path), option], time_limit=VERSION_LIMIT)
        found = re.search(pattern, outcome.log) if outcome.ending == "ended" else None
        return found[1] if found else None

    return version


def _package_version(manifest: Path) -> str | None:
    """The version of an npm package, read from its ``package.json``."""
    version = json.loads(manifest.read_text())["version"]
    return version if isinstance(version, str) else None


def _folder_version(path: Path) -> str | None:
    """The version in the name of the cache folder: ``dxc-3.7`` holds 3.7."""
    return path.parent.name.partition("-")[2]


@dataclass(frozen=True, slots=True)
class Tool:
    """An external tool."""

    name: str
    purpose: str
    files: tuple[str, ...]
    """What has to be there: programs, or paths inside the tool's cache folder."""
    version: Callable[[Path], str | None]
    """Reads the version off the first of the files."""
    install: str
    """The command that installs it."""
    pinned: str = ""
    """The version that the installer puts into the cache; empty for a system package."""
    minimum: tuple[int, ...] = ()
    """The oldest version that behaves; empty when any does."""
    on_path: bool = True
    """Whether its files are programs, so that PATH may hold them too."""

    @property
    def folder(self) -> str:
        """Its folder's name in the cache; a new version gets a new folder."""
        return f"{self.name}-{self.pinned}" if self.pinned else self.name

    def find(self) -> tuple[Path, ...] | None:
        """The paths of all its files, in the cache or on PATH; None when one is missing."""
        return self.find_in(cache_folder() / self.folder) or self._find_on_path()

    def find_in(self, folder: Path) -> tuple[Path, ...] | None:
        """The paths of all its files in a folder laid out like the cache's; None if incomplete."""
        base = folder / "bin" if self.on_path else folder
        paths = tuple(base / file for file in self.files)
        return paths if all(path.is_file() for path in paths) else None

    def _find_on_path(self) -> tuple[Path, ...] | None:
        if not self.on_path:
            return None
        paths = tuple(Path(path) for file in self.files if (path := shutil.which(file)))
        return paths if len(paths) == len(self.files) else None


@dataclass(frozen=True, slots=True)
class ToolState:
    """What is known of a tool on this machine."""

    tool: Tool
    paths: tuple[Path, ...]
    """Of the tool's files, in their order; empty when it is missing."""
    version: str | None
    problem: str | None
    """Why the tool cannot be used; None when it can."""


def _own_installer(name: str) -> str:
    return f"python -m burnish.targets.toolchain.install {name}"


TOOLS: tuple[Tool, ...] = (
    Tool(
        name="glslang",
        purpose="compiles GLSL, and HLSL, to SPIR-V",
        files=("glslangValidator",),
        version=_says("--version", r"Glslang Version: (?:\d+:)?(\S+)"),
        install="apt-get install -y --no-install-recommends glslang-tools",
    ),
    Tool(
        name="spirv-tools",
        purpose="validates, optimises and prints SPIR-V",
        files=("spirv-val", "spirv-opt", "spirv-dis"),
        version=_says("--version", r"SPIRV-Tools v(\S+)"),
        install="apt-get install -y --no-install-recommends spirv-tools",
    ),
    Tool(
        name="dxc",
        purpose="compiles HLSL to DXIL and to SPIR-V",
        files=(DXC_LIBRARY,),
        version=_folder_version,
        install=_own_installer("dxc"),
        pinned="3.7",
        on_path=False,
    ),
    Tool(
        name="naga",
        purpose="validates WGSL and compiles it to SPIR-V; the WebGPU front end of Firefox",
        files=("naga",),
        version=_says("--version", r"(\d+\.\d+\.\d+)"),
        install=_own_installer("naga"),
        pinned="30.0.1",
        minimum=(30,),
    ),
    Tool(
        name="node",
        purpose="runs tint",
        files=("node",),
        version=_says("--version", r"v(\S+)"),
        install="apt-get install -y --no-install-recommends nodejs npm",
    ),
    Tool(
        name="tint",
        purpose="validates WGSL; the WebGPU front end of Chromium",
        files=(TINT_PACKAGE,),
        version=_package_version,
        install=_own_installer("tint"),
        pinned="0.6.2",
        on_path=False,
    ),
)


def cache_folder() -> Path:
    """The folder with one sub-folder for each tool that Burnish installed itself."""
    moved = os.environ.get("BURNISH_TOOLS")
    return Path(moved) if moved else user_cache_path("burnish") / "tools"


def tool_named(name: str) -> Tool:
    """The tool's row. Raises ``KeyError`` for a name that is no tool's."""
    return {tool.name: tool for tool in TOOLS}[name]


def inspect(tool: Tool) -> ToolState:
    """Finds a tool and asks it for its version."""
    return judge(tool, tool.find())


def judge(tool: Tool, paths: tuple[Path, ...] | None) -> ToolState:
    """Asks a tool that was found at ``paths`` for its version, and says whether it will do."""
    if paths is None:
        return ToolState(tool, (), None, f"{tool.name} is missing; to install it: {tool.install}")
    version = tool.version(paths[0])
    return ToolState(tool, paths, version, _version_problem(tool, version))


def _version_problem(tool: Tool, version: str | None) -> str | None:
    if version is None:
        return f"{tool.name} does not say its version; to install it anew: {tool.install}"
    numbers = tuple(int(digits) for digits in re.findall(r"\d+", version))
    if numbers < tool.minimum:
        wanted = ".".join(map(str, tool.minimum))
        return f"{tool.name} {version} is older than {wanted}; to install it: {tool.install}"
    return None


def program(file: str) -> Path | None:
    """The path of a tool's program by its own name, e.g. ``spirv-opt``; None when missing."""
    owner = next(tool for tool in TOOLS if file in tool.files)
    paths = owner.find()
    return paths[owner.files.index(file)] if paths else None
