"""What the page shows of light: what ``render`` writes, by any exposure and tone mapping."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Browser, Page, ViewportSize

from ..cli.kit import invoke
from ..suite.processes import LIMIT
from .kit import Viewer
from .pages import opened, write

pytestmark = pytest.mark.xdist_group("light in the page of view")  # One server serves all.

Bytes = NDArray[np.int16]

SMALL = ViewportSize(width=330, height=420)
"""A window with few pixels for the picture, which the reference draws, too."""
NO_WEBGPU = "delete Navigator.prototype.gpu;"
BRIGHT = """
/// Light of all hues over the whole picture, up to eight times as bright as white.
material Bright {
    clip_position = vec4(2 * uv - 1, 0, 1)
    color = 8 * pow(uv.x, 3) * (0.6 + 0.4 * cos(6 * uv.y + vec3(0, 2, 4)))
}
"""
WALL = """
import std.terms.{ambient, lambert}
material Wall { color = ambient(#402010) + lambert(vec3(2, 0.6, 0.2)) }
"""
DARK = """
/// A grey that becomes brighter from left to right, by less than a hundredth.
material Dark {
    clip_position = vec4(2 * uv - 1, 0, 1)
    color = vec3(0.008 * uv.x)
}
"""


@pytest.fixture(params=["webgpu", "webgl2"])
def page(request: pytest.FixtureRequest, browser: Browser, viewer: Viewer) -> Iterator[Page]:
    write(viewer, BRIGHT)
    with browser.new_context(viewport=SMALL) as context:
        context.set_default_timeout(1000 * LIMIT)
        made = context.new_page()
        if request.param == "webgl2":
            made.add_init_script(NO_WEBGPU)
        yield opened(made, viewer, "?mesh=plane")


def saved(page: Page, folder: Path) -> Bytes:
    """The texels of the picture, as the page saves it."""
    page.wait_for_selector("body[data-ready=yes]")
    with page.expect_download() as download:
        page.locator("#save").click()
    download.value.save_as(folder / "saved.png")
    return pixels(folder / "saved.png")


def pixels(path: Path) -> Bytes:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"), np.int16)


def rendered(viewer: Viewer, like: Bytes, folder: Path, *options: str) -> Bytes:
    """The picture that the reference draws of the same file, in the same size."""
    file, size = viewer.said.with_suffix(".burnish"), f"{like.shape[1]}x{like.shape[0]}"
    whole = ("--mesh", "plane", "--samples", "4", "--size", size, *options)
    result = invoke("render", file, "-o", folder / "rendered.png", *whole)
    assert result.exit_code == 0, result.output
    return pixels(folder / "rendered.png")


def show(page: Page, viewer: Viewer, text: str, title: str) -> None:
    write(viewer, text)
    page.wait_for_selector(f"h2:has-text('{title}')")
    page.wait_for_selector("body[data-ready=yes]")


def choose(page: Page, exposure: str, tone: str) -> None:
    page.locator("[data-name='--exposure'] [type=number]").fill(exposure)
    page.locator("[data-name='--tone'] select").select_option(tone)


def test_the_picture_is_that_of_render(page: Page, viewer: Viewer, tmp_path: Path) -> None:
    cut = saved(page, tmp_path)
    assert np.abs(cut - rendered(viewer, cut, tmp_path)).max() <= 1
    choose(page, "1", "agx")
    mapped = saved(page, tmp_path)
    wanted = rendered(viewer, cut, tmp_path, "--exposure", "1", "--tone", "agx")
    assert np.abs(mapped - wanted).max() <= 1
    assert (cut == 255).mean() > 2 * (mapped == 255).mean()


def test_edges_are_smooth(page: Page, viewer: Viewer, tmp_path: Path) -> None:
    """As those of ``render`` with as many samples, but for samples that lie on an edge."""
    show(page, viewer, WALL, "Wall")
    found = saved(page, tmp_path)
    differs = np.abs(found - rendered(viewer, found, tmp_path)).max(axis=2) > 1
    assert differs.mean() < 0.003
    single = rendered(viewer, found, tmp_path, "--samples", "1")
    assert (np.abs(found - single).max(axis=2) > 1).mean() > 0.005


def test_dark_colours_have_no_bands_of_other_hues(
    page: Page, viewer: Viewer, tmp_path: Path
) -> None:
    """A grey stays one, and each byte follows the one before, also where it is brightened."""
    show(page, viewer, DARK, "Dark")
    for exposure in ("0", "3"):
        choose(page, exposure, "none")
        row = saved(page, tmp_path)[8]
        assert (row == row[:, :1]).all()
        assert set(np.diff(row[:, 0])) == {0, 1}
