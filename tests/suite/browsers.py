"""Starts Chromium for tests that look at pages as people see them, and serves pages from a folder.

The driver of the package has a browser of its own (``targets/runner/drivers/browser``), which runs
jobs and shows nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

from playwright.sync_api import Browser, Page, Route, sync_playwright

from burnish.targets.runner.drivers.browser.chromium import CANVAS_FLAGS, launch
from burnish.targets.toolchain.tools import tool_named

from .processes import LIMIT

_TYPES = {
    ".js": "text/javascript", ".json": "application/json", ".html": "text/html",
    ".bin": "application/octet-stream",
}  # fmt: skip


@contextmanager
def browser() -> Iterator[Browser]:
    """A browser for as long as the block runs, whose canvases show what WebGPU draws."""
    paths = tool_named("chromium").find()
    assert paths is not None
    with sync_playwright() as playwright:
        started, _ = launch(playwright, paths[0], CANVAS_FLAGS)
        yield started
        started.close()


def serve(page: Page, folder: Path) -> None:
    """Answer all that a page asks for with the files of a folder, under any address."""

    def answer(route: Route) -> None:
        path = folder / (urlsplit(route.request.url).path.removeprefix("/") or "index.html")
        if path.is_file():
            route.fulfill(body=path.read_bytes(), content_type=_TYPES[path.suffix])
        else:
            route.fulfill(status=404)

    page.set_default_timeout(1000 * LIMIT)
    page.route("**/*", answer)
