"""The time from a saved file to the new picture in the page of ``burnish view``.

A file is written again and again, each time with another constant, so that its shader is new to
everybody. The clock starts before the file is written, and stops when the browser is about to show
the frame behind the first picture that was drawn of it. ``server`` is the part that ends when the
page has the new package. These are times by the clock: on a busy machine they say little.
"""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from statistics import median

from playwright.sync_api import Page

from ..suite import browsers
from ..view.kit import viewing
from .table import Row, Section

EXAMPLES = Path(__file__).parents[2] / "examples"
FILES = {
    "plastic.burnish": ("base * albedo", "base * 0.{:02} * albedo"),
    "frames/glow.burnish": ("24 * uv.y", "24.{:02} * uv.y"),
}
"""The files that are shown, each with the text around a constant that the changes are made to."""
ROUNDS = 8
AIM = 300
SIZE = {"width": 900, "height": 600}

_WATCH = """() => {
  const body = document.body;
  new MutationObserver(() => requestAnimationFrame(() => requestAnimationFrame(() => {
    body.dataset.seen = `${body.dataset.version} ${Date.now()}`;
  }))).observe(body, { attributes: true, attributeFilter: ["data-version"] });
  const ask = window.fetch;
  window.fetch = async (...given) => {
    const answer = await ask(...given);
    const text = await answer.text();
    body.dataset.got = Date.now();
    return new Response(text, answer);
  };
}"""
"""Has the page note when a version was shown, and when its package came."""


def measure() -> Iterator[Section]:
    """A row for each file."""
    with browsers.browser() as browser:
        context = browser.new_context(viewport=SIZE)  # type: ignore[arg-type]
        rows = [_row(name, context.new_page()) for name in FILES]
    yield Section("view", "Milliseconds by the clock from a saved file to its picture", rows)


def _row(name: str, page: Page) -> Row:
    old, new = FILES[name]
    text = (EXAMPLES / name).read_text("utf-8")
    assert old in text, f"{name} has no {old}"
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree((EXAMPLES / name).parent, folder, dirs_exist_ok=True)
        file = Path(folder) / Path(name).name
        with viewing(file) as viewer:
            page.goto(viewer.address)
            page.wait_for_selector("body[data-ready=yes]")
            page.evaluate(_WATCH)
            found = [_one(page, file, text.replace(old, new.format(n + 16))) for n in range(ROUNDS)]
    whole, server = zip(*found, strict=True)
    return {
        "file": name, "median": median(whole), "least": min(whole), "server": median(server),
        "aim": AIM, "within": median(whole) <= AIM,
    }  # fmt: skip


def _one(page: Page, file: Path, text: str) -> tuple[float, float]:
    version = page.locator("body").get_attribute("data-version")
    began = 1000 * time.time()
    file.write_text(text, "utf-8")
    seen = f"body[data-seen]:not([data-seen^='{version} ']):not([data-version='{version}'])"
    body = page.wait_for_selector(seen)
    assert body is not None
    shown, at = (body.get_attribute("data-seen") or "").split()
    assert shown == body.get_attribute("data-version"), "a picture of another version"
    assert page.locator("body").get_attribute("data-ready") == "yes"
    return float(at) - began, float(body.get_attribute("data-got") or 0) - began
