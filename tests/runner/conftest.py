"""Fixtures of this folder: the workers of drivers, and an instance to set values of."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from burnish import Instance

from . import textual_kit
from .frame_kit import Driver
from .instance_kit import REFLECTION
from .vulkan_kit import Asker


@pytest.fixture(scope="session", params=["lavapipe", "swiftshader"])
def vulkan(request: pytest.FixtureRequest) -> Iterator[Asker]:
    """A Vulkan driver. ``make test`` installs both, so a missing one fails the test."""
    asker = Asker(request.param)
    yield asker
    asker.close()


@pytest.fixture(scope="session", params=["lavapipe", "swiftshader", "opengl"])
def driver(request: pytest.FixtureRequest) -> Iterator[Driver]:
    """A driver that draws frames."""
    if request.param == "opengl":
        asker = textual_kit.Asker("opengl")
        yield Driver("opengl", asker)
        asker.close()
    else:
        other = Asker(request.param)
        yield Driver("vulkan", other)
        other.close()


@pytest.fixture
def instance() -> Instance:
    """An instance of the material with a parameter of every kind."""
    return Instance(REFLECTION)
