"""The hosts in Python: projects that are built and run as their pages say."""

from __future__ import annotations

import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from .expecting import SCENES, Picture, difference
from .projects import GLUE, HOSTS, commands, project

DOCS = HOSTS.parents[1] / "docs"
PYTHON = ("wgpu-py", "moderngl")
COMMENTS = ("#", '"""')
TIME_LIMIT = 120


def _run(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a command of a page, with this environment's Python and Burnish."""
    command, *arguments = shlex.split(line)
    program = [sys.executable, *(["-m", "burnish"] if command == "burnish" else [])]
    assert command in ("burnish", "python")
    return subprocess.run(
        [*program, *arguments], cwd=folder, capture_output=True, text=True, timeout=TIME_LIMIT,
        check=False,
    )  # fmt: skip


@pytest.fixture(scope="module", params=PYTHON)
def built(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project of a host, after the first command of its page."""
    host: str = request.param
    folder = project(host, tmp_path_factory.mktemp(host) / "project")
    done = _run(commands(folder)[0], folder)
    assert done.returncode == 0, done.stderr
    return folder


@pytest.mark.parametrize("scene", SCENES)
def test_a_host_draws_what_burnish_draws(
    scene: str, built: Path, expected: Callable[[str], Picture]
) -> None:
    line = commands(built)[1].replace("plastic", scene)
    done = _run(line, built)
    assert done.returncode == 0, done.stderr
    assert difference(built / f"{scene}.png", expected(scene)) == ""


def test_a_scene_that_there_is_not(built: Path) -> None:
    done = _run("python draw.py glass glass.png", built)
    assert done.returncode == 1
    assert done.stderr.startswith("there is no scene `glass`: there are plastic, banner, shadows")
    assert not (built / "glass.png").exists()


def test_types_are_right(built: Path) -> None:
    if "import wgpu" in (built / "draw.py").read_text(encoding="utf-8"):
        return  # wgpu brings no types.
    done = _run("python -m mypy --strict --no-incremental draw.py", built)
    assert done.returncode == 0, done.stdout


def test_the_page_of_bindings_shows_what_is_drawn_here() -> None:
    page = (DOCS / "bindings.md").read_text(encoding="utf-8")
    for part in GLUE.findall((HOSTS / "wgpu-py" / "draw.py").read_text(encoding="utf-8")):
        assert f"```py\n{part.strip()}\n```" in page
