"""Fixtures of this folder: the workers of the Vulkan drivers, and an instance to set values of."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from burnish import Instance

from .instance_kit import REFLECTION
from .vulkan_kit import Asker


@pytest.fixture(scope="session", params=["lavapipe", "swiftshader"])
def vulkan(request: pytest.FixtureRequest) -> Iterator[Asker]:
    """A Vulkan driver. ``make test`` installs both, so a missing one fails the test."""
    asker = Asker(request.param)
    yield asker
    asker.close()


@pytest.fixture
def instance() -> Instance:
    """An instance of the material with a parameter of every kind."""
    return Instance(REFLECTION)
