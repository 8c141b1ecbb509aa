"""The host in Rust: built by Cargo as its page says, it draws what Burnish's own host draws."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from burnish.targets.toolchain.tools import cache_folder, tool_named

from ..integrations.kit import environment, tool
from ..suite.processes import run
from .expecting import SCENES, Picture, difference
from .projects import commands, project

LIMIT = 1200
"""Seconds in which Cargo downloads wgpu and builds it."""

pytestmark = [
    pytest.mark.xdist_group("rust-wgpu"),  # Its tests share what Cargo has built.
    pytest.mark.timeout(LIMIT),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The project, after the commands of its page that build it."""
    made = project("rust-wgpu", tmp_path_factory.mktemp("rust-wgpu") / "project")
    build, _ = commands(made)
    for line in build.splitlines():
        run(shlex.split(line), cwd=made, env=_environment(), limit=LIMIT, check=True)
    return made


def _environment() -> Mapping[str, str]:
    """That of somebody with a driver, and with the crates that earlier runs of tests have built."""
    found = tool_named("lavapipe").find()
    assert found is not None, "lavapipe is missing: make tools"
    driver = str(found[0])
    return environment(
        CARGO_TARGET_DIR=str(cache_folder().parent / "rust-wgpu"), XDG_RUNTIME_DIR="/tmp",
        VK_DRIVER_FILES=driver, VK_ICD_FILENAMES=driver,
    )  # fmt: skip


def _draw(folder: Path, scene: str, *, check: bool = True) -> str:
    """Run the command of the page that draws, for a scene; what it has said."""
    tool("cargo", "cargo")
    _, draw = commands(folder)
    words = shlex.split(draw.replace("plastic", scene))
    done = run(words, cwd=folder, env=_environment(), limit=LIMIT)
    assert (done.returncode == 0) == check, done
    return done.stderr


@pytest.mark.parametrize("scene", SCENES)
def test_it_draws_what_burnish_draws(
    scene: str, folder: Path, expected: Callable[[str], Picture]
) -> None:
    said = _draw(folder, scene)
    assert "warning" not in said
    assert difference(folder / f"{scene}.png", expected(scene)) == ""


def test_a_scene_that_there_is_not(folder: Path) -> None:
    said = _draw(folder, "glass", check=False)
    assert "there is no scene `glass`: there are plastic, banner, shadows" in said
    assert "panicked" not in said
    assert not (folder / "glass.png").exists()
