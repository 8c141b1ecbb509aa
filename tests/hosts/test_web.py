"""The hosts in pages: projects that are built as their pages say, and drawn by a browser."""

from __future__ import annotations

import json
import shlex
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from burnish.targets.toolchain.tools import program

from ..integrations.kit import environment
from ..suite import browsers
from ..suite.processes import run
from .expecting import SCENES, Picture, difference
from .projects import project

PAGES = ("webgpu", "webgl2")
ADDRESS = "https://burnish.invalid/"

pytestmark = pytest.mark.xdist_group("hosts in pages")  # One browser draws for all tests.


def _tool(name: str, member: str) -> str:
    found = program(name, member)
    assert found is not None, name
    return str(found)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with browsers.browser() as opened:
        yield opened


@pytest.fixture(scope="module", params=PAGES)
def built(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project, after the commands of its ``package.json`` that bind, check and build."""
    folder = project(request.param, tmp_path_factory.mktemp(request.param) / "project")
    modules = folder / "node_modules"
    modules.mkdir()
    (modules / "vite").symlink_to(Path(_tool("vite", "package.json")).parent)
    programs = {
        "burnish": ["burnish"],
        "tsc": [_tool("node", "node"), _tool("typescript", "tsc")],
        "vite": [_tool("node", "node"), str(modules / "vite" / "bin" / "vite.js")],
    }
    scripts = json.loads((folder / "package.json").read_text(encoding="utf-8"))["scripts"]
    for line in (
        scripts["bind"],
        scripts["check"],
        scripts["build"].removeprefix("npm run bind && "),
    ):
        word, *arguments = shlex.split(line)
        done = run([*programs[word], *arguments], cwd=folder, env=environment(), limit=300)
        assert done.returncode == 0, done.stdout + done.stderr
    return folder


def _opened(browser: Browser, built: Path, name: str) -> Page:
    """The page of a scene, once it has drawn or said why not."""
    page = browser.new_page()
    browsers.serve(page, built / "dist")
    page.goto(f"{ADDRESS}?draw={name}")
    page.wait_for_selector("body[data-drawn], [role=alert]:not(:empty)", state="attached")
    return page


@pytest.mark.parametrize("name", SCENES)
def test_a_page_draws_what_burnish_draws(
    name: str, built: Path, browser: Browser, expected: Callable[[str], Picture], tmp_path: Path
) -> None:
    page = _opened(browser, built, name)
    assert page.locator("[role=alert]").inner_text() == ""
    page.locator("canvas").screenshot(path=tmp_path / f"{name}.png")
    assert difference(tmp_path / f"{name}.png", expected(name)) == ""


def test_a_scene_that_there_is_not(built: Path, browser: Browser) -> None:
    told = _opened(browser, built, "glass").locator("[role=alert]").inner_text()
    assert told == "there is no scene `glass`: there are plastic, banner, shadows"
