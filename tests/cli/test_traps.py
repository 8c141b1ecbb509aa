"""In a folder full of traps, every command does its own work and nothing else.

The folder has what a cloned repository may have: Python modules and programs with the names of
those that Burnish starts, settings of other tools, links to files outside, pipes, and names that
are words of other languages. A trap that is sprung leaves a mark. Files outside are compared with
what they were, and what a command writes may contain none of their secrets.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from burnish.targets.toolchain.places import AnyProgram, Programs
from burnish.targets.toolchain.tools import TOOLS, cache_folder

from ..suite.processes import run, started

SECRET = "S3CRET-0F-AN0THER-F0LDER"
COLOR = (13, 177, 91)
"""The colour of a picture outside, which no material here has."""
MATERIAL = "material Good {{ color = vec3(0.5) }}{}\n"
FRAME = """import std.frames.{FullScreen}
pass Sky : FullScreen { target color : rgba8 = vec4(uv, 0, 1) }
frame Seen { a = Sky(screen)  output o = a.color }
"""
STEAL = """//!     burnish render steal.burnish -o x.png --set t={}
material Steal {{ map t : texture2d  color = t(uv).rgb }}
"""
PROSE = """//! `burnish render prose.burnish -o prose.png` shows what it is, and that's it.
material Prose { color = vec3(0.1) }
"""
MODULES = (
    "base64", "burnish/__init__", "collections/__init__", "concurrent/__init__", "ctypes/__init__",
    "encodings/__init__", "faulthandler", "jinja2/__init__", "json", "jsonschema/__init__",
    "lark/__init__", "moderngl", "msgspec", "numpy/__init__", "PIL/__init__", "pickle",
    "platformdirs", "playwright/__init__", "random", "re", "site", "sitecustomize", "struct",
    "subprocess", "tempfile", "typing", "usercustomize", "vulkan", "watchfiles/__init__",
    "wgpu/__init__",
)  # fmt: skip
"""Modules that Burnish or its processes import."""
PROGRAMS = (
    *(name for tool in TOOLS if isinstance(tool.place, Programs | AnyProgram)
      for name in tool.place.names),
    "cargo", "npm", "git", "gs", "python", "python3", "sh", "setpriv", "prlimit", "ldconfig",
)  # fmt: skip
"""Programs that Burnish starts, or that something which it uses may start."""
SETTINGS = {
    ".cargo/config.toml": '[build]\nrustc-wrapper = "./sh"\n',
    ".npmrc": "node-options = --require ./trap.js\n",
    "package.json": '{"type": "module", "main": "trap.js"}\n',
    "pip.conf": "[global]\nindex-url = nowhere\n",
    "pyvenv.cfg": "home = .\n",
    "clang.cfg": "-include ./trap.h\n",
    "vk_layer_settings.txt": (
        "khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG\n"
        "khronos_validation.report_flags = error,warn,info,perf,debug\n"
        "khronos_validation.log_filename = {marks}/layer\n"
    ),
}
"""Files in the current folder that other programs read."""
COMMANDS = (
    "compile good.burnish -o build",
    "compile good.burnish -o build --validate",
    "compile seen.burnish -o build -t glsl,wgsl",
    "compile ./-o.burnish -o build",
    "check good.burnish",
    "check outside.burnish",
    "graph good.burnish",
    "graph seen.burnish -o build/seen.svg",
    "render good.burnish -o build/good.png --size 8",
    "render good.burnish -o build/good.png --size 8 --on all",
    "render steal.burnish -o build/good.png --size 8 --set t=eps.png",
    "render steal.burnish -o build/good.png --size 8 --set t=pipe.png",
    "render seen.burnish -o build/good.png --size 8 --scene scene.gltf",
    "conform good.burnish seen.burnish --routes lavapipe:glsl,llvmpipe:gl330 --report build",
    "conform good.burnish --routes chromium:webgpu",
    "gallery . -o pages --routes lavapipe:glsl --on lavapipe:glsl --size 16",
    "targets",
    "doctor",
    "explain B0201",
)  # fmt: skip


class Traps:
    """A folder full of traps, with a folder beside it that nothing may touch."""

    def __init__(self, base: Path) -> None:
        self.folder = base / "cloned"
        self.outside = base / "outside"
        self.marks = base / "marks"
        for each in (self.folder, self.outside, self.marks, base / "home"):
            each.mkdir()
        self.environment = {
            # Entries of PATH that mean the current folder, as some people have them.
            "PATH": os.pathsep.join(["", ".", *os.environ["PATH"].split(os.pathsep)]),
            "HOME": str(base / "home"),
            "BURNISH_CACHE": str(base / "cache"),
            "BURNISH_TOOLS": str(cache_folder()),
        }
        self._fill_outside()
        self._fill()
        self._before = dict(self._state())

    def _fill_outside(self) -> None:
        (self.outside / "notes").write_text(f"material {SECRET.replace('-', '_')} {{ }}\n")
        (self.outside / "sub").mkdir()
        (self.outside / "sub" / "id").write_text(SECRET)
        picture = np.full((8, 8, 3), COLOR, np.uint8)
        Image.fromarray(picture).save(self.outside / "private.png")

    def _fill(self) -> None:
        trap = f"import os\nopen(os.path.join({str(self.marks)!r}, __name__), 'w').close()\n"
        for name in MODULES:
            self._write(f"{name}.py", trap)
        for name in PROGRAMS:
            self._write(name, f"#!/bin/sh\n: > '{self.marks}/{name}'\n", mode=0o755)
        for name, text in SETTINGS.items():
            self._write(name, text.replace("{marks}", str(self.marks)))
        self._write("trap.js", f"require('fs').writeFileSync('{self.marks}/js', '')\n")
        self._fill_sources()
        journal = f"build/.burnish-output-{os.getuid()}"
        self._write(f"{journal}/whole", "")
        for name in ("old", "new"):
            self._link(f"{journal}/{name}", self.outside)
        for name in ("Good.json", "Good.frag.wgsl", "good.png", "index.html"):
            self._link(f"build/{name}", self.outside / "notes")

    def _fill_sources(self) -> None:
        self._write("good.burnish", MATERIAL.format(""))
        self._write("seen.burnish", FRAME)
        self._write("prose.burnish", PROSE)
        self._write("steal.burnish", STEAL.format(self.outside / "private.png"))
        self._write("scene.gltf", '{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 1, '
                    '"uri": "../outside/notes"}]}')  # fmt: skip
        self._write("eps.png", "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n"
                    f"({self.marks}/ps) (w) file closefile\n")  # fmt: skip
        for name in ("-o", "javascript:alert(1)", "a#b?c%41", "<script>x", "it's", "two\nlines"):
            self._write(f"{name}.burnish", MATERIAL.format(f"  // {name!r}"))
        self._write("\x1b[2J\u202e.burnish", MATERIAL.format("  // \x1b[31mred"))
        (self.folder / os.fsdecode(b"\xff\xfe.burnish")).write_text(MATERIAL.format(""))
        self._link("outside.burnish", self.outside / "notes")
        self._link("linked", self.outside)
        for name in ("pipe.burnish", "pipe.png"):
            os.mkfifo(self.folder / name)

    def _write(self, name: str, text: str, mode: int = 0o644) -> None:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
        path.chmod(mode)

    def _link(self, name: str, target: Path) -> None:
        (self.folder / name).symlink_to(target)

    def _state(self) -> Iterator[tuple[str, tuple[int, int, bytes]]]:
        """Everything that commands have to leave alone: where it is, and what."""
        journal = self.folder / "build" / f".burnish-output-{os.getuid()}"
        for folder in (self.outside, self.folder.parent / "home", journal):
            for path in sorted([folder, *folder.rglob("*")]):
                status = path.lstat()
                content = path.read_bytes() if path.is_file() else b""
                yield str(path), (status.st_ino, status.st_mode, content)

    def check(self, output: str) -> None:
        """Insist that no trap was sprung, nothing outside has changed, and no secret is shown."""
        assert sorted(path.name for path in self.marks.iterdir()) == []
        assert dict(self._state()) == self._before
        assert "Traceback" not in output
        assert "\x1b[2J" not in output
        assert SECRET not in output
        for path in self._written():
            content = path.read_bytes()
            assert SECRET.encode() not in content, path
            assert b"Traceback" not in content, path
            if path.suffix == ".png":
                with Image.open(path) as picture:
                    colors = picture.convert("RGB").getcolors(1 << 20) or []
                assert COLOR not in {color for _count, color in colors}, path

    def _written(self) -> Iterator[Path]:
        for name in ("build", "pages"):
            for path in (self.folder / name).rglob("*"):
                if path.is_file() and not path.is_symlink():
                    yield path


@pytest.fixture
def traps(tmp_path: Path) -> Traps:
    return Traps(tmp_path)


@pytest.mark.parametrize("command", COMMANDS)
def test_no_trap_is_sprung(command: str, traps: Traps) -> None:
    done = run([sys.executable, "-P", "-m", "burnish", *command.split()],
               cwd=traps.folder, env=traps.environment)  # fmt: skip
    assert done.returncode in (0, 1), done.stderr
    traps.check(done.stdout + done.stderr)


@pytest.mark.usefixtures("interruptible")
def test_no_trap_is_sprung_by_the_viewer(traps: Traps) -> None:
    command = [sys.executable, "-P", "-m", "burnish", "view", ".", "--no-browser"]
    with started(command, cwd=traps.folder, env=traps.environment) as program:
        line = program.line().decode()
        program.signal(signal.SIGINT)
        done = program.ended()
    assert "http://127.0.0.1:" in line
    traps.check(line + done.stdout + done.stderr)
