"""The host in C++ with Vulkan: it is built as its page says, and draws what Burnish draws."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from burnish.targets.toolchain.tools import inspect, tool_named
from burnish.tests.integrations.kit import environment
from burnish.tests.suite.processes import run

from .expecting import SCENES, Picture, difference
from .projects import commands, project

pytestmark = pytest.mark.xdist_group("cpp-vulkan")  # It is built once.

HOST = "cpp-vulkan"


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The project, after the first command of its page."""
    for name in ("cmake", "ninja", "vulkan-headers"):
        assert inspect(tool_named(name)).problem is None, inspect(tool_named(name)).problem
    return _built(project(HOST, tmp_path_factory.mktemp(HOST) / "project"))


def _built(folder: Path) -> Path:
    run(
        ["sh", "-c", commands(folder)[0]], cwd=folder, check=True, limit=600,
        env=environment(CXXFLAGS="-Wall -Wextra -Wpedantic -Werror"),
    )  # fmt: skip
    return folder


def _draw(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    return run([str(folder / "build" / HOST), *words], cwd=folder)


@pytest.mark.parametrize("scene", SCENES)
def test_it_draws_what_burnish_draws(
    scene: str, built: Path, expected: Callable[[str], Picture]
) -> None:
    done = _draw(built, scene, f"{scene}.png")
    assert (done.returncode, done.stderr) == (0, "")
    assert difference(built / f"{scene}.png", expected(scene)) == ""


def test_push_constants_and_combined_samplers_draw_the_same(
    tmp_path: Path, built: Path, expected: Callable[[str], Picture]
) -> None:
    """The binding's section for Vulkan follows a scheme; a host records the push constants."""
    del built  # It has looked for the tools.
    folder = project(HOST, tmp_path / "project")
    scheme = 'combined_samplers = true\npush_constants = "material"\n'
    (folder / "scheme.toml").write_text(scheme, "utf-8")
    asked = 'OPTIONS --bindings "${CMAKE_CURRENT_SOURCE_DIR}/scheme.toml"'
    _replace(folder / "CMakeLists.txt", "BINDINGS cpp", f"BINDINGS cpp {asked}")
    bound = "gpu_.bind(layout.pipeline, sets);"
    pushed = "vulkan::push(gpu_.commands, layout, profile, *blocks);"
    _replace(folder / "main.cpp", bound, f"{bound} {pushed}")
    _built(folder)
    done = _draw(folder, "plastic", "plastic.png")
    assert (done.returncode, done.stderr) == (0, "")
    assert difference(folder / "plastic.png", expected("plastic")) == ""
    (header,) = (folder / "build").rglob("scene.hpp")
    text = "".join(header.read_text("utf-8").split())  # However it is folded.
    assert '{"Plastic.Material",Kind::push_constants,-1,-1,' in text
    assert '{"albedo",Kind::combined,2,' in text


def _replace(path: Path, old: str, new: str) -> None:
    text = path.read_text("utf-8")
    assert text.count(old) == 1
    path.write_text(text.replace(old, new), "utf-8")


def test_a_scene_that_there_is_not(built: Path) -> None:
    done = _draw(built, "glass", "glass.png")
    assert done.returncode == 2
    assert done.stderr == "there is no scene `glass`: there are banner, plastic, shadows\n"
    assert not (built / "glass.png").exists()


def test_a_stale_binding_is_told(built: Path) -> None:
    reflection = built / "build" / "burnish" / "scene" / "Banner.json"
    text = reflection.read_text("utf-8")
    reflection.write_text(re.sub('("layout_id": ")....', r"\1gone", text), "utf-8")
    done = _draw(built, "banner", "stale.png")
    reflection.write_text(text, "utf-8")
    assert done.returncode == 1
    assert "the binding is stale: a block has another layout; run `burnish bind`" in done.stderr
    assert not (built / "stale.png").exists()
