"""The outputs in the page of ``burnish view``: pictures of any size, and buffers."""

from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Browser, Page

from ..suite.processes import until
from .kit import Viewer
from .pages import SIZE, Color, opened, pixel, shows, write

pytestmark = pytest.mark.xdist_group("view of outputs")  # One server and browser serve all.

OUTPUTS = """
import std.frames.{FullScreen}

pass Halves : FullScreen {
    target color : rgba8 = if uv.x < 0.5 then vec4(1, 0, 0, 1) else vec4(0, 0, 1, 1)
}

struct Spark { place : vec3  age : float  hot : bool }

kernel Sparks {
    param count : int in 0..8 = 3
    result sparks : Spark[count] = Spark(vec3(float(index), 0.5, 0), 0.25 * float(index), index > 1)
}

frame Outputs {
    halves = Halves(screen, ivec2(4, 2))
    flying = Sparks()
    output tiny   = halves.color
    output sparks = flying.sparks
}
"""
RED: Color = (255, 0, 0)
BLUE: Color = (0, 0, 255)


def show(page: Page, viewer: Viewer) -> None:
    write(viewer, OUTPUTS)
    page.wait_for_selector("h2:has-text('Outputs')")


def test_a_picture_of_another_size_keeps_its_shape(page: Page, viewer: Viewer) -> None:
    """The picture's pixels are shown unchanged, without gaps, with room above and below."""
    show(page, viewer)
    shows(page, RED, 0.49)
    box = page.locator("#picture").bounding_box()
    assert box is not None
    wide, high = box["width"], box["height"]
    assert wide < 2 * high, "the place is not as wide as the picture"
    assert pixel(page, 0.505) == BLUE
    border = (1 - wide / 2 / high) / 2
    assert pixel(page, 0.25, border + 0.02) == RED
    assert pixel(page, 0.25, 1 - border - 0.02) == RED
    assert RED != pixel(page, 0.25, border - 0.02) != BLUE
    size, times = page.locator("#size").inner_text().split(" at ")
    assert size == "4 × 2"
    assert float(times.rstrip("×")) == pytest.approx(wide / 4, rel=0.05)


def test_it_is_saved_as_it_is(page: Page, viewer: Viewer, tmp_path: Path) -> None:
    show(page, viewer)
    shows(page, RED, 0.49)
    with page.expect_download() as download:
        page.locator("#save").click()
    download.value.save_as(tmp_path / "saved.png")
    with Image.open(tmp_path / "saved.png") as image:
        assert image.size == (4, 2)
        assert image.convert("RGB").getpixel((3, 1)) == BLUE


def test_the_elements_of_a_buffer(browser: Browser, page: Page, viewer: Viewer) -> None:
    show(page, viewer)
    page.locator("#output").select_option("sparks")
    rows = page.locator("#elements tr")
    until(lambda: rows.count() == 4, "a row for each element")
    assert [row.split() for row in rows.all_inner_texts()] == [
        ["#", "place", "age", "hot"],
        ["0", "0,", "0.5,", "0", "0", "false"],
        ["1", "1,", "0.5,", "0", "0.25", "false"],
        ["2", "2,", "0.5,", "0", "0.5", "true"],
    ]
    assert page.locator("#elements-about").inner_text() == "3 × Spark, 32 bytes each"
    assert not page.locator("#picture").is_visible()
    plot = page.locator("#plot")
    assert plot.get_attribute("aria-label") == "Points in space: place"
    points = plot.screenshot()
    page.locator("#column").select_option("age")
    until(lambda: plot.get_attribute("aria-label") == "Values in order: age", "another plot")
    assert plot.screenshot() != points

    page.locator("[data-name=count] [type=number]").fill("0")
    until(lambda: "No elements" in page.locator("#elements-about").inner_text(), "an empty buffer")
    assert not page.locator("#elements").is_visible()
    page.locator("[data-name=count] [type=number]").fill("2")
    until(lambda: rows.count() == 3, "two elements")
    # The address says which output it is.
    with browser.new_context(viewport=SIZE) as context:
        second = opened(context.new_page(), viewer, page.url.removeprefix(viewer.address))
        assert second.locator("#output").input_value() == "sparks"
        until(lambda: second.locator("#elements tr").count() == 4, "the same output")
    page.locator("#output").select_option("tiny")
    shows(page, RED, 0.49)
    assert not page.locator("#buffer").is_visible()


CAPTURED = """
pass Corners { capture position : vec3 = 2 * position  capture weight : float = 1 }
material Any { color = vec3(1) }
"""


def test_captured_vertices(page: Page, viewer: Viewer) -> None:
    """A cube has twelve triangles, and so 36 corners at eight places."""
    write(viewer, CAPTURED)
    page.wait_for_selector("h2:has-text('Any')")
    page.locator("#mesh").select_option("cube")
    rows = page.locator("#elements tbody tr")
    until(lambda: rows.count() == 36, "the corners of a cube")
    assert page.locator("#elements-about").inner_text().startswith("36 × vertex")
    found = [row.replace(",", "").split()[1:] for row in rows.all_inner_texts()]
    assert {weight for *_place, weight in found} == {"1"}
    places = {tuple(map(float, place)) for *place, _weight in found}
    side = max(map(max, places))
    assert places == {
        (x, y, z) for x in (-side, side) for y in (-side, side) for z in (-side, side)
    }
