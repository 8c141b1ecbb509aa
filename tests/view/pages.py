"""The actions of tests in the page of ``burnish view``, and the colours of its picture.

``conftest.py`` has the browser, the server and the page.
"""

from __future__ import annotations

import io
import math

from PIL import Image
from playwright.sync_api import Page, ViewportSize

from ..suite.processes import until
from .kit import Viewer

SIZE = ViewportSize(width=900, height=500)
BEHIND = (0x1B, 0x1D, 0x21)
"""The colour behind a material."""
NEAR = 3
"""The largest error of a lane of a pixel, of 255."""

Color = tuple[int, int, int]


def opened(page: Page, viewer: Viewer, query: str = "") -> Page:
    wrong: list[str] = []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.on("console", lambda said: wrong.append(said.text) if said.type == "error" else None)
    page.goto(f"{viewer.address}{query}")
    page.wait_for_selector("body[data-ready]")
    assert not wrong
    return page


def write(viewer: Viewer, text: str) -> None:
    viewer.said.with_suffix(".burnish").write_text(text)


def pixel(page: Page, right: float = 0.5, down: float = 0.5) -> Color:
    """A pixel of the picture, by shares of its sides."""
    with Image.open(io.BytesIO(page.locator("#picture").screenshot())) as image:
        found = image.convert("RGB").getpixel((int(right * image.width), int(down * image.height)))
    assert isinstance(found, tuple)
    return found[0], found[1], found[2]


def shows(page: Page, color: Color, right: float = 0.5, down: float = 0.5) -> None:
    """Wait until a pixel has a colour."""

    def is_there() -> bool:
        found = pixel(page, right, down)
        return all(abs(a - b) <= NEAR for a, b in zip(found, color, strict=True))

    until(is_there, f"a pixel of the colour {color}")


def srgb(linear: float) -> int:
    """The sRGB byte of a number in linear light."""
    return round(255 * (1.055 * math.pow(linear, 1 / 2.4) - 0.055))
