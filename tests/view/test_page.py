"""The page of ``burnish view`` in a real browser: what a person does there, and what is seen."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Browser, Page

from ..suite.processes import until
from .kit import FLAT, Viewer
from .pages import BEHIND, NEAR, SIZE, Color, opened, pixel, shows, srgb, write

pytestmark = pytest.mark.xdist_group("page of view")  # One server and browser serve all.

FACING = """
/// Shows where surfaces look to.
material Facing {
    color = 0.5 + 0.5 * vec3(normal)
}
"""
EVOLVING = """
import std.frames.{FullScreen}

pass Grown : FullScreen {
    map before : texture2d with { filter = nearest, mip = none }
    target color : rgba16f = vec4(before(uv).r + 0.125)
}

/// It becomes brighter from frame to frame, and has a second output.
frame Brighter {
    grown = Grown(screen) with { before = previous(grown.color) }
    again = Grown(screen) with { before = grown.color }
    output picture  = grown.color
    output brighter = again.color
}
"""


def _of_normal(yaw: float, pitch: float) -> Color:
    """The colour of ``Facing`` in the middle of a sphere that is seen from there."""
    x, y, z = math.sin(yaw) * math.cos(pitch), math.sin(pitch), math.cos(yaw) * math.cos(pitch)
    return srgb(0.5 + 0.5 * x), srgb(0.5 + 0.5 * y), srgb(0.5 + 0.5 * z)


def test_controls_change_the_picture(page: Page) -> None:
    shows(page, (0xB5, 0x65, 0x1D))
    assert page.locator("h2").inner_text() == "Flat"
    assert page.locator("#doc").inner_text() == "One colour all over."
    level = page.locator("[data-name=level]")
    assert level.locator(".doc").inner_text() == "How much of it"
    number, slider = level.locator("[type=number]"), level.locator("[type=range]")
    assert (number.input_value(), number.get_attribute("max")) == ("1", "1")

    number.fill("0.25")
    # A quarter of 0.462 in linear light, and so on.
    shows(page, (srgb(0.25 * 0.46208), srgb(0.25 * 0.13014), srgb(0.25 * 0.01229)))
    assert slider.input_value() == "250"
    slider.press("Home")
    shows(page, (0, 0, 0))
    assert number.input_value() == "0"
    number.fill("7")
    shows(page, (0xB5, 0x65, 0x1D))  # No more than the range allows.
    number.blur()
    assert number.input_value() == "1"

    page.locator("[data-name=base] [type=color]").fill("#3399cc")
    shows(page, (0x33, 0x99, 0xCC))
    page.locator("[data-name=base] .reset").click()
    shows(page, (0xB5, 0x65, 0x1D))


def test_a_saved_file_is_drawn_with_what_was_set(page: Page, viewer: Viewer) -> None:
    shows(page, (0xB5, 0x65, 0x1D))
    number = page.locator("[data-name=level] [type=number]")
    number.fill("0.25")
    white = FLAT.replace("#b5651d", "#ffffff")
    write(viewer, white)
    shows(page, (srgb(0.25),) * 3)
    assert number.input_value() == "0.25"
    write(viewer, white.replace("base * level", "base").replace("param level", "// param"))
    shows(page, (255, 255, 255))
    assert number.count() == 0
    # It comes back with another range, in which the nearest value to what was set is 0.5.
    write(viewer, white.replace("0..1", "0.5..1"))
    shows(page, (srgb(0.5),) * 3)
    assert number.input_value() == "0.5"
    page.reload()
    shows(page, (srgb(0.5),) * 3)
    page.locator("#defaults").click()
    shows(page, (255, 255, 255))


def test_mistakes_are_shown_over_the_last_picture(
    browser: Browser, page: Page, viewer: Viewer
) -> None:
    shows(page, (0xB5, 0x65, 0x1D))
    problem = page.locator("#problem")
    assert problem.is_hidden()
    write(viewer, FLAT.replace("base * level", "base * levle"))
    problem.wait_for(state="visible")
    text = problem.inner_text()
    assert text.startswith("error[B0201]: unknown name `levle`\n")
    assert "= help: did you mean `level`?" in text
    assert page.locator("#problem .error").first.inner_text() == "error[B0201]"
    assert pixel(page, 0.5, 0.8) == pytest.approx((0xB5, 0x65, 0x1D), abs=NEAR)
    write(viewer, FLAT.replace("#b5651d", "#336699"))
    problem.wait_for(state="hidden")
    shows(page, (0x33, 0x66, 0x99))
    write(viewer, "material Flat {")
    problem.wait_for(state="visible")
    # Who opens the page now sees what is wrong, and then what is right.
    with browser.new_context(viewport=SIZE) as context:
        second = context.new_page()
        second.goto(viewer.address)
        second.locator("#problem").wait_for(state="visible")
        write(viewer, FLAT)
        second.locator("#problem").wait_for(state="hidden")
        for each in (page, second):
            shows(each, (0xB5, 0x65, 0x1D))


def test_the_camera(page: Page, viewer: Viewer) -> None:
    write(viewer, FACING)
    page.wait_for_selector("h2:has-text('Facing')")
    # The eye stands at (0.9, 0.8, 3), and what it sees in the middle looks to it.
    yaw, pitch = math.atan2(0.9, 3), math.asin(0.8 / math.hypot(0.9, 0.8, 3))
    shows(page, _of_normal(yaw, pitch))
    canvas = page.locator("#picture")
    box = canvas.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y - 20)
    page.mouse.up()
    turned = yaw - math.pi * 60 / box["height"], pitch - math.pi * 20 / box["height"]
    shows(page, _of_normal(*turned))

    canvas.press("ArrowRight")
    canvas.press("ArrowUp")
    step = math.radians(5)
    shows(page, _of_normal(turned[0] + step, turned[1] + step))
    canvas.press("h")
    shows(page, _of_normal(yaw, pitch))

    assert pixel(page, 0.5, 0.06) != BEHIND
    page.mouse.wheel(0, 800)
    shows(page, BEHIND, 0.5, 0.06)
    shows(page, _of_normal(yaw, pitch))
    page.keyboard.down("Shift")
    page.mouse.down()
    page.mouse.move(x, y + box["height"] / 2.2)
    page.mouse.up()
    page.keyboard.up("Shift")
    shows(page, BEHIND)


def test_frames_evolve_step_by_step(page: Page, viewer: Viewer) -> None:
    write(viewer, EVOLVING)
    page.wait_for_selector("h2:has-text('Brighter')")
    shows(page, (255, 255, 255))  # After eight frames, without anybody's doing.
    assert page.locator("#rate").inner_text().endswith(" fps")
    page.locator("#play").click()
    page.locator("#restart").click()
    shows(page, (srgb(0.125),) * 3)
    page.locator("#step").click()
    shows(page, (srgb(0.25),) * 3)
    page.locator("#output").select_option("brighter")
    shows(page, (srgb(0.375),) * 3)
    page.locator("#play").click()
    shows(page, (255, 255, 255))


def test_the_texts_of_the_shaders(page: Page, viewer: Viewer) -> None:
    shows(page, (0xB5, 0x65, 0x1D))
    page.locator("#open-texts").click()
    assert page.locator("#text-of option").all_inner_texts() == [
        "Flat · vertex", "Flat · fragment",
    ]  # fmt: skip
    text = page.locator("#text")
    assert "material.base * material.level" in text.inner_text()
    write(viewer, FLAT.replace("base * level", "base * level * uv.x"))
    until(lambda: "input.uv" in text.inner_text(), "the new text")
    page.keyboard.press("Escape")
    assert text.is_hidden()


def test_a_kernel_over_images(page: Page, viewer: Viewer) -> None:
    """Images of this format are drawn in WebGPU, and not stored."""
    write(viewer, """
        kernel Half {
            map source : texture2d
            bright = max(source.load(texel).r, 1)
            result half : image2d<r8>[source.size()] = if texel.x < 256 then 0.5 else bright
        }
    """)  # fmt: skip
    page.wait_for_selector("h2:has-text('Half')")
    shows(page, (srgb(0.5),) * 3, 0.25, 0.5)
    shows(page, (255, 255, 255), 0.75, 0.5)
    assert page.locator("#problem").is_hidden()
    said = page.locator("[data-name=source] .texture").inner_text()
    assert said.startswith("A picture")


def test_numbers_run_with_the_time(page: Page, viewer: Viewer) -> None:
    write(
        viewer, "material Wave { param time : float per frame = 0  color = vec3(step(0.5, time)) }"
    )
    page.wait_for_selector("h2:has-text('Wave')")
    shows(page, (0, 0, 0))
    clock = page.locator("[data-name=time] .clock")
    clock.click()
    shows(page, (255, 255, 255))  # After half a second.
    clock.click()
    page.locator("[data-name=time] .reset").click()
    shows(page, (0, 0, 0))
    assert page.locator("[data-name=time] [type=number]").input_value() == "0"


def test_choices_are_in_the_address(browser: Browser, page: Page, viewer: Viewer) -> None:
    write(viewer, FLAT + FACING)
    page.wait_for_selector("#subject", state="visible")
    page.locator("#subject").select_option("Facing")
    page.locator("#mesh").select_option("plane")
    shows(page, _of_normal(0, 0))  # A plane looks to +z.
    address = page.url.removeprefix(viewer.address)
    assert address == "?subject=Facing&mesh=plane"
    with browser.new_context(viewport=SIZE) as context:
        second = opened(context.new_page(), viewer, address)
        shows(second, _of_normal(0, 0))
        assert second.locator("#subject").input_value() == "Facing"
        shows(page, _of_normal(0, 0))


INHERITING = """
abstract material Shaded {
    param level : float in 0..1 = 1
    color = base * level
    base : rgb
}

material Painted : Shaded {
    param paint : rgb = #b5651d
    base = paint
}

material Plain : Shaded { base = #ffffff }
"""


def test_what_is_inherited_is_folded(page: Page, viewer: Viewer) -> None:
    write(viewer, INHERITING)
    page.wait_for_selector("h2:has-text('Painted')")
    shows(page, (0xB5, 0x65, 0x1D))
    own, inherited = page.locator("[data-name=paint]"), page.locator("[data-name=level]")
    assert (own.is_visible(), inherited.is_visible()) == (True, False)
    page.locator("summary:text-is('from Shaded')").click()
    inherited.locator("[type=number]").fill("0")
    shows(page, (0, 0, 0))
    write(viewer, INHERITING.replace("#b5651d", "#336699"))
    until(lambda: own.locator(".code").inner_text() == "#336699", "the new default")
    assert inherited.is_visible(), "what was opened stays open"
    page.locator("#subject").select_option("Plain")
    page.wait_for_selector("h2:has-text('Plain')")
    assert inherited.is_visible(), "it is all that there is"


NO_WEBGPU = "delete Navigator.prototype.gpu;"


def test_browsers_without_webgpu_draw_with_webgl_2(browser: Browser, viewer: Viewer) -> None:
    write(viewer, FLAT)
    with browser.new_context(viewport=SIZE) as context:
        page = context.new_page()
        page.add_init_script(NO_WEBGPU)
        opened(page, viewer)
        assert page.locator("#api").inner_text() == "WebGL 2"
        shows(page, (0xB5, 0x65, 0x1D))
        page.locator("[data-name=level] [type=number]").fill("0.25")
        shows(page, (srgb(0.25 * 0.46208), srgb(0.25 * 0.13014), srgb(0.25 * 0.01229)))
        write(viewer, FLAT.replace("#b5651d", "#ffffff"))
        shows(page, (srgb(0.25),) * 3)


@pytest.mark.parametrize("script", ["", NO_WEBGPU], ids=["webgpu", "webgl2"])
def test_the_upper_side_is_up(browser: Browser, viewer: Viewer, script: str) -> None:
    """Texts for WebGL 2 draw the bottom row of a material's picture first."""
    write(viewer, FACING)
    with browser.new_context(viewport=SIZE) as context:
        page = context.new_page()
        page.add_init_script(script)
        opened(page, viewer, "?mesh=sphere")
        until(lambda: pixel(page) != BEHIND, "a sphere")
        (_, upper, _), (_, lower, _) = pixel(page, 0.5, 0.2), pixel(page, 0.5, 0.8)
        assert upper > lower + 50


def test_a_browser_that_cannot_draw(browser: Browser, viewer: Viewer) -> None:
    write(viewer, FLAT)
    with browser.new_context(viewport=SIZE) as context:
        page = context.new_page()
        page.add_init_script(f"{NO_WEBGPU} OffscreenCanvas.prototype.getContext = () => null")
        page.goto(viewer.address)
        page.locator("#problem").wait_for(state="visible")
        said = page.locator("#problem").inner_text()
    assert said == (
        "This browser offers nothing that this page can draw with: WebGPU, WebGL 2. A newer one "
        "may, such as Chrome 113, Edge 113, Safari 26 or Firefox 141."
    )


def test_pictures_are_saved(page: Page, tmp_path: Path) -> None:
    shows(page, (0xB5, 0x65, 0x1D))
    with page.expect_download() as download:
        page.locator("#save").click()
    assert download.value.suggested_filename == "Flat.png"
    download.value.save_as(tmp_path / "saved.png")
    with Image.open(tmp_path / "saved.png") as image:
        box = page.locator("#picture").bounding_box()
        assert box is not None
        assert image.size == (round(box["width"]), round(box["height"]))
        middle = image.convert("RGB").getpixel((image.width // 2, image.height // 2))
    assert middle == pytest.approx((0xB5, 0x65, 0x1D), abs=NEAR)
