"""A browser and a server for all tests of a module, and a page for each of them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page

from ..suite import browsers
from ..suite.processes import LIMIT
from .kit import FLAT, Viewer, viewing
from .pages import SIZE, opened, write


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with browsers.browser() as browser:
        yield browser


@pytest.fixture(scope="module")
def viewer(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Viewer]:
    file = tmp_path_factory.mktemp("page") / "shown.burnish"
    file.write_text(FLAT)
    with viewing(file) as viewer:
        yield viewer


@pytest.fixture
def page(browser: Browser, viewer: Viewer) -> Iterator[Page]:
    """A page of its own, with nothing that others have set."""
    write(viewer, FLAT)
    with browser.new_context(viewport=SIZE) as context:
        context.set_default_timeout(1000 * LIMIT)
        yield opened(context.new_page(), viewer)
