"""The host for three.js: a project that is built and drawn in Chromium as its page says."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Page

from burnish.targets.toolchain.tools import tool_named
from burnish.tests.cli.kit import invoke
from burnish.tests.suite import browsers

from .expecting import SCENES, Picture, difference
from .projects import commands
from .projects import project as project_of

ADDRESS = "https://burnish.invalid"


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The project, built by the commands of its page."""
    folder = project_of("three", tmp_path_factory.mktemp("three") / "project")
    found = tool_named("three").find()
    assert found is not None
    (folder / "node_modules").symlink_to(found[0].parents[1])
    (block,) = commands(folder)
    install, *lines = block.strip().splitlines()
    assert install.startswith("npm install three@")  # What the tests have stands for it.
    for line in lines:
        program, command, *arguments = shlex.split(line)
        assert program == "burnish"
        inside = [
            folder / each if each.startswith(("materials/", "build")) else each
            for each in arguments
        ]
        result = invoke(command, *inside)
        assert result.exit_code == 0, result.stderr
    return folder


@pytest.fixture(scope="module")
def page(project: Path) -> Iterator[Page]:
    with browsers.browser() as browser:
        opened = browser.new_page()
        browsers.serve(opened, project)
        yield opened


def shown(page: Page, address: str, to: Path) -> str:
    """Draw what an address shows to a file, and return what the page tells."""
    page.goto(f"{ADDRESS}/{address}")
    page.wait_for_function("window.drawn === true")
    page.locator("canvas").screenshot(path=to)
    return page.inner_text("#told")


@pytest.mark.xdist_group("three")
@pytest.mark.parametrize("scene", SCENES)
def test_the_host_draws_what_burnish_draws(
    scene: str, page: Page, expected: Callable[[str], Picture], tmp_path: Path
) -> None:
    drawn = tmp_path / f"{scene}.png"
    assert shown(page, f"index.html?draw={scene}", drawn) == ""
    assert difference(drawn, expected(scene)) == ""


@pytest.mark.xdist_group("three")
@pytest.mark.parametrize("query", ["draw=plastic", "draw=plastic&webgl"])
def test_functions_are_lit_by_three(query: str, page: Page, tmp_path: Path) -> None:
    """Light and dark tiles of the texture are seen, in the orange of the material."""
    drawn = tmp_path / "lit.png"
    assert shown(page, f"lit.html?{query}", drawn) == ""
    with Image.open(drawn) as opened:
        pixels = np.array(opened.convert("RGB")).astype(int)
    ball = pixels[40:216, 50:206].reshape(-1, 3)
    orange = (ball[:, 0] > 1.3 * ball[:, 1]) & (ball[:, 1] > ball[:, 2])
    assert orange.mean() > 0.5
    assert np.percentile(ball[:, 0], 90) > 2 * np.percentile(ball[:, 0], 20)


def test_a_scene_that_there_is_not_is_told(page: Page, tmp_path: Path) -> None:
    told = shown(page, "index.html?draw=glass", tmp_path / "nothing.png")
    assert told == "there is no scene `glass`: there are plastic, banner, shadows"
