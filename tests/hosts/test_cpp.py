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
    folder = project(HOST, tmp_path_factory.mktemp(HOST) / "project")
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
