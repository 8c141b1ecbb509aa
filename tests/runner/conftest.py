"""The workers of the Vulkan drivers that all tests of this folder share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .vulkan_kit import Asker


@pytest.fixture(scope="session", params=["lavapipe", "swiftshader"])
def vulkan(request: pytest.FixtureRequest) -> Iterator[Asker]:
    """A Vulkan driver. ``make test`` installs both, so a missing one fails the test."""
    asker = Asker(request.param)
    yield asker
    asker.close()
