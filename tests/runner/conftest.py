"""One worker of each Vulkan driver for all tests of this folder."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .vulkan_kit import Asker


@pytest.fixture(scope="session", params=["lavapipe", "swiftshader"])
def vulkan(request: pytest.FixtureRequest) -> Iterator[Asker]:
    """A Vulkan driver. ``make test`` has installed both, so a missing one is a failure."""
    asker = Asker(request.param)
    yield asker
    asker.close()
