"""A headless Chromium with one page, which cannot reach any network.

The browser belongs to Playwright's driver process. This module ends the browser and removes its
folders when Burnish's process has ended, in whatever way.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import partial
from importlib.abc import Traversable
from importlib.resources import files
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from playwright.sync_api import Browser, Error, Playwright, Route, sync_playwright

from ....toolchain.tools import tool_named
from ....toolchain.versions import refuses_sandbox
from ....web_host.serving.modules import host_modules
from ..device import DriverError

# Only a page with a secure origin may use WebGPU. This address is never requested from the network,
# because `_serve` answers.
PAGE = "https://burnish.invalid/"
HOST = "host/"
"""The path at which the page finds the modules of the host for web pages."""
START_LIMIT = 50_000.0
"""The milliseconds that the browser may take to start; it is slow on a busy machine."""

FLAGS = (
    "--enable-unsafe-webgpu",
    # Use the software renderer even if there is a GPU, so that pictures are the same everywhere.
    "--use-webgpu-adapter=swiftshader",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    # Turn off the requests that a browser sends by itself.
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
)

_NO_HOME = dict.fromkeys(("HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME"), os.devnull)
"""Variables that name a folder that cannot exist: the browser keeps nothing, and has none of the
user's settings."""

CANVAS_FLAGS = ("--enable-features=Vulkan", "--use-vulkan=swiftshader")
"""Further flags: without a GPU, a canvas needs them to show what WebGPU draws to it."""


def launch(
    playwright: Playwright, program: Path, further: Sequence[str] = ()
) -> tuple[Browser, bool]:
    """Start a browser; the second result is True if the browser has its sandbox.

    Where the system forbids the parts of the sandbox, as many containers do, the browser ends at
    once, and is started without. Raises ``Error``.
    """

    def start(*, sandbox: bool) -> Browser:
        return playwright.chromium.launch(
            executable_path=program, headless=True, args=(*FLAGS, *further),
            timeout=START_LIMIT, chromium_sandbox=sandbox, env={**os.environ, **_NO_HOME},
        )  # fmt: skip

    if not refuses_sandbox():
        with suppress(Error):
            return start(sandbox=True), True
    return start(sandbox=False), False


class Chromium:
    """A browser whose page has loaded a module."""

    def __init__(self, module: str, folder: Traversable | None = None) -> None:
        """Start the browser. ``folder`` has the module; by default it is one of this package's.

        Raises ``DriverError``.
        """
        paths = tool_named("chromium").find()
        if paths is None:
            install = tool_named("chromium").install
            raise DriverError(f"chromium is missing; to install it: {install}")
        self._playwright = sync_playwright().start()
        try:
            self._browser, sandboxed = launch(self._playwright, paths[0])
            self._page = self._browser.new_page()
            own = folder or files(__package__)
            self._page.route("**/*", partial(_serve, own, host_modules()))
            self._page.goto(PAGE, timeout=START_LIMIT)
            self._module = self._page.evaluate_handle("module => import(module)", f"./{module}")
        except Error as error:
            self._playwright.stop()
            raise DriverError(f"chromium does not start: {error.message}") from None
        self.version = self._browser.version + ("" if sandboxed else ", without its sandbox")

    def call(self, function: str, argument: str) -> Mapping[str, Any]:
        """The result of a function of the module. Raises ``DriverError`` if the page is lost."""
        try:
            answer: Mapping[str, Any] = self._page.evaluate(
                "([module, name, argument]) => module[name](JSON.parse(argument))",
                [self._module, function, argument],
            )
        except Error as error:
            raise DriverError(f"chromium: {error.message}") from None
        return answer

    def close(self) -> None:
        """End the browser."""
        self._playwright.stop()


def _serve(folder: Traversable, host: Mapping[str, str], route: Route) -> None:
    """Answer the page's requests with an empty page, with a module of the folder, or with one of
    the host's."""
    name = urlsplit(route.request.url).path.removeprefix("/")
    if not name:
        route.fulfill(body="<!doctype html>", content_type="text/html")
    elif name.startswith(HOST) and name.removeprefix(HOST) in host:
        route.fulfill(body=host[name.removeprefix(HOST)], content_type="text/javascript")
    elif name.endswith(".mjs"):
        module = folder.joinpath(name)
        route.fulfill(body=module.read_text(), content_type="text/javascript")
    else:
        route.fulfill(status=404)
